"""Results as CSV in long form (one number per row), for spreadsheets and pandas."""

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
"""Sign conventions and units of the numbers, as sentences.

They are written in rows without a value, because spreadsheets do not support comments in CSV.
"""


def write(results: Results, *, raw: bool = False) -> str:
    """Write the results of a case as CSV.

    The columns are table, row, gear and value. A value that does not exist is empty. The
    distribution matrix does not depend on the gear, so the column is empty, and the row is
    ``link:device``. The last rows contain the conventions and the program instead of a value.

    Parameters
    ----------
    results : Results
    raw : bool
        True to omit the apostrophes of `csv.guarded`.
    """
    return "".join([head(several=False), rows(None, results, raw=raw), tail(several=False)])


def head(*, several: bool) -> str:
    """Return the line of column names, with `case` first for several results."""
    return csv.lines([["case"] * several + ["table", "row", "gear", "value"]])


def rows(file: str | None, results: Results, *, raw: bool = False) -> str:
    """Return the rows of a result, which begin with the file of the case unless it is None."""
    front = [] if file is None else [file]
    cells = []
    for table in tables(results):
        kind = float if table.quantity.kind is float else int  # flags are written as 0 or 1
        values = table.values.ravel().tolist()
        for (key, row, gear), value in zip(places(table), values, strict=True):
            shown = "" if math.isnan(value) else repr(kind(value))
            cells.append([*front, key, row, gear or "", shown])
    return csv.lines(cells, raw=raw)


def tail(*, several: bool) -> str:
    """Return the rows with the conventions and the program."""
    about = [("conventions", convention) for convention in CONVENTIONS]
    return csv.lines(
        [""] * several + [table, text, "", ""] for table, text in [*about, ("program", PROGRAM)]
    )
