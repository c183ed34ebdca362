"""The section on vibration: natural frequencies, resonances, the modes of each gear."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from vstatics.report.drawn import Drawn
from vstatics.report.parts import figures, of_gear
from vstatics.report.vibration import Vibration
from vstatics.tables.grid import Cell, Column, Grid, Row, exact, text, whole
from vstatics.tables.html import Markup, table, tag

if TYPE_CHECKING:
    from vstatics.torsion.gear_modes import GearModes

OF_GEAR = ("frequencies", "energy")
"""Keys of the tables of a gear."""


def shown_vibration(found: Vibration, digits: int | None) -> Iterator[Markup]:
    """All of it, or why it is left out."""
    if found.without:
        yield tag("p", f"Left out: {found.without}")
        return
    said = [f"gear {gear.name}: {text}" for gear in found.gears for text in gear.warnings]
    if said:
        yield tag("ul", *(tag("li", text) for text in said))
    yield table(frequencies(found.gears).with_digits(digits))
    if found.campbell:
        yield from figures(found.campbell, "Campbell diagram")
    for number, gear in enumerate(found.gears):
        drawn = found.shapes[number] if found.shapes else None
        yield of_gear("modes", gear.name, list(_gear(gear, drawn, digits)))


def frequencies(gears: Sequence[GearModes]) -> Grid:
    """The natural frequencies of all gears, without damping; why a gear has none.

    Examples
    --------
    >>> from vstatics.torsion.gear_modes import GearModes
    >>> grid = frequencies([GearModes("1", 1), GearModes("2", error="tied up")])
    >>> [column.heading for column in grid.columns], grid.texts
    (['gear', 'rigid modes', 'note'], [['1', '1', ''], ['2', '-', 'tied up']])
    """
    most = max(len(gear.modes) for gear in gears)
    columns = [text("gear"), Column("rigid modes"), *(Column(str(n + 1)) for n in range(most))]
    rows: list[Row] = []
    for gear in gears:
        rigid = Cell("-") if gear.error else whole(gear.rigid_modes)
        missing = [exact(None)] * (most - len(gear.modes))
        rows.append([gear.name, rigid, *(exact(mode.frequency) for mode in gear.modes), *missing])
    if any(gear.error for gear in gears):
        columns.append(text("note"))
        rows = [[*row, gear.error] for row, gear in zip(rows, gears, strict=True)]
    return Grid("Natural frequencies by mode [Hz]", columns, rows)


def _gear(gear: GearModes, drawn: Drawn | None, digits: int | None) -> Iterator[Markup]:
    """The modes of a gear."""
    from vstatics.torsion.grids import modes_grids

    if not gear.modes:
        yield tag("p", f"Gear {gear.name}: {gear.error or 'no natural frequency'}")
        return
    if drawn:
        yield from figures(drawn, f"Natural modes in gear {gear.name}")
    for grid in modes_grids([gear]):
        if grid.key in OF_GEAR:
            title = f"Gear {gear.name}: {grid.title[0].lower()}{grid.title[1:]}"
            yield table(grid._replace(title=title).with_digits(digits))
