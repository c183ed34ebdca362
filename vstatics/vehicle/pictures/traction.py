"""Wheel force over road speed in each gear, with all losses, and road resistance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look, Point
from vstatics.pictures.drawing.ends import LineEnd, along, beside, width_of
from vstatics.pictures.drawing.free import Taken
from vstatics.pictures.drawing.labels import LEADER, Label, height
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import SIZE, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.vehicle.operation.traction import HUNDRED, KMH
from vstatics.vehicle.pictures.driven import (
    ROOM_OVER_LINES,
    DrivenGear,
    DrivenVehicle,
    driven,
    name_on_line,
    speed_panel,
)

SLOPES = (0, 5, 10, 15, 20, 30)
"""Slopes of the road in a picture: rise divided by horizontal distance. [%]"""
POINTS_OF_LINE = 240
"""Number of points on a line, in addition to full-load points of the engine."""
KILO = 1000.0
"""Factor from N to kN, and from W to kW."""
NAME_PLACES = (0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2, 0.9, 0.1)
"""Possible positions of a gear's name along its line, relative to the length of the line. [-]"""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Canvas]:
    """Draw the wheel force at full load, in all gears or in the selected gears.

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
    largest, fastest = max(map(_highest, vehicles)), max(other.fastest for other in vehicles)
    unit, unit_name = (1.0, style.text("N"))
    if largest >= 10 * KILO:
        unit, unit_name = (KILO, style.text("kN"))
    up = AxisScale(0.0, largest / unit * (1 + ROOM_OVER_LINES))
    name_of_picture = style.text("wheel force over road speed")
    names = (
        style.text("road speed, km/h"),
        style.text("wheel force, {name}", name=unit_name),
    )
    right, top = _ends(vehicle, KMH * fastest * (1 + ROOM_OVER_LINES), up.high * unit, style)
    above = 0.65 * LEADER + height("0 %") + SIZE / 2 if top else 0.0
    key = [
        (True, "resistance on a slope", _road(style)),
        (True, _power(vehicle.pull.largest_power, style), _hyperbola(style)),
        (True, "largest speed on the level", _fastest(style)),
    ]
    room = max(width_of(right), SIZE)
    pen = speed_panel(
        title(results.case, name_of_picture), key, fastest, up, names, room, above, style
    )
    _draw_road(pen, vehicle, unit)
    beside(pen, "right", right)
    along(
        pen,
        "top",
        [label._replace(at=pen.across(label.at)) for label in reversed(top)],
        upright=False,
    )
    taken: Taken = []
    _draw_hyperbola(pen, vehicle, unit)
    for gear in vehicle.gears:
        _draw_gear(pen, vehicle, gear, unit, taken)
    return [pen.canvas]


def _highest(vehicle: DrivenVehicle) -> float:
    forces = [vehicle.pull.largest_force(gear.place) for gear in vehicle.gears]
    steepest = float(vehicle.vehicle.resistance(0.0, sine(SLOPES[-1])))
    return max(steepest, *(force for force in forces if math.isfinite(force)))


def sine(slope: float) -> float:
    """Return the sine of the angle of a slope in % [-].

    >>> round(sine(30), 4)
    0.2873
    """
    return math.sin(math.atan(slope / 100))


def _road(style: Style) -> Look:
    return {"color": style.soft, "width": 0.8}


def _hyperbola(style: Style) -> Look:
    return {"color": style.circulating, "linestyle": (0, (6, 3)), "width": 1.0}


def _fastest(style: Style) -> Look:
    look: Look = {"color": style.ink, "marker": "o", "markersize": 4.0, "linestyle": ""}
    return look | {"markerfacecolor": style.paper}


def _ends(
    vehicle: DrivenVehicle, fastest: float, largest: float, style: Style
) -> tuple[list[LineEnd], list[Label]]:
    """Return labels of slopes: line ends at the right edge, and labels at the upper edge.

    Parameters
    ----------
    fastest, largest : float
        Speed at the right edge [km/h], and force at the upper edge [N].
    """
    right, top = [], []
    speeds = np.linspace(0.0, fastest, POINTS_OF_LINE)
    for slope in SLOPES:
        forces, name = vehicle.vehicle.resistance(speeds / KMH, sine(slope)), f"{slope} %"
        if forces[-1] > largest:
            top.append(Label(float(np.interp(largest, forces, speeds)), name, style.ink))
        else:
            right.append(LineEnd(float(forces[-1]) / largest, (name,)))
    return right, top


def _power(power: float, style: Style) -> str:
    return style.text("largest power, {power} kW", power=number(power / KILO))


def _draw_road(pen: Pen, vehicle: DrivenVehicle, unit: float) -> None:
    speeds = np.linspace(0.0, pen.x.high, POINTS_OF_LINE)
    for slope in SLOPES:
        data = {"slope": str(slope)}
        if slope == 0:
            data["force_at_100"] = f"{vehicle.vehicle.resistance(HUNDRED):.9g}"
        forces = vehicle.vehicle.resistance(speeds / KMH, sine(slope)) / unit
        line_title = pen.style.text("resistance at")
        pen.within("line", **data).plot(
            speeds, forces, title=f"{line_title} {slope} %", zorder=0.8, **_road(pen.style)
        )


def _draw_hyperbola(pen: Pen, vehicle: DrivenVehicle, unit: float) -> None:
    """Draw the hyperbola of wheel force at the engine's largest power, without losses."""
    power = vehicle.pull.largest_power
    slowest = KMH * power / unit / pen.y.high
    speeds = np.geomspace(slowest, max(pen.x.high, 2 * slowest), POINTS_OF_LINE)
    group = pen.within("line", name="hyperbola", power=f"{power:.9g}")
    line_title = _power(power, pen.style)
    group.plot(
        speeds, KMH * power / speeds / unit, title=line_title, zorder=0.9, **_hyperbola(pen.style)
    )


def _draw_gear(
    pen: Pen, vehicle: DrivenVehicle, gear: DrivenGear, unit: float, taken: Taken
) -> None:
    pull = vehicle.pull
    engine = np.union1d(
        np.linspace(pull.slowest(gear.place), pull.last, POINTS_OF_LINE),
        [speed for speed, _ in vehicle.vehicle.full_load],
    )
    speeds = KMH * pull.road_speeds(gear.place, engine)
    forces = pull.forces(gear.place, engine) / unit
    fastest, strongest = pull.top_speed(gear.place), pull.largest_force(gear.place)
    data = {
        "gear": gear.name,
        "largest_force": f"{strongest:.9g}",
        "largest_speed": f"{KMH * gear.largest_speed:.9g}",
    }
    if math.isfinite(fastest):
        data["top_speed"] = f"{KMH * fastest:.9g}"
    group = pen.within("line", **data)
    line_title = f"{gear_title(gear.name, pen.style)}: {number(strongest / KILO)} kN"
    group.plot(speeds, forces, width=1.5, title=line_title, **gear.look)
    if math.isfinite(fastest):
        at = float(np.interp(KMH * fastest, speeds, forces))
        group.line((pen.across(KMH * fastest), pen.up(at)), zorder=4, **_fastest(pen.style))
    name_on_line(group, _places(pen, speeds, forces), gear.name, taken)


def _places(pen: Pen, speeds: Floats, forces: Floats) -> Iterator[Point]:
    for part in NAME_PLACES:
        speed = float(speeds[0] + part * (speeds[-1] - speeds[0]))
        force = float(np.interp(speed, speeds, forces))
        if math.isfinite(force):
            yield pen.across(speed), pen.up(force)
