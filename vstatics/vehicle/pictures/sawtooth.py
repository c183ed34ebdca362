"""Engine speed over road speed: a ray for each gear, and the teeth of shifts at the last speed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from matplotlib.figure import Figure

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.statics.results import Results
from vstatics.core.summary.design_table import ranges
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.free import Taken, first_free
from vstatics.pictures.drawing.labels import LEADER, LINE_HEIGHT, Label, Point, width
from vstatics.pictures.drawing.line_styles import Look, mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import SIZE, SMALL_NUMBER, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.vehicle.operation.traction import KMH
from vstatics.vehicle.pictures.driven import DrivenGear, DrivenVehicle, driven, speed_panel


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Figure]:
    """Draw the engine speed of all gears, or of some.

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
    said = style.text("engine speed over road speed")
    names = (
        style.text("road speed, km/h"),
        style.text("engine speed, rpm"),
    )
    key = [
        (True, "shifts at the last speed of the engine", _tooth(style)),
        (True, "first speed of the engine", _first(style)),
    ]
    up = AxisScale(0.0, max(one.pull.last for one in every) / RAD_PER_RPM)
    fastest = max(one.fastest for one in every)
    above = LEADER + LINE_HEIGHT * SIZE
    pen = speed_panel(title(results.case, said), key, fastest, up, names, SIZE, above, style)
    least = pen.up(made.pull.first / RAD_PER_RPM)
    pen.line((0.0, least), (pen.size[0], least), **_first(style))
    for gear in made.gears:
        _draw_gear(pen, made, gear)
    teeth = list(_teeth(pen, _forward(results, made), made))
    if len(teeth) > 2:
        pen.line(*teeth, kind="saw", **_tooth(style))
        _name_drops(pen, teeth[1:])
    last = pen.up(made.pull.last / RAD_PER_RPM)
    ends = [Label(pen.across(KMH * one.largest_speed), one.name, style.ink) for one in made.gears]
    along(pen.panel(pen.corner, (pen.size[0], last)), "top", ends, upright=False)
    return [pen.figure]


def _tooth(style: Style) -> Look:
    return {"color": mixed(style.ink, style.paper, 0.3), "width": 4.0, "zorder": 0.9}


def _first(style: Style) -> Look:
    return {"color": style.soft, "width": 0.8, "linestyle": (0, (2, 2))}


def _draw_gear(pen: Pen, made: DrivenVehicle, gear: DrivenGear) -> None:
    per_speed = made.pull.last / RAD_PER_RPM / (KMH * gear.largest_speed)
    own = pen.within("line", gear=gear.name, rpm_per_kmh=f"{per_speed:.9g}")
    end = pen.across(KMH * gear.largest_speed), pen.up(made.pull.last / RAD_PER_RPM)
    unit = pen.style.text("rpm per km/h")
    said = f"{gear_title(gear.name, pen.style)}: {per_speed:.4g} {unit}"
    own.line((0.0, 0.0), end, title=said, **gear.look)


def _forward(results: Results, made: DrivenVehicle) -> list[DrivenGear]:
    """The gears that follow one another as the vehicle goes faster."""
    order = next(iter(ranges(results)), [])
    own = {one.place: one for one in made.gears}
    return sorted((own[at] for at in order if at in own), key=lambda one: one.largest_speed)


def _teeth(pen: Pen, gears: Sequence[DrivenGear], made: DrivenVehicle) -> Iterator[Point]:
    """Up in a gear to the last speed of the engine, down to what it is in the next one."""
    if gears:
        yield 0.0, 0.0
    last = pen.up(made.pull.last / RAD_PER_RPM)
    for one, other in pairwise(gears):
        x = pen.across(KMH * one.largest_speed)
        yield x, last
        yield x, last * one.largest_speed / other.largest_speed
    if gears:
        yield pen.across(KMH * gears[-1].largest_speed), last


def _name_drops(pen: Pen, teeth: Sequence[Point]) -> None:
    """The engine speed behind each shift, where it has room."""
    taken: Taken = []
    high = pen.y.high / pen.size[1]
    for x, y in teeth[1::2]:
        text = f"{y * high:.0f}"
        wide, tall = width(text, SMALL_NUMBER) + 3, LINE_HEIGHT * SMALL_NUMBER
        places = [(x + wide / 2 + 2, y - tall / 2), (x + wide / 2 + 2, y - 1.5 * tall)]
        found = first_free(places, wide, tall, pen.size, taken)
        if found:
            look: Look = {"ha": "center", "va": "center_baseline"}
            pen.text(*found, text, size=SMALL_NUMBER, over=True, **look)
