"""Written results as numbers: what a reader makes of a listing or JSON, to be compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.model.transmission import Transmission


class Figure(NamedTuple):
    """A number as it was written: NaN stands for none."""

    value: float
    slack: float = 0.0
    """Half of the last digit, for a number from a listing."""


Figures = list[list[Figure]]
"""Rows of a table; a list over gears is one row."""


class WrittenResult(NamedTuple):
    """The tables of one result, by their keys."""

    tables: dict[str, Figures]
    case: Transmission | None
    """For the names of rows and gears; a foreign listing may have none."""
    printed: bool
    """Whether it was a listing."""
    errors: bool = False
    """Whether it stands for a case that failed."""
    rows: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Names of the rows of its tables, where the result of a drawn case has them."""
