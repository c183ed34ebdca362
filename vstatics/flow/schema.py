"""The JSON Schema of the power of gears: what `document` makes."""

from __future__ import annotations

from vstatics.flow.circulation import Node
from vstatics.flow.document import CONVENTIONS, FORMAT, SIDE_NUMBERS, VERSION
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
    """The schema of ``vstatics flow -f json``."""
    node = schema_of(Node)
    edges = list_of(record({"from": node, "to": node, "power": NUMBER}))
    loops = list_of(record({"power": NUMBER, "nodes": list_of(node), "note": TEXT}))
    side = record(
        {
            **dict.fromkeys(SIDE_NUMBERS, NUMBER),
            "throughput": list_of(schema_of(Node, power=NUMBER)),
            "losses": list_of(schema_of(Node, power=NUMBER, share=NUMBER)),
            "members": list_of(schema_of(Node, member=TEXT, link=TEXT, power=NUMBER)),
            "teeth": list_of(schema_of(Node, mesh=TEXT, power=NUMBER, loss=NUMBER)),
            "edges": edges,
            "forward": edges,
            "loops": loops,
            "locked_in": loops,
        }
    )
    side_or_none = {"anyOf": [{"$ref": "#/$defs/side"}, {"type": "null"}]}
    gear = record(
        {
            "gear": TEXT,
            "note": TEXT,
            "input_link_kW": NUMBER,
            "by_convention": list_of(node),
            **ports_schema(),
            "ideal": side_or_none,
            "lossy": side_or_none,
        }
    )
    one = record(
        {
            **head(FORMAT, VERSION),
            "conventions": record(dict.fromkeys(CONVENTIONS, TEXT)),
            "case": TEXT,
            "gears": list_of(gear),
        }
    )
    return documents("flow", "Power of gears, of vstatics flow", one, {"side": side})
