"""The ports of a gear in JSON, and their schema."""

from __future__ import annotations

import math
from typing import Any

from vstatics.tables.ports import MEASURES, PortTable
from vstatics.writers.record_schema import NUMBER, TEXT, Schema, list_of, record


def port_document(gear: PortTable) -> dict[str, Any]:
    """The ports of a gear as plain data: relative numbers, and those with a unit by a load."""

    def numbers(values: dict[str, float]) -> dict[str, float]:
        units = dict(MEASURES)
        with_units = {
            f"{name}_{units[name]}": value * gear.scales[units[name]]
            for name, value in values.items()
            if not math.isnan(gear.scales[units[name]])
        }
        return {**values, **with_units}

    return {
        "ports": [
            {
                "link": name,
                "way": port.way or None,
                "output": port.is_output,
                **numbers({what: getattr(port, what) for what, _ in MEASURES}),
            }
            for name, port in gear.rows
        ],
        "lost": [{"in": name, **numbers({"power": lost})} for name, lost in gear.losses],
    }


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
