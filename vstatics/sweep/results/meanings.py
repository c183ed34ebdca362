"""What names in an expression stand for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Language
from vstatics.core.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.sweep.variants.targets import OF_MECHANISM

OMEGA = "omega"
"""Table of natural frequencies, which the annex of torsional vibration calculates. [rad/s]"""
STEP, SPREAD = "step", "spread"
OF_RATIOS = (STEP, SPREAD)
"""Tables that follow from the ratios of all gears; only sweeps have them."""


OK = "ok"
"""Whether the status of a row is that; only sweeps have it."""


PART_NUMBERS: dict[str, str] = {one: f"{one} of parts" for one in OF_MECHANISM}
"""Tables of what mechanisms have in a variant, by the quantity; an expression names a number."""
OF_A_VARIANT = (SPREAD, *PART_NUMBERS.values())
"""Tables that have one value for all gears."""


class Selection(NamedTuple):
    """A table of the results, or what is left of it."""

    table: str
    gear: int | None
    """None for all gears."""
    row: int | None
    """None for all rows, or where the table has none."""
    rows: int
    """How many there are; 0: the table has one value per gear."""


class VariedNumber(NamedTuple):
    """A number that the sweep varies."""

    column: int


Name: TypeAlias = Selection | VariedNumber


class NameFinder(Protocol):
    """Finds what the names in an expression mean."""

    source: Excerpt

    @property
    def language(self) -> Language:
        """What the expression can have."""

    @property
    def gears(self) -> Sequence[str]:
        """Names along the axis of gears; none if it is another one."""

    def number(self, name: DottedName) -> VariedNumber | Applied | Constant | Selection:
        """Return the meaning of a number of the subject."""

    def table(self, read: TableName) -> Selection | VariedNumber | Constant:
        """Return the meaning of a table, or of a part of it."""

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of a table's rows; none if it has no rows."""

    def written_rows(self, table: str) -> Sequence[str]:
        """Return the names of all rows that a table can have in a variant."""

    def row(self, table: str) -> str:
        """Return what a row of a table is."""

    def key(self, index: int, rows: Sequence[str]) -> str:
        """Return a row or a gear as it is written between brackets."""


class Tables(Protocol):
    """What has tables: `Results`, or what a sweep calculates of a block of variants."""

    def existing(self, name: str) -> Floats:
        """A table of shape (..., gears[, rows]), with NaN where there is nothing to be said."""


class GearRows(NamedTuple):
    """Tables whose rows are of a gear: first all gears of the first variant."""

    tables: Tables
    gears: int

    def existing(self, name: str) -> Floats:
        """A table of shape (variants * gears, 1[, rows])."""
        table: Any = self.tables.existing(name)
        if name in OF_A_VARIANT:
            table = np.repeat(table, self.gears, axis=1)
        variants, gears, *rows = table.shape
        whole: Floats = table.reshape(variants * gears, 1, *rows)
        return whole


class WithStatus(NamedTuple):
    """Tables, and which rows are of variants of which nothing bad is to be said."""

    tables: Tables
    good: Booleans
    """(rows,)"""

    def existing(self, name: str) -> Floats:
        """A table; the one of the status has a single value for each row."""
        if name == OK:
            good: Floats = self.good[:, np.newaxis].astype(float)
            return good
        return self.tables.existing(name)


def value_of(name: Name, tables: Tables, varied: Floats) -> Floats:
    """The values of what a name stands for, shape (..., gears or 1, rows or 1).

    Floats are views of the results, whatever their strides; marks are copied to floats.
    """
    if isinstance(name, VariedNumber):
        return varied[..., name.column, None, None]
    table: Any = tables.existing(name.table)
    if not name.rows:
        table = table[..., None]
    gears = slice(None) if name.gear is None else slice(name.gear, name.gear + 1)
    rows = slice(name.rows or 1) if name.row is None else slice(name.row, name.row + 1)
    values: Floats = table[..., gears, rows].astype(float, copy=False)
    return values
