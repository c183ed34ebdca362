"""The JSON Schema of explanations: what `document` makes."""

from __future__ import annotations

from vstatics.explain.document import FORMAT, VERSION
from vstatics.explain.equations import Equation
from vstatics.explain.explanation import Explanation
from vstatics.explain.formula import RatioFormula, Symbol
from vstatics.writers.documents import documents, head
from vstatics.writers.record_schema import (
    NUMBER,
    TEXT,
    Schema,
    list_of,
    record,
    schema_of,
)


def json_schema() -> Schema:
    """The schema of ``vstatics explain -f json``."""
    equation = schema_of(Equation, symbols=TEXT, numbers=TEXT)
    values: Schema = {"type": "object", "additionalProperties": NUMBER}
    system = record({"equations": list_of(equation), "values": values})
    speed = record({"symbol": TEXT, "name": TEXT, "value": NUMBER})
    formula = schema_of(
        RatioFormula,
        symbols=list_of(schema_of(Symbol, symbol=TEXT)),
        speeds=list_of(speed),
    )
    none: Schema = {"type": "null"}
    gear = schema_of(
        Explanation,
        matrix=list_of(list_of({"type": "number"})),
        speeds={"$ref": "#/$defs/system"},
        torques={"anyOf": [{"$ref": "#/$defs/system"}, none]},
        lossy={"anyOf": [{"$ref": "#/$defs/system"}, none]},
        formula={"anyOf": [formula, none]},
    )
    one = record(
        {
            **head(FORMAT, VERSION),
            "case": TEXT,
            "gears": list_of(gear),
        }
    )
    return documents("explain", "Gears explained, of vstatics explain", one, {"system": system})
