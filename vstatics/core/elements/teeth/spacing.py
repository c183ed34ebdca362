"""Checks of planet positions: coaxial central gears, clearance from gears and other planets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from vstatics.core.elements.element import CentralWheel
from vstatics.core.elements.teeth.assembly import assembled, placements
from vstatics.core.elements.teeth.conditions import (
    SHIFT,
    TIPS,
    closes,
    crossing_distance,
    neighbours_room,
    passing_room,
    seated,
)
from vstatics.core.elements.teeth.layout import AxisLayout, Doubt
from vstatics.core.elements.teeth.subjects import OfPlanets, Subject
from vstatics.core.numerics.tolerances import TIP_CLEARANCE

PASSING = {
    "double_planet": (("inner", "ring"), ("outer", "sun")),
    "ravigneaux": (("long", "small_sun"),),
}
"""Pairs of a planet gear and a central gear that pass closely without meshing, by kind of set."""


def of_planets(layout: AxisLayout) -> Iterator[Doubt]:
    """Yield warnings and notes about planets that do not fit, or that touch other gears."""
    hopeless = [
        Doubt(
            "W311",
            f"no planet `{planet}` fits between the gears around it",
            layout.key(wheels[-1]),
        )
        for planet, rims in layout.group.planets.items()
        for rim, teeth in rims.items()
        if teeth is not None and teeth < 1 and (wheels := layout.around(rim))
    ]
    yield from hopeless
    if not hopeless:
        yield from _coaxial(layout)
        yield from _modules(layout)
        yield from _triangles(layout)
        yield from _clear_wheels(layout)
        count = layout.element.planets or 1
        if count > 1:
            yield from assembled(layout)
            yield from _touching_neighbours(layout, count)


def _coaxial(layout: AxisLayout) -> Iterator[Doubt]:
    """Report central gears that would put the same planet at different centre distances."""
    for rim in layout.group.planet_of:
        wheels, teeth = layout.around(rim), layout.teeth(rim)
        if not wheels or teeth is None:
            continue
        first, *others = wheels
        if teeth.denominator > 1:
            sun, ring = map(layout.label, sorted(wheels, key=lambda wheel: wheel.internal))
            label = layout.label(rim)
            name = label if "planet" in label or layout.element.rims else f"{label} planet"
            yield Doubt(
                "N311",
                f"the {name} would need {float(teeth):g} teeth (({ring} - {sun})/2); "
                "its speed is calculated with this number; `allow: [N311]` is usual for a real "
                "gearbox",
                layout.key(wheels[-1]),
            )
        for other in others:
            change = int((layout.span(other) or 0) - (layout.span(first) or 0))
            if change and teeth.denominator == 1:
                yield _off_axis(layout, first, other, change)


def _off_axis(layout: AxisLayout, first: CentralWheel, other: CentralWheel, change: int) -> Doubt:
    wanted = layout.label(first)
    if first.internal != other.internal:
        wanted += f" {'-' if first.internal else '+'} 2 {layout.label(first.rim)}"
    message = f"{layout.label(other)} {other.teeth} is not {wanted} = {other.teeth - change}"
    if abs(change) <= SHIFT:
        message += ": this needs shifted profiles"
        return Doubt("N312", message, layout.key(other))
    return Doubt("W312", f"{message}: their axes do not coincide", layout.key(other))


def _modules(layout: AxisLayout) -> Iterator[Doubt]:
    """Note toothed gears of a stepped planet that need different modules."""
    for rims in layout.group.planets.values():
        first, *others = [rim for rim in rims if layout.around(rim)] or [""]
        for rim in others:
            here, there = layout.axis(rim), layout.axis(first)
            if here and there and here[0] != there[0] and min(here[0], there[0]) > 0:
                ratio = there[0] / here[0]
                shifted = abs(here[0] - there[0]) <= SHIFT
                message = (
                    f"coaxial with {'shifted profiles, or with ' if shifted else ''}"
                    f"different modules: the module of {layout.label(rim)} is "
                    f"{float(ratio):.5g} times the module of {layout.label(first)} ({ratio})"
                )
                yield Doubt("N313", message, rim, has_cure=False)


def _triangles(layout: AxisLayout) -> Iterator[Doubt]:
    """Report planets whose axes are too near to or too far from each other to mesh.

    The axes of meshing planets and the central axis form a triangle.
    """
    for rim, partner in layout.group.meshes:
        sides = _sides(layout, rim, partner)
        if sides is None or closes(*sides):
            continue
        first, second, apart = sides
        names = f"{layout.label(rim)} and {layout.label(partner)}"
        message = (
            f"{names} cannot mesh: with axes at the radii {first:g} and {second:g} modules their "
            f"distance {apart:g} would have to be between {abs(first - second):g} and "
            f"{first + second:g}"
        )
        rims = layout.group.planets
        if all(len(rims[layout.group.planet_of[toothed]]) == 1 for toothed in (rim, partner)):
            yield Doubt("W313", message, rim)
        else:
            yield Doubt(
                "N314", f"{message}, if all gears have the same module", rim, has_cure=False
            )


def _sides(layout: AxisLayout, rim: str, partner: str) -> tuple[float, float, float] | None:
    """Return the radii of two planet axes and the distance between these axes, all in modules."""
    first, second = layout.axis(rim), layout.axis(partner)
    teeth = (layout.teeth(rim), layout.teeth(partner))
    if first is None or second is None or teeth[0] is None or teeth[1] is None:
        return None
    return float(first[0]) / 2, float(second[0]) / 2, float(teeth[0] + teeth[1]) / 2


def _clear_wheels(layout: AxisLayout) -> Iterator[Doubt]:
    """Report planets that touch a central gear without meshing.

    In a Ravigneaux set the long planets can be too short to reach the small sun. Contact with the
    small sun is therefore only a note.
    """
    for rim, member in PASSING.get(layout.element.kind, ()):
        axis = layout.axis(rim) if rim in layout.group.planet_of else None
        teeth = layout.teeth(rim) if axis else None
        passed = next((wheel for wheel in layout.group.wheels if wheel.member == member), None)
        if axis is None or teeth is None or passed is None:
            continue
        room = passing_room(
            float(axis[0]), float(teeth), float(passed.teeth), internal=passed.internal
        )
        if room > 0:
            continue
        names = f"{rim} {float(teeth):g} and {member} {passed.teeth}"
        if layout.element.kind == "ravigneaux":
            message = f"tips of {names} would touch if the gears were in one plane"
            yield Doubt("N315", message, layout.key(passed), has_cure=False)
        else:
            yield Doubt("W314", f"tips of {names} touch, but these gears do not mesh", rim)


def _touching_neighbours(layout: AxisLayout, count: int) -> Iterator[Doubt]:
    sine = math.sin(math.pi / count)
    for rims in layout.group.planets.values():
        gaps = [  # tip clearance of neighbouring planets, in modules
            (neighbours_room(float(axis[0]), float(teeth), sine), rim, axis)
            for rim, teeth in rims.items()
            if teeth is not None and (axis := layout.axis(rim))
        ]
        least = min(gaps, default=None)
        if least and least[0] < TIP_CLEARANCE:
            _, rim, (span, wheel) = least
            yield Doubt(
                "W315",
                f"tips of neighbouring planets touch: ({layout.label(wheel)} "
                f"{'-' if wheel.internal else '+'} {layout.label(wheel.rim)}) "
                f"sin(180°/{count}) = {float(span) * sine:.4g}, "
                f"expected more than {layout.label(rim)} + 2 = "
                f"{float(layout.group.teeth(rim)) + 2:g}",
                None,
            )
    for rim_in_mesh, partner in layout.group.meshes:
        yield from _crossing(layout, rim_in_mesh, partner, count)


def _crossing(layout: AxisLayout, rim: str, partner: str, count: int) -> Iterator[Doubt]:
    """Report a planet that touches a planet of the neighbouring pair."""
    sides = _sides(layout, rim, partner)
    if sides is None or not closes(*sides):
        return
    first, second, apart = sides
    distance = crossing_distance(first, second, apart, 2 * math.pi / count)
    if distance - apart - TIPS < TIP_CLEARANCE:
        yield Doubt(
            "W316",
            f"{layout.label(rim)} and {layout.label(partner)} of neighbouring planets touch at "
            f"their tips: the axes are {distance:.4g} modules apart, expected more than "
            f"{apart + 2:g}",
            None,
        )


def counts(subject: Subject) -> str:
    """Return words such as ``; 3 or 5 planets fit``, with the nearest possible numbers."""
    count = subject.element.planets or 1
    if not isinstance(subject, OfPlanets):
        return ""
    fit = fitting_numbers(subject.given, range(max(2, count - 3), count + 3))
    fit = sorted(sorted(fit, key=lambda number: abs(number - count))[:2])
    return f"; {' or '.join(map(str, fit))} planets fit" if fit else ""


def fitting_numbers(layout: AxisLayout, numbers: Iterable[int]) -> list[int]:
    """Return the numbers of planets that can be assembled without contact."""
    trains = [placements(layout.group, train) for train in layout.group.trains]
    return [
        number
        for number in numbers
        if all(seated(places, number) for places in trains)
        and not any(_touching_neighbours(layout, number))
    ]
