"""Written results in CSV, one number a row, back to tables of numbers."""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Sequence

from vstatics.errors import Problem, ReadError
from vstatics.readers.reading import Source
from vstatics.tables.csv import unguarded
from vstatics.tables.figures import Figure, WrittenResult
from vstatics.tables.quantities import BY_NAME

COLUMNS = ["table", "row", "gear", "value"]
_Cells = dict[str, dict[str, dict[str, Figure]]]
"""Of a result: table, row, and gear or device."""


def is_result(text: str) -> bool:
    """Whether a text begins as such a file does."""
    first = text.partition("\n")[0].strip().split(",")
    return first in (COLUMNS, ["case", *COLUMNS])


def read(text: str, file: str) -> list[WrittenResult]:
    """The results of a file in their order.

    Raises
    ------
    ReadError
        If a line has no number, or belongs to no table.
    """
    lines = csv.reader(io.StringIO(text))
    has_case = next(lines)[0] == "case"
    results: dict[str, _Cells] = {}
    for row in lines:
        cells = [unguarded(cell) for cell in row]
        case = cells.pop(0) if has_case and cells else ""
        if not cells or cells[0] == "conventions":
            continue
        if len(cells) != len(COLUMNS) or cells[0] not in BY_NAME:
            raise _fail("no row of a result in CSV: expected table,row,gear,value", file, lines)
        table, name, gear, value = cells
        if BY_NAME[table].columns == "devices":
            name, _, gear = name.rpartition(":")
        try:
            figure = Figure(float(value) if value else math.nan)
        except ValueError:
            raise _fail(f"read {value!r}, expected a number", file, lines) from None
        results.setdefault(case, {}).setdefault(table, {}).setdefault(name, {})[gear] = figure
    if not results:
        raise ReadError([Problem("no result in it", place=Source(file, "").place(0))])
    return [_result(case, cells) for case, cells in results.items()]


def _fail(message: str, file: str, lines: object) -> ReadError:
    number = getattr(lines, "line_num", 0)
    return ReadError([Problem(message, place=Source(file, "").place(number))])


def _result(file: str, tables: _Cells) -> WrittenResult:
    figures, rows = {}, {}
    gears: Sequence[str] = ()
    for key, table in tables.items():
        figures[key] = [list(row.values()) for row in table.values()]
        if BY_NAME[key].rows != "one":
            rows[key] = list(table)
        if BY_NAME[key].columns != "devices":
            gears = max(gears, list(next(iter(table.values()))), key=len)
    name = os.path.basename(file)  # noqa: PTH119
    return WrittenResult(figures, None, printed=False, rows=rows, file=name, gears=gears)
