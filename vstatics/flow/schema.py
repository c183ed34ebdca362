"""The JSON Schema of the power of gears: what `document` makes."""

from __future__ import annotations

from vstatics.flow.circulation import Node
from vstatics.flow.document import CONVENTIONS, SIDE_NUMBERS, VERSION
from vstatics.tables.ports import MEASURES
from vstatics.writers.record_schema import (
    NUMBER,
    TEXT,
    Schema,
    documents,
    head,
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
            **head("vstatics-flow", VERSION),
            "conventions": record(dict.fromkeys(CONVENTIONS, TEXT)),
            "case": TEXT,
            "gears": list_of(gear),
        }
    )
    return documents("flow", "Power of gears, of vstatics flow", one, {"side": side})


def ports_schema() -> Schema:
    """The keys of `port_document`."""

    def numbers(*names: str) -> Schema:
        units = [f"{name}_{unit}" for name, unit in MEASURES if name in names]
        return dict.fromkeys([*names, *units], NUMBER)

    all_of_port = numbers(*(name for name, _ in MEASURES))
    with_units = [name for name in all_of_port if name not in dict(MEASURES)]
    port = {
        "link": TEXT,
        "way": {"type": ["string", "null"]},
        "output": {"type": "boolean"},
        **all_of_port,
    }
    lost = {"in": TEXT, **numbers("power")}
    return {
        "ports": list_of(record(port, optional=with_units)),
        "lost": list_of(record(lost, optional=with_units)),
    }
