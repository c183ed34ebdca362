"""A fit as tables: what is known of it before, and what it has found."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from vstatics.core.tables.answer import plain_data
from vstatics.core.tables.grid import Cell, Grid, Values, exact, grid_of
from vstatics.synthesis.ratios.fitting import Fit, deviation
from vstatics.synthesis.ratios.least_squares import MOST_FIT_STEPS
from vstatics.synthesis.ratios.problem import FitProblem
from vstatics.synthesis.ratios.search import start_count
from vstatics.synthesis.ratios.space import FitPoints, fit_space
from vstatics.synthesis.tolerances import TINY_RATIO

DEVIATION_DECIMALS = 9
"""Digits of a deviation; what is below them is rounding."""


def fit_grids(found: Fit) -> Iterator[Grid]:
    """What the gears have, then the mechanisms, then all solutions where there are several.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.ratios.fitting import fit
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gears, mechanisms = fit_grids(fit(case, {"1": 4.0}))
    >>> gears.texts, mechanisms.texts
    ([['1', '4.0000', '4.0000', '.000', 'met']], [['D1', '-3.0000', '-14.0000', '-1.0000', '']])
    """
    yield _gears(found)
    yield _mechanisms(found)
    if len(found.solutions) > 1:
        yield _solutions(found)


def number(value: float | None) -> Cell:
    """A ratio as somebody gave it, which may be of any size, as a cell.

    >>> number(-4.7).text, number(0.00125).text, number(1e-300).text, number(None).text
    ('-4.7000', '.001250', '1e-300', '-')
    """
    if value is None or not 0 < abs(value) < TINY_RATIO:
        return exact(value, 4)
    return Cell(f"{value:.4g}", value, kind=float)


def _gears(found: Fit) -> Grid:
    problem = found.problem
    rows = []
    for index, gear in enumerate(problem.own.case.gears):
        ratio, target = found.gears[gear.name], problem.targets.get(index)
        off, note = None, ""
        if target is not None:
            note = "not met" if gear.name in found.unmet else "met"
            off = 100 * round(deviation(ratio, target), DEVIATION_DECIMALS)
        rows.append((gear.name, number(target), exact(ratio, 4), off, note))
    return grid_of("Gears", ["gear", "wanted", "ratio", "off [%]", "note"], rows)


def _mechanisms(found: Fit) -> Grid:
    """The ratios of mechanisms with their bounds."""
    problem = found.problem
    rows: list[Values] = []
    for index, (name, ratio) in enumerate(found.ratios.items()):
        low, high = problem.bounds.low[index], problem.bounds.high[index]
        numbers = (number(one) for one in (ratio, low, high))
        rows.append((name, *numbers, _note(found, index, ratio)))
    return grid_of("Mechanisms", ["mechanism", "ratio", "from", "to", "note"], rows)


def _note(found: Fit, index: int, ratio: float) -> str:
    """What is to be said of the ratio of a mechanism, by its index."""
    problem = found.problem
    if problem.bounds.is_fixed(index):
        return "given"
    if index in problem.unused:
        return "in no wanted ratio"
    if ratio in (problem.bounds.low[index], problem.bounds.high[index]):
        return "at its bound"
    return "free" if problem.own.case.mechanisms[index].name in found.free else ""


def _solutions(found: Fit) -> Grid:
    names = list(found.ratios)
    rows: list[Values] = [
        (number, exact(one.residual, 6), *(exact(one.ratios[name], 4) for name in names))
        for number, one in enumerate(found.solutions, 1)
    ]
    return grid_of("All solutions", ["solution", "residual", *names], rows, key="solutions")


def dry_document(problem: FitProblem) -> dict[str, Any]:
    """What is varied, what the gears can have, and the longest time [s], for JSON."""
    case, bounds = problem.own.case, problem.bounds
    varied = {
        case.mechanisms[index].name: {"from": bounds.low[index], "to": bounds.high[index]}
        for index in problem.varied
    }
    gears = {}
    for index, target in problem.targets.items():
        low, high = problem.reach(index) or (math.nan, math.nan)
        gears[case.gears[index].name] = {"wanted": target, "from": low, "to": high}
    starts = start_count(fit_space(problem))
    made: dict[str, Any] = plain_data(
        {"varied": varied, "gears": gears, "starts": starts, "seconds": longest(problem)}
    )
    return made


def longest(problem: FitProblem) -> float:
    """How long a fit takes at most, by one step of it [s]."""
    space = fit_space(problem)
    if not space.varied:
        return 0.0
    count = start_count(space)
    starts = FitPoints(*(np.repeat(one, count, axis=0) for one in space.own))
    began = time.perf_counter()
    space.minima(starts, weight=1.0, steps=TIMED_STEPS)
    return (time.perf_counter() - began) * MOST_FIT_STEPS / TIMED_STEPS


TIMED_STEPS = 2
"""Steps by which the time is estimated."""


def dry_grids(known: Mapping[str, Any]) -> Iterator[Grid]:
    """The same as tables."""
    parts = {
        "Varied": ("varied", "mechanism", "from", "to"),
        "What the gears can have within the bounds": ("gears", "gear", "wanted", "from", "to"),
    }
    for title, (key, *headings) in parts.items():
        rows = ((name, *map(number, one.values())) for name, one in known[key].items())
        yield grid_of(title, headings, rows, key=key * (key == "gears"))
    seconds = f"at most {max(known['seconds'], 0.1):.2g} s"
    yield grid_of("Search", ["", ""], [["starts", str(known["starts"])], ["time", seconds]])
