"""Marks on results and powers of gears, by which the scripts of a page find the numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.core.flow.tables import SECTIONS
from vstatics.core.tables.grid import Cell, Grid
from vstatics.core.tables.quantities import QUANTITIES
from vstatics.page.report.tools.marks import LOSS_SHARE, POWERS
from vstatics.pictures.paged.marks import with_mark

_OF_GEARS = {"ratio": "ratio", "step": "step", "efficiency": "efficiency"} | {
    quantity.name.replace("_", " "): quantity.name
    for quantity in QUANTITIES
    if quantity.rows == "one"
}
"""Keys of quantities by their heading in the table with a row for each gear."""
_WITH_ROWS = {quantity.name for quantity in QUANTITIES if quantity.columns == "gears"}
"""Keys of quantities whose table has a column for each gear."""


def marked(grid: Grid) -> Grid:
    """Return a table of results of gears with marks on its numbers.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.tables.result_tables import of_results
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear()], link_names=["in", "out"])
    >>> by_key = {grid.key: marked(grid) for grid in of_results(solve(case))}
    >>> by_key["speeds"].cells[1][1].marks
    {'result': 'speeds', 'row': 'out', 'gear': '1', 'number': '-0.25'}
    >>> [cell.marks.get("result") for cell in by_key["gears"].cells[0]][:3]
    [None, 'efficiency', 'ratio']
    """
    if grid.key == "gears":
        names = [_OF_GEARS.get(column.heading, "") for column in grid.columns]
        return grid._replace(rows=[_of_gear(row, names) for row in grid.cells])
    if grid.key in _WITH_ROWS:
        gears = [column.heading for column in grid.columns[1:]]
        return grid._replace(rows=[_of_row(row, grid.key, gears) for row in grid.cells])
    return grid


def marked_powers(grid: Grid, gear: str) -> Grid:
    """Return the table of a gear's powers with marks on its numbers.

    Rows are named by kind and name, as in ``link ring`` or ``mechanism P1.sun``. Powers of tooth
    meshes and of spring members are marked with their present unit only, because scripts convert
    but do not recalculate them.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.tables import power_grid
    >>> from vstatics.core.flow.power import flows
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [flow] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> [row[1].marks.get("row") for row in marked_powers(power_grid(flow), "1").cells][:6]
    [None, 'link 1', 'link 2', None, 'mechanism pair', 'mechanism pair.first']
    """
    kinds = {heading: kind for kind, heading in SECTIONS.items()}
    names = [POWERS.get(column.heading, "") for column in grid.columns]
    kind, owner, rows = "", "", []
    for level, row in zip(grid.levels, grid.cells, strict=True):
        name = row[0].text
        if level == 1:
            kind = kinds[name]
        elif level == 2:
            owner = name
        member = f".{name.partition(':')[0]}" * (level == 3)
        if level == 2 or (level == 3 and kind == "mechanism" and ":" in name):
            place = f"{kind} {owner}{member}"
            rows.append([*_of_powers(row, names, row=place, gear=gear)])
        else:
            rows.append([*_in_units(row, names, gear)])
    return grid._replace(rows=rows)


def _in_units(cells: Sequence[Cell], names: Sequence[str], gear: str) -> Iterator[Cell]:
    """Yield cells of powers with their present unit, for scripts that only convert values."""
    for cell, name in zip(cells, names, strict=True):
        if cell.kind is not float or name in ("", LOSS_SHARE):
            yield cell
        elif name.endswith("_kW"):
            yield cell._replace(marks={**cell.marks, "unit": "kW", "gear": gear, "repeats": ""})
        else:
            yield cell._replace(marks={**cell.marks, "scaled": "kW", "gear": gear})


def _of_powers(cells: Sequence[Cell], names: Sequence[str], **place: str) -> Iterator[Cell]:
    for cell, name in zip(cells, names, strict=True):
        yield with_mark(cell, name, **place) if name and cell.kind is float else cell


def _of_gear(row: Sequence[Cell], names: Sequence[str]) -> list[Cell]:
    gear = row[0].text
    return [
        with_mark(cell, name, gear=gear) if name else cell
        for cell, name in zip(row, names, strict=True)
    ]


def _of_row(row: Sequence[Cell], key: str, gears: Sequence[str]) -> list[Cell]:
    name, *cells = row
    pairs = zip(cells, gears, strict=True)
    return [name, *(with_mark(cell, key, row=name.text, gear=gear) for cell, gear in pairs)]
