"""The natural modes of a case that vibrates, for its page.

The section on vibration: natural frequencies, resonances, the modes of each gear.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import CaseError
from vstatics.core.extras import require
from vstatics.core.model.transmission import Mechanism, ShiftElement, Transmission
from vstatics.core.tables.grid import Cell, Column, Grid, Values, grid_of, whole
from vstatics.core.tables.html import Markup, table, tables, tag
from vstatics.core.texts import tr
from vstatics.pictures.paged.drawn import Drawn, name_of
from vstatics.pictures.paged.parts import PartRequest, figures, gear_link, of_gear

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


class Vibration(NamedTuple):
    """What the page shows of the natural modes of a case."""

    gears: Sequence[GearModes] = ()
    shapes: Sequence[Drawn] = ()
    """Of each gear; nothing where there are no pictures."""
    campbell: Drawn | None = None
    """Of all gears that are shown."""
    in_full: bool = True
    """Whether what is shown of each gear is printed."""
    without: str = ""
    """Why all this is left out, else nothing."""
    drawn: tuple[str, ...] = ()

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """All of it, or why it is left out."""
        if self.without:
            yield tag("p", tr("Left out: {why}", why=self.without))
            return
        said = [
            f"{tr('gear {gear}', gear=gear.name)}: {text}"
            for gear in self.gears
            for text in gear.warnings
        ]
        if said:
            yield tag("ul", *(tag("li", text) for text in said), class_="messages")
        grid = frequencies(self.gears).with_digits(digits)
        yield table(grid._replace(rows=[[gear_link(row[0].text), *row[1:]] for row in grid.cells]))
        if self.campbell:
            yield from figures(self.campbell, name_of(self.campbell.kind))
        for number, gear in enumerate(self.gears):
            drawn = self.shapes[number] if self.shapes else None
            shown = list(_gear(gear, drawn, digits))
            yield of_gear("modes", gear.name, shown, is_printed=self.in_full)


def has_part(case: Transmission, *, runs: bool = False) -> bool:  # noqa: ARG001
    """Whether anything has an inertia, and anything is elastic.

    >>> from vstatics import Spring
    >>> spring = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[spring])
    >>> has_part(case), has_part(case.replace(inertias={1: 0.5}))
    (False, True)
    """
    drawing = drawing_of(case)
    elements = drawing.elements if drawing is not None else ()
    heavy = any(case.heavy.values()) or any(one.planet_masses for one in elements)
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    return heavy and (bool(case.springs) or any(one.stiffness is not None for one in parts))


def part(request: PartRequest) -> Vibration | None:
    """Return the natural modes of a case; nothing if it does not vibrate."""
    case = request.results.case
    if not has_part(case):
        return None
    try:
        require("torsion", "the section on vibration")
    except CaseError as error:
        return Vibration(without=str(error))
    from vstatics.torsion.vibration.gear_modes import modes

    numbers = [n for n in range(1, len(case.gears) + 1) if request.shows(n)]
    found = [gear for n, gear in enumerate(modes(case), 1) if request.shows(n)]
    if not request.has_pictures or not any(gear.modes for gear in found):
        return Vibration(found)
    shapes = [request.draw("modes", [number]) for number in numbers]
    campbell = request.draw("campbell", request.gears)
    return Vibration(found, shapes, campbell, request.in_full)


OF_GEAR = ("frequencies", "energy")
"""Keys of the tables of a gear."""


def frequencies(gears: Sequence[GearModes]) -> Grid:
    """The natural frequencies of all gears, without damping; why a gear has none.

    Examples
    --------
    >>> from vstatics.torsion.vibration.gear_modes import GearModes
    >>> grid = frequencies([GearModes("1", 1), GearModes("2", error="tied up")])
    >>> [column.heading for column in grid.columns], grid.texts
    (['gear', 'rigid modes', 'note'], [['1', '1', ''], ['2', '-', 'tied up']])
    """
    most = max(len(gear.modes) for gear in gears)
    modes = (Column(str(number), over="mode") for number in range(1, most + 1))
    rows: list[Values] = []
    for gear in gears:
        rigid = Cell("-") if gear.error else whole(gear.rigid_modes)
        missing = [None] * (most - len(gear.modes))
        frequencies = (mode.frequency for mode in gear.modes)
        rows.append((gear.name, rigid, *frequencies, *missing, gear.error))
    title = "Natural frequencies [Hz]"
    return grid_of(title, ["gear", Column("rigid modes"), *modes, "note"], rows, optional=["note"])


def _gear(gear: GearModes, drawn: Drawn | None, digits: int | None) -> Iterator[Markup]:
    """The modes of a gear, below its name."""
    from vstatics.torsion.vibration.tables import modes_grids

    if not gear.modes:
        yield tag("p", gear.error or tr("no natural frequency"))
        return
    if drawn:
        yield from figures(drawn, name_of(drawn.kind))
    shown = (grid for grid in modes_grids([gear]) if grid.key in OF_GEAR)
    for_one = (grid.with_columns(range(1, len(grid.columns))) for grid in shown)
    yield from tables(grid.with_digits(digits) for grid in for_one)
