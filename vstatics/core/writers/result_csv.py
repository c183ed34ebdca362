"""Results as CSV in long form, with a number in each row, for spreadsheets and pandas."""

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
"""Conventions of the numbers.

They are written as rows without a value, because CSV has no comments for spreadsheets.
"""


def write(results: Results, *, raw: bool = False) -> str:
    """Write the results of a case as CSV.

    The columns are table, row, gear and value. The distribution matrix does not depend on the
    gear: its rows are ``link:device``, without a gear. A value that does not exist is empty. The
    last rows state the conventions and the program, also without a value.

    Parameters
    ----------
    results : Results
    raw : bool
        Whether texts that begin like a formula are left unguarded; see `csv.guarded`.
    """
    return "".join([head(several=False), rows(None, results, raw=raw), tail(several=False)])


def head(*, several: bool) -> str:
    """Write the names of the columns; several results need a column `case`."""
    return csv.lines([["case"] * several + ["table", "row", "gear", "value"]])


def rows(file: str | None, results: Results, *, raw: bool = False) -> str:
    """Write the rows of a result, with the file of the case if there are several."""
    front = [] if file is None else [file]
    cells = []
    for table in tables(results):
        kind = float if table.quantity.kind is float else int  # a flag is written as 0 or 1
        values = table.values.ravel().tolist()
        for (key, row, gear), value in zip(places(table), values, strict=True):
            shown = "" if math.isnan(value) else repr(kind(value))
            cells.append([*front, key, row, gear or "", shown])
    return csv.lines(cells, raw=raw)


def tail(*, several: bool) -> str:
    """Write the rows of the conventions and of the program."""
    about = [("conventions", convention) for convention in CONVENTIONS]
    return csv.lines(
        [""] * several + [table, text, "", ""] for table, text in [*about, ("program", PROGRAM)]
    )
