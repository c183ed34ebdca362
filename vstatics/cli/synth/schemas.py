"""The JSON Schemas of what the commands of `vstatics synth` write."""

from __future__ import annotations

from vstatics.synthesis.boxes.document import box_schema
from vstatics.synthesis.gears.engaged_sets import EngagedSet
from vstatics.synthesis.gears.kinds import EngagedKind
from vstatics.synthesis.ratios.fitting import fit_schema
from vstatics.synthesis.structures.growth import FoundScheme
from vstatics.synthesis.teeth.solutions import teeth_schema
from vstatics.writers.record_schema import NUMBER, TEXT, Schema, list_of, record, schema_of


def json_schemas() -> dict[str, Schema]:
    """By the name of each: the schemas of ``vstatics synth ... -f json``."""
    return {
        "structures": structures_schema(),
        "combinations": combinations_schema(),
        "fit": fit_schema(),
        "box": boxes_schema(),
        "teeth": teeth_schema(),
    }


def structures_schema() -> Schema:
    """The schema of ``vstatics synth structures``: a line of a list, a count, an estimate."""
    number: Schema = {"type": "integer", "minimum": 0}
    link: Schema = {"type": ["integer", "null"], "minimum": 0}
    code: Schema = {"type": "string", "pattern": "^[0-9]+(-[0-9]+)*$"}
    scheme = schema_of(FoundScheme, code=code, links=number, input=link, output=link)
    by_links: Schema = {"type": "object", "additionalProperties": number}
    counted = {"sets": number, "count": number, "by_links": by_links}
    size = {"bytes": {**number, "type": ["integer", "null"]}, "seconds": {"type": "number"}}
    about = record({**counted, "exact": {"type": "boolean"}, **size})
    title = "Schemes of planetary sets, of vstatics synth structures"
    return _schema("structures", title, {"anyOf": [scheme, record(counted), about]})


def combinations_schema() -> Schema:
    """The schema of ``vstatics synth combinations -f json``: all, a line, an estimate."""
    kinds: Schema = {"enum": [kind.word for kind in EngagedKind]}
    one = schema_of(EngagedSet, kind=kinds)
    found = record({"combinations": list_of(one)})
    names, sizes = list_of(TEXT), list_of({"type": "integer", "minimum": 0})
    numbers = dict.fromkeys(("count", "bytes", "seconds"), NUMBER)
    about = record({"elements": names, "engaged": sizes, **numbers})
    title = "Combinations of shift elements, of vstatics synth combinations"
    return _schema("combinations", title, {"anyOf": [found, one, about]})


def boxes_schema() -> Schema:
    """The schema of ``vstatics synth box -f json``: all that is found, a line, an estimate."""
    found = box_schema()
    one = found["properties"]["boxes"]["items"]
    numbers = dict.fromkeys(("searched", "found", "seconds"), NUMBER)
    about = record({**numbers, "exact": {"type": "boolean"}})
    title = "Gearboxes for wanted ratios, of vstatics synth box"
    return _schema("box", title, {"anyOf": [found, one, about]})


def _schema(name: str, title: str, document: Schema) -> Schema:
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"{name}.schema.json",
        "title": title,
        **document,
    }
