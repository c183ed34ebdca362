"""Assembly of planets: the teeth of all planets must fit into tooth spaces at the same time."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np

from vstatics.core.elements.element import CentralWheel, Element
from vstatics.core.elements.group import PlanetGroup
from vstatics.core.elements.teeth.conditions import common_step, seated
from vstatics.core.elements.teeth.layout import AxisLayout, Doubt, Key, Teeth
from vstatics.core.elements.teeth.subjects import OfPlanets, Subject
from vstatics.core.numerics.arrays import Integers


def placements(group: PlanetGroup, train: Mapping[str, Fraction]) -> int:
    """Return the number of equidistant angles at which a train of planets fits; 0 for any angle.

    `common_step` explains the condition.

    >>> wheels = [CentralWheel("sun", 1, 30, False, "p"), CentralWheel("ring2", 2, 95, True, "p2")]
    >>> rims = {"p": Fraction(20), "p2": Fraction(25)}
    >>> group = PlanetGroup(3, wheels, {"planet": rims})
    >>> placements(group, group.trains[0])  # (30 * 25 + 95 * 20)/gcd(20, 25)
    530
    """

    def teeth(key: Key) -> int:
        return group.teeth(key).numerator if isinstance(key, str) else group.wheels[key].teeth

    return int(common_step(np.array([*_rows(group, train, teeth)], dtype=object), len(train)))


def _rows(
    group: PlanetGroup, train: Mapping[str, Fraction], teeth: Callable[[Key], Any]
) -> Iterator[list[Any]]:
    """Yield the numbers of teeth in each mesh of a train of planets, as rows for `common_step`.

    A row has a column for each planet, and a last column for the central gear.
    """
    column = {planet: number for number, planet in enumerate(train)}
    for place, wheel in enumerate(group.wheels):
        planet = group.planet_of[wheel.rim]
        if planet in column:
            row: list[Any] = [0] * (len(column) + 1)
            row[column[planet]] = teeth(wheel.rim)
            row[-1] = -teeth(place) if wheel.internal else teeth(place)
            yield row
    for pair in group.meshes:
        if group.planet_of[pair[0]] in column:
            row = [0] * (len(column) + 1)
            for rim in pair:
                number = column[group.planet_of[rim]]
                row[number] = row[number] + teeth(rim)
            yield row


def assemblable(subject: Subject, choices: Iterable[Teeth]) -> Iterator[Teeth]:
    """Yield the tooth numbers in `choices` with which the planets can be assembled."""
    count = subject.element.planets or 1
    if count == 1 or not isinstance(subject, OfPlanets):
        yield from choices
        return
    many = list(choices)
    group = subject.given.group

    def teeth(key: Key) -> Integers:
        return np.array([choice.get(key, 1) for choice in many], dtype=np.int64)

    go_in = np.ones(len(many), np.bool_)
    for train in group.trains:
        rows = [
            [np.broadcast_to(cell, len(many)) for cell in row] for row in _rows(group, train, teeth)
        ]
        go_in &= seated(common_step(np.array(rows, dtype=np.int64), len(train)), count)
    yield from (choice for choice, fits in zip(many, go_in.tolist(), strict=True) if fits)


def assembled(layout: AxisLayout) -> Iterator[Doubt]:
    """Report equally spaced planets that cannot be assembled."""
    count = layout.element.planets or 1
    for train in layout.group.trains:
        places = placements(layout.group, train)
        if seated(places, count):
            continue
        sums = [_sum(layout, *pair) for pair in combinations(layout.group.wheels_of(train), 2)]
        failed = [
            f"{text} = {whole}/{part * count} is not whole; "
            for text, whole, part in filter(None, sums)
            if whole % (part * count)
        ]
        message = f"{count} equally spaced planets cannot be assembled: "
        if len(layout.group.trains) > 1:
            message = message.replace("planets", f"planets {', '.join(train)}", 1)
        message += failed[0] if failed else ""
        where = (
            f"they fit at multiples of 1/{places} turn" if places > 1 else "only one planet fits"
        )
        yield Doubt("W317", message + where, None)


def bevel_assembled(element: Element, teeth: Teeth) -> Iterator[Doubt]:
    """Report bevel planets that cannot be assembled between the side gears."""
    count, whole = element.planets or 1, teeth["left"] + teeth["right"]
    if whole % count:
        yield Doubt(
            "W318",
            f"{count} equally spaced planets cannot be assembled: "
            f"(left + right)/planets = {whole}/{count} is not whole",
            None,
        )


def _sum(
    layout: AxisLayout, first: CentralWheel, second: CentralWheel
) -> tuple[str, int, int] | None:
    """Return the quotient for two central gears that must be whole: text, dividend, divisor.

    The caller multiplies the divisor by the number of planets.
    """
    group = layout.group
    planets = [group.planet_of[wheel.rim] for wheel in (first, second)]
    way = group.path(planets[0], planets[1])
    names, parts = [layout.label(first), layout.label(second)], [1, 1]
    below, divisor = "planets", 1
    if way and any(len(group.planets[group.planet_of[rim]]) > 1 for pair in way for rim in pair):
        return None
    if not way and first.rim != second.rim:
        teeth = [int(group.teeth(wheel.rim)) for wheel in (first, second)]
        rims = [layout.label(wheel.rim) for wheel in (first, second)]
        parts, divisor = teeth[::-1], math.gcd(*teeth)
        names = [f"{names[0]} * {rims[1]}", f"{names[1]} * {rims[0]}"]
        below = f"(planets * gcd({rims[0]}, {rims[1]}))"
    turned = len(way) % 2 == 1
    values = [first.teeth * parts[0], second.teeth * parts[1]]
    if (first.internal != second.internal) != turned:
        return f"({names[0]} + {names[1]})/{below}", sum(values), divisor
    if values[1] > values[0]:
        names, values = names[::-1], values[::-1]
    return f"({names[0]} - {names[1]})/{below}", values[0] - values[1], divisor
