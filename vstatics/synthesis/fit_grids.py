"""A fit as tables."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.synthesis.fit import Fit, deviation
from vstatics.synthesis.fit_problem import FitProblem
from vstatics.tables.grid import Column, Grid, Row, exact, text, whole

ROUNDED = 9
"""Digits of a deviation; what is below them is rounding."""


def fit_grids(found: Fit) -> Iterator[Grid]:
    """What the gears have, then the mechanisms, then all solutions where there are several.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.fit import fit
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gears, mechanisms = fit_grids(fit(case, {"1": 4.0}))
    >>> gears.texts, mechanisms.texts
    ([['1', '4.0000', '4.0000', '.000', 'met']], [['D1', '-3.0000', '-14.0000', '-1.0000', '']])
    """
    yield _gears(found)
    yield _mechanisms(found)
    if len(found.solutions) > 1:
        yield _solutions(found)


def _gears(found: Fit) -> Grid:
    problem = found.problem
    rows: list[Row] = []
    for index, gear in enumerate(problem.own.case.gears):
        ratio, target = found.gears[gear.name], problem.targets.get(index)
        row: Row = [gear.name, exact(target, 4), exact(ratio, 4)]
        if target is None:
            row += [exact(None), ""]
        else:
            met = "not met" if gear.name in found.unmet else "met"
            row += [exact(100 * round(deviation(ratio, target), ROUNDED)), met]
        rows.append(row)
    columns = [text("gear"), *map(Column, ("wanted", "ratio", "off [%]")), text("note")]
    return Grid("Gears", columns, rows)


def _mechanisms(found: Fit) -> Grid:
    """The ratios of mechanisms with their bounds."""
    problem = found.problem
    rows: list[Row] = []
    for index, (name, ratio) in enumerate(found.ratios.items()):
        low, high = problem.bounds.low[index], problem.bounds.high[index]
        numbers = (exact(one, 4) for one in (ratio, low, high))
        rows.append([name, *numbers, mechanism_note(problem, index, ratio, found)])
    columns = [text("mechanism"), *map(Column, ("ratio", "from", "to")), text("note")]
    return Grid("Mechanisms", columns, rows)


def mechanism_note(problem: FitProblem, index: int, ratio: float, found: Fit) -> str:
    """What is to be said of the ratio of a mechanism, by its index."""
    low, high = problem.bounds.low[index], problem.bounds.high[index]
    if low == high:
        return "given"
    if index in problem.unused:
        return "in no wanted ratio"
    if ratio in (low, high):
        return "at its bound"
    return "free" if problem.own.case.mechanisms[index].name in found.free else ""


def _solutions(found: Fit) -> Grid:
    names = list(found.ratios)
    rows: list[Row] = [
        [whole(number), exact(one.residual, 6), *(exact(one.ratios[name], 4) for name in names)]
        for number, one in enumerate(found.solutions, 1)
    ]
    columns = [Column("solution"), Column("residual"), *map(Column, names)]
    return Grid("All solutions", columns, rows, key="solutions")
