"""Doubts about teeth: wheels that cannot be made or put together, or would wear soon.

A case with such teeth stays calculable: ratios and torques ask for numbers only. So these
are warnings and notes. They hold for the usual profile of 20 degrees with tips one module
high. Each tells what nearby teeth would do.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from vstatics.elements.element import CentralWheel, Drawing, Element
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import EXTERNAL, INTERNAL, Planetary
from vstatics.elements.nearby import (
    SHIFT,
    Key,
    Layout,
    Mesh,
    OfPlanets,
    OfWheels,
    Subject,
    Teeth,
    Toothed,
    nearest,
    suggested,
)
from vstatics.errors import Path, Problem, Severity

UNCUT, UNCUT_SHIFTED = 17, 14
"""Fewest teeth of a wheel without undercut, and of one with a shifted profile."""

INSIDE = 8
"""Teeth that a ring must have more than the wheel in it."""


NO_GAP = 1e-9
"""Modules that are lost in rounding."""

CLEAR = 4
"""Of two tips on either side: teeth by which wheels differ that pass one another."""

PASSING = {
    "double_planet": (("inner", "ring"), ("outer", "sun")),
    "ravigneaux": (("long", "small_sun"),),
}
"""Rims and wheels that stand side by side without meshing."""


class Doubt(NamedTuple):
    """What is doubtful about an element: of which wheel, or of the number of planets."""

    message: str
    about: Key | None
    severity: Severity = "warning"
    has_cure: bool = True
    """Whether other teeth may be right."""


def doubts(drawing: Drawing) -> Iterator[Problem]:
    """What is doubtful about the teeth of a drawing's elements, in their order.

    Parameters
    ----------
    drawing : Drawing
        Elements without errors (`vstatics.elements.checks`).

    Yields
    ------
    Problem
        Warnings and notes, never errors, with the path of what they are about.

    Notes
    -----
    Conditions of coaxiality, assembly, neighbouring planets and undercut as the synthesis
    of planetary gears has them (after Willis; Ravigneaux sets after Simionescu). What has
    no whole number of teeth is left out; so are belts, worms, shafts.

    Examples
    --------
    >>> members = {"sun": 1, "ring": 2, "carrier": 3}
    >>> given = Element("P", "planetary", members, {"sun": 47, "ring": 97}, planets=5)
    >>> (problem,) = doubts(Drawing(3, [given]))
    >>> print(problem.message.replace("; ", "\\n"))
    5 equally spaced planets can't be assembled: (sun + ring)/planets = 144/5 is not whole
    they fit at multiples of 1/144 turn
    4 or 6 planets fit
    nearest that fit: sun 46, ring 94 (ratio -2.0435) or sun 49, ring 101 (ratio -2.0612)
    """
    for number, element in enumerate(drawing.elements, 1):
        for doubt in _doubts(element):
            path = ("elements", number, *_place(element, doubt.about))
            yield Problem(doubt.message, path, severity=doubt.severity)


def _doubts(element: Element) -> Iterator[Doubt]:
    if not all(float(count).is_integer() for count in element.teeth.values()):
        return
    if isinstance(element.shape, Planetary):
        yield from _with_cures(OfPlanets(element))
    elif element.kind == "chain":
        yield from _sprockets(element)
    elif element.teeth and set(element.shape.meshes) <= {EXTERNAL, INTERNAL, "bevel"}:
        yield from _with_cures(OfWheels(element))


def _place(element: Element, about: Key | None) -> Path:
    """Where the teeth that a doubt is about stand in an element."""
    if about is None:
        return ("planets",)
    if isinstance(about, int) and element.rims:
        wheel = element.wheels[about]
        alike = [one for one in element.wheels if one.internal == wheel.internal]
        return ("rings" if wheel.internal else "suns", alike.index(wheel) + 1, "teeth")
    if isinstance(about, int):
        return ("teeth", group_of(element).wheels[about].member)
    for planet, rims in element.rims.items():
        if about in rims:
            return ("rims", planet, about)
    return ("teeth", about) if about in element.teeth else ("teeth",)


def _sprockets(element: Element) -> Iterator[Doubt]:
    for name, teeth in element.teeth.items():
        if teeth < UNCUT:
            message = f"{name} {teeth:g} runs roughly: a chain wants {UNCUT} teeth or more"
            yield Doubt(message, name, "note")


def _with_cures(subject: Subject) -> Iterator[Doubt]:
    """The doubts about an element, each with the nearest teeth that leave none."""
    found = [*_wrong(subject)]
    least = min((wheel.teeth for wheel in subject.wheels().values()), default=0)

    def is_right(teeth: Teeth) -> bool:
        """Nothing to cure, and no wheel that newly needs a shifted profile."""
        return (
            min(teeth.values()) >= min(least, UNCUT)
            and _goes_in(subject, teeth)
            and not any(doubt.has_cure for doubt in _wrong(subject, teeth))
        )

    cures, has_cure = "", True
    if any(doubt.has_cure for doubt in found):
        cures = suggested(subject, filter(is_right, nearest(subject.space)), "that fit")
        has_cure = bool(cures)
    for doubt in found:
        hint = _counts(subject) if doubt.about is None else ""
        hint += cures if doubt.has_cure else ""
        yield doubt._replace(message=doubt.message + hint)
    for doubt in _hunting(subject.meshes(), subject.against):
        coprime = filter(subject.is_hunting, nearest(subject.space) if has_cure else ())
        hint = suggested(subject, filter(is_right, coprime), "without a common divisor")
        yield doubt._replace(message=doubt.message + hint)


def _wrong(subject: Subject, teeth: Teeth | None = None) -> Iterator[Doubt]:
    """What is wrong with the teeth of an element, or with others in their place; wear apart."""
    if isinstance(subject, OfPlanets):
        yield from _of_planets(subject.layout(teeth))
    if subject.element.kind == "bevel":
        yield from _bevel_assembled(subject.element, teeth or subject.known())
    else:
        yield from _undercut(subject.wheels(teeth).values())
        yield from _interfering(subject.meshes(teeth))


def _of_planets(layout: Layout) -> Iterator[Doubt]:
    """Everything about the places of planets, each part of it in turn."""
    hopeless = [*_without_room(layout)]
    yield from hopeless
    if not hopeless:
        yield from _coaxial(layout)
        yield from _modules(layout)
        yield from _triangles(layout)
        yield from _clear_wheels(layout)
        yield from _planets(layout)


def _without_room(layout: Layout) -> Iterator[Doubt]:
    for planet, rims in layout.group.planets.items():
        for rim, teeth in rims.items():
            if teeth is not None and teeth < 1:
                message = f"no planet `{planet}` fits between the wheels around it"
                yield Doubt(message, layout.key(layout.around(rim)[-1]))


def _coaxial(layout: Layout) -> Iterator[Doubt]:
    """Wheels that mesh with one rim stand at one distance from it."""
    for rim in layout.group.planet_of:
        wheels, teeth = layout.around(rim), layout.teeth(rim)
        if not wheels or teeth is None:
            continue
        first, *others = wheels
        if teeth.denominator > 1:
            message = (
                f"no standard {layout.label(rim)} fits between: ({_difference(layout, rim)})/2 = "
                f"{float(teeth):g} is not whole; speeds of planets take it as it is"
            )
            yield Doubt(message, layout.key(wheels[-1]), "note")
        for other in others:
            change = int((layout.span(other) or 0) - (layout.span(first) or 0))
            if change and teeth.denominator == 1:
                yield _off_axis(layout, first, other, change)


def _difference(layout: Layout, rim: str) -> str:
    sun, ring = sorted(layout.around(rim), key=lambda wheel: wheel.internal)
    return f"{layout.label(ring)} - {layout.label(sun)}"


def _off_axis(layout: Layout, first: CentralWheel, other: CentralWheel, change: int) -> Doubt:
    wanted = layout.label(first)
    if first.internal != other.internal:
        wanted += f" {'-' if first.internal else '+'} 2 {layout.label(first.rim)}"
    message = f"{layout.label(other)} {other.teeth} is not {wanted} = {other.teeth - change}"
    if abs(change) <= SHIFT:
        message += ": runs with shifted profiles only"
        return Doubt(message, layout.key(other), "note")
    return Doubt(f"{message}: their axes don't coincide", layout.key(other))


def _modules(layout: Layout) -> Iterator[Doubt]:
    """Different rims of a planet may differ in module, and often have to."""
    for rims in layout.group.planets.values():
        first, *others = [rim for rim in rims if layout.around(rim)] or [""]
        for rim in others:
            here, there = layout.axis(rim), layout.axis(first)
            if here and there and here[0] != there[0] and min(here[0], there[0]) > 0:
                ratio = there[0] / here[0]
                shifted = abs(here[0] - there[0]) <= SHIFT
                message = (
                    f"coaxial with {'shifted profiles, or with ' if shifted else ''}"
                    f"different modules: that of {layout.label(rim)} is "
                    f"{float(ratio):.5g} times that of {layout.label(first)} ({ratio})"
                )
                yield Doubt(message, rim, "note", has_cure=False)


def _triangles(layout: Layout) -> Iterator[Doubt]:
    """Planets that mesh with one another stand at the corners of a triangle with the axis."""
    for one, other in layout.group.meshes:
        sides = _sides(layout, one, other)
        if sides is None or abs(sides[0] - sides[1]) < sides[2] < sides[0] + sides[1]:
            continue
        first, second, apart = (float(side) / 2 for side in sides)
        names = f"{layout.label(one)} and {layout.label(other)}"
        message = (
            f"{names} can't mesh: on axes at the radii {first:g} and {second:g} modules their "
            f"distance {apart:g} would have to lie between {abs(first - second):g} and "
            f"{first + second:g}"
        )
        rims = layout.group.planets
        alone = all(len(rims[layout.group.planet_of[rim]]) == 1 for rim in (one, other))
        if alone:
            yield Doubt(message, one)
        else:
            yield Doubt(f"{message}, if all rims have one module", one, "note", has_cure=False)


def _sides(layout: Layout, one: str, other: str) -> tuple[Fraction, Fraction, Fraction] | None:
    """Twice the radii of two axes of planets, and twice their distance, in modules."""
    first, second = layout.axis(one), layout.axis(other)
    teeth = (layout.teeth(one), layout.teeth(other))
    if first is None or second is None or teeth[0] is None or teeth[1] is None:
        return None
    return first[0], second[0], teeth[0] + teeth[1]


def _clear_wheels(layout: Layout) -> Iterator[Doubt]:
    """Meshed planets keep clear of the wheel that they pass.

    A Ravigneaux ring stands beside the short planets, over the large sun, and long planets
    may end before the small sun: that is only worth a note.
    """
    for rim, member in PASSING.get(layout.element.kind, ()):
        axis = layout.axis(rim) if rim in layout.group.planet_of else None
        teeth = layout.teeth(rim) if axis else None
        passed = next((wheel for wheel in layout.group.wheels if wheel.member == member), None)
        if axis is None or teeth is None or passed is None:
            continue
        room = passed.teeth - axis[0] if passed.internal else axis[0] - passed.teeth
        if room - teeth >= CLEAR:
            continue
        names = f"{rim} {teeth} and {member} {passed.teeth}"
        if layout.element.kind == "ravigneaux":
            message = f"tips of {names} would touch where they stood side by side"
            yield Doubt(message, layout.key(passed), "note", has_cure=False)
        else:
            yield Doubt(f"tips of {names} touch, which are not to mesh", rim)


def _planets(layout: Layout) -> Iterator[Doubt]:
    """Whether so many planets go in."""
    count = layout.element.planets or 1
    if count > 1:
        yield from _assembled(layout)
        yield from _touching(layout, count)


def _touching(layout: Layout, count: int) -> Iterator[Doubt]:
    """Tips of neighbouring planets must not meet."""
    sine = math.sin(math.pi / count)
    for rims in layout.group.planets.values():
        found = [_gap(layout, rim, sine) for rim in rims]
        gap, rim = min(filter(None, found), default=(1.0, ""))
        if gap < NO_GAP:
            yield _touched(layout, rim, count)
    for one, other in layout.group.meshes:
        yield from _crossing(layout, one, other, count)


def _gap(layout: Layout, rim: str, sine: float) -> tuple[float, str] | None:
    """How far the tips of neighbours are apart, in modules; which rim it is."""
    axis, teeth = layout.axis(rim), layout.teeth(rim)
    if axis is None or teeth is None:
        return None
    return float(axis[0]) * sine - float(teeth) - 2, rim


def _touched(layout: Layout, rim: str, count: int) -> Doubt:
    axis, teeth = layout.axis(rim), layout.teeth(rim)
    if axis is None or teeth is None:
        raise TypeError(rim)
    span, wheel = axis
    name = layout.label(rim)
    sign = "-" if wheel.internal else "+"
    apart = float(span) * math.sin(math.pi / count)
    message = (
        f"tips of neighbouring planets touch: ({layout.label(wheel)} {sign} "
        f"{layout.label(wheel.rim)}) sin(180°/{count}) = {apart:.4g}, "
        f"expected more than {name} + 2 = {float(teeth) + 2:g}"
    )
    return Doubt(message, None)


def _crossing(layout: Layout, one: str, other: str, count: int) -> Iterator[Doubt]:
    """A planet against the meshing planet of the next place."""
    sides = _sides(layout, one, other)
    if sides is None or not abs(sides[0] - sides[1]) < sides[2] < sides[0] + sides[1]:
        return
    first, second, apart = (float(side) / 2 for side in sides)
    angle = math.acos((first**2 + second**2 - apart**2) / (2 * first * second))
    turn = 2 * math.pi / count
    beyond = first**2 + second**2 - 2 * first * second * math.cos(turn - angle)
    distance = math.sqrt(max(beyond, 0.0))
    if distance - apart - 2 < NO_GAP:
        message = (
            f"{layout.label(one)} and {layout.label(other)} of neighbouring planets touch with "
            f"their tips: axes are {distance:.4g} modules apart, expected more than {apart + 2:g}"
        )
        yield Doubt(message, None)


def _counts(subject: Subject) -> str:
    """Numbers of planets near that of an element which would go in."""
    count = subject.element.planets or 1
    if not isinstance(subject, OfPlanets):
        return ""
    layout = subject.given
    trains = [placements(layout.group, train) for train in layout.group.trains]
    fit = [
        number
        for number in range(max(2, count - 3), count + 3)
        if not any(places % number for places in trains) and not any(_touching(layout, number))
    ]
    fit = sorted(sorted(fit, key=lambda number: abs(number - count))[:2])
    return f"; {' or '.join(map(str, fit))} planets fit" if fit else ""


def placements(group: PlanetGroup, train: Mapping[str, Fraction]) -> int:
    """In how many places around the axis a train of planets would go in; 0 in any.

    At a place ``k/n`` turn from the first train, a wheel of z teeth stands ``z k/n`` teeth
    further in the planet's eyes (a ring backward). Phases of the planets that fit all
    meshes exist where every whole combination of meshes that leaves no planet has a
    whole number of teeth; the greatest common divisor of these is what n must divide.

    >>> wheels = [CentralWheel("sun", 1, 30, False, "p"), CentralWheel("ring2", 2, 95, True, "p2")]
    >>> rims = {"p": Fraction(20), "p2": Fraction(25)}
    >>> group = PlanetGroup(3, wheels, {"planet": rims})
    >>> placements(group, group.trains[0])  # (30 * 25 + 95 * 20)/gcd(20, 25)
    530
    """
    column = {planet: number for number, planet in enumerate(train)}
    rows: list[list[int]] = []
    for wheel in group.wheels_of(train):
        row = [0] * len(column)
        row[column[group.planet_of[wheel.rim]]] = group.teeth(wheel.rim).numerator
        rows.append([*row, -wheel.teeth if wheel.internal else wheel.teeth])
    for pair in group.meshes:
        if group.planet_of[pair[0]] in train:
            row = [0] * len(column)
            for rim in pair:
                row[column[group.planet_of[rim]]] += group.teeth(rim).numerator
            rows.append([*row, 0])
    for number in column.values():
        _eliminate(rows, number)
    return math.gcd(*(row[-1] for row in rows))


def _eliminate(rows: list[list[int]], column: int) -> None:
    """Whole steps until one row is left that has anything in a column; take that one out."""
    while left := sorted((row for row in rows if row[column]), key=lambda row: abs(row[column])):
        pivot, *others = left
        if not others:
            rows[:] = [row for row in rows if row is not pivot]
        for row in others:
            times = row[column] // pivot[column]
            row[:] = [value - times * part for value, part in zip(row, pivot, strict=True)]


def _goes_in(subject: Subject, teeth: Teeth) -> bool:
    """Whether planets can be assembled: for a search the quickest question."""
    count = subject.element.planets or 1
    if count == 1 or not isinstance(subject, OfPlanets):
        return True
    group = subject.layout(teeth).group
    return not any(placements(group, train) % count for train in group.trains)


def _assembled(layout: Layout) -> Iterator[Doubt]:
    """Equally spaced planets must all find a tooth space at the same time."""
    count = layout.element.planets or 1
    for train in layout.group.trains:
        places = placements(layout.group, train)
        if places % count == 0:
            continue
        wheels = layout.group.wheels_of(train)
        sums = [_sum(layout, *pair) for pair in combinations(wheels, 2)]
        failed = [
            f"{text} = {whole}/{part * count} is not whole; "
            for text, whole, part in filter(None, sums)
            if whole % (part * count)
        ]
        message = f"{count} equally spaced planets can't be assembled: "
        if len(layout.group.trains) > 1:
            message = message.replace("planets", f"planets {', '.join(train)}", 1)
        message += failed[0] if failed else ""
        where = f"they fit at multiples of 1/{places} turn" if places > 1 else "only one fits"
        yield Doubt(message + where, None)


def _bevel_assembled(element: Element, teeth: Teeth) -> Iterator[Doubt]:
    """Side wheels are to planets between them what a sun and a ring are."""
    count, whole = element.planets or 1, teeth["left"] + teeth["right"]
    if whole % count:
        message = (
            f"{count} equally spaced planets can't be assembled: "
            f"(left + right)/planets = {whole}/{count} is not whole"
        )
        yield Doubt(message, None)


def _sum(layout: Layout, one: CentralWheel, other: CentralWheel) -> tuple[str, int, int] | None:
    """What two wheels ask to be whole: its text, dividend, divisor but for the planets."""
    group = layout.group
    planets = [group.planet_of[wheel.rim] for wheel in (one, other)]
    way = group.path(planets[0], planets[1])
    names, parts = [layout.label(one), layout.label(other)], [1, 1]
    below, divisor = "planets", 1
    if way and any(len(group.planets[group.planet_of[rim]]) > 1 for pair in way for rim in pair):
        return None
    if not way and one.rim != other.rim:
        teeth = [int(group.teeth(wheel.rim)) for wheel in (one, other)]
        rims = [layout.label(wheel.rim) for wheel in (one, other)]
        parts, divisor = teeth[::-1], math.gcd(*teeth)
        names = [f"{names[0]} * {rims[1]}", f"{names[1]} * {rims[0]}"]
        below = f"(planets * gcd({rims[0]}, {rims[1]}))"
    turned = len(way) % 2 == 1
    values = [one.teeth * parts[0], other.teeth * parts[1]]
    if (one.internal != other.internal) != turned:
        return f"({names[0]} + {names[1]})/{below}", sum(values), divisor
    if values[1] > values[0]:
        names, values = names[::-1], values[::-1]
    return f"({names[0]} - {names[1]})/{below}", values[0] - values[1], divisor


def _undercut(wheels: Iterable[Toothed]) -> Iterator[Doubt]:
    """The tool digs into the feet of few teeth."""
    for wheel in wheels:
        if wheel.internal:
            continue
        if wheel.teeth < UNCUT_SHIFTED:
            message = (
                f"{wheel} is undercut even with a shifted profile, "
                f"expected {UNCUT_SHIFTED} teeth or more"
            )
            yield Doubt(message, wheel.key)
        elif wheel.teeth < UNCUT:
            message = f"{wheel} needs a shifted profile: below {UNCUT} teeth are undercut"
            yield Doubt(message, wheel.key, "note", has_cure=False)


def _interfering(meshes: Sequence[Mesh]) -> Iterator[Doubt]:
    """Tips foul one another in a ring that is hardly larger than the wheel in it."""
    for ring, wheel in meshes:
        more = ring.teeth - wheel.teeth
        if ring.internal and more <= 0:
            yield Doubt(f"{wheel} doesn't fit into {ring}", ring.key)
        elif ring.internal and more < INSIDE:
            message = (
                f"tips of {wheel} and {ring} interfere: the ring has {more} teeth more, "
                f"expected {INSIDE} or more"
            )
            yield Doubt(message, ring.key)


def _hunting(meshes: Sequence[Mesh], against: str) -> Iterator[Doubt]:
    """Meshes where each tooth meets only some of the other wheel's, and a fault wears these.

    Parameters
    ----------
    meshes : sequence of Mesh
    against : str
        What the turns are counted against; the housing when empty.
    """
    common = sorted(
        (mesh for mesh in meshes if mesh.divisor > 1), key=lambda mesh: mesh.divisor, reverse=True
    )
    if not common:
        return
    (first, second), *others = common
    shared = common[0].divisor
    turns = second.teeth // shared
    often = "every turn" if turns == 1 else f"every {turns} turns"
    message = (
        f"{first} and {second} have the common divisor {shared}: "
        f"the same teeth meet {often} of {first.label}{against}"
    )
    if others:
        names = (f"{mesh.first} and {mesh.second} ({mesh.divisor})" for mesh in others)
        message += f"; likewise {', '.join(names)}"
    yield Doubt(message, first.key, "note", has_cure=False)
