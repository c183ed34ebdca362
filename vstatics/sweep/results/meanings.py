"""Meanings that names in an expression can have: tables, parts of tables, varied numbers."""

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
"""Tables derived from the ratios of all gears, which exist only in sweeps."""


OK = "ok"
"""Table that is 1 if the status of a row is ok, which exists only in sweeps."""


PART_NUMBERS: dict[str, str] = {quantity: f"{quantity} of parts" for quantity in OF_MECHANISM}
"""Name of the table with the values of all mechanisms in a variant, by the quantity."""
OF_A_VARIANT = (SPREAD, *PART_NUMBERS.values())
"""Tables with a single value for all gears."""


class Selection(NamedTuple):
    """Table of the results, or a part of a table."""

    table: str
    gear: int | None
    """Index of the gear, or `None` for all gears."""
    row: int | None
    """Index of the row, or `None` for all rows or a table without rows."""
    rows: int
    """Number of rows; 0 for a table with a single value per gear."""


class VariedNumber(NamedTuple):
    """Number that the sweep varies."""

    column: int


Name: TypeAlias = Selection | VariedNumber


class NameFinder(Protocol):
    """Finder of the meanings of names in an expression."""

    source: Excerpt

    @property
    def language(self) -> Language:
        """Language of the expression."""

    @property
    def gears(self) -> Sequence[str]:
        """Names of the gears along the axis of gears; empty without this axis."""

    def number(self, name: DottedName) -> VariedNumber | Applied | Constant | Selection:
        """Return the meaning of a number of the subject."""

    def table(self, read: TableName) -> Selection | VariedNumber | Constant:
        """Return the meaning of a table, or of a part of a table."""

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table, if any."""

    def written_rows(self, table: str) -> Sequence[str]:
        """Return the names of all rows that a table can have in a variant."""

    def row(self, table: str) -> str:
        """Return the noun for a row of a table."""

    def key(self, index: int, rows: Sequence[str]) -> str:
        """Return a row or a gear as written between brackets."""


class Tables(Protocol):
    """Object that has tables by name: `Results`, or the results of a block of variants."""

    def existing(self, name: str) -> Floats:
        """Return a table of shape (..., gears[, rows]), with NaN for undefined values."""


class GearRows(NamedTuple):
    """Tables with a row for each gear of a variant; all gears of the first variant come first."""

    tables: Tables
    gears: int

    def existing(self, name: str) -> Floats:
        """Return a table of shape (variants * gears, 1[, rows])."""
        table: Any = self.tables.existing(name)
        if name in OF_A_VARIANT:
            table = np.repeat(table, self.gears, axis=1)
        variants, gears, *rows = table.shape
        whole: Floats = table.reshape(variants * gears, 1, *rows)
        return whole


class WithStatus(NamedTuple):
    """Tables, and in addition the table `ok`, which marks the rows with the status ok."""

    tables: Tables
    good: Booleans
    """Mask of the rows with the status ok, shape (rows,)."""

    def existing(self, name: str) -> Floats:
        """Return a table; the table of the status has a single value per row."""
        if name == OK:
            good: Floats = self.good[:, np.newaxis].astype(float)
            return good
        return self.tables.existing(name)


def value_of(name: Name, tables: Tables, varied: Floats) -> Floats:
    """Return the values of a name, shape (..., gears or 1, rows or 1).

    Floats are views of the results with any strides; booleans are copied to floats.
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
