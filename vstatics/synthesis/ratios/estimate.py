"""What is known of a fit before it is carried out."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from vstatics.synthesis.ratios.grids import number
from vstatics.synthesis.ratios.least_squares import MOST_FIT_STEPS
from vstatics.synthesis.ratios.problem import FitProblem
from vstatics.synthesis.ratios.search import start_count
from vstatics.synthesis.ratios.space import FitPoints, fit_space
from vstatics.tables.answer import plain_data
from vstatics.tables.grid import Grid, grid_of


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
