"""The JSON Schema of a summary: what `document` makes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.summary.design_table import GearLine
from vstatics.summary.document import FORMAT, VERSION
from vstatics.summary.duty import Cycle
from vstatics.summary.extremes import Largest, Margin
from vstatics.summary.inertia import GearInertia
from vstatics.summary.shifts import Transition
from vstatics.summary.unused_sets import Combination
from vstatics.writers.documents import documents, head
from vstatics.writers.ports import ports_schema
from vstatics.writers.record_schema import (
    NUMBER,
    TEXT,
    Schema,
    list_of,
    record,
    schema_of,
)


def json_schema() -> Schema:
    """The schema of ``vstatics summary -f json``."""
    sometimes: Schema = {
        "margins": schema_of(Sequence[Margin]),
        "inertia": schema_of(Sequence[GearInertia]),
        "duty": schema_of(Cycle),
        "combinations": schema_of(Sequence[Combination]),
    }
    one = record(
        {
            **head(FORMAT, VERSION),
            "name": TEXT,
            "gears": schema_of(Sequence[GearLine]),
            "forward": list_of(TEXT),
            "spread": NUMBER,
            "transitions": list_of(schema_of(Transition, changes={"type": "integer"}, kind=TEXT)),
            "ports": list_of(record({"gear": TEXT, **ports_schema()})),
            "largest": schema_of(Mapping[str, Sequence[Largest]]),
            "sensitivity": schema_of(Mapping[str, Sequence[float]]),
            **sometimes,
        },
        optional=list(sometimes),
    )
    return documents("summary", "Summary of a case, of vstatics summary", one)
