"""Found boxes as plain data for JSON, and its schema."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.synthesis.boxes.box import BoxFigures
from vstatics.synthesis.boxes.choice import RankedBox, family_count
from vstatics.synthesis.boxes.figures import BoxGear
from vstatics.writers.named import mapping
from vstatics.writers.plain_json import plain_data
from vstatics.writers.record_schema import NUMBER, TEXT, Schema, list_of, record, schema_of

COUNT: Schema = {"type": "integer", "minimum": 0}


def box_document(searched: int, boxes: Sequence[RankedBox]) -> dict[str, Any]:
    """Found boxes as plain data, in their order.

    Parameters
    ----------
    searched : int
        So many boxes were looked at.
    boxes : sequence of RankedBox
    """
    return {
        "searched": searched,
        "found": len(boxes),
        "families": family_count(boxes),
        "boxes": [box_record(box) for box in boxes],
    }


def box_record(ranked: RankedBox) -> dict[str, Any]:
    """A found box as plain data; its held link only if it has one."""
    found, box = ranked.found, ranked.found.box
    record: dict[str, Any] = {"code": box.scheme.code, "input": box.input, "output": box.output}
    if box.held is not None:
        record["held"] = box.held
    gears = {
        gear.name: {"engaged": gear.engaged, "ratio": gear.ratio, "target": gear.target}
        for gear in found.gears
    }
    record |= {"elements": found.elements, "ratios": found.ratios, "gears": gears}
    record |= found.figures._asdict() | {"family": ranked.family, "pareto": ranked.pareto}
    plain: dict[str, Any] = plain_data(record)
    return plain | {"case": mapping(found.case)}


def box_schema() -> Schema:
    """The schema of ``vstatics synth box -f json``: what `box_document` makes."""
    gear = schema_of(BoxGear)["properties"]
    gear = record({key: gear[key] for key in ("engaged", "ratio", "target")})
    code: Schema = {"type": "string", "pattern": "^[0-9]+(-[0-9]+)*$"}
    named = {"type": "object", "additionalProperties": NUMBER}
    elements = {"type": "object", "additionalProperties": list_of(TEXT)}
    gears = {"type": "object", "additionalProperties": gear}
    case: Schema = {"type": "object", "description": "As vstatics convert has it."}
    ports = dict.fromkeys(("input", "output", "held"), COUNT)
    figures = schema_of(BoxFigures)["properties"]
    one = record(
        {"code": code, **ports, "elements": elements, "ratios": named, "gears": gears, **figures}
        | {"family": COUNT, "pareto": {"type": "boolean"}, "case": case},
        optional=["held"],
    )
    counts = dict.fromkeys(("searched", "found", "families"), COUNT)
    return record({**counts, "boxes": list_of(one)})
