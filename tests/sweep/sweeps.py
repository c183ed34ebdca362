"""Sweeps as tests make them: small plans, and the command as a process to be disturbed."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import environment
from tests.processes import names
from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.steps import Steps
from vstatics.sweep import build
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.variants.numbered import Variants
from vstatics.sweep.variants.targets import Target
from vstatics.sweep.variants.variation import Span, Variation

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
    return made if piece is None else replace(made, piece=piece)


def small_pieces(monkeypatch: pytest.MonkeyPatch, size: int = 8) -> None:
    whole = build.plan
    monkeypatch.setattr(build, "plan", lambda *of: replace(whole(*of), piece=size))


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


def finished(parts: Path) -> list[str]:
    return [name for name in names(parts) if name.isdigit()]


SETS = Mechanism(1, 2, 3, -2.5), Mechanism(3, 4, 5, -2.0, name="D.2=x")
CASE = Transmission(7, [], [*SETS, Mechanism(5, 6, 7, -3.0, name="1")], [Gear()])


def variations(*lists: list[float] | Steps | Span) -> list[Variation]:
    """Variations of any numbers; targets may be any here."""
    return [
        Variation(
            Target(f"D{number}.ratio", number - 1, "ratio"),
            np.array(values, float) if isinstance(values, list) else values,
        )
        for number, values in enumerate(lists, 1)
    ]


def in_parts(variants: Variants, cuts: list[int]) -> Floats:
    """All blocks between cuts, asked for from the last to the first."""
    ends = sorted({0, variants.count, *(cut % (variants.count + 1) for cut in cuts)})
    blocks = [variants.block(*two) for two in reversed(list(pairwise(ends)))]
    return np.concatenate([np.empty((0, len(variants.targets))), *blocks[::-1]])
