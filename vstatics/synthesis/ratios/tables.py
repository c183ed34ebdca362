"""Tables of a fit: the problem before the fit, and the result."""

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
"""Number of decimals of a printed deviation. Further digits are rounding noise."""


def fit_grids(result: Fit) -> Iterator[Grid]:
    """Yield tables of the gears, the mechanisms, and all solutions if there are several.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.ratios.fitting import fit
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gears, mechanisms = fit_grids(fit(case, {"1": 4.0}))
    >>> gears.texts, mechanisms.texts
    ([['1', '4.0000', '4.0000', '0.000', 'met']], [['D1', '-3.0000', '-14.0000', '-1.0000', '']])
    """
    yield _gears(result)
    yield _mechanism_table(result)
    if len(result.solutions) > 1:
        yield _solutions(result)


def number(value: float | None) -> Cell:
    """Return a cell with a ratio of any magnitude.

    >>> number(-4.7).text, number(0.00125).text, number(1e-300).text, number(None).text
    ('-4.7000', '0.001250', '1e-300', '-')
    """
    if value is None or not 0 < abs(value) < TINY_RATIO:
        return exact(value, 4)
    return Cell(f"{value:.4g}", value, kind=float)


def _gears(result: Fit) -> Grid:
    problem = result.problem
    rows = []
    for index, gear in enumerate(problem.links.case.gears):
        ratio, target = result.gears[gear.name], problem.targets.get(index)
        off, note = None, ""
        if target is not None:
            note = "not met" if gear.name in result.unmet else "met"
            off = 100 * round(deviation(ratio, target), DEVIATION_DECIMALS)
        rows.append((gear.name, number(target), exact(ratio, 4), off, note))
    return grid_of("Gears", ["gear", "wanted", "ratio", "off [%]", "note"], rows)


def _mechanism_table(result: Fit) -> Grid:
    problem = result.problem
    rows: list[Values] = []
    for index, (name, ratio) in enumerate(result.ratios.items()):
        low, high = problem.bounds.low[index], problem.bounds.high[index]
        numbers = (number(value) for value in (ratio, low, high))
        rows.append((name, *numbers, _note(result, index, ratio)))
    return grid_of("Mechanisms", ["mechanism", "ratio", "from", "to", "note"], rows)


def _note(result: Fit, index: int, ratio: float) -> str:
    problem = result.problem
    if problem.bounds.is_fixed(index):
        return "given"
    if index in problem.unused:
        return "in no wanted ratio"
    if ratio in (problem.bounds.low[index], problem.bounds.high[index]):
        return "at its bound"
    return "free" if problem.links.case.mechanisms[index].name in result.free else ""


def _solutions(result: Fit) -> Grid:
    names = list(result.ratios)
    rows: list[Values] = [
        (number, exact(solution.residual, 6), *(exact(solution.ratios[name], 4) for name in names))
        for number, solution in enumerate(result.solutions, 1)
    ]
    return grid_of("All solutions", ["solution", "residual", *names], rows, key="solutions")


def dry_document(problem: FitProblem) -> dict[str, Any]:
    """Return the varied ratios, the possible gear ratios and the longest time [s], for JSON."""
    case, bounds = problem.links.case, problem.bounds
    varied = {
        case.mechanisms[index].name: {"from": bounds.low[index], "to": bounds.high[index]}
        for index in problem.varied
    }
    gears = {}
    for index, target in problem.targets.items():
        low, high = problem.reach(index) or (math.nan, math.nan)
        gears[case.gears[index].name] = {"wanted": target, "from": low, "to": high}
    starts = start_count(fit_space(problem))
    document: dict[str, Any] = plain_data(
        {"varied": varied, "gears": gears, "starts": starts, "seconds": longest(problem)}
    )
    return document


def longest(problem: FitProblem) -> float:
    """Estimate the longest time of a fit from the time of a few steps [s]."""
    space = fit_space(problem)
    if not space.varied:
        return 0.0
    count = start_count(space)
    starts = FitPoints(*(np.repeat(array, count, axis=0) for array in space.case_point))
    began = time.perf_counter()
    space.minima(starts, weight=1.0, steps=TIMED_STEPS)
    return (time.perf_counter() - began) * MOST_FIT_STEPS / TIMED_STEPS


TIMED_STEPS = 2
"""Number of steps that are timed for the estimate."""


def dry_grids(known: Mapping[str, Any]) -> Iterator[Grid]:
    """Yield the tables of a dry run, from the document of `dry_document`."""
    parts = {
        "Varied": ("varied", "mechanism", "from", "to"),
        "What the gears can have within the bounds": ("gears", "gear", "wanted", "from", "to"),
    }
    for title, (key, *headings) in parts.items():
        rows = ((name, *map(number, values.values())) for name, values in known[key].items())
        yield grid_of(title, headings, rows, key=key * (key == "gears"))
    seconds = f"at most {max(known['seconds'], 0.1):.2g} s"
    yield grid_of("Search", ["", ""], [["starts", str(known["starts"])], ["time", seconds]])
