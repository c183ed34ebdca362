"""The JSON Schemas of a scenario and of a simulation."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.model.shape import Measure
from vstatics.readers.named.schema import document_schema
from vstatics.simulation.record.document import FORMAT, VERSION
from vstatics.simulation.record.motion import Energy, Event, Peak, Reached
from vstatics.simulation.scenario.keys import SCENARIO
from vstatics.sweep.kept import statistics
from vstatics.sweep.kept.statistics import Statistics
from vstatics.writers.documents import documents, head
from vstatics.writers.record_schema import NUMBER, TEXT, Schema, list_of, record, schema_of

_MEASURES: tuple[Measure, ...] = (
    "time",
    "si_torque",
    "mass",
    "length",
    "area",
    "pump_factor",
)
_OVER_TIME = schema_of(Mapping[str, tuple[float, ...]])
"""By the name of a link, a shift element or a device."""


def json_schemas() -> dict[str, Schema]:
    """By the name of each: of a scenario, and of what ``vstatics simulate -f json`` gives."""
    measures: tuple[Measure, ...] = (
        "time",
        "si_torque",
        "si_speed",
        "mass",
        "length",
        "area",
        "pump_factor",
    )
    return {
        "scenario": document_schema(SCENARIO, measures),
        "simulation": simulation_schema(),
        "samples": samples_schema(),
    }


def samples_schema() -> Schema:
    """The schema of ``vstatics simulate --samples N -f json``."""
    quantiles = {"type": "object", "additionalProperties": NUMBER}
    by_name = {
        "type": "object",
        "additionalProperties": schema_of(Statistics, quantiles=quantiles),
    }
    start = head(statistics.FORMAT, statistics.VERSION)
    document = record({**start, "drawn": by_name, "results": by_name})
    return documents("samples", "Statistics of vstatics simulate --samples", document)


def simulation_schema() -> Schema:
    """The schema of ``vstatics simulate -f json``."""
    energy = schema_of(Energy)
    energy["required"].remove("heat_per_area")
    document = record(
        {
            **head(FORMAT, VERSION),
            "case": TEXT,
            "time": list_of(NUMBER),
            "speeds": _OVER_TIME,
            "slips": _OVER_TIME,
            "torques": _OVER_TIME,
            "events": list_of(schema_of(Event)),
            "energy": energy,
            "peaks": {"type": "object", "additionalProperties": schema_of(Peak)},
            "targets": list_of(schema_of(Reached)),
            "messages": list_of(TEXT),
            "stopped": {"type": ["string", "null"]},
        },
        optional=["targets"],
    )
    return documents("simulation", "A simulation, of vstatics simulate", document)
