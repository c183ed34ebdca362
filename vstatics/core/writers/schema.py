"""JSON Schema of a result, derived from the declaration of its tables."""

from __future__ import annotations

from vstatics.core.tables.answer import (
    NUMBER,
    TEXT,
    Schema,
    documents,
    head_schema,
    list_of,
    object_of,
)
from vstatics.core.tables.names import ROWS
from vstatics.core.tables.quantities import QUANTITIES, Quantity
from vstatics.core.writers.result_json import CONVENTIONS, FORMAT

NUMBERS: dict[type, Schema] = {
    float: NUMBER,
    int: {"type": ["integer", "null"]},
    bool: {"type": ["boolean", "null"]},
}
SIGN = {"enum": [-1, 0, 1, None]}


def json_schema(of_case: Schema) -> Schema:
    """Return the JSON Schema of a file of results; see `result_json.document`.

    Parameters
    ----------
    of_case : dict
        Schema of the case, which is contained in the result.
    """
    texts = list_of(TEXT)
    properties: Schema = {
        **head_schema(FORMAT),
        "conventions": object_of(dict.fromkeys(CONVENTIONS, TEXT)),
        "case": {"$ref": "#/$defs/case", "description": "The case as it was calculated."},
        "gears": {**texts, "description": "Names of the gears."},
        "rows": {
            "type": "object",
            "additionalProperties": texts,
            "description": "Names of the rows of each table, for a case that is drawn: its own "
            "links and elements, planets, members, meshes; and for one with springs.",
        },
    }
    properties |= {quantity.name: _table(quantity) for quantity in QUANTITIES}
    ratio = object_of({"speed_ratio": NUMBER, "others": list_of(NUMBER)})
    properties["converters"] = {
        "description": "For each gear the speed ratio of each converter, and `others` at which "
        "its pump also takes the torque of the load; null: bypassed or open.",
        **list_of({"type": "object", "additionalProperties": {"anyOf": [ratio, {"type": "null"}]}}),
    }
    properties["messages"] = {**texts, "description": "Messages about the results, gear by gear."}
    sometimes = [
        "rows",
        "converters",
        *(quantity.name for quantity in QUANTITIES if not quantity.always),
    ]
    content = {
        "description": "Tables of one case by name; null: no value.",
        **object_of(properties, optional=sometimes),
    }
    case_schema = {key: value for key, value in of_case.items() if key not in ("$schema", "$defs")}
    return documents(
        "result", "Result of vstatics", content, {"case": case_schema, **of_case["$defs"]}
    )


def _table(quantity: Quantity) -> Schema:
    row = {"type": "array", "items": SIGN if quantity.is_sign else NUMBERS[quantity.kind]}
    unit = f" [{quantity.unit}]" if quantity.unit else ""
    if quantity.rows == "one":
        return {"description": f"A list over the gears{unit}.", **row}
    return {
        "description": f"Rows: {ROWS[quantity.rows].all}; columns: {quantity.columns}{unit}.",
        "type": "array",
        "items": row,
    }
