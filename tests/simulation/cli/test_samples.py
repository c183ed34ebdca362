"""`vstatics simulate --samples` and `vstatics sweep SCENARIO` as commands: files, errors."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from tests.commands import vstatics
from tests.core.cli.test_schemas import validator
from tests.simulation.variants.scenarios import CASE, SCENARIO
from tests.simulation.variants.states import write_scenario

LOCKS = 0.410054006
"""tarasik.md, section 4."""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    write_scenario(folder)


def samples(*options: object) -> str:
    said = vstatics("simulate", "lock.yaml", "--samples", 5, "--jobs", 1, "-q", *options)
    assert said.is_without_messages()
    return said.out


def test_statistics_fit_a_terminal_and_json_has_them() -> None:
    shown = samples("--seed", 3)
    assert max(map(len, shown.splitlines())) <= 80
    assert "Drawn, 5 runs" in shown
    assert "Results, 5 runs" in shown
    found = json.loads(samples("--seed", 3, "-f", "json"))
    assert list(validator("samples").iter_errors(found)) == []
    assert list(found["drawn"]) == ["controls.brake.scale", "torques.sun"]
    assert {"abs(peaks)[brake]", "heat[brake]", "locks[brake]", "work"} <= set(found["results"])
    assert 'heat["lock-up"]' not in found["results"]  # 0 in all runs


def test_the_runs_are_written_and_give_the_same_statistics() -> None:
    options = ("--seed", 3, "--out", "locks[brake]")
    found = json.loads(samples(*options, "-f", "json"))["results"]["locks[brake]"]
    shown = samples(*options, "-o", "runs.npz")
    times = np.load("runs.npz")["locks[brake]"]
    assert len(times) == 5
    assert found["mean"] == pytest.approx(times.mean(), rel=1e-12)
    assert found["deviation"] == pytest.approx(times.std(ddof=1), rel=1e-12)
    assert found["quantiles"]["50%"] == pytest.approx(float(np.median(times)), rel=1e-12)
    assert f"{times.mean():.3f}".lstrip("0") in shown
    samples(*options, "-o", "runs.csv")
    rows = csv.DictReader(Path("runs.csv").read_text("utf-8").splitlines())
    assert [float(row["locks[brake]"]) for row in rows] == pytest.approx(times, rel=1e-11)


def test_wrong_use_of_samples() -> None:
    for options, said in (
        (["--seed", "1"], "--seed belongs to --samples."),
        (
            ["--samples", "3", "--time-step", ".1"],
            "--time-step applies to a single run: leave out --samples.",
        ),
        (["--samples", "3", "-o", "out.md"], "--samples writes .csv .jsonl .ndjson .npz .parquet"),
        (["--samples", "3", "--resume"], "--resume needs the output of the stopped run"),
        (["--out", "jerks"], "--out asks for columns over time: expected -o with .csv .json"),
        (["--out", "jerks", "--method", "tarasik"], "--out is for the method `events`."),
        (["--samples", "0"], "0 is not in the range"),
    ):
        shown = vstatics("simulate", "lock.yaml", *options)
        assert shown.is_wrong_use(said)
        assert not Path("out.md").exists()


def test_runs_that_cannot_be_are_counted() -> None:
    text = SCENARIO.replace(b"{normal: [1, 0.05]}", b"{uniform: [-1, -0.5]}")
    Path("lock.yaml").write_bytes(text)
    shown = vstatics("simulate", "lock.yaml", "--samples", 3, "--jobs", 1)
    assert shown.gives_nothing("3 runs, of which 3 invalid", "expected a scale of 0 or more")
    shown = vstatics("sweep", "lock.yaml", "--vary", "duration=-1,-2", "--out", "work")
    assert shown.fails("2 rows of 2 variants (2 invalid)", "duration: read -1, expected a time ab")


def test_a_sample_of_what_there_is_not_is_reported_without_samples_too() -> None:
    Path("lock.yaml").write_bytes(SCENARIO.replace(b"torques.sun:", b"torques.son:"))
    for command in ("simulate", "check"):
        shown = vstatics(command, "lock.yaml")
        assert shown.status == 1
        assert "lock.yaml:11:3: error: samples: torques: read 'son', expected" in shown.all
        assert "did you mean `sun`?" in shown.all


def test_a_sweep_takes_a_scenario() -> None:
    swept = ("sweep", "lock.yaml", "-q", "--vary", "controls.brake.1.2=100:140:3")
    said = vstatics(*swept, "--out", "locks[brake]", "--min", "abs(locks[brake]-.41)", "--best", 1)
    assert said.is_without_messages()
    heads, row = csv.reader(said.out.splitlines())
    assert heads == ["variant", "controls.brake.1.2", "status", "locks[brake]"]
    assert row[:3] == ["1", "120", "ok"]
    assert float(row[3]) == pytest.approx(LOCKS, abs=5e-10)
    said = vstatics(*swept, "--dry-run")
    assert said.status == 0
    assert "heat[brake]" in said.out


@pytest.mark.slow
def test_two_processes_give_what_one_gives() -> None:
    vary = ("--vary", "controls.brake.scale=.8:1.2:9", "--vary", "torques.sun=35,45,40")
    swept = ("sweep", "lock.yaml", "-q", *vary, "--out", "heat[brake]")
    one, two = (vstatics(*swept, "--jobs", jobs) for jobs in (1, 2))
    assert (one.status, one.err, len(one.out.splitlines())) == (0, "", 28)
    assert two == one


def test_mistakes_in_a_sweep_of_a_scenario() -> None:
    vary = ["--vary", "duration=1,2"]
    for options, status, said in (
        (["--vary", "duratio=1,2"], 1, "has a key `duratio`; did you mean `duration`?"),
        ([*vary, "--out", "gears"], 1, "a run has no table `gears`"),
        ([*vary, "--coast"], 2, "--coast is for a case"),
        ([*vary, "-o", "set.yaml"], 2, "cannot determine the format of set.yaml"),
    ):
        shown = vstatics("sweep", "lock.yaml", *options)
        assert (shown.status, shown.out) == (status, "")
        assert said in shown.err
        assert Path("set.yaml").read_bytes() == CASE


LIGHT = b"""\
links: [a, b, c]
inertias: {a: 1, c: 1}
springs: {ab: {links: [a, b], stiffness: 100}, bc: {links: [b, c], stiffness: 100}}
"""
JUMP = b"""\
case: light.yaml
duration: 0.2
start: {speeds: {a: 0}}
torques: {b: [[0, 0], [0.1, 0], [0.1, 10]]}
"""


def test_a_warning_of_a_run_makes_a_strict_sweep_fail() -> None:
    """A link without inertia, on which a torque jumps; by 0 N*m it does not."""
    Path("light.yaml").write_bytes(LIGHT)
    Path("jump.yaml").write_bytes(JUMP)
    swept = ("sweep", "jump.yaml", "--vary", "torques.b.3.2=0,10,20", "--out", "work")
    said = vstatics(*swept, "--strict")
    assert "jump.yaml: warning: in 2 of 3 variants, the first is 1: link b has no" in said.err
    assert (said.status, len(said.out.splitlines())) == (1, 4)
    assert vstatics(*swept).status == 0
    assert "1 warning (W602), so --strict fails" in vstatics(*swept, "--strict", "-q").err
    allowed = vstatics(*swept, "--strict", "--allow", "W602")
    assert (allowed.status, "link b" in allowed.err) == (0, False)
    text = JUMP + b"samples: {torques.b.3.2: {normal: [10, 0]}}\n"
    Path("jump.yaml").write_bytes(text)
    drawn = vstatics("simulate", "jump.yaml", "--samples", 3, "--jobs", 1, "--out", "work")
    assert "jump.yaml: warning: in all 3 variants: link b has no" in drawn.err
