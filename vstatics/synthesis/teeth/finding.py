"""Integer tooth numbers for wanted ratios of gears or gear sets, as in `vstatics synth teeth`.

If a gear set has too many possible tooth numbers to list, only tooth numbers whose error is below a
limit are listed. The limit starts at the smallest error that any real ratios can have, and grows
until enough solutions are found. Then all solutions below the limit are known.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem, listed
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.ratios.problem import Advance, reach_text, sign_fault, untold
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.limits import COAXIAL, TeethLimits
from vstatics.synthesis.teeth.problem import TeethProblem, teeth_problem
from vstatics.synthesis.teeth.rows import LOOKED, TeethRows
from vstatics.synthesis.teeth.search import (
    MOST_TEETH_SOLUTIONS,
    BestTeeth,
    best_teeth,
    different_teeth,
)
from vstatics.synthesis.teeth.solutions import TeethSolution, teeth_solutions
from vstatics.synthesis.teeth.table import TeethTable, teeth_table
from vstatics.synthesis.teeth.targets import TeethError, TeethTarget, least_errors
from vstatics.synthesis.tolerances import (
    FIRST_ERROR_LIMIT,
    MET_ERROR,
    NARROW_WINDOW,
    ROUNDED_ERROR,
    TOLD_ERROR,
)


def reach(rows: Sequence[TeethRows], tables: Sequence[TeethTable | None]) -> tuple[Floats, Floats]:
    """Return the smallest and largest possible ratios of all gear sets [-].

    Without a table, the ranges of the tooth numbers bound the ratios of a gear set.
    """
    ends = [
        ends_by_ranges(gear_set) if table is None else (table.low[0], table.high[0])
        for gear_set, table in zip(rows, tables, strict=True)
    ]
    low, high = map(np.concatenate, zip(*ends, strict=True))
    return low, high


def range_doubts(problem: TeethProblem, low: Floats, high: Floats) -> Iterator[str]:
    """Yield messages on ranges of tooth numbers that exclude a target, or all targets together.

    The message names a ratio as limiting if the smallest error is at an end of its range.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> find_teeth(case, {"1": 20.0}).doubts
    ['gear 1 cannot have 20: within the bounds its ratio is 2.576 to 8.118']

    If gear 2 has its wanted ratio, gear 1 needs a ratio -1.5 of P, which is outside the default
    ranges:

    >>> sets = [Mechanism(1, 2, 3, -2.5, name="P"), Mechanism(3, 4, 5, -2.5, name="Q")]
    >>> gears = [Gear([1, 2], name="1"), Gear([2, 3], name="2")]
    >>> case = Transmission(5, [ShiftElement(2), ShiftElement(4), ShiftElement(1, 2)], sets, gears)
    >>> [doubt] = find_teeth(case, {"1": 2.5 * 3.6, "2": 3.6}).doubts
    >>> doubt.partition("; ")[2]
    'at the end of its range is P (-7.118 to -1.576): wider ranges can help'
    """
    gears = {gear.name for gear in problem.links.case.gears}
    is_excluded = False
    for target in problem.targets:
        reached = target.ends(low[np.newaxis], high[np.newaxis])
        least = float(target.least(low[np.newaxis], high[np.newaxis])[0])
        if reached is not None and least > MET_ERROR:
            is_excluded = True
            name = f"gear {target.name}" if target.name in gears else target.name
            yield f"{name} cannot have {target.wanted:g}: {reach_text(*reached)}"
    if is_excluded or narrowed(problem.targets, low, high, TOLD_ERROR) is not None:
        return
    least = least_possible(problem.targets, low, high)
    ends = narrowed(problem.targets, low, high, least * (1 + NARROW_WINDOW) + NARROW_WINDOW)
    if ends is None:
        return
    names = [ratio.name for layout in problem.layouts for ratio in layout.ratios]
    at_end = [
        f"{name} ({first:.4g} to {last:.4g})"
        for name, first, last, needed in zip(names, low, high, zip(*ends, strict=True), strict=True)
        if (first == needed[0]) != (last == needed[1])
    ]
    if at_end:
        yield (
            "within the bounds no ratios meet all wanted ratios together, the error is at least "
            f"{least:.3g}; at the end of "
            f"{'its range is' if len(at_end) == 1 else 'their ranges are'} "
            f"{listed(at_end)}: wider ranges can help"
        )


def doubts_before(problem: TeethProblem) -> Iterator[str]:
    """Yield the messages of `range_doubts` from the ranges alone, before any search."""
    rows = [TeethRows(layout, problem.limits) for layout in problem.layouts]
    yield from range_doubts(problem, *reach(rows, [None] * len(rows)))


MOST_WINDOWS = 4096
"""Largest number of ranges into which the ranges of ratios are divided by halving."""
LARGEST_ERROR_LIMIT = 20.0
"""Largest finite limit of errors; the next limit is infinite. [-]"""
HALVINGS = 30
"""Number of bisection steps for the smallest possible error."""


def ends_by_ranges(rows: TeethRows) -> tuple[Floats, Floats]:
    """Return the smallest and largest ratios that the ranges of tooth numbers permit [-]."""
    bounds = []
    for ratio in rows.layout.ratios:
        sizes = [1.0, 1.0]
        for wheel, power in ratio.powers.items():
            ends = sorted(max(float(end), 1.0) ** power for end in rows.ends(wheel))
            sizes = [size * end for size, end in zip(sizes, ends, strict=True)]
        bounds.append(sorted(ratio.sign * size for size in sizes))
    low, high = np.array(bounds).T
    return low, high


def narrowed(
    targets: Sequence[TeethTarget], low: Floats, high: Floats, most: float
) -> tuple[Floats, Floats] | None:
    """Return narrower ranges of ratios that contain all errors up to `most`.

    Return None if the ranges are empty.

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
        possible = least_errors(targets, low, high) <= most
        if not possible.any():
            return None
        low, high = low[possible], high[possible]
    return low.min(axis=0), high.max(axis=0)


