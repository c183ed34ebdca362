"""Section on vibration in the report of a case: natural frequencies, resonances, modes by gear."""

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
    """Content of the section on vibration."""

    gears: Sequence[GearModes] = ()
    shapes: Sequence[Drawn] = ()
    """Pictures of the mode shapes, one for each gear; empty without pictures."""
    campbell: Drawn | None = None
    """Campbell diagram of all gears in the report."""
    in_full: bool = True
    """True if the details of single gears are shown on paper, too."""
    without: str = ""
    """Reason why the section has no content, or an empty text."""
    drawn: tuple[str, ...] = ()
    """Kinds of pictures that the section already contains."""

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """Yield the HTML of the section, or the reason why it has no content."""
        if self.without:
            yield tag("p", tr("Left out: {why}", why=self.without))
            return
        warnings = [
            f"{tr('gear {gear}', gear=gear.name)}: {text}"
            for gear in self.gears
            for text in gear.warnings
        ]
        if warnings:
            yield tag("ul", *(tag("li", text) for text in warnings), class_="messages")
        grid = frequencies(self.gears).with_digits(digits)
        yield table(grid._replace(rows=[[gear_link(row[0].text), *row[1:]] for row in grid.cells]))
        if self.campbell:
            yield from figures(self.campbell, name_of(self.campbell.kind))
        for number, gear in enumerate(self.gears):
            drawn = self.shapes[number] if self.shapes else None
            shown = list(_gear_markup(gear, drawn, digits))
            yield of_gear("modes", gear.name, shown, is_printed=self.in_full)


def has_part(case: Transmission, *, runs: bool = False) -> bool:  # noqa: ARG001
    """Return whether a case has both inertias and elastic components.

    >>> from vstatics import Spring
    >>> spring = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[spring])
    >>> has_part(case), has_part(case.replace(inertias={1: 0.5}))
    (False, True)
    """
    drawing = drawing_of(case)
    elements = drawing.elements if drawing is not None else ()
    heavy = any(case.heavy.values()) or any(element.planet_masses for element in elements)
    devices: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    return heavy and (bool(case.springs) or any(d.stiffness is not None for d in devices))


def part(request: PartRequest) -> Vibration | None:
    """Return the section for a request, None if the case cannot vibrate."""
    case = request.results.case
    if not has_part(case):
        return None
    try:
        require("torsion", "the section on vibration")
    except CaseError as error:
        return Vibration(without=str(error))
    from vstatics.torsion.vibration.gear_modes import modes

    numbers = [n for n in range(1, len(case.gears) + 1) if request.shows(n)]
    gears = [gear for n, gear in enumerate(modes(case), 1) if request.shows(n)]
    if not request.has_pictures or not any(gear.modes for gear in gears):
        return Vibration(gears)
    shapes = [request.draw("modes", [number]) for number in numbers]
    campbell = request.draw("campbell", request.gears)
    return Vibration(gears, shapes, campbell, request.in_full)


OF_GEAR = ("frequencies", "energy")
"""Keys of the tables that are shown for each gear."""


def frequencies(gears: Sequence[GearModes]) -> Grid:
    """Return the table of undamped natural frequencies, with notes about gears without modes.

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


def _gear_markup(gear: GearModes, drawn: Drawn | None, digits: int | None) -> Iterator[Markup]:
    from vstatics.torsion.vibration.tables import modes_grids

    if not gear.modes:
        yield tag("p", gear.error or tr("no natural frequency"))
        return
    if drawn:
        yield from figures(drawn, name_of(drawn.kind))
    shown = (grid for grid in modes_grids([gear]) if grid.key in OF_GEAR)
    without_gear = (grid.with_columns(range(1, len(grid.columns))) for grid in shown)
    yield from tables((grid.with_digits(digits) for grid in without_gear), level=4)
