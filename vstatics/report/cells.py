"""The results as tables of the page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.statics.results import Results
from vstatics.tables.grid import Cell, Column, Grid, exact, sign
from vstatics.tables.table import Table
from vstatics.tables.values import tables
from vstatics.writers.listing import HEADINGS, UNITS

_OWN = {
    "W": "Speeds of the links",
    "AMLG": "Torques of shift elements, mechanisms and the output (Mx), without losses",
    "AMLGP": "Torques of shift elements, mechanisms and the output (Mx), with losses",
    "AJK": "Structural-distribution matrix",
}
TITLES = {
    name: heading.en.removesuffix(":").removesuffix(" (1)")
    for name, heading in {**HEADINGS, **UNITS}.items()
} | _OWN
"""Of a table of the results, by its name."""

_DECIMALS = {"": 3, "rpm": 1, "Nm": 1, "kW": 3}


def of_results(results: Results) -> Iterator[Grid]:
    """All tables of the results: lists over gears together, then the others."""
    found = tables(results)
    yield _by_gear([one for one in found if one.shape.rows == "one"])
    matrix_last = sorted(found, key=lambda one: one.shape.name == "AJK")
    for one in matrix_last:
        if one.shape.rows != "one" and one.values.size:
            yield _of_table(one)


def _by_gear(lists: Sequence[Table]) -> Grid:
    """A row for each gear, with the quantities of one number."""
    columns = [Column("gear", is_number=False)]
    columns += [Column(one.shape.name.replace("_", " ")) for one in lists]
    rows = [
        [Cell(gear), *(_number(one, float(one.values[0, place])) for one in lists)]
        for place, gear in enumerate(lists[0].columns)
    ]
    return Grid("By gear", columns, rows)


def _of_table(one: Table) -> Grid:
    columns = [Column(_ROWS[one.shape.rows], is_number=False), *map(Column, one.columns)]
    rows = [
        [Cell(name), *(_number(one, value) for value in values)]
        for name, values in zip(one.rows, one.values.tolist(), strict=True)
    ]
    return Grid(f"{TITLES[one.shape.name]} [{one.shape.name}]", columns, rows)


_ROWS = {
    "links": "link",
    "elements": "element",
    "mechanisms": "mechanism",
    "torques": "torque of",
    "meshes": "mesh",
}


def _number(one: Table, value: float) -> Cell:
    if one.shape.kind is bool:
        return sign(value)
    if one.shape.kind is int:
        return exact(value, 0)
    small = one.shape.name in ("losses", "drag_losses", "ETA")
    return exact(value, 4 if small else _DECIMALS[one.shape.unit])
