"""Marks on the numbers of a page, by which a script finds them to update them.

``data-result`` is the key of the quantity in JSON, ``data-row`` the name of the row of a table, and
``data-gear`` the gear. ``data-number`` is the number with all digits, empty if missing. A page
without scripts has no marks.
"""

from __future__ import annotations

import math

from vstatics.core.tables.grid import Cell


def with_mark(cell: Cell, result: str, **place: str) -> Cell:
    """Return a cell of a table with marks: quantity, row or gear, and all digits of the number.

    >>> with_mark(Cell("1.5", 1.5), "ratio", gear="R").marks
    {'result': 'ratio', 'gear': 'R', 'number': '1.5'}
    """
    value = math.nan if cell.value is None else cell.value
    return cell._replace(marks={"result": result, **place, "number": digits_of(value)})


def digits_of(value: float) -> str:
    """Return a number with all digits; an empty text for NaN.

    >>> digits_of(0.1), digits_of(3.0), digits_of(float("nan"))
    ('0.1', '3', '')
    """
    return repr(float(value)).removesuffix(".0") if math.isfinite(value) else ""
