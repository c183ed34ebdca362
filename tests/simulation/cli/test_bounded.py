"""Runs that would take hours: they say so, stop when they shall, and leave what they have.

A mass of 1 kg*m^2 on 100 N*m/rad swings 1.6 times a second, for 1e9 s.
"""

import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import environment, json_file, vstatics
from vstatics import VariedScenario
from vstatics.core.cli.shared import progress
from vstatics.simulation import bounds, load_scenario, simulate
from vstatics.simulation.cli import documents

CASE = """\
links: [m, n]
inertias: {m: 1, n: 1}
springs: {k: {links: [m, housing], stiffness: 100}}
"""
SCENARIO = "{case: mass.yaml, duration: DURATION, start: {speeds: {m: 1, n: 0}}}"
LONG, SHORT = "1e9", "2"


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "mass.yaml").write_text(CASE, "utf-8")
    for name, duration in (("long.yaml", LONG), ("short.yaml", SHORT)):
        (folder / name).write_text(SCENARIO.replace("DURATION", duration), "utf-8")


def document() -> Any:
    return json_file(Path("out.json"))


def is_right(found: Any) -> None:
    """What was calculated is the swing cos 10 t rad/s."""
    times = np.array(found["time"])
    assert len(times) > 100
    assert found["speeds"]["m"] == pytest.approx(np.cos(10 * times), abs=1e-6)


def test_a_limit_ends_a_run_with_what_was_calculated() -> None:
    said = vstatics("simulate", "long.yaml", "--limit", "0.1", "-o", "out.json")
    assert said.fails("--limit 0.1 s")
    found = document()
    assert "--limit 0.1 s" in found["stopped"]
    is_right(found)


@pytest.mark.parametrize("limit", ["0", "-1", "nan"])
def test_a_limit_is_above_0(limit: str) -> None:
    for command in (("simulate",), ("sweep", "--vary", "duration=1,2")):
        assert vstatics(*command, "short.yaml", "--limit", limit).status == 2
    published = ("--method", "tarasik", "--limit", "1")
    assert vstatics("simulate", "short.yaml", *published).status == 2


def test_a_row_of_a_sweep_is_stopped_and_the_next_goes_on() -> None:
    vary = ("--vary", "duration=1,1e9,2", "--out", "peaks[k]")
    said = vstatics("sweep", "short.yaml", *vary, "--limit", "0.3")
    assert said.status == 0
    rows = [line.split(",")[2:] for line in said.out.splitlines()[1:]]
    assert [row[0] for row in rows] == ["ok", "stopped", "ok"]
    assert rows[1][1] == ""
    assert abs(float(rows[2][1])) == pytest.approx(10)  # sqrt(k J) w
    assert said.err.count("\n") == 1  # the summary
    assert vstatics("sweep", "mass.yaml", "--vary", "inertia.m=1,2", "--limit", "1").status == 2


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("sweep long.yaml --vary duration=2e9 --out work", "variants: 0 % after a second\n"),
        ("simulate long.yaml -o out.json", " left\n"),
        ("simulate few.yaml --samples 1 --out work", "runs: 0 % after a second\n"),
        (
            "sweep long.yaml --vary duration=2e9 --out work --jobs 2 -o out.csv",
            "variants: 0 % after a second\n",
        ),
    ],
)
def test_long_runs_say_how_far_they_are(
    command: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where no run has ended yet, and with several processes; with -q nothing is said."""
    assert progress.FIRST_WORD < 10
    monkeypatch.setattr(progress, "FIRST_WORD", 0.05)
    few = ", samples: {duration: {uniform: [1e9, 2e9]}}}"
    Path("few.yaml").write_text(SCENARIO.replace("DURATION", LONG)[:-1] + few, "utf-8")
    shown = vstatics(*command.split(), "--limit", "0.2").err
    assert said in shown
    assert " % after " in shown
    assert " % after " not in vstatics(*command.split(), "--limit", "0.06", "-q").err


def test_check_tells_a_run_of_hours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(documents, "TRIED", 0.2)
    said = vstatics("check", "long.yaml")
    assert said.status == 0
    assert "note: duration: the run takes long" in said.err
    assert "--limit" in said.err
    assert vstatics("check", "short.yaml").err == ""


def test_what_is_needed_follows_from_the_pace(monkeypatch: pytest.MonkeyPatch) -> None:
    """20 s of a run take a second, so 1000 s take 50, however long it was until the first step."""
    clock = 0.0
    monkeypatch.setattr(time, "process_time", lambda: clock)
    pace, at = bounds.Pace(1000, 1), 0.0
    clock = 7.0
    while not pace(at):
        clock, at = clock + 0.1, at + 2
    assert 20 <= at <= 22
    assert pace.needed == pytest.approx(50)


def test_waiting_for_the_processor_is_no_pace_and_what_ended_needs_no_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """An hour passes by the clock between two of the first steps."""
    pace = bounds.Pace(2, 600)
    assert simulate(load_scenario("short.yaml"), watch=pace).stopped is None
    assert pace.needed == 0
    hours = iter(range(9))
    monkeypatch.setattr(time, "monotonic", lambda: 3600.0 * next(hours))
    pace = bounds.Pace(1, 1)
    assert [pace(at) for at in (0.0, 1e-12, 2e-12)] == ["", "", ""]
    assert pace.needed == 0


@pytest.mark.slow
def test_ctrl_c_leaves_what_was_calculated() -> None:
    """It comes after the first word of the run, which comes within 10 s."""
    command = [sys.executable, "-m", "vstatics", "simulate", "long.yaml", "-o", "out.json"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, env=environment()) as process:
        try:
            assert process.stderr is not None
            assert b" % after " in process.stderr.readline()
            process.send_signal(signal.SIGINT)
            _, said = process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode == 130
    assert b"Ctrl-C" in said
    assert b"Traceback" not in said
    found = document()
    assert "Ctrl-C" in found["stopped"]
    is_right(found)


def test_a_dry_run_takes_as_many_runs_whatever_the_count(monkeypatch: pytest.MonkeyPatch) -> None:
    runs = []
    run = VariedScenario.run

    def counted(self: VariedScenario, *numbers: Any) -> Any:
        runs.append(numbers)
        return run(self, *numbers)

    monkeypatch.setattr(VariedScenario, "run", counted)
    counts = []
    for count in ("100", "1000000"):
        runs.clear()
        vary = ("--vary", f"start.speeds.m=1:2:{count}", "--out", "work")
        said = vstatics("sweep", "short.yaml", *vary, "--dry-run")
        assert said.status == 0
        assert f"variants  {count}\n" in said.out
        counts.append(len(runs))
    assert counts[0] == counts[1] < 20
