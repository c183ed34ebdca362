"""Marks on numbers of a page, by which a script finds the number that it changes.

``data-result`` is the key of the quantity in JSON, ``data-row`` the name of its row there, where
it has rows, ``data-gear`` the gear, ``data-number`` the number with all digits, empty where there
is none. A page that stays as it is has no marks.
"""

from __future__ import annotations

import math

from vstatics.core.tables.grid import Cell


def with_mark(cell: Cell, result: str, **place: str) -> Cell:
    """Return a number that says what it is.

    >>> with_mark(Cell("1.5", 1.5), "ratio", gear="R").marks
    {'result': 'ratio', 'gear': 'R', 'number': '1.5'}
    """
    value = math.nan if cell.value is None else cell.value
    return cell._replace(marks={"result": result, **place, "number": digits_of(value)})


def digits_of(value: float) -> str:
    """A number with all its digits; nothing for one that does not exist.

    >>> digits_of(0.1), digits_of(3.0), digits_of(float("nan"))
    ('0.1', '3', '')
    """
    return repr(float(value)).removesuffix(".0") if math.isfinite(value) else ""
