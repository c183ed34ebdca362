"""Sweeps as tests make them: small plans, and the command as a process to be disturbed."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.commands import environment
from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.sweep import build
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.plan import SweepPlan

DIFFERENTIAL = Transmission(
    3,
    [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    [Mechanism(1, 2, 3, -2.5, 0.96, name="D")],
    [Gear([1], name="direct"), Gear([2], name="low")],
)
"""Its low gear has the ratio 1 - u and the efficiency (1 - u eta)/(1 - u), u = D.ratio."""
CASE_TEXT = """\
links: 3
shift_elements: {C: [1, 2], B: [2, housing]}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears: {direct: {engaged: [C]}, low: {engaged: [B]}}
"""
"""The same."""


def plan(
    *vary: str, piece: int | None = None, case: Transmission = DIFFERENTIAL, **more: Any
) -> SweepPlan:
    """A plan from texts as on the command line; `piece` is the size of a piece."""
    made = build.plan(case, SweepOptions.of(vary=vary, **more))
    return made if piece is None else made.__class__(**{**vars(made), "piece": piece})


def begin(*arguments: object, cwd: Path, before: Callable[[], None] | None = None) -> Any:
    """Start ``vstatics sweep`` in a session of its own, which can be killed as a whole."""
    return subprocess.Popen(
        [sys.executable, "-m", "vstatics", "sweep", *map(str, arguments)],
        cwd=cwd,
        env=environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=before,  # noqa: PLW1509 (there are no threads here)
    )


def end(process: Any) -> tuple[int, str]:
    """Exit status and stderr."""
    said = process.communicate(timeout=120)[1]
    return process.returncode, said


def finished(parts: Path) -> list[str]:
    """Names of the finished pieces in a directory."""
    return [name for name in names(parts) if name.isdigit()]


def names(folder: Path) -> list[str]:
    """What is in a folder."""
    return sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []


def wait_for(condition: Callable[[], object], seconds: float = 60) -> None:
    """Wait until something is so."""
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit, "it never happened"
        time.sleep(0.01)


def children(process: int) -> list[int]:
    """The processes that a process has started."""
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                text = (folder / "stat").read_text(encoding="utf-8")
            except OSError:
                continue
            if int(text.rpartition(")")[2].split()[1]) == process:
                found.append(int(folder.name))
    return sorted(found)