def least_possible(targets: Sequence[TeethTarget], low: Floats, high: Floats) -> float:
    """Return a lower bound of the error of all ratios within bounds [-]."""
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
    """Yield limits of errors to try in turn, from the smallest possible error to infinity.

    >>> [round(limit, 6) for limit in growing_limits(0.5)][:3]
    [0.50001, 0.50004, 0.50016]
    """
    more = FIRST_ERROR_LIMIT
    while least + more < LARGEST_ERROR_LIMIT:
        yield least + more
        more *= 4
    yield math.inf


MOST_LISTED_CANDIDATES = 8_000_000
"""Number of candidates above which only useful ratios of a gear set are listed."""


class NoTeethError(CaseError):
    """Error if no tooth numbers of a gear set satisfy all conditions."""


class FoundTeeth(NamedTuple):
    """Best tooth numbers, and whether they are proven to be the best."""

    solutions: Sequence[TeethSolution]
    """Different tooth numbers by ascending error; with equal errors, small tooth numbers first."""
    problem: TeethProblem
    tables: Sequence[TeethTable]
    bound: float
    """Lower bound of the error of all tooth numbers that are not listed. [-]"""
    is_proven: bool
    """True if no other tooth numbers are better than the last solution."""
    doubts: Sequence[str]
    """Messages on wanted ratios that no tooth numbers can meet."""


@refusing()
def find_teeth(
    case: Transmission,
    ratios: Mapping[str, float],
    limits: TeethLimits | None = None,
    *,
    error: TeethError = "ln",
    advance: Advance = untold,
) -> FoundTeeth:
    """Find integer tooth numbers for which ratios of gears or gear sets are nearest to targets.

    Parameters
    ----------
    case : Transmission
        Gearbox; only the signs of its present ratios matter.
    ratios : mapping of str to float
        Wanted ratio by the name of a gear, or of a gear set or one of its mechanisms. [-]
    limits : TeethLimits, optional
        Ranges and further requirements.
    error : {"ln", "absolute"}
        Kind of error, whose largest value over all targets is minimised.
    advance : callable
        Function that is called with the number of further finished regions of the search.

    Returns
    -------
    FoundTeeth
        Solutions, the best first, and whether better solutions are excluded.

    Raises
    ------
    NoTeethError
        If no tooth numbers satisfy the conditions; the message names the condition that excludes
        most.
    CaseError
        If the problem cannot be solved; the path of each problem begins with the option.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = find_teeth(case, {"1": 3.6})
    >>> best = found.solutions[0]
    >>> dict(best.teeth["D1"]), best.error < 1e-12, found.is_proven
    ({'sun': 25, 'ring': 65, 'planet': 20}, True, True)
    """
    problem = teeth_problem(case, ratios, limits or TeethLimits(), error)
    rows = [TeethRows(layout, problem.limits) for layout in problem.layouts]
    tables: list[TeethTable | None] = []
    for gear_set in rows:
        tables.append(_whole_table(gear_set))
        advance(1)
    full = [table for table in tables if table is not None]
    ends = low, high = reach(rows, tables)
    problems = []
    for target in problem.targets:
        reached = target.ends(low[np.newaxis], high[np.newaxis])
        if reached and (wrong := sign_fault(target.name, target.wanted, reached)):
            problems.append(Problem("E833", wrong, ("ratios", target.name)))
    if problems:
        raise CaseError(problems)
    if len(full) == len(tables):
        best = best_teeth(full, problem.targets, advance=advance)
    else:
        full, best = _by_limits(problem, rows, tables, ends, advance)
    solutions = [*teeth_solutions(problem, full, best)]
    last = solutions[-1].error if solutions else math.inf
    is_proven = best.bound >= last * (1 - ROUNDED_ERROR) - ROUNDED_ERROR
    doubts = [*range_doubts(problem, *ends)]
    return FoundTeeth(solutions, problem, full, best.bound, is_proven, doubts)


