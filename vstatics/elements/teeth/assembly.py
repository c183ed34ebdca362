"""Whether planets can be put in: all must find a tooth space at the same time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations

import numpy as np

from vstatics.elements.element import CentralWheel, Element
from vstatics.elements.group import PlanetGroup
from vstatics.elements.teeth.conditions import common_step, seated
from vstatics.elements.teeth.layout import AxisLayout, Doubt, Teeth
from vstatics.elements.teeth.subjects import OfPlanets, Subject


def placements(group: PlanetGroup, train: Mapping[str, Fraction]) -> int:
    """In how many places around the axis a train of planets would go in; 0 in any.

    See `common_step` for the condition.

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
    return int(common_step(np.array(rows, dtype=object), len(column)))


def goes_in(subject: Subject, teeth: Teeth) -> bool:
    """Whether planets can be assembled: for a search the quickest question."""
    count = subject.element.planets or 1
    if count == 1 or not isinstance(subject, OfPlanets):
        return True
    group = subject.layout(teeth).group
    return all(seated(placements(group, train), count) for train in group.trains)


def assembled(layout: AxisLayout) -> Iterator[Doubt]:
    """Equally spaced planets must all find a tooth space at the same time."""
    count = layout.element.planets or 1
    for train in layout.group.trains:
        places = placements(layout.group, train)
        if seated(places, count):
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


def bevel_assembled(element: Element, teeth: Teeth) -> Iterator[Doubt]:
    """Side wheels are to planets between them what a sun and a ring are."""
    count, whole = element.planets or 1, teeth["left"] + teeth["right"]
    if whole % count:
        message = (
            f"{count} equally spaced planets can't be assembled: "
            f"(left + right)/planets = {whole}/{count} is not whole"
        )
        yield Doubt(message, None)


def _sum(layout: AxisLayout, one: CentralWheel, other: CentralWheel) -> tuple[str, int, int] | None:
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
