"""Integer teeth for wanted ratios of gears or sets, as `vstatics synth teeth` finds them.

Where the teeth of an element are too many to list, only those with an error up to some limit are:
it grows from the least error that any ratios could have, until enough teeth are found. All below
it are known by then.
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
    """The least and largest ratios of all elements; by the ranges where no table tells them [-]."""
    ends = [
        ends_by_ranges(one) if table is None else (table.low[0], table.high[0])
        for one, table in zip(rows, tables, strict=True)
    ]
    low, high = map(np.concatenate, zip(*ends, strict=True))
    return low, high


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
            problems.append(Problem("E833", wrong, ("ratios", target.name)))
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


def range_doubts(problem: TeethProblem, low: Floats, high: Floats) -> Iterator[str]:
    """What the ranges of teeth stand in the way of, in words: of one wish, else of all together.

    A ratio is at its end where none that differs has so small an error.

    Examples
    --------
    With gear 2 met gear 1 needs a ratio of P of -1.5, which the default ranges don't come to:

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> sets = [Mechanism(1, 2, 3, -2.5, name="P"), Mechanism(3, 4, 5, -2.5, name="Q")]
    >>> gears = [Gear([1, 2], name="1"), Gear([2, 3], name="2")]
    >>> case = Transmission(5, [ShiftElement(2), ShiftElement(4), ShiftElement(1, 2)], sets, gears)
    >>> [told] = find_teeth(case, {"1": 2.5 * 3.6, "2": 3.6}).doubts
    >>> told.partition("; ")[2]
    'at its end is P (-7.118 to -1.576): wider ranges may help'
    """
    alone = [*reach_doubts(problem, low, high)]
    yield from alone
    if alone or (least := least_possible(problem.targets, low, high)) <= TOLD_ERROR:
        return
    ends = narrowed(problem.targets, low, high, least * (1 + NARROW_WINDOW) + NARROW_WINDOW)
    if ends is None:
        return
    names = [ratio.name for layout in problem.layouts for ratio in layout.ratios]
    at_end = [
        f"{name} ({first:.4g} to {last:.4g})"
        for name, first, last, own in zip(names, low, high, zip(*ends, strict=True), strict=True)
        if (first == own[0]) != (last == own[1])
    ]
    if at_end:
        yield (
            "within the bounds no ratios come to all that is wanted, the error is "
            f"{least:.3g} at least; at {'its end is' if len(at_end) == 1 else 'their ends are'} "
            f"{listed(at_end)}: wider ranges may help"
        )


def doubts_before(problem: TeethProblem) -> Iterator[str]:
    """The same by the ranges alone, before any teeth are looked for."""
    rows = [TeethRows(layout, problem.limits) for layout in problem.layouts]
    yield from range_doubts(problem, *reach(rows, [None] * len(rows)))


MOST_WINDOWS = 4096
"""The ranges of ratios are halved until so many parts of them are left."""
LARGEST_ERROR_LIMIT = 20.0
"""Larger limits of errors are none."""
HALVINGS = 30


def ends_by_ranges(rows: TeethRows) -> tuple[Floats, Floats]:
    """The least and largest ratios that the ranges of teeth alone allow [-]."""
    found = []
    for ratio in rows.layout.ratios:
        sizes = [1.0, 1.0]
        for wheel, power in ratio.powers.items():
            ends = sorted(max(float(end), 1.0) ** power for end in rows.ends(wheel))
            sizes = [size * end for size, end in zip(sizes, ends, strict=True)]
        found.append(sorted(ratio.sign * size for size in sizes))
    low, high = np.array(found).T
    return low, high


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


MOST_LISTED_CANDIDATES = 8_000_000
"""An element with more candidates has only those listed whose ratios are of use."""


class NoTeethError(CaseError):
    """No teeth of an element fulfil all conditions."""


class FoundTeeth(NamedTuple):
    """The best teeth, and what is proven of them."""

    solutions: Sequence[TeethSolution]
    """Each with other teeth, in the order of the error; the smaller first where it is equal."""
    problem: TeethProblem
    tables: Sequence[TeethTable]
    bound: float
    """All other teeth have an error that is no smaller [-]."""
    is_proven: bool
    """Whether no others are better than the last of the solutions."""
    doubts: Sequence[str]
    """Ratios that no teeth come to, in words."""


@refusing()
def find_teeth(
    case: Transmission,
    ratios: Mapping[str, float],
    limits: TeethLimits | None = None,
    *,
    error: TeethError = "ln",
    advance: Advance = untold,
) -> FoundTeeth:
    """Integer teeth with which gears, or elements, have ratios as near as may be to those wanted.

    Parameters
    ----------
    case : Transmission
        The teeth and ratios that it has do not matter, but for their signs.
    ratios : mapping of str to float
        By the name of a gear, or else of an element or one of its mechanisms. [-]
    limits : TeethLimits, optional
    error : {"ln", "absolute"}
        What is least in its largest value.
    advance : callable
        Told how many regions of the search more are done.

    Returns
    -------
    FoundTeeth
        Solutions from the best on, and whether no better one can be.

    Raises
    ------
    NoTeethError
        If no teeth fulfil the conditions: which one excludes most.
    CaseError
        If nothing can be looked for; the path of each problem begins with the option that it is
        about.

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
    for one in rows:
        tables.append(_whole_table(one))
        advance(1)
    full = [table for table in tables if table is not None]
    ends = reach(rows, tables)
    refuse_signs(problem, *ends)
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
    """All teeth of an element; None if they are too many to list.

    Raises
    ------
    NoTeethError
        If there are none, with the condition that excludes most.
    """
    told: Counter[str] = Counter()
    found = teeth_table(rows.layout, rows.found({}, told, MOST_LISTED_CANDIDATES), rows.counts)
    if not found.is_whole:
        return None
    if not found.total:
        raise NoTeethError([none_fits(rows.layout, told)])
    return found


