"""What a page leaves blank: zeros that follow from the scheme, what does not exist."""

from __future__ import annotations

import numpy as np

from vstatics.numerics.arrays import Booleans
from vstatics.statics.results import Results
from vstatics.tables.grid import NOTHING, Grid
from vstatics.tables.quantity import Table

_OF_SCHEME = {"mesh_torques", "lossy_mesh_torques", "power_sign", "idle", "holds"}
_TORQUES = {"torques", "lossy_torques"}


def structural_zeros(table: Table, results: Results) -> Booleans:
    """Where a table of one case has a zero that the scheme makes, (rows, columns).

    Torques of open elements and of members without load, slip of engaged elements, losses
    of what has no flow of power, links that a device does not have. What stands, and an
    engaged element without torque, keep their 0.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.tables.values import tables
    >>> elements = [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")]
    >>> case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> results = solve(case)
    >>> found = {one.quantity.name: structural_zeros(one, results) for one in tables(results)}
    >>> found["slip_speeds"].tolist(), found["torques"].tolist()[:2], bool(found["speeds"].any())
    ([[False, True], [True, False]], [[True, False], [False, True]], False)
    """
    quantity = table.quantity
    zero: Booleans = table.values == 0
    name = quantity.of or quantity.name
    if quantity.columns == "devices" or name in _OF_SCHEME:
        return zero
    if name in _TORQUES:
        zero[: len(results.holds.T)] &= ~results.holds.T
        zero[-1] = False
        return zero
    own = {"slip_speeds": results.holds.T, "losses": results.idle.T}
    zero &= own.get(name, np.zeros_like(zero))
    return zero


def without_zeros(grid: Grid) -> Grid:
    """A table in which what is exactly 0 is blank; the values stay.

    >>> from vstatics.tables.grid import Column, exact, text
    >>> cells = [exact(0.0), exact(0.5)]
    >>> without_zeros(Grid("t", [text("x"), Column("y"), Column("z")], [["a", *cells]])).texts
    [['a', '', '.500']]
    """
    rows = [
        [cell._replace(text="") if cell.value == 0 else cell for cell in row] for row in grid.cells
    ]
    return grid._replace(rows=rows)


def without_missing(grid: Grid) -> Grid:
    """A table in which numbers that do not exist are blank, where that is what is usual.

    >>> from vstatics.tables.grid import Column, exact, text
    >>> without_missing(Grid("t", [text("x"), Column("y")], [["a", exact(None)]])).texts
    [['a', '']]
    """
    rows = [
        [cell._replace(text="") if cell.text == NOTHING else cell for cell in row]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)
