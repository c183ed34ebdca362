"""The largest values over all gears, each with its gear."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.statics.results import Results
from vstatics.summary.order import SAME
from vstatics.tables.quantities import BY_NAME
from vstatics.tables.table import Table
from vstatics.tables.values import tables

PLANETS, SLIPS, TORQUES, LOSSY_TORQUES = "WSAT", "WFRI", "AMLG", "AMLGP"


class Largest(NamedTuple):
    """The value of a row that is the largest one without its sign."""

    row: str
    value: float
    """With its sign; NaN where there is none in any gear."""
    gear: str
    """The first gear with it; empty where the value is 0 or there is none."""


def largest(results: Results) -> dict[str, list[Largest]]:
    """The largest values over all gears, by the name of the table.

    Speeds of planets, slip speeds of open shift elements, torques of engaged ones without
    and with losses where the gear can run; with a load all of them in rpm and N*m, too.
    Rows are those of the tables, so what the case draws has its own.

    Parameters
    ----------
    results : Results
        Of one case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> found = largest(solve(case))
    >>> found["AMLG"][1]
    Largest(row='B', value=-2.5, gear='1')
    >>> list(found)
    ['WSAT', 'WFRI', 'AMLG', 'AMLGP']
    """
    found = {}
    for table in tables(results):
        key = table.quantity.key
        kind = BY_NAME[table.quantity.of or key].key
        if kind == PLANETS:
            found[key] = _of(table, table.values)
        elif kind == SLIPS:
            found[key] = _of(table, np.where(results.holds.T, np.nan, table.values))
        elif kind in (TORQUES, LOSSY_TORQUES):
            own = table.values[: len(results.case.shift_elements)]
            loaded = results.holds.T & results.calculable  # a gear that is tied up has no flow
            found[key] = _of(table, np.where(loaded, own, np.nan))
    return found


def overall(lines: Sequence[Largest]) -> Largest | None:
    """The largest of all rows."""
    known = [line for line in lines if not math.isnan(line.value)]
    return max(known, key=lambda line: abs(line.value)) if known else None


def _of(table: Table, values: Floats) -> list[Largest]:
    return [
        _largest(name, row, table.columns)
        for name, row in zip(table.rows, values, strict=False)  # rows of mechanisms left out
    ]


def _largest(name: str, row: Floats, gears: Sequence[str]) -> Largest:
    sizes = np.abs(row)
    if np.isnan(sizes).all():
        return Largest(name, math.nan, "")
    top = np.nanmax(sizes)
    first = int(np.argmax(sizes >= top * (1 - SAME)))  # a comparison with NaN is false
    return Largest(name, float(row[first]), gears[first] if top > 0 else "")
