"""Work that is killed at random moments and resumed: nothing is lost or mixed up.

``pytest tests/core/cli/test_killed.py --kills 200 -s`` tries it more often, and tells how often.
"""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.chance import seeded
from tests.commands import MZKT, environment
from tests.core.cli.states import RECORD
from tests.installed import HERE, needs
from tests.processes import children, names

pytestmark = [pytest.mark.slow, pytest.mark.alone]

GRID = "--vary D.ratio=-4:-2:500 --vary D.efficiency=.9:1:800"
"""400000 variants in 7 pieces."""
CASES = 150
BRAKES = "--vary controls.brake.scale=.9:1.2:200 --out locks[brake],heat[brake]"
BOXES = "--sets 3 --shift-elements 5 --engaged 2 --ratios 4.584,2.964,1.912,1.446,1,.746,-2.94"
"""Nine pieces of a second or less."""


class Work(NamedTuple):
    """What is done, and disturbed."""

    line: str
    output: str


OF_CASES = {
    f"run {form} -j {jobs}": Work(f"run --files-from list -f {form} -j {jobs}", "out/")
    for form in ("json", "listing")
    for jobs in "123"
}
OF_VARIANTS = {
    **{
        f"sweep {form} -j {jobs}": Work(f"sweep box.yaml {GRID} -j {jobs}", f"out.{form}")
        for form in ("csv", "jsonl", "npz", "parquet")
        for jobs in "12"
    },
    "sweep best": Work(f"sweep box.yaml {GRID} --max ratio[low]", "out.csv"),
    "sweep where": Work(f"sweep box.yaml {GRID} --where ratio[low]>4", "out.npz"),
}
WORKS = {
    "cases and sweeps": {**OF_CASES, **(OF_VARIANTS if "sweep" in HERE else {})},
    "samples": {
        f"{form} -j {jobs}": Work(f"simulate lock.yaml --samples 200 -j {jobs}", f"out.{form}")
        for form, jobs in (("csv", "1"), ("csv", "2"), ("npz", "2"))
    },
    "sweeps of scenarios": {
        "all": Work(f"sweep lock.yaml {BRAKES}", "out.jsonl"),
        "best": Work(f"sweep lock.yaml {BRAKES} --min heat[brake]", "out.csv"),
    },
    "boxes": {
        "a file": Work(f"synth box {BOXES} -j 2", "out.json"),
        "a folder": Work(f"synth box {BOXES} -j 1", "out/"),
    },
}
ANNEX = {"samples": "simulation", "sweeps of scenarios": "simulation", "boxes": "synthesis"}
"""Annex that work of a kind needs."""


def prepare(folder: Path) -> None:
    """A folder with the cases, which differ in a number."""
    folder.mkdir()
    if "sweep" in HERE:
        from tests.sweep.sweeps import CASE_TEXT

        (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
    if "simulation" in HERE:
        from tests.simulation.variants.states import write_scenario

        write_scenario(folder)
    text = MZKT.read_text("utf-8")
    assert ".9500Е+00" in text
    for number in range(CASES):
        varied = text.replace(".9500Е+00", f".9{number:03}Е+00")
        (folder / f"case{number}.dat").write_text(varied, "utf-8")
    (folder / "list").write_text("".join(f"case{n}.dat\n" for n in range(CASES)), "utf-8")


def end(process: subprocess.Popen[bytes]) -> tuple[int, str]:
    said = process.communicate(timeout=120)[1].decode()
    assert "Traceback" not in said
    assert "an error of vstatics" not in said
    return process.returncode, said


def begin(work: Work, folder: Path, *more: str) -> subprocess.Popen[bytes]:
    line = [sys.executable, "-m", "vstatics", *work.line.split(), "-o", work.output, *more]
    none, pipe = subprocess.DEVNULL, subprocess.PIPE
    return subprocess.Popen(
        line, cwd=folder, env=environment(), stdout=none, stderr=pipe, start_new_session=True
    )


def made(work: Work, folder: Path) -> dict[str, bytes]:
    """All that was written, but for what tells of the run."""
    output = folder / work.output
    files = [path for path in output.iterdir() if path.name[0] != "."] if output.is_dir() else []
    return {path.name: path.read_bytes() for path in files or [output]}


def left(folder: Path) -> list[str]:
    """What lies about in the folders that should not; hashes of boxes are kept, as runs are."""
    inner = [name for name in names(folder / "out") if name.startswith(".vstatics")]
    return [
        name
        for name in [*names(folder), *inner]
        if name.endswith(".parts")
        or (name.startswith(".vstatics") and "-run-" not in name and name != RECORD)
    ]


def kill_a_worker(process: subprocess.Popen[bytes]) -> None:
    """Or the process itself, where it works alone."""
    os.kill([*children(process.pid), process.pid][0], signal.SIGKILL)


WAYS: dict[str, tuple[Callable[[subprocess.Popen[bytes]], None], tuple[int, ...]]] = {
    "killed, all of it": (lambda run: os.killpg(run.pid, signal.SIGKILL), (-9,)),
    "killed, the parent": (subprocess.Popen.kill, (-9,)),
    "killed, a worker": (kill_a_worker, (0, -9)),
    "Ctrl-C": (lambda run: os.killpg(run.pid, signal.SIGINT), (130,)),  # as a terminal does
    # a program that is being imported has nothing to keep
    "SIGTERM": (subprocess.Popen.terminate, (143, -15)),
}
"""Ways to stop a process, and its exit status then."""


def whole(work: Work, folder: Path) -> tuple[dict[str, bytes], float]:
    """What undisturbed work gives, and how long it takes [s]."""
    prepare(folder)
    began = time.monotonic()
    status, said = end(begin(work, folder))
    assert status == 0, said
    assert left(folder) == []
    return made(work, folder), time.monotonic() - began


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=needs(*ANNEX.get(kind, "").split())) for kind in WORKS]
)
def test_work_that_is_killed_and_resumed_is_that_of_undisturbed_work(
    kind: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """Up to three times in a row, then it is let alone; the bytes are the same."""
    kills = int(request.config.getoption("--kills"))
    choose = seeded(kills)
    told: Counter[str] = Counter()
    undisturbed: dict[str, tuple[dict[str, bytes], float]] = {}
    while sum(told[way] for way in WAYS) < kills:
        name = choose.choice(list(WORKS[kind]))
        work = WORKS[kind][name]
        if name not in undisturbed:
            undisturbed[name] = whole(work, tmp_path / f"whole {len(undisturbed)}")
        expected, seconds = undisturbed[name]
        folder = tmp_path / str(told.total())
        prepare(folder)
        for _ in range(choose.randint(1, 3)):
            way = choose.choice(list(WAYS))
            stop, statuses = WAYS[way]
            running = begin(work, folder, "--resume")
            time.sleep(choose.uniform(0.3, seconds))  # Python itself has started by then
            ended = running.poll() is not None
            if not ended:
                stop(running)
            status, said = end(running)
            assert status in (0, *statuses), (name, way, said)
            told[way if not ended and status in statuses else "it had ended before"] += 1
        running = begin(work, folder, "--resume")
        status, said = end(running)
        assert (status, "failed" in said) == (0, False), (name, said)
        assert made(work, folder) == expected, name
        assert left(folder) == []
        told["resumed to the end, the same bytes"] += 1
        told[name] += 1
    print(dict(told))  # noqa: T201
