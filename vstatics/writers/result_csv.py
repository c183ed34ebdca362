"""Results as CSV in long form: one number a row, for spreadsheets and pandas."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from vstatics.results import OUTPUT, Results
from vstatics.writers.tables import tables

LABELS = {
    OUTPUT: "Mx (given to the load; input torque = 1)",
    "ratio": "w_input/w_output",
}
"""The conventions stand in names of rows: a line of comment would trouble spreadsheets."""


def write(results: Sequence[Results], *, several: bool) -> str:
    """One or several results; several have a column `case` in front.

    Columns: table, row, gear, value. AJK, which is the same in all gears, has the link
    and the device in `row` and no gear. A value that does not exist is empty.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["case"] * several + ["table", "row", "gear", "value"])
    for number, result in enumerate(results, 1):
        front = [result.case.name or str(number)] * several
        for table in tables(result):
            for row, values in zip(table.rows, table.values, strict=True):
                for column, value in zip(table.columns, values, strict=True):
                    if table.shape.name == "AJK":
                        place = [f"{row}:{column}", ""]
                    else:
                        place = [LABELS.get(row, row), column]
                    shown = "" if math.isnan(value) else _number(value, table.shape.kind)
                    writer.writerow([*front, table.shape.name, *place, shown])
    return text.getvalue()


def _number(value: float, kind: type) -> str:
    """A number in full; what is whole or a mark without a decimal point."""
    return repr(float(value)) if kind is float else str(int(value))
