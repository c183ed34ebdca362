"""Tables of the results of a case, in which zeros without information can be blank."""

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
    """Yield all tables of the results. The first table has a row for each gear.

    Parameters
    ----------
    results : Results
    blanks : bool
        True for blanks instead of `structural_zeros`.
    """
    in_order = tables(results)
    yield _by_gear([table for table in in_order if table.quantity.rows == "one"])
    for table in sorted(in_order, key=lambda table: table.quantity.columns == "devices"):
        if table.quantity.rows != "one" and table.values.size:
            grid = _of_table(table)
            if table.quantity.name == "idle":
                grid = _with_roles(grid, results)
            if blanks:  # only texts become blank, values remain
                zero = structural_zeros(table, results).tolist()
                grid = _by_place(
                    grid, zero, lambda cell, no: cell._replace(text="") if no else cell
                )
            yield grid


def _with_roles(grid: Grid, results: Results) -> Grid:
    """Return the table `idle` with the names of roles instead of marks."""
    by_gear = [roles(results, number) for number in range(len(results.case.gears))]

    def with_role(cell: Cell, role: str) -> Cell:
        return (
            cell if cell.text == NOTHING else cell._replace(text=role or NO, says="", is_said=True)
        )

    return _by_place(grid, zip(*by_gear, strict=True), with_role)


def _by_place(grid: Grid, data: Iterable[Sequence[T]], change: Callable[[Cell, T], Cell]) -> Grid:
    """Return a table after applying a function of cell and datum to all but the first column."""
    pairs = zip(grid.cells, data, strict=True)
    return grid._replace(
        rows=[[row[0], *map(change, row[1:], row_data)] for row, row_data in pairs]
    )


def of_messages(results: Results) -> Grid:
    """Return the table of messages about the gears."""
    rows = ((message.gear, word(message.severity), message.text) for message in results.messages)
    return grid_of("Messages", ["gear", "severity", "message"], rows, key="messages")


def _by_gear(lists: Sequence[Table]) -> Grid:
    """Return a table with a row for each gear, and a column for each of `lists`."""
    columns = [text("gear")]
    columns += [Column(table.quantity.name.replace("_", " ")) for table in lists]
    rows = [
        [Cell(gear), *(_number(table, float(table.values[0, index])) for table in lists)]
        for index, gear in enumerate(lists[0].columns)
    ]
    return Grid("By gear", columns, rows, key="gears")


def _of_table(table: Table) -> Grid:
    kind = table.quantity.rows
    over = "gear" if table.quantity.columns == "gears" else "component"
    columns = [text(_HEADS.get(kind, ROWS[kind].singular))]
    columns += [Column(name, over=over) for name in table.columns]
    rows = [
        [Cell(name), *(_number(table, value) for value in values)]
        for name, values in zip(table.rows, table.values.tolist(), strict=True)
    ]
    return Grid(
        f"{table.quantity.title} [{table.quantity.name}]", columns, rows, key=table.quantity.name
    )


_HEADS = {"elements": "shift element", "torques": "torque of"}
"""Headings of columns of row names, if not the word for the kind of row."""


def _number(table: Table, value: float) -> Cell:
    if table.quantity.kind is bool:
        return sign(value)
    if table.quantity.kind is int:
        return whole(value)
    return exact(value, table.quantity.decimals)


_OF_SCHEME = {"mesh_torques", "lossy_mesh_torques", "power_sign", "idle", "holds"}
_TORQUES = {"torques", "lossy_torques"}


def structural_zeros(table: Table, results: Results) -> Booleans:
    """Return flags of zeros that follow from the gear-train layout, shape (rows, columns).

    Such zeros are torques of disengaged shift elements and unloaded members, slip speeds of engaged
    shift elements, losses of unloaded mechanisms, and matrix entries for links that a mechanism
    does not have. Zeros of links at rest, and of engaged shift elements without torque, are not
    flagged.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.core.tables.values import tables
    >>> elements = [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")]
    >>> case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> results = solve(case)
    >>> zeros = {table.quantity.name: structural_zeros(table, results) for table in tables(results)}
    >>> zeros["slip_speeds"].tolist(), zeros["torques"].tolist()[:2], bool(zeros["speeds"].any())
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
    candidates = {"slip_speeds": results.holds.T, "losses": results.idle.T}
    zero &= candidates.get(name, np.zeros_like(zero))
    return zero


def without_zeros(grid: Grid) -> Grid:
    """Return a table with blank texts, but unchanged values, for numbers that are exactly 0.

    >>> from vstatics.core.tables.grid import Column, exact, text
    >>> cells = [exact(0.0), exact(0.5)]
    >>> without_zeros(Grid("t", [text("x"), Column("y"), Column("z")], [["a", *cells]])).texts
    [['a', '', '0.500']]
    """
    return grid.changed(lambda cell: cell._replace(text="") if cell.value == 0 else cell)


def without_missing(grid: Grid) -> Grid:
    """Return a table in which the texts of missing numbers are blank.

    >>> from vstatics.core.tables.grid import Column, exact, text
    >>> without_missing(Grid("t", [text("x"), Column("y")], [["a", exact(None)]])).texts
    [['a', '']]
    """
    return grid.changed(lambda cell: cell._replace(text="") if cell.text == NOTHING else cell)
