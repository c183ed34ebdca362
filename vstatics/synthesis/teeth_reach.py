"""What ratios the teeth can make: those of another sign are refused, those beyond are told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.numerics.arrays import Floats
from vstatics.synthesis.fit_problem import reach_text
from vstatics.synthesis.teeth_problem import TeethProblem
from vstatics.synthesis.teeth_rows import TeethRows
from vstatics.synthesis.teeth_table import TeethTable
from vstatics.synthesis.teeth_windows import ends_by_ranges

MET_ERROR = 1e-9
"""An error of no more is rounding."""


def reach(rows: Sequence[TeethRows], tables: Sequence[TeethTable | None]) -> tuple[Floats, Floats]:
    """The least and largest ratios of all elements; by the ranges where no table tells them [-]."""
    ends = [
        ends_by_ranges(one) if table is None else (table.low[0], table.high[0])
        for one, table in zip(rows, tables, strict=True)
    ]
    return np.concatenate([low for low, _ in ends]), np.concatenate([high for _, high in ends])


def refuse_signs(problem: TeethProblem, low: Floats, high: Floats) -> None:
    """Refuse what has the other sign than all that the teeth can make.

    Raises
    ------
    CaseError
    """
    problems = []
    for target in problem.targets:
        ends = target.ends(low[np.newaxis], high[np.newaxis])
        if ends and (ends[1] <= 0 < target.wanted or target.wanted < 0 <= ends[0]):
            side = "below" if target.wanted > 0 else "above"
            read = f"{target.name}: read {target.wanted:g}, but {reach_text(*ends)}"
            message = f"{read}: expected a ratio {side} 0"
            problems.append(Problem(message, ("ratios", target.name)))
    if problems:
        raise CaseError(problems)


def reach_doubts(problem: TeethProblem, low: Floats, high: Floats) -> Iterator[str]:
    """Which wanted ratios no ratios of the elements between two ends come to, in words.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> find_teeth(case, {"1": 20.0}).doubts
    ["gear 1 can't have 20: within the bounds its ratio is 2.576 to 8.118"]
    """
    gears = {gear.name for gear in problem.own.case.gears}
    for target in problem.targets:
        ends = target.ends(low[np.newaxis], high[np.newaxis])
        least = float(target.least(low[np.newaxis], high[np.newaxis])[0])
        if ends is not None and least > MET_ERROR:
            name = f"gear {target.name}" if target.name in gears else target.name
            yield f"{name} can't have {target.wanted:g}: {reach_text(*ends)}"


def doubts_before(problem: TeethProblem) -> Iterator[str]:
    """The same by the ranges alone, before any teeth are looked for."""
    rows = [TeethRows(layout, problem.limits) for layout in problem.layouts]
    yield from reach_doubts(problem, *reach(rows, [None] * len(rows)))
