"""What is known of a fit before it is carried out."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from typing import Any

from vstatics.synthesis.fit_problem import FitProblem
from vstatics.synthesis.fit_search import STARTS, Search
from vstatics.synthesis.least_squares import STEPS
from vstatics.tables.grid import Column, Grid, Row, exact, text
from vstatics.writers.plain_json import plain_data


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
    made: dict[str, Any] = plain_data(
        {"varied": varied, "gears": gears, "starts": STARTS, "seconds": longest(problem)}
    )
    return made


def longest(problem: FitProblem) -> float:
    """How long a fit takes at most, by one step of it [s]."""
    search = Search.of(problem)
    if not search.varied:
        return 0.0
    began = time.perf_counter()
    search.one_step()
    return (time.perf_counter() - began) * 2 * STEPS


def dry_grids(problem: FitProblem) -> Iterator[Grid]:
    """The same as tables."""
    known = dry_document(problem)
    mechanisms: list[Row] = [
        [name, exact(one["from"], 4), exact(one["to"], 4)] for name, one in known["varied"].items()
    ]
    yield Grid("Varied", [text("mechanism"), Column("from"), Column("to")], mechanisms)
    gears: list[Row] = [
        [name, *(exact(one[key], 4) for key in ("wanted", "from", "to"))]
        for name, one in known["gears"].items()
    ]
    columns = [text("gear"), *map(Column, ("wanted", "from", "to"))]
    yield Grid("What the gears can have within the bounds", columns, gears, key="gears")
    seconds = f"at most {max(known['seconds'], 0.1):.2g} s"
    rows: list[Row] = [["starts", str(known["starts"])], ["time", seconds]]
    yield Grid("Search", [text(""), text("")], rows)
