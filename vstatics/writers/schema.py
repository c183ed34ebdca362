"""The JSON Schema of a result, made from the declaration of its tables.

``python -m vstatics.writers.schema > schemas/result.schema.json``
"""

from __future__ import annotations

import json
import sys
from typing import Any

from vstatics.tables.quantities import QUANTITIES
from vstatics.tables.quantity import Quantity
from vstatics.tables.rows import ROWS
from vstatics.writers.result_json import CONVENTIONS, VERSION

NUMBERS: dict[type, dict[str, Any]] = {
    float: {"type": ["number", "null"]},
    int: {"type": ["integer", "null"]},
    bool: {"type": ["boolean", "null"]},
}
SIGN = {"enum": [-1, 0, 1, None]}


def json_schema() -> dict[str, Any]:
    """The schema of what `result_json.document` makes."""
    texts = {"type": "array", "items": {"type": "string"}}
    properties: dict[str, Any] = {
        "format": {"const": "vstatics-result"},
        "version": {"const": VERSION},
        "file": {"type": "string", "description": "The file of the case, without folders."},
        "conventions": {
            "type": "object",
            "properties": {key: {"type": "string"} for key in CONVENTIONS},
            "required": list(CONVENTIONS),
        },
        "case": {"$ref": "case.schema.json", "description": "The case as it was calculated."},
        "gears": {**texts, "description": "Names of the gears."},
        "rows": {
            "type": "object",
            "additionalProperties": texts,
            "description": "Names of the rows of each table, for a case that is drawn: its own "
            "links and elements, planets, members, meshes.",
        },
    }
    properties |= {quantity.key: _table(quantity) for quantity in QUANTITIES}
    properties["messages"] = {**texts, "description": "What was noticed, gear by gear."}
    sometimes = {"file", "rows", *(quantity.key for quantity in QUANTITIES if not quantity.always)}
    required = [name for name in properties if name not in sometimes]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "result.schema.json",
        "title": "Result of vstatics",
        "description": "Tables of one case under the names of the deck; null: no value.",
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


def _table(quantity: Quantity) -> dict[str, Any]:
    row = {"type": "array", "items": SIGN if quantity.is_sign else NUMBERS[quantity.kind]}
    unit = f" [{quantity.unit}]" if quantity.unit else ""
    if quantity.rows == "one":
        return {"description": f"A list over the gears{unit}.", **row}
    return {
        "description": f"Rows: {ROWS[quantity.rows].all}; columns: {quantity.columns}{unit}.",
        "type": "array",
        "items": row,
    }


if __name__ == "__main__":
    json.dump(json_schema(), sys.stdout, indent=2, ensure_ascii=False)
    sys.stdout.write("\n")
