"""Results as CSV in long form: one number a row, for spreadsheets and pandas."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence

from vstatics.statics.results import Results
from vstatics.tables.values import tables

CONVENTIONS = (
    "ratio = w_input/w_output",
    "torques: external ones act on a link, positive like the input's, which is 1; Mx is the "
    "output torque, given to the load",
)
"""They stand in last rows without a value: a line of comment would trouble spreadsheets."""


def write(results: Sequence[tuple[str, Results]], *, several: bool) -> str:
    """One or several results by the names of their files; several have a column `case`.

    Columns: table, row, gear, value. AJK, which is the same in all gears, has the link
    and the device in `row` and no gear. A value that does not exist is empty. The last
    rows state the conventions and have no value either.
    """
    bodies = [rows(file if several else None, result) for file, result in results]
    return "".join([head(several=several), *bodies, tail(several=several)])


def head(*, several: bool) -> str:
    """The names of the columns."""
    return _lines([["case"] * several + ["table", "row", "gear", "value"]])


def rows(file: str | None, results: Results) -> str:
    """The rows of one result; `file` is the first column among several."""
    front = [] if file is None else [file]
    cells = []
    for table in tables(results):
        quantity = table.quantity
        for row, values in zip(table.rows, table.values.tolist(), strict=True):
            for column, value in zip(table.columns, values, strict=True):
                place = [f"{row}:{column}", ""] if quantity.columns == "devices" else [row, column]
                shown = "" if math.isnan(value) else _number(value, quantity.kind)
                cells.append([*front, quantity.key, *place, shown])
    return _lines(cells)


def tail(*, several: bool) -> str:
    """The rows of the conventions."""
    return _lines(
        [""] * several + ["conventions", convention, "", ""] for convention in CONVENTIONS
    )


def _lines(cells: Iterable[Sequence[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(cells)
    return text.getvalue()


def _number(value: float, kind: type) -> str:
    """A number in full; what is whole or a mark without a decimal point."""
    return repr(float(value)) if kind is float else str(int(value))
