"""Whether equally spaced planets can be put in, found by putting them in.

The first set of planets is put in at direction 0 and the central wheels are turned until
they mesh with it. From then on the wheels stand. At every further place the simulation
looks for turned positions of identical planets that mesh with all they touch. Angles are
exact fractions of a turn; no assembly formula is used.

Phase of a wheel in a direction: how many pitches its tooth lies before that direction.
Tooth has to meet gap, half a pitch away from a tooth. Seen along the common tangent the
teeth of wheels that mesh from outside are counted in opposite senses, those of a ring and
the planet inside it in the same sense.

The direction from one planet to the next in a set is the angle of a triangle of centres.
It is irrational; its float is taken as an exact fraction, the same for every set.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

HALF = Fraction(1, 2)


class Wheel(NamedTuple):
    """A central wheel and the rim that it meshes with."""

    teeth: int
    rim: str
    internal: bool


class Contact(NamedTuple):
    """Two rims that mesh from outside, and where the second lies from the first."""

    first: str
    second: str
    direction: Fraction
    """Of the line of centres, in a set at direction 0. [turn]"""


class Group(NamedTuple):
    """A set of planets, of which several stand on one carrier, and the central wheels."""

    rims: Mapping[str, Mapping[str, int]]
    """Planets, with the teeth of their rims."""
    places: Mapping[str, Fraction]
    """Direction of each planet from the main axis, in a set at direction 0. [turn]"""
    wheels: Sequence[Wheel]
    contacts: Sequence[Contact] = ()

    def planet(self, rim: str) -> str:
        """The planet that has a rim."""
        return next(planet for planet, rims in self.rims.items() if rim in rims)

    def teeth(self, rim: str) -> int:
        """The teeth of a rim."""
        return self.rims[self.planet(rim)][rim]


Turned = Mapping[str, Fraction]
"""How far each planet is turned; a tooth of each of its rims stands there. [turn]"""


def phase(teeth: int, turned: Fraction, direction: Fraction) -> Fraction:
    """How many pitches lie from a tooth to a direction."""
    return teeth * (direction - turned)


def meets(gap: Fraction) -> bool:
    """Whether a tooth stands in the middle of a gap: whole pitches remain."""
    return gap.denominator == 1


def outside(
    first: tuple[int, Fraction], second: tuple[int, Fraction], direction: Fraction
) -> Fraction:
    """How far two outer wheels are from meshing, the second in a direction from the first."""
    return phase(*first, direction) + phase(*second, direction + HALF) + HALF


def inside(
    ring: tuple[int, Fraction], planet: tuple[int, Fraction], direction: Fraction
) -> Fraction:
    """How far a ring and the planet inside it are from meshing."""
    return phase(*planet, direction) - phase(*ring, direction) + HALF


def _wheel_gap(
    group: Group, wheel: Wheel, stands: Fraction, turned: Fraction, at: Fraction
) -> Fraction:
    """How far a central wheel is from meshing with the set at a direction, in pitches."""
    direction = at + group.places[group.planet(wheel.rim)]
    gap = inside if wheel.internal else outside
    return gap((wheel.teeth, stands), (group.teeth(wheel.rim), turned), direction)


def _contact_gap(group: Group, contact: Contact, turned: Turned, at: Fraction) -> Fraction:
    """How far two planets of the set at a direction are from meshing, in pitches."""
    first, second = (
        (group.teeth(rim), turned[group.planet(rim)]) for rim in (contact.first, contact.second)
    )
    return outside(first, second, at + contact.direction)


def _gaps(
    group: Group, stand: Sequence[Fraction], turned: Turned, at: Fraction
) -> Iterator[tuple[str, Fraction, str]]:
    """Of every mesh of the planets that stand already: a rim, its gap, its planet."""
    for wheel, stands in zip(group.wheels, stand, strict=False):
        planet = group.planet(wheel.rim)
        if planet in turned:
            yield wheel.rim, _wheel_gap(group, wheel, stands, turned[planet], at), planet
    for contact in group.contacts:
        planets = [group.planet(rim) for rim in (contact.first, contact.second)]
        if all(planet in turned for planet in planets):
            newest = max(planets, key=list(turned).index)
            rim = contact.first if group.planet(contact.first) == newest else contact.second
            yield rim, _contact_gap(group, contact, turned, at), newest


def _fitting(
    group: Group, stand: Sequence[Fraction], turned: dict[str, Fraction], at: Fraction
) -> Iterator[Turned]:
    """All ways to turn the planets of a set so that everything meshes."""
    left = [planet for planet in group.rims if planet not in turned]
    if not left:
        yield turned
        return
    for planet in left:
        tried = {**turned, planet: Fraction(0)}
        touched = [(rim, gap) for rim, gap, of in _gaps(group, stand, tried, at) if of == planet]
        if touched:
            break
    else:  # nothing that stands touches what is left: any position will do
        planet = left[0]
        yield from _fitting(group, stand, {**turned, planet: Fraction(0)}, at)
        return
    rim, gap = touched[0]
    teeth = group.teeth(rim)
    pitches = teeth // math.gcd(*group.rims[planet].values())
    for tooth in range(pitches):  # further ones look the same again
        tried[planet] = (gap + tooth) / teeth
        if all(meets(g) for _, g, of in _gaps(group, stand, tried, at) if of == planet):
            yield from _fitting(group, stand, dict(tried), at)


def assembles(group: Group, sets: int) -> bool:
    """Whether a number of equally spaced sets of identical planets can be put in."""
    zero = Fraction(0)
    first = next(_fitting(group, (), {}, zero), None)
    if first is None:
        raise ValueError("not even one set of planets can be put in")
    stand = []
    for wheel in group.wheels:
        gap = _wheel_gap(group, wheel, zero, first[group.planet(wheel.rim)], zero)
        stand.append((-gap if wheel.internal else gap) / wheel.teeth)
    return all(
        next(_fitting(group, stand, {}, Fraction(number, sets)), None) is not None
        for number in range(sets)
    )


def triangle(first: float, second: float, apart: float) -> tuple[Fraction, Fraction]:
    """Two planets at radii from the main axis and apart from one another.

    Returns
    -------
    tuple
        The direction of the second from the main axis, and from the first, when the first
        lies in direction 0. [turn]
    """
    cosine = (first**2 + second**2 - apart**2) / (2 * first * second)
    if not -1 <= cosine <= 1:
        raise ValueError("the planets cannot touch")
    angle = math.acos(cosine)
    line = math.atan2(second * math.sin(angle), second * math.cos(angle) - first)
    return Fraction(angle / math.tau), Fraction(line / math.tau)


def assembles_simple(sun: int, planet: int, ring: int, n: int) -> bool:
    """Whether n planets between a sun and a ring can be put in."""
    wheels = [Wheel(sun, "planet", internal=False), Wheel(ring, "planet", internal=True)]
    return assembles(Group({"planet": {"planet": planet}}, {"planet": Fraction(0)}, wheels), n)


def assembles_double(sun: int, inner: int, outer: int, ring: int, n: int) -> bool:
    """Whether n equally spaced pairs of meshed planets can be put in."""
    place, line = triangle((sun + inner) / 2, (ring - outer) / 2, (inner + outer) / 2)
    wheels = [Wheel(sun, "inner", internal=False), Wheel(ring, "outer", internal=True)]
    return assembles(_pair(inner, outer, place, line, wheels), n)


def assembles_stepped(  # noqa: PLR0913 (each wheel with its rim)
    wheel1: int, rim1: int, wheel2: int, rim2: int, n: int, *, internal1: bool, internal2: bool
) -> bool:
    """Whether n identical planets of two rims can be put in between two wheels."""
    wheels = [Wheel(wheel1, "rim1", internal1), Wheel(wheel2, "rim2", internal2)]
    return assembles_rims(rim1, rim2, wheels, n)


def assembles_rims(rim1: int, rim2: int, wheels: Sequence[Wheel], n: int) -> bool:
    """Whether n identical planets of two rims, `rim1` and `rim2`, fit any wheels."""
    rims = {"planet": {"rim1": rim1, "rim2": rim2}}
    return assembles(Group(rims, {"planet": Fraction(0)}, wheels), n)


def assembles_ravigneaux(  # noqa: PLR0913, PLR0917 (a Ravigneaux set has that many wheels)
    small_sun: int | None, large_sun: int | None, short: int, long: int, ring: int | None, n: int
) -> bool:
    """Whether n pairs of a short and a long planet can be put in; a wheel may be absent."""
    if large_sun is not None:
        radius = (large_sun + long) / 2
    elif ring is not None:
        radius = (ring - long) / 2
    else:
        raise ValueError("neither the large sun nor the ring tells where the long planet is")
    inner = radius if small_sun is None else (small_sun + short) / 2
    place, line = triangle(inner, radius, (short + long) / 2)
    wheels = [
        Wheel(teeth, rim, internal)
        for teeth, rim, internal in (
            (small_sun, "inner", False),
            (large_sun, "outer", False),
            (ring, "outer", True),
        )
        if teeth is not None
    ]
    return assembles(_pair(short, long, place, line, wheels), n)


def _pair(
    inner: int, outer: int, place: Fraction, line: Fraction, wheels: Sequence[Wheel]
) -> Group:
    """Two planets of one rim each that mesh with one another."""
    return Group(
        {"inner": {"inner": inner}, "outer": {"outer": outer}},
        {"inner": Fraction(0), "outer": place},
        wheels,
        [Contact("inner", "outer", line)],
    )
