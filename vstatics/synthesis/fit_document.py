"""A fit as plain data for JSON, and its schema."""

from __future__ import annotations

from typing import Any

from vstatics.synthesis.fit import Fit, FitSolution
from vstatics.writers.documents import documents
from vstatics.writers.plain_json import plain_data
from vstatics.writers.record_schema import Schema, list_of, schema_of


def fit_document(found: Fit) -> dict[str, Any]:
    """A fit as plain data: the best solution, and all of them."""
    best = {name: getattr(found, name) for name in FitSolution._fields}
    made: dict[str, Any] = plain_data(best | {"solutions": found.solutions})
    return made


def fit_schema() -> Schema:
    """The schema of ``vstatics synth fit -f json``."""
    one = schema_of(FitSolution)
    best = schema_of(FitSolution, solutions=list_of(one))
    return documents("fit", "Ratios for wanted gears, of vstatics synth fit", best)
