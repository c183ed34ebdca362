"""Results as a JSON object. Its schema is `schemas/result.schema.json`."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

from vstatics.core.errors import printable
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.tables.answer import head, with_file
from vstatics.core.tables.values import tables
from vstatics.core.writers.named import mapping

FORMAT = "vstatics-result"

CONVENTIONS = {
    "ratio": "w_input/w_output",
    "basic_ratio": "(w_first - w_third)/(w_second - w_third)",
    "speeds": "relative to the input speed",
    "torques": "relative to the input torque; an external torque acts on a link and is positive "
    "in the direction of the input torque; the torque of a component is the torque that its first "
    "link gives to it; the last row of torques and lossy_torques is the output torque, given to "
    "the load",
    "powers": "relative to the input power; when coasting, all powers change sign and losses are "
    "negative",
    "power_sign": "+1 the first link drives, -1 it is driven, 0 no power flows",
    "null": "undefined or indeterminate",
}


def document(results: Results) -> dict[str, Any]:
    """Convert results to a mapping of plain data for JSON.

    A table becomes a list of rows, a table with one value per gear a plain list. NaN becomes None.
    The case always has the key `idle`.
    """
    case = results.case
    result: dict[str, Any] = {
        **head(FORMAT),
        "conventions": CONVENTIONS,
        "case": mapping(case) | {"idle": case.idle},
        "gears": results.gears,
    }
    shown = tables(results)
    if case.has_own_rows:
        result["rows"] = {t.quantity.name: list(t.rows) for t in shown if t.quantity.rows != "one"}
    for table in shown:
        quantity, kind = table.quantity, table.quantity.kind
        rows = [
            [None if math.isnan(value) else kind(value) for value in row]
            for row in table.values.tolist()
        ]
        result[quantity.name] = rows[0] if quantity.rows == "one" else rows
    if any(part.can_be_open and math.isnan(part.ratio) for part in case.mechanisms):
        result["converters"] = [dict(_converters(results, n)) for n in range(len(case.gears))]
    result["messages"] = [str(message) for message in results.messages]
    return result


def _converters(results: Results, number: int) -> Iterator[tuple[str, Any]]:
    """Yield the speed ratio of each converter in a gear, and further ratios that suit the load.

    The speed ratio is None for a converter that is bypassed or open.
    """
    case, points = results.case, results.points
    others = points.other_ratios.get(number, ()) if points else ()
    sought = case.sought_converters(case.gears[number])
    unloaded = case.unloaded_converters(results.gear_at(number).gear)
    places = [n for n, mechanism in enumerate(case.mechanisms) if mechanism.kind == "converter"]
    for place, ratio in zip(places, results.speed_ratio[number].tolist(), strict=True):
        known = None if math.isnan(ratio) else ratio
        answer = {"speed_ratio": known, "others": list(others) if place in sought else []}
        yield case.mechanisms[place].name, None if place in unloaded else answer


def to_json(results: Results, file: str = "") -> str:
    """Write the results of a case as JSON, exactly as ``vstatics run -f json``.

    Parameters
    ----------
    results : Results
        Results of one case, not of arrays of variants.
    file : str
        File of the case, for the key `file`; empty to omit the key.
    """
    expect_one_case(results, "to_json")
    data = document(results)
    return printable(text(with_file(data, file) if file else data), lines=True) + "\n"


def text(data: dict[str, Any]) -> str:
    """Return a document as text with a line for each row of a table, without a final line end.

    Examples
    --------
    >>> print(text({"speeds": [[1.0, 1.0], [0.5, None]], "ratio": [2.0]}))
    {
      "speeds": [
        [1.0, 1.0],
        [0.5, null]
      ],
      "ratio": [2.0]
    }
    """
    return _braced((_text(key), _value(key, value)) for key, value in data.items())


def _braced(entries: Iterable[tuple[str, str]], indent: str = "") -> str:
    inner = ",\n".join(f"{indent}  {key}: {value}" for key, value in entries)
    return f"{{\n{inner}\n{indent}}}"


def _value(key: str, value: Any) -> str:
    """Return a value on several lines (tables, mappings, lists of messages) or on a single line."""
    if value is CONVENTIONS:
        return _conventions()
    if isinstance(value, dict) and value:
        return _mapping(value)
    if isinstance(value, list) and value:
        if isinstance(value[0], list):  # in a table, "], [" only separates rows
            return "[\n    " + _text(value)[1:-1].replace("], [", "],\n    [") + "\n  ]"
        if key == "messages":
            return "[\n" + ",\n".join(f"    {_text(entry)}" for entry in value) + "\n  ]"
    return _text(value)


def _mapping(value: dict[str, Any]) -> str:
    return _braced(((_text(key), _text(entry)) for key, entry in value.items()), "  ")


@cache
def _conventions() -> str:
    """Return the conventions, which are equal for all results, as text."""
    return _mapping(CONVENTIONS)


_text = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode
