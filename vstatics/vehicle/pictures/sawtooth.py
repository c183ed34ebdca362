"""Engine speed over road speed: a line for each gear, and upshifts at the last engine speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import chain

import numpy as np

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.statics.results import Results
from vstatics.core.summary.design_table import ranges
from vstatics.pictures.drawing.canvas import Canvas, Look, Point
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.free import Taken, first_free
from vstatics.pictures.drawing.labels import LEADER, LINE_HEIGHT, Label, width
from vstatics.pictures.drawing.line_styles import mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import SIZE, SMALL_NUMBER, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.vehicle.operation.traction import KMH
from vstatics.vehicle.pictures.driven import DrivenGear, DrivenVehicle, driven, speed_panel

POINTS_OF_CONVERTER = 120
"""Number of points on the line of a gear with a free converter."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Canvas]:
    """Draw engine speed over road speed, in all gears or in the selected gears.

    Parameters
    ----------
    alike : sequence of Results
        Other cases, for which the scales must be the same.

    Raises
    ------
    CaseError
        If the case has no vehicle with an engine, or if no gear is driven by the engine alone.
    """
    vehicle = driven(results, gears, style)
    vehicles = [vehicle, *(driven(other, gears, style) for other in alike)]
    name = style.text("engine speed over road speed")
    names = (
        style.text("road speed, km/h"),
        style.text("engine speed, rpm"),
    )
    key = [
        (True, "shifts at the largest speed", _tooth(style)),
        (True, "first speed of full load", _first(style)),
    ]
    up = AxisScale(0.0, max(other.pull.last for other in vehicles) / RAD_PER_RPM)
    fastest = max(other.fastest for other in vehicles)
    above = LEADER + LINE_HEIGHT * SIZE
    pen = speed_panel(title(results.case, name), key, fastest, up, names, SIZE, above, style)
    least = pen.up(vehicle.pull.first / RAD_PER_RPM)
    pen.line((0.0, least), (pen.size[0], least), **_first(style))
    for gear in vehicle.gears:
        _draw_gear(pen, vehicle, gear)
    last = pen.up(vehicle.pull.last / RAD_PER_RPM)
    forward = _forward(results, vehicle)
    if len(forward) > 1:
        teeth = list(_teeth(pen, vehicle, forward))
        pen.line(*chain.from_iterable(teeth), kind="saw", **_tooth(style))
        _name_drops(pen, [tooth[0] for tooth in teeth[1:] if tooth])
    ends = [
        Label(pen.across(KMH * gear.largest_speed), gear.name, style.ink) for gear in vehicle.gears
    ]
    along(pen.panel(pen.corner, (pen.size[0], last)), "top", ends, upright=False)
    return [pen.canvas]


def _tooth(style: Style) -> Look:
    return {"color": mixed(style.ink, style.paper, 0.3), "width": 4.0, "zorder": 0.9}


def _first(style: Style) -> Look:
    return {"color": style.soft, "width": 0.8, "linestyle": (0, (2, 2))}


def _draw_gear(pen: Pen, vehicle: DrivenVehicle, gear: DrivenGear) -> None:
    per_speed = 1 / RAD_PER_RPM / (KMH * float(vehicle.pull.per_engine[gear.place]))
    group = pen.within("line", gear=gear.name, rpm_per_kmh=f"{per_speed:.9g}")
    unit = pen.style.text("rpm per km/h")
    line_title = f"{gear_title(gear.name, pen.style)}: {per_speed:.4g} {unit}"
    group.line(*_course(pen, vehicle, gear, 0.0), title=line_title, **gear.look)


def _course(pen: Pen, vehicle: DrivenVehicle, gear: DrivenGear, slowest: float) -> list[Point]:
    """Return points on the line of engine speed, up to the largest road speed of a gear.

    Parameters
    ----------
    slowest : float
        Road speed of the first point. [m/s]
    """
    pull = vehicle.pull
    count = POINTS_OF_CONVERTER if gear.place in pull.converters else 2
    speeds = np.linspace(slowest, gear.largest_speed, count)
    engine = pull.engine_speeds(gear.place, pull.speeds_at(gear.place, speeds))
    return [
        (pen.across(KMH * speed), pen.up(turned / RAD_PER_RPM))
        for speed, turned in zip(speeds.tolist(), engine.tolist(), strict=True)
        if math.isfinite(turned)
    ]


def _forward(results: Results, vehicle: DrivenVehicle) -> list[DrivenGear]:
    order = next(iter(ranges(results)), [])
    by_place = {gear.place: gear for gear in vehicle.gears}
    return sorted(
        (by_place[at] for at in order if at in by_place), key=lambda gear: gear.largest_speed
    )


def _teeth(pen: Pen, vehicle: DrivenVehicle, gears: Sequence[DrivenGear]) -> Iterator[list[Point]]:
    """Yield the points of each tooth, from the upshift into a gear to the last engine speed."""
    speed = 0.0
    for gear in gears:
        yield _course(pen, vehicle, gear, speed)
        speed = gear.largest_speed


def _name_drops(pen: Pen, drops: Sequence[Point]) -> None:
    """Write the engine speed after each upshift, where there is room."""
    taken: Taken = []
    high = pen.y.high / pen.size[1]
    for x, y in drops:
        text = f"{y * high:.0f}"
        wide, tall = width(text, SMALL_NUMBER) + 3, LINE_HEIGHT * SMALL_NUMBER
        places = [(x + wide / 2 + 2, y - tall / 2), (x + wide / 2 + 2, y - 1.5 * tall)]
        place = first_free(places, wide, tall, pen.size, taken)
        if place:
            look: Look = {"ha": "center", "va": "center_baseline"}
            pen.text(*place, text, size=SMALL_NUMBER, over=True, **look)
