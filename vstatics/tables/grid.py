"""A table of texts, which each format writes in its own way.

Plain text is `text`, then there are `markdown`, `latex`, `html` and, for a person at a
terminal, `terminal`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.tables.numbers import fixed

NOTHING = "-"
"""Stands for a number that does not exist, and for a list of nothing."""
LARGE = 1e7
"""From here on numbers that keep their digits are written with a power of ten."""
YES, NO = "●", "·"


class Column(NamedTuple):
    """A column of a grid."""

    heading: str
    is_number: bool = True
    is_sign: bool = False
    """Of one sign in each row: such columns stand close together at a terminal."""


class Cell(NamedTuple):
    """A cell of which more is known than its text."""

    text: str
    value: float | None = None
    """What the text is rounded from; None in a cell of words, NaN for what does not exist."""
    says: str = ""
    """What a sign means, for those who do not see it."""
    style: str = ""
    """Its colour at a terminal, as `rich` names it."""


class Grid(NamedTuple):
    """A table of texts; the first column names the rows."""

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell | str]]
    levels: Sequence[int] = ()
    """How far each row is set in, from 1: it stays below the row that it belongs to."""

    @property
    def cells(self) -> list[list[Cell]]:
        """The rows, where a text alone is a cell of words."""
        return [[one if isinstance(one, Cell) else Cell(one) for one in row] for row in self.rows]

    @property
    def texts(self) -> list[list[str]]:
        """The texts of all rows."""
        return [[cell.text for cell in row] for row in self.cells]


def text(heading: str) -> Column:
    """A column of words."""
    return Column(heading, is_number=False)


def number(value: float, decimals: int = 3) -> str:
    """A number as a cell.

    >>> number(3.5), number(math.nan)
    ('3.500', '-')
    """
    return fixed(value, decimals=decimals) if math.isfinite(value) else NOTHING


def exact(value: float | None, decimals: int = 3) -> Cell:
    """A number as a cell that keeps all its digits for a page; None does not exist.

    >>> exact(0.98765)[:2], exact(-1.5e9).text, exact(None).text
    (('.988', 0.98765), '-1.5e+09', '-')
    """
    known = math.nan if value is None else value
    if LARGE <= abs(known) < math.inf:
        return Cell(f"{known:.6g}", known)
    return Cell(number(known, decimals), known)


def sign(value: float) -> Cell:
    """A dot for what is so; NaN where it is unknown."""
    if math.isnan(value):
        return Cell(NOTHING, math.nan)
    return Cell(YES, 1.0, "yes") if value else Cell(NO, 0.0, "no")


def words(names: Sequence[str]) -> str:
    """Names as a cell."""
    return ", ".join(names) or NOTHING
