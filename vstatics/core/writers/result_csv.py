"""Results as CSV in long form: one number a row, for spreadsheets and pandas."""

from __future__ import annotations

import math

from vstatics.core.statics.results import Results
from vstatics.core.tables import csv
from vstatics.core.tables.values import tables

CONVENTIONS = (
    "ratio = w_input/w_output",
    "torques: external ones act on a link, positive like the input's, which is 1; Mx is the "
    "output torque, given to the load",
)
"""They stand in last rows without a value: a line of comment would trouble spreadsheets."""


def write(results: Results, *, raw: bool = False) -> str:
    """One result.

    Columns: table, row, gear, value. AJK, which is the same in all gears, has the link
    and the device in `row` and no gear. A value that does not exist is empty. The last
    rows state the conventions and have no value either.

    Parameters
    ----------
    raw : bool
        Whether texts stay as they are, also where a spreadsheet calculates them.
    """
    return "".join([head(several=False), rows(None, results, raw=raw), tail(several=False)])


def head(*, several: bool) -> str:
    """The names of the columns; several results have a column `case`."""
    return csv.lines([["case"] * several + ["table", "row", "gear", "value"]])


def rows(file: str | None, results: Results, *, raw: bool = False) -> str:
    """The rows of one result; `file` is the first column among several."""
    front = [] if file is None else [file]
    cells = []
    for table in tables(results):
        quantity = table.quantity
        for row, values in zip(table.rows, table.values.tolist(), strict=True):
            for column, value in zip(table.columns, values, strict=True):
                place = [f"{row}:{column}", ""] if quantity.columns == "devices" else [row, column]
                kind = float if quantity.kind is float else int  # a mark is a whole number
                shown = "" if math.isnan(value) else repr(kind(value))
                cells.append([*front, quantity.key, *place, shown])
    return csv.lines(cells, raw=raw)


def tail(*, several: bool) -> str:
    """The rows of the conventions."""
    return csv.lines(
        [""] * several + ["conventions", convention, "", ""] for convention in CONVENTIONS
    )
