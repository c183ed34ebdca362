"""What ratios the teeth can make, and which are of use where the teeth are too many to list.

Only teeth with an error up to some limit are listed then: the limit grows from the least error
that any ratios could have, until enough teeth are found. All below it are known by then.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.numerics.arrays import Floats
from vstatics.synthesis.ratios.problem import reach_text, sign_fault
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.rows import TeethRows
from vstatics.synthesis.teeth.table import TeethTable
from vstatics.synthesis.teeth.targets import TeethTarget, least_errors
from vstatics.synthesis.tolerances import FIRST_ERROR_LIMIT, MET_ERROR, NARROW_WINDOW


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
        if ends and (wrong := sign_fault(target.name, target.wanted, ends)):
            problems.append(Problem(wrong, ("ratios", target.name)))
    if problems:
        raise CaseError(problems)


def reach_doubts(problem: TeethProblem, low: Floats, high: Floats) -> Iterator[str]:
    """Which wanted ratios no ratios of the elements between two ends come to, in words.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth.finding import find_teeth
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


MOST_WINDOWS = 4096
"""The ranges of ratios are halved until so many parts of them are left."""
LARGEST_ERROR_LIMIT = 20.0
"""Larger limits of errors are none."""
HALVINGS = 30


def ends_by_ranges(rows: TeethRows) -> tuple[Floats, Floats]:
    """The least and largest ratios that the ranges of teeth alone allow [-]."""
    low, high = [], []
    for ratio in rows.layout.ratios:
        sizes = [1.0, 1.0]
        for wheel, power in ratio.powers.items():
            ends = sorted(max(float(end), 1.0) ** power for end in rows.ends(wheel))
            sizes = [size * end for size, end in zip(sizes, ends, strict=True)]
        first, second = sorted(ratio.sign * size for size in sizes)
        low.append(first)
        high.append(second)
    return np.array(low), np.array(high)


def narrowed(
    targets: Sequence[TeethTarget], low: Floats, high: Floats, most: float
) -> tuple[Floats, Floats] | None:
    """Ranges of all ratios outside which every error is above `most`; None where all are.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from vstatics.synthesis.ratios.formula import GearFormula
    >>> formula = GearFormula("ratio", {1: Fraction(1)}, {0: Fraction(1)})
    >>> target = TeethTarget("P", -3.0, formula, {0: 0}, "absolute")
    >>> ends = narrowed([target], np.array([-8.0]), np.array([-1.0]), 0.5)
    >>> bool(-3.6 < ends[0][0] <= -3.5), narrowed([target], *ends, 0.5) is not None
    (True, True)
    >>> narrowed([target], np.array([-8.0]), np.array([-4.0]), 0.5)
    """
    low, high = low[np.newaxis], high[np.newaxis]
    while len(low) <= MOST_WINDOWS:
        widths = np.abs(np.log(high / low))
        if widths.max() <= NARROW_WINDOW:
            break
        widest = (np.arange(len(low)), widths.argmax(axis=1))
        middle = np.sign(low[widest]) * np.sqrt(low[widest] * high[widest])
        upper, lower = low.copy(), high.copy()
        upper[widest], lower[widest] = middle, middle
        low, high = np.concatenate([low, upper]), np.concatenate([lower, high])
        kept = least_errors(targets, low, high) <= most
        if not kept.any():
            return None
        low, high = low[kept], high[kept]
    return low.min(axis=0), high.max(axis=0)


def least_possible(targets: Sequence[TeethTarget], low: Floats, high: Floats) -> float:
    """An error that no ratios within bounds are below [-]."""
    least, most = 0.0, LARGEST_ERROR_LIMIT
    if narrowed(targets, low, high, most) is None:
        return most
    for _ in range(HALVINGS):
        middle = (least + most) / 2
        if narrowed(targets, low, high, middle) is None:
            least = middle
        else:
            most = middle
    return least


def growing_limits(least: float) -> Iterator[float]:
    """Limits of errors to be tried in turn, from the least possible one; the last one is none.

    >>> [round(limit, 6) for limit in growing_limits(0.5)][:3]
    [0.50001, 0.50004, 0.50016]
    """
    more = FIRST_ERROR_LIMIT
    while least + more < LARGEST_ERROR_LIMIT:
        yield least + more
        more *= 4
    yield math.inf
