"""Gears that drive a vehicle, and panels over road speed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.free import Taken, first_free
from vstatics.pictures.drawing.head import Meaning, headed
from vstatics.pictures.drawing.labels import LINE_HEIGHT, ticks, widest, width
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.traction import KMH, Traction

DRIVE_PANEL_HEIGHT = 250.0
"""Height of the panel without scales. [pt]"""
BELOW_SPEEDS = 24.0
"""Distance from the panel to the title of the axis of road speed. [pt]"""
ROOM_OVER_LINES = 0.04
"""Margin beyond the largest value on an axis, relative to this value. [-]"""
NAME_CLEARANCE = 3.0
"""Additional width for the name of a gear on a line. [pt]"""


class DrivenGear(NamedTuple):
    """Gear in a picture, which drives the vehicle."""

    place: int
    """Index of the gear in the case."""
    name: str
    look: Look
    largest_speed: float
    """Road speed at the last engine speed. [m/s]"""


class DrivenVehicle(NamedTuple):
    """Vehicle, with the gears in a picture."""

    vehicle: Vehicle
    pull: Traction
    gears: Sequence[DrivenGear]

    @property
    def fastest(self) -> float:
        """Largest road speed of all gears in the picture [m/s]."""
        return max(gear.largest_speed for gear in self.gears)


def driven(results: Results, shown: Sequence[int], style: Style) -> DrivenVehicle:
    """Return the vehicle of a case, with all driving gears or those numbered in `shown`.

    Raises
    ------
    CaseError
        If the case has no vehicle, if the vehicle has no engine, or if no gear is driven by the
        engine alone.
    """
    case, vehicle = results.case, Vehicle.needed(results.case)
    if not vehicle.full_load:
        message = "the vehicle has no `engine`, expected its full load: [[rad/s, N*m], ...]"
        raise CaseError("E442", message)
    pull = Traction(case, vehicle)
    gears = []
    for index in [number - 1 for number in shown] or range(len(case.gears)):
        fastest = pull.largest_speed(index)
        if math.isfinite(fastest) and fastest > 0:
            look = {"color": style.colour(index), "linestyle": style.dash(index)}
            gears.append(DrivenGear(index, case.gears[index].name, look, fastest))
    if not gears:
        asked = ", ".join(case.gears[number - 1].name for number in shown)
        which = f"gear {asked}" if shown else "the case"
        message = f"{which} has no ratio, or other machines drive as well"
        raise CaseError("E443", f"{message}; expected a gear that the engine alone drives")
    return DrivenVehicle(vehicle, pull, gears)


def speed_panel(  # noqa: PLR0913 PLR0917 - a panel has these
    title: str,
    meanings: Iterable[Meaning],
    fastest: float,
    up: AxisScale,
    names: tuple[str, str],
    right: float,
    above: float,
    style: Style,
) -> Pen:
    """Draw an empty panel over road speeds up to `fastest` [m/s], as wide as the page.

    Parameters
    ----------
    names : tuple of str
        Titles of the horizontal and the vertical axis.
    right, above : float
        Space for labels to the right of the panel and above it. [pt]
    """
    numbers = ticks(up.low, up.high, 8)
    left = widest(tick_texts(numbers)) + 2 * SIZE + MARGIN
    low = BELOW_SPEEDS + MARGIN + SIZE / 2
    wide, high = style.width - left - right - MARGIN, DRIVE_PANEL_HEIGHT
    pen = headed(title, "", meanings, (style.width, low + high + above + SIZE), style)
    across = AxisScale(0.0, KMH * fastest * (1 + ROOM_OVER_LINES))
    pen = pen.panel((left, low), (wide, high), across, up)
    pen.scale("bottom", ticks(0.0, across.high, 10), grid=True)
    pen.scale("left", numbers, grid=True)
    pen.frame()
    pen.name("bottom", names[0], BELOW_SPEEDS)
    pen.name("left", names[1], left - MARGIN - SIZE / 2)
    return pen


def name_on_line(pen: Pen, places: Iterable[Point], name: str, taken: Taken) -> None:
    """Write a name at the first of `places` that is free of other names, if any is free."""
    long, tall = width(name) + NAME_CLEARANCE, LINE_HEIGHT * SIZE
    place = first_free(places, long, tall, pen.size, taken)
    if place:
        pen.text(*place, name, over=True, ha="center", va="center_baseline")
