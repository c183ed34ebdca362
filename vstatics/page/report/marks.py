"""Marks on the numbers of a page, by which a script finds the one that it changes.

``data-result`` is the key of the quantity in JSON, ``data-row`` the name of its row there, where
it has rows, ``data-gear`` the gear, ``data-number`` the number with all digits, empty where there
is none. A page that stays as it is has no marks.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.core.flow.tables import SECTIONS
from vstatics.core.tables.grid import Cell, Grid
from vstatics.core.tables.quantities import QUANTITIES
from vstatics.page.report.tools.marks import LOSS_SHARE, POWERS

_OF_GEARS = {"ratio": "ratio", "step": "step", "efficiency": "ETA"} | {
    one.key.replace("_", " "): one.key for one in QUANTITIES if one.rows == "one"
}
"""Columns of the tables that have a row for each gear, and what their numbers are."""
_WITH_ROWS = {one.key for one in QUANTITIES if one.columns == "gears"}


def marked(grid: Grid) -> Grid:
    """A table whose numbers say what they are, if they are results of gears or times of events.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.tables.result_tables import of_results
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear()], link_names=["in", "out"])
    >>> by_key = {one.key: marked(one) for one in of_results(solve(case))}
    >>> by_key["W"].cells[1][1].marks
    {'result': 'W', 'row': 'out', 'gear': '1', 'number': '-0.25'}
    >>> [one.marks.get("result") for one in by_key["gears"].cells[0]][:3]
    [None, 'ETA', 'ratio']
    """
    if grid.key == "gears":
        names = [_OF_GEARS.get(one.heading, "") for one in grid.columns]
        return grid._replace(rows=[_of_gear(row, names) for row in grid.cells])
    if grid.key == "events":
        return grid._replace(rows=[_of_event(row) for row in grid.cells])
    if grid.key in _WITH_ROWS:
        gears = [one.heading for one in grid.columns[1:]]
        return grid._replace(rows=[_of_row(row, grid.key, gears) for row in grid.cells])
    return grid


def marked_frequencies(grid: Grid) -> Grid:
    """The natural frequencies of all gears with marks: ``frequencies``, by number of the mode.

    Examples
    --------
    >>> from vstatics.core.tables.grid import Column, grid_of
    >>> columns = ["gear", Column("rigid modes"), Column("1", over="mode")]
    >>> [row] = marked_frequencies(grid_of("f [Hz]", columns, [("R", 1, 12.5)])).cells
    >>> row[2].marks
    {'result': 'frequencies', 'row': '1', 'gear': 'R', 'number': '12.5'}
    """
    rows = [
        [
            _marked(cell, "frequencies", row=column.heading, gear=row[0].text)
            if column.over and cell.value is not None
            else cell
            for cell, column in zip(row, grid.columns, strict=True)
        ]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)


def marked_powers(grid: Grid, gear: str) -> Grid:
    """The table of powers of a gear with marks; rows are ``link ring``, ``mechanism P1.sun``.

    Power of teeth, and of members of springs, has the unit that it is in alone: no script
    calculates it.

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
    names = [POWERS.get(one.heading, "") for one in grid.columns]
    kind, owner, rows = "", "", []
    for level, row in zip(grid.levels, grid.cells, strict=True):
        own = row[0].text
        if level == 1:
            kind = kinds[own]
        elif level == 2:
            owner = own
        member = f".{own.partition(':')[0]}" * (level == 3)
        if level == 2 or (level == 3 and kind == "mechanism" and ":" in own):
            place = f"{kind} {owner}{member}"
            rows.append([*_of_powers(row, names, row=place, gear=gear)])
        else:
            rows.append([*_in_units(row, names, gear)])
    return grid._replace(rows=rows)


def _in_units(cells: Sequence[Cell], names: Sequence[str], gear: str) -> Iterator[Cell]:
    """Powers that a script writes in other units, and does not calculate."""
    for cell, name in zip(cells, names, strict=True):
        if cell.kind is not float or name in ("", LOSS_SHARE):
            yield cell
        elif name.endswith("_kW"):
            yield cell._replace(marks={**cell.marks, "unit": "kW", "gear": gear, "repeats": ""})
        else:
            yield cell._replace(marks={**cell.marks, "scaled": "kW", "gear": gear})


def _of_powers(cells: Sequence[Cell], names: Sequence[str], **place: str) -> Iterator[Cell]:
    for cell, name in zip(cells, names, strict=True):
        yield _marked(cell, name, **place) if name and cell.kind is float else cell


def _of_gear(row: Sequence[Cell], names: Sequence[str]) -> list[Cell]:
    gear = row[0].text
    return [
        _marked(cell, name, gear=gear) if name else cell
        for cell, name in zip(row, names, strict=True)
    ]


def _of_row(row: Sequence[Cell], key: str, gears: Sequence[str]) -> list[Cell]:
    name, *cells = row
    pairs = zip(cells, gears, strict=True)
    return [name, *(_marked(cell, key, row=name.text, gear=gear) for cell, gear in pairs)]


def _of_event(row: Sequence[Cell]) -> list[Cell]:
    """The time of what happens, by what it happens to."""
    time, element, event, *others = row
    named = _marked(time, "events", row=f"{element.text} {event.text}".strip())
    return [named, element, event, *others]


def _marked(cell: Cell, result: str, **place: str) -> Cell:
    value = math.nan if cell.value is None else cell.value
    return cell._replace(marks={"result": result, **place, "number": digits_of(value)})


def digits_of(value: float) -> str:
    """A number with all its digits; nothing for one that does not exist.

    >>> digits_of(0.1), digits_of(3.0), digits_of(float("nan"))
    ('0.1', '3', '')
    """
    return repr(float(value)).removesuffix(".0") if math.isfinite(value) else ""
