"""A table of texts, which each format writes in its own way."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.tables.numbers import fixed

NOTHING = "-"
"""Stands for a number that does not exist, and for a list of nothing."""


class Column(NamedTuple):
    """A column of a grid."""

    heading: str
    is_number: bool = True


class Grid(NamedTuple):
    """A table of texts."""

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[str]]


def text(heading: str) -> Column:
    """A column of words."""
    return Column(heading, is_number=False)


def number(value: float, decimals: int = 3) -> str:
    """A number as a cell.

    >>> number(3.5), number(math.nan)
    ('3.500', '-')
    """
    return fixed(value, decimals=decimals) if math.isfinite(value) else NOTHING


def words(names: Sequence[str]) -> str:
    """Names as a cell."""
    return ", ".join(names) or NOTHING
