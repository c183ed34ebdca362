"""Wheel force over road speed, gear by gear, with all losses, against resistance of the road."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.figure import Figure

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.ends import LineEnd, along, beside, width_of
from vstatics.pictures.drawing.free import Taken
from vstatics.pictures.drawing.labels import LEADER, Label, Point, height
from vstatics.pictures.drawing.line_styles import Look
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
"""Of the road: rise over run. [%]"""
POINTS_OF_LINE = 240
"""Of a line, besides the points of the engine."""
KILO = 1000.0
"""From so many newtons on forces are in kN."""
NAME_PLACES = (0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2, 0.9, 0.1)
"""Where the name of a gear may stand, as parts of its line."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Figure]:
    """Draw the force of all gears, or of some, at full load.

    Parameters
    ----------
    alike : sequence of Results
        Of further cases, with which the scales are common.

    Raises
    ------
    CaseError
        If the case has no vehicle with an engine, or no gear drives it.
    """
    made = driven(results, gears, style)
    every = [made, *(driven(one, gears, style) for one in alike)]
    largest, fastest = max(map(_highest, every)), max(one.fastest for one in every)
    unit, name = (1.0, style.text("N"))
    if largest >= 10 * KILO:
        unit, name = (KILO, style.text("kN"))
    up = AxisScale(0.0, largest / unit * (1 + ROOM_OVER_LINES))
    said = style.text("wheel force over road speed")
    names = (
        style.text("road speed, km/h"),
        style.text("wheel force, {name}", name=name),
    )
    right, top = _ends(made, KMH * fastest * (1 + ROOM_OVER_LINES), up.high * unit, style)
    above = 0.65 * LEADER + height("0 %") + SIZE / 2 if top else 0.0
    key = [
        (True, "resistance on a slope", _road(style)),
        (True, _power(made.pull.largest_power, style), _hyperbola(style)),
        (True, "largest speed on the level", _fastest(style)),
    ]
    room = max(width_of(right), SIZE)
    pen = speed_panel(title(results.case, said), key, fastest, up, names, room, above, style)
    _draw_road(pen, made, unit)
    beside(pen, "right", right)
    along(pen, "top", [one._replace(at=pen.across(one.at)) for one in reversed(top)], upright=False)
    taken: Taken = []
    _draw_hyperbola(pen, made, unit)
    for gear in made.gears:
        _draw_gear(pen, made, gear, unit, taken)
    return [pen.figure]


def _highest(made: DrivenVehicle) -> float:
    """The largest force of all lines that do not grow without end [N]."""
    forces = [made.pull.largest_force(one.place) for one in made.gears]
    steepest = float(made.vehicle.resistance(0.0, sine(SLOPES[-1])))
    return max(steepest, *(one for one in forces if math.isfinite(one)))


def sine(slope: float) -> float:
    """Of the angle of a slope [%].

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
    made: DrivenVehicle, fastest: float, largest: float, style: Style
) -> tuple[list[LineEnd], list[Label]]:
    """Names of the slopes where their lines leave the panel: at its right, or at its top.

    Parameters
    ----------
    fastest, largest : float
        Speed at the right edge [km/h]; force at the upper one [N].
    """
    right, top = [], []
    speeds = np.linspace(0.0, fastest, POINTS_OF_LINE)
    for slope in SLOPES:
        forces, name = made.vehicle.resistance(speeds / KMH, sine(slope)), f"{slope} %"
        if forces[-1] > largest:
            top.append(Label(float(np.interp(largest, forces, speeds)), name, style.ink))
        else:
            right.append(LineEnd(float(forces[-1]) / largest, (name,)))
    return right, top


def _power(power: float, style: Style) -> str:
    """What the hyperbola is."""
    return style.text("all power of the engine, {power} kW", power=number(power / KILO))


def _draw_road(pen: Pen, made: DrivenVehicle, unit: float) -> None:
    """A line for each slope."""
    speeds = np.linspace(0.0, pen.x.high, POINTS_OF_LINE)
    for slope in SLOPES:
        data = {"slope": str(slope)}
        if slope == 0:
            data["force_at_100"] = f"{made.vehicle.resistance(HUNDRED):.9g}"
        forces = made.vehicle.resistance(speeds / KMH, sine(slope)) / unit
        said = pen.style.text("resistance at")
        pen.within("line", **data).plot(
            speeds, forces, title=f"{said} {slope} %", zorder=0.8, **_road(pen.style)
        )


def _draw_hyperbola(pen: Pen, made: DrivenVehicle, unit: float) -> None:
    """The force of all power of the engine at the wheels, as if nothing were lost."""
    power = made.pull.largest_power
    slowest = KMH * power / unit / pen.y.high
    speeds = np.geomspace(slowest, max(pen.x.high, 2 * slowest), POINTS_OF_LINE)
    own = pen.within("line", name="hyperbola", power=f"{power:.9g}")
    said = _power(power, pen.style)
    own.plot(speeds, KMH * power / speeds / unit, title=said, zorder=0.9, **_hyperbola(pen.style))


def _draw_gear(pen: Pen, made: DrivenVehicle, gear: DrivenGear, unit: float, taken: Taken) -> None:
    """The line of a gear with its name and its largest speed on the level."""
    pull = made.pull
    engine = np.union1d(
        np.linspace(pull.first, pull.last, POINTS_OF_LINE),
        [speed for speed, _ in made.vehicle.engine],
    )
    speeds, forces = KMH * engine * pull.per_engine[gear.place], pull.forces(gear.place, engine)
    fastest, strongest = pull.top_speed(gear.place), pull.largest_force(gear.place)
    data = {
        "gear": gear.name,
        "largest_force": f"{strongest:.9g}",
        "largest_speed": f"{KMH * gear.largest_speed:.9g}",
    }
    if math.isfinite(fastest):
        data["top_speed"] = f"{KMH * fastest:.9g}"
    own = pen.within("line", **data)
    said = f"{gear_title(gear.name, pen.style)}: {number(strongest / KILO)} kN"
    own.plot(speeds, forces / unit, width=1.5, title=said, **gear.look)
    if math.isfinite(fastest):
        at = float(np.interp(KMH * fastest, speeds, forces / unit))
        own.line((pen.across(KMH * fastest), pen.up(at)), zorder=4, **_fastest(pen.style))
    name_on_line(own, _places(pen, speeds, forces / unit), gear.name, taken)


def _places(pen: Pen, speeds: Floats, forces: Floats) -> Iterator[Point]:
    """Where the name of a gear may stand."""
    for part in NAME_PLACES:
        speed = float(speeds[0] + part * (speeds[-1] - speeds[0]))
        force = float(np.interp(speed, speeds, forces))
        if math.isfinite(force):
            yield pen.across(speed), pen.up(force)
