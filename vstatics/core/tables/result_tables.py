"""The results of a case as tables, for people, and what a page leaves blank in them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Booleans
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import roles
from vstatics.core.tables.grid import (
    NO,
    NOTHING,
    Cell,
    Column,
    Grid,
    exact,
    grid_of,
    sign,
    text,
    whole,
    word,
)
from vstatics.core.tables.names import ROWS
from vstatics.core.tables.quantities import Table
from vstatics.core.tables.values import tables

T = TypeVar("T")


def of_results(results: Results, *, blanks: bool = False) -> Iterator[Grid]:
    """All tables of the results: lists over gears together, then the others.

    Parameters
    ----------
    blanks : bool
        Whether zeros that the scheme makes are left out.
    """
    in_order = tables(results)
    yield _by_gear([one for one in in_order if one.quantity.rows == "one"])
    for one in sorted(in_order, key=lambda one: one.quantity.columns == "devices"):
        if one.quantity.rows != "one" and one.values.size:
            grid = _of_table(one)
            if one.quantity.name == "idle":
                grid = _with_roles(grid, results)
            if blanks:  # for people; the values stay
                zero = structural_zeros(one, results).tolist()
                grid = _by_place(
                    grid, zero, lambda cell, no: cell._replace(text="") if no else cell
                )
            yield grid


def _with_roles(grid: Grid, results: Results) -> Grid:
    """Marks of what transmits no power, as the word for it."""
    by_gear = [roles(results, number) for number in range(len(results.case.gears))]

    def said(cell: Cell, role: str) -> Cell:
        return (
            cell if cell.text == NOTHING else cell._replace(text=role or NO, says="", is_said=True)
        )

    return _by_place(grid, zip(*by_gear, strict=True), said)


def _by_place(grid: Grid, told: Iterable[Sequence[T]], change: Callable[[Cell, T], Cell]) -> Grid:
    """The same with other cells behind its first column, by what is told of each."""
    pairs = zip(grid.cells, told, strict=True)
    return grid._replace(rows=[[row[0], *map(change, row[1:], of_row)] for row, of_row in pairs])


def of_messages(results: Results) -> Grid:
    """What there is to say of the gears."""
    rows = ((one.gear, word(one.severity), one.text) for one in results.messages)
    return grid_of("Messages", ["gear", "severity", "message"], rows, key="messages")


def _by_gear(lists: Sequence[Table]) -> Grid:
    """A row for each gear, with the quantities of one number."""
    columns = [text("gear")]
    columns += [Column(one.quantity.key.replace("_", " ")) for one in lists]
    rows = [
        [Cell(gear), *(_number(one, float(one.values[0, place])) for one in lists)]
        for place, gear in enumerate(lists[0].columns)
    ]
    return Grid("By gear", columns, rows, key="gears")


def _of_table(one: Table) -> Grid:
    kind = one.quantity.rows
    over = "gear" if one.quantity.columns == "gears" else "device"
    columns = [text(_HEADS.get(kind, ROWS[kind].one))]
    columns += [Column(name, over=over) for name in one.columns]
    rows = [
        [Cell(name), *(_number(one, value) for value in values)]
        for name, values in zip(one.rows, one.values.tolist(), strict=True)
    ]
    return Grid(f"{one.quantity.title} [{one.quantity.key}]", columns, rows, key=one.quantity.key)


_HEADS = {"elements": "element", "torques": "torque of"}
"""Over the names of rows, where it is not their word."""


def _number(one: Table, value: float) -> Cell:
    if one.quantity.kind is bool:
        return sign(value)
    if one.quantity.kind is int:
        return whole(value)
    return exact(value, one.quantity.decimals)


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
    >>> from vstatics.core.tables.values import tables
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

    >>> from vstatics.core.tables.grid import Column, exact, text
    >>> cells = [exact(0.0), exact(0.5)]
    >>> without_zeros(Grid("t", [text("x"), Column("y"), Column("z")], [["a", *cells]])).texts
    [['a', '', '.500']]
    """
    return grid.changed(lambda cell: cell._replace(text="") if cell.value == 0 else cell)


def without_missing(grid: Grid) -> Grid:
    """A table in which numbers that do not exist are blank, where that is what is usual.

    >>> from vstatics.core.tables.grid import Column, exact, text
    >>> without_missing(Grid("t", [text("x"), Column("y")], [["a", exact(None)]])).texts
    [['a', '']]
    """
    return grid.changed(lambda cell: cell._replace(text="") if cell.text == NOTHING else cell)
