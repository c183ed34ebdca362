"""Found teeth as plain data for JSON, and its schema."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.synthesis.teeth_problem import TeethProblem
from vstatics.synthesis.teeth_solutions import TeethSolution
from vstatics.writers.documents import documents
from vstatics.writers.plain_json import plain_data
from vstatics.writers.record_schema import Schema, list_of, record, schema_of


def teeth_document(solutions: Sequence[TeethSolution]) -> dict[str, Any]:
    """Solutions as plain data; modules where they were chosen."""
    found = []
    for one in solutions:
        data = {name: getattr(one, name) for name in ("teeth", "planets", "gears", "error")}
        if one.modules:
            data["modules"] = one.modules
        found.append(plain_data(data))
    return {"solutions": found}


def teeth_schema() -> Schema:
    """The schema of ``vstatics synth teeth -f json``."""
    full = schema_of(TeethSolution)["properties"]
    names = ("teeth", "planets", "gears", "error", "modules")
    solution = record({name: full[name] for name in names}, optional=["modules"])
    found = record({"solutions": list_of(solution)})
    return documents("teeth", "Teeth for wanted ratios, of vstatics synth teeth", found)


def asked_document(problem: TeethProblem) -> dict[str, Any]:
    """What is looked for: ranges of wheels, numbers of planets, the kinds of the elements."""
    limits = problem.limits
    ranges = {
        layout.name: {
            wheel: {"from": low, "to": high}
            for wheel, (low, high) in zip(layout.wheels, limits.of_wheels(layout), strict=True)
        }
        for layout in problem.layouts
    }
    planets = {one.name: sorted(limits.counts(one)) for one in problem.layouts if one.planets}
    kinds = {one.name: one.element.kind for one in problem.layouts}
    return {"ranges": ranges, "planets": planets, "kinds": kinds}
