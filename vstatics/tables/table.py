"""A table of results: rows, gears, numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.numerics.arrays import Floats
from vstatics.tables.quantity import Quantity


class Table(NamedTuple):
    """One table: rows are links, devices or mechanisms, columns are gears.

    Columns of the distribution matrix are devices. A list over gears is a table of one row.
    """

    quantity: Quantity
    rows: Sequence[str]
    columns: Sequence[str]
    values: Floats
    """(rows, columns), NaN for what does not exist."""