def none_fits(layout: TeethLayout, told: Counter[str]) -> Problem:
    """That no teeth fulfil all conditions, and which of these excludes most.

    Of all teeth most are not coaxial: that counts where none are.
    """
    message = f"no teeth of {layout.name} fulfil all conditions"
    left = {label: count for label, count in told.items() if count and label != LOOKED}
    on_one_axis = {label: count for label, count in left.items() if label != COAXIAL}
    left = on_one_axis or left
    if left:
        label = max(left, key=lambda one: left[one])
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
    """The best teeth where some elements have too many: below limits of errors that grow.

    Where too many are below a limit, as many as may be are looked at.

    Raises
    ------
    CaseError
        If no teeth are found.
    """
    targets = problem.targets
    proven = least_possible(targets, *ends)
    best: tuple[list[TeethTable], BestTeeth] | None = None
    told: Counter[str] = Counter()
    for most in growing_limits(proven):
        between = narrowed(targets, *ends, most)
        if between is None:
            continue
        listed = list(_in_windows(rows, tables, between, told))
        is_whole = all(table.is_whole for table in listed)
        if all(table.total for table in listed):
            within = most if is_whole else math.inf
            found = best_teeth(listed, targets, most=within, advance=advance)
            if len(found.errors) and (is_whole or best is None):
                best = listed, found._replace(bound=min(found.bound, most if is_whole else proven))
            if different_teeth(listed, found.places).sum() >= MOST_TEETH_SOLUTIONS:
                break
        if not is_whole:
            break
        proven = most
    if best is not None:
        return best
    first = tables.index(None)
    if is_whole:
        raise NoTeethError([none_fits(rows[first].layout, told)])
    message = f"{rows[first].layout.name}: too many teeth to be looked at"
    hint = "expected narrower ranges, or fewer numbers of planets or modules"
    raise CaseError("E835", f"{message}; {hint}", ("range",))


def _in_windows(
    rows: Sequence[TeethRows],
    tables: Sequence[TeethTable | None],
    between: tuple[Floats, Floats],
    told: Counter[str],
) -> Iterator[TeethTable]:
    """The tables of all elements, of those with too many only with ratios that are of use."""
    sizes = iter(np.sort(np.abs(between), axis=0).T.tolist())
    for one, table in zip(rows, tables, strict=True):
        own = islice(sizes, len(one.layout.ratios))
        windows = {number: (low, high) for number, (low, high) in enumerate(own)}
        if table is None:
            yield teeth_table(one.layout, one.found(windows, told), one.counts)
        else:
            yield table
