"""Results as CSV in long form: one number a row, for spreadsheets and pandas."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from vstatics.results import Results
from vstatics.writers.tables import tables

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
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["case"] * several + ["table", "row", "gear", "value"])
    for file, result in results:
        front = [file] * several
        for table in tables(result):
            for row, values in zip(table.rows, table.values, strict=True):
                for column, value in zip(table.columns, values, strict=True):
                    ajk = table.shape.name == "AJK"
                    place = [f"{row}:{column}", ""] if ajk else [row, column]
                    shown = "" if math.isnan(value) else _number(value, table.shape.kind)
                    writer.writerow([*front, table.shape.name, *place, shown])
    for convention in CONVENTIONS:
        writer.writerow([""] * several + ["conventions", convention, "", ""])
    return text.getvalue()


def _number(value: float, kind: type) -> str:
    """A number in full; what is whole or a mark without a decimal point."""
    return repr(float(value)) if kind is float else str(int(value))