def _whole_table(rows: TeethRows) -> TeethTable | None:
    """Return the table of all tooth numbers of a gear set.

    Return None if there are too many.

    Raises
    ------
    NoTeethError
        If no tooth numbers satisfy the conditions.
    """
    excluded: Counter[str] = Counter()
    table = teeth_table(rows.layout, rows.pieces({}, excluded, MOST_LISTED_CANDIDATES), rows.counts)
    if not table.is_whole:
        return None
    if not table.total:
        raise NoTeethError([none_fits(rows.layout, excluded)])
    return table


def none_fits(layout: TeethLayout, excluded: Counter[str]) -> Problem:
    """Return the problem that no tooth numbers fit, with the condition that excludes most.

    Axes coincide only for few tooth numbers, so this condition is named only if no other condition
    excludes any.
    """
    message = f"no teeth of {layout.name} fulfil all conditions"
    left = {label: count for label, count in excluded.items() if count and label != LOOKED}
    on_one_axis = {label: count for label, count in left.items() if label != COAXIAL}
    left = on_one_axis or left
    if left:
        label = max(left, key=lambda name: left[name])
        of = "" if label == COAXIAL else f" ({left[label]} of {sum(left.values())})"
        message += f"; most are excluded by: {label}{of}"
    return Problem("E834", message)


def _by_limits(
    problem: TeethProblem,
    rows: Sequence[TeethRows],
    tables: Sequence[TeethTable | None],
    ends: tuple[Floats, Floats],
    advance: Advance,
) -> tuple[list[TeethTable], BestTeeth]:
    """Return tables and the best tooth numbers, if there are too many candidates to list.

    Only candidates with an error below a limit are listed, and the limit grows. If too many are
    below a limit, as many as possible are examined.

    Raises
    ------
    CaseError
        If no tooth numbers are found.
    """
    targets = problem.targets
    proven = least_possible(targets, *ends)
    best = None
    excluded: Counter[str] = Counter()
    for most in growing_limits(proven):
        between = narrowed(targets, *ends, most)
        if between is None:
            continue
        listed = list(_in_windows(rows, tables, between, excluded))
        is_whole = all(table.is_whole for table in listed)
        if all(table.total for table in listed):
            within = most if is_whole else math.inf
            result = best_teeth(listed, targets, most=within, advance=advance)
            if len(result.errors) and (is_whole or best is None):
                best = (
                    listed,
                    result._replace(bound=min(result.bound, most if is_whole else proven)),
                )
            if different_teeth(listed, result.places).sum() >= MOST_TEETH_SOLUTIONS:
                break
        if not is_whole:
            break
        proven = most
    if best is not None:
        return best
    first = tables.index(None)
    if is_whole:
        raise NoTeethError([none_fits(rows[first].layout, excluded)])
    message = f"{rows[first].layout.name}: the ranges contain too many tooth numbers to examine"
    hint = "expected narrower ranges, or fewer numbers of planets or modules"
    raise CaseError("E835", f"{message}; {hint}", ("range",))


def _in_windows(
    rows: Sequence[TeethRows],
    tables: Sequence[TeethTable | None],
    between: tuple[Floats, Floats],
    excluded: Counter[str],
) -> Iterator[TeethTable]:
    """Yield the tables of all gear sets, limited to useful ratios if otherwise too large."""
    sizes = iter(np.sort(np.abs(between), axis=0).T.tolist())
    for gear_set, table in zip(rows, tables, strict=True):
        useful = islice(sizes, len(gear_set.layout.ratios))
        windows = dict(enumerate(useful))
        if table is None:
            yield teeth_table(gear_set.layout, gear_set.pieces(windows, excluded), gear_set.counts)
        else:
            yield table
