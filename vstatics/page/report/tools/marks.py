"""Marks on tables for the tools of a page: links of each row, and unit of each number.

``data-links`` in the first cell of a row contains the indices of its links. ``data-unit`` is the
present unit of a number, and ``data-scaled`` its unit at an operating point. Results have
``data-result`` instead, whose units `toolbar` lists once for all tables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.result_arrays import OUTPUT
from vstatics.core.summary.tables import WITH_LOAD
from vstatics.core.tables.grid import Cell, Column, Grid
from vstatics.core.tables.quantities import UNITS

RELATIVE = "\N{MULTIPLICATION SIGN} input"
"""Heading, instead of a unit, of numbers relative to the input."""
LOSS_SHARE = "loss_share"
POWERS = {
    "ideal": "power",
    "with losses": "lossy_power",
    "kW": "lossy_power_kW",
    "loss": "power_loss",
    "loss, kW": "power_loss_kW",
    "share, %": LOSS_SHARE,
}
"""Keys of quantities by their heading in the table of powers of a gear."""
PartLinks = Callable[[str], Sequence[int]]
"""Function from the name of a component to the indices of its links."""
_RELATIVE = {"speed": "rpm", "slip": "rpm", "torque": "Nm", "with losses": "Nm"}
_RELATIVE |= {"power": "kW", "capacity": "Nm"}
"""Units of relative numbers at an operating point, by heading of the column."""
_IN_UNITS = ("planets", "shift elements", "margins", "needed capacity", "slip power", "ports")
"""Keys of tables with columns of relative numbers as well as columns with units."""


def with_tool_marks(grid: Grid, case: Transmission) -> Grid:
    """Return a table with marks for the tools of the page.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.tables.result_tables import of_results
    >>> pair = Mechanism(1, 2, 0, -4.0, name="pair")
    >>> case = Transmission(2, [], [pair], [Gear()], link_names=["in", "out"])
    >>> by_key = {grid.key: with_tool_marks(grid, case) for grid in of_results(solve(case))}
    >>> torques = by_key["torques"].cells[0][0].marks
    >>> [row[0].marks.get("links") for row in by_key["speeds"].cells], torques
    (['0', '1'], {'links': '0 1'})
    """
    return _with_units(_with_links(grid, case))


def marked_links(grid: Grid, case: Transmission) -> Grid:
    """Mark the rows of a gear's powers with links. A heading has the links of all its rows."""
    find = _named(case)["power through"]
    kinds = {"links": _links(case)}
    rows, links_of_row, kind = [row[:] for row in grid.cells], [set[int]() for _ in grid.rows], find
    head = owner = 0
    for place, (level, [first, *_]) in enumerate(zip(grid.levels, rows, strict=True)):
        if level == 1:
            head, kind = place, kinds.get(first.text, find)
        elif level == 2:
            owner, links_of_row[place] = place, {*kind(first.text)}
        else:
            member = _links(case)(first.text.rpartition(": ")[2])
            links_of_row[place] = {*(member or links_of_row[owner])}
        links_of_row[head] |= links_of_row[place]
    for row, links in zip(rows, links_of_row, strict=True):
        row[0] = _of_links(row[0], sorted(links))
    return grid._replace(rows=rows)


def _with_links(grid: Grid, case: Transmission) -> Grid:
    headings = [column_of_grid.heading for column_of_grid in grid.columns]
    column = 1 if headings[:2] == ["gear", "port"] else 0
    find = _named(case).get(headings[column]) if headings else None
    if find is None:
        return grid
    rows = [[_of_links(row[0], find(row[column].text)), *row[1:]] for row in grid.cells]
    return grid._replace(rows=rows)


def _of_links(cell: Cell, links: Sequence[int]) -> Cell:
    if not links:
        return cell
    return cell._replace(marks={**cell.marks, "links": " ".join(map(str, links))})


def _named(case: Transmission) -> dict[str, PartLinks]:
    """Return functions from names to link indices, by heading of the column of names."""
    elements = {part.name: _indices(part.links) for part in case.shift_elements}
    devices, members, planets = (dict[str, list[int]]() for _ in range(3))
    for part in case.mechanisms:
        devices[part.name] = _indices(part.links)
    for device in case.own_devices:
        devices[device.name] = _indices(member.link for member in device.members)
        planets |= {planet.name: devices[device.name] for planet in device.planets}
        for member in device.members:
            members[f"{device.name}.{member.name}"] = _indices([member.link])
    springs = {part.name: _indices(part.form) for part in case.springs}
    output = {OUTPUT: [case.main_output - 1]}
    parts = {**springs, **devices, **elements}
    links = _links(case)
    by_name = {
        "planet": {**devices, **planets},
        "mechanism": devices,
        "mesh": devices,
        "element": parts,
        "shift element": elements,
        "spring": springs,
        "torque of": {**parts, **members, **output},
        "power through": parts,
    }
    return {"link": links, "port": links} | {
        heading: partial(_found, names) for heading, names in by_name.items()
    }


def _found(names: Mapping[str, Sequence[int]], name: str) -> Sequence[int]:
    return names.get(name, ())


def _links(case: Transmission) -> PartLinks:
    return partial(_found, {name: [index] for index, name in enumerate(case.link_names)})


def _indices(links: Iterable[int]) -> list[int]:
    return sorted({link - 1 for link in links if link})


def _with_units(grid: Grid) -> Grid:
    if grid.key.removesuffix(WITH_LOAD) not in _IN_UNITS:
        return grid
    units = [_unit(column) for column in grid.columns]
    repeats = {"repeats": ""} if grid.key.endswith(WITH_LOAD) else {}
    rows = []
    for row in grid.cells:
        gears = [*_gears(grid.columns, row)]
        rows.append(
            [
                cell._replace(marks={**cell.marks, **unit, **gear, **repeats})
                if unit and cell.kind is float
                else cell
                for cell, unit, gear in zip(row, units, gears, strict=True)
            ]
        )
    return grid._replace(rows=rows)


def _unit(column: Column) -> dict[str, str]:
    for unit, words in UNITS.items():
        if column.heading.endswith(f", {words.text}"):
            return {"unit": unit}
    scaled = _RELATIVE.get(column.heading)
    return {"scaled": scaled} if scaled else {}


def _gears(columns: Sequence[Column], row: Sequence[Cell]) -> Iterator[dict[str, str]]:
    """Yield the gear of each cell, from the heading of its column or else from the row."""
    first = row[0].text if columns[0].heading == "gear" else ""
    for place, _ in enumerate(columns):
        after = place + 1
        named = after < len(columns) and columns[after].heading == "gear"
        gear = row[after].text if named else first
        yield {"gear": gear} if gear else {}
