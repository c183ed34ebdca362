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
"""Name of the table of natural frequencies, which the annex of torsional vibration calculates.
[rad/s]
"""
STEP, SPREAD = "step", "spread"
OF_RATIOS = (STEP, SPREAD)
"""Names of tables that are derived from the ratios of all gears, only in sweeps."""


OK = "ok"
"""Name of the table that is 1 for rows with the status ok, else 0; only in sweeps."""


PART_NUMBERS: dict[str, str] = {quantity: f"{quantity} of parts" for quantity in OF_MECHANISM}
"""Names of the tables with the ratio or efficiency of each mechanism, by the quantity."""
OF_A_VARIANT = (SPREAD, *PART_NUMBERS.values())
"""Tables whose values do not depend on the gear."""


class Selection(NamedTuple):
    """Table of results, or a part of a table."""

    table: str
    gear: int | None
    """Index of the gear; None for all gears."""
    row: int | None
    """Index of the row; None for all rows, or for a table without rows."""
    rows: int
    """Number of rows; 0 for a table with a single value per gear."""


class VariedNumber(NamedTuple):
    """Number that the sweep varies, given by the index among the varied numbers."""

    column: int


Name: TypeAlias = Selection | VariedNumber


class NameFinder(Protocol):
    """Finder of the meanings of names in an expression."""

    source: Excerpt

    @property
    def language(self) -> Language:
        """Language of the expression: functions and operators."""

    @property
    def gears(self) -> Sequence[str]:
        """Names of the gears if values have an axis of gears; otherwise empty."""

    def number(self, name: DottedName) -> VariedNumber | Applied | Constant | Selection:
        """Return the meaning of the name of a number in the case or scenario."""

    def table(self, read: TableName) -> Selection | VariedNumber | Constant:
        """Return the meaning of the name of a table, with the subscripts."""

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table; empty for a table without rows."""

    def written_rows(self, table: str) -> Sequence[str]:
        """Return the names of all rows that a table can have in a variant."""

    def row(self, table: str) -> str:
        """Return the noun for a row of a table."""

    def key(self, index: int, rows: Sequence[str]) -> str:
        """Return the name of a row or gear with an index, as written between brackets."""


class Tables(Protocol):
    """Object that has tables by name: `Results`, or the results of a block of variants."""

    def existing(self, name: str) -> Floats:
        """Return the table called `name`, shape (..., gears[, rows]), with NaN where undefined."""


class GearRows(NamedTuple):
    """Tables in which each gear of a variant has a row. Gears of a variant are neighbours."""

    tables: Tables
    gears: int

    def existing(self, name: str) -> Floats:
        """Return the table called `name`, shape (variants * gears, 1[, rows])."""
        table: Any = self.tables.existing(name)
        if name in OF_A_VARIANT:
            table = np.repeat(table, self.gears, axis=1)
        variants, gears, *rows = table.shape
        whole: Floats = table.reshape(variants * gears, 1, *rows)
        return whole


class WithStatus(NamedTuple):
    """Tables with the additional table `ok`, which marks rows with the status ok."""

    tables: Tables
    good: Booleans
    """Mask of the rows with the status ok, shape (rows,)."""

    def existing(self, name: str) -> Floats:
        """Return the table called `name`. `ok` has a value per row."""
        if name == OK:
            good: Floats = self.good[:, np.newaxis].astype(float)
            return good
        return self.tables.existing(name)


def value_of(name: Name, tables: Tables, varied: Floats) -> Floats:
    """Return the values of a table or varied number, shape (..., gears or 1, rows or 1).

    Floats are returned as views of the results; booleans are converted to floats.
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
