"""A table of results: rows, gears, numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.numerics.arrays import Floats
from vstatics.statics.results import TableShape


class Table(NamedTuple):
    """One table: rows are links, devices or mechanisms, columns are gears.

    In AJK columns are devices. A list over gears is a table of one row.
    """

    shape: TableShape
    rows: Sequence[str]
    columns: Sequence[str]
    values: Floats
    """(rows, columns), NaN for what does not exist."""
