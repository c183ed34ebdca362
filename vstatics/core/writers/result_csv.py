"""Results as CSV with one number per row (long form), for spreadsheets and pandas."""

from __future__ import annotations

import math

from vstatics.core.statics.results import Results
from vstatics.core.tables import csv
from vstatics.core.tables.answer import PROGRAM
from vstatics.core.tables.values import places, tables

CONVENTIONS = (
    "ratio = w_input/w_output",
    "torques: an external torque acts on a link and is positive in the direction of the input "
    "torque, which is 1; Mx is the output torque, given to the load",
)
"""Conventions of the written numbers.

The conventions are rows without a value, because spreadsheets read no comments in CSV.
"""


def write(results: Results, *, raw: bool = False) -> str:
    """Write the results of a case as CSV in long form.

    The columns are table, row, gear and value. The distribution matrix does not depend on the gear:
    its rows are named ``link:device``, and their gear is empty. A missing value is empty. The last
    rows state the conventions and the program, also without a value.

    Parameters
    ----------
    results : Results
    raw : bool
        Whether to leave texts unchanged that a spreadsheet takes for formulas; see `csv.guarded`.
    """
    return "".join([head(several=False), rows(None, results, raw=raw), tail(several=False)])


def head(*, several: bool) -> str:
    """Write the names of the columns; if there are several results, add a column `case`."""
    return csv.lines([["case"] * several + ["table", "row", "gear", "value"]])


def rows(file: str | None, results: Results, *, raw: bool = False) -> str:
    """Write the rows of a result; if there are several results, `file` is the file of the case."""
    front = [] if file is None else [file]
    cells = []
    for table in tables(results):
        kind = float if table.quantity.kind is float else int  # a truth value is written as 0 or 1
        values = table.values.ravel().tolist()
        for (key, row, gear), value in zip(places(table), values, strict=True):
            shown = "" if math.isnan(value) else repr(kind(value))
            cells.append([*front, key, row, gear or "", shown])
    return csv.lines(cells, raw=raw)


def tail(*, several: bool) -> str:
    """Write the last rows, which state the conventions and the program."""
    about = [("conventions", convention) for convention in CONVENTIONS]
    return csv.lines(
        [""] * several + [table, text, "", ""] for table, text in [*about, ("program", PROGRAM)]
    )
