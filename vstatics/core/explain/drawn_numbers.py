"""A case with other numbers, drawn at random: teeth that can be assembled, ratios near its own."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from itertools import islice
from random import Random

import numpy as np

from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.teeth.doubtful_teeth import fitting
from vstatics.core.elements.teeth.layout import Teeth
from vstatics.core.model.parts import Gear, Mechanism, OfLoad, ShiftElement
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.carried import carried_torques
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve

FARTHEST = 0.25
"""By such a part a ratio changes at most."""


def drawn(results: Results, seed: int) -> Results:
    """Results of the case with other numbers, where elements have the margins of the given case.

    Capacities are those of the given ratios: with others an element would carry too much.
    """
    made = solve(drawn_numbers(results.case, seed))
    if not any(one.capacity for one in results.case.shift_elements):
        return made
    with np.errstate(all="ignore"):
        factors = (_largest(made) / _largest(results)).tolist()
    elements = [
        _with_capacity(one, factor)
        for one, factor in zip(made.case.shift_elements, factors, strict=True)
    ]
    return solve(made.case.replace(shift_elements=elements))


def _largest(results: Results) -> Floats:
    """What each shift element carries at most, of all gears."""
    load = results.case.load
    torques, carrying = carried_torques(results, load.torque_size if load else 0.0)
    largest: Floats = np.where(carrying, torques, 0.0).max(axis=0)
    return largest


def _with_capacity(one: ShiftElement, factor: float) -> ShiftElement:
    """An element whose capacity is that times as large, with its third digit rounded up."""
    own = one.capacity
    if own is None or not 0 < factor < math.inf:
        return one
    exact = factor * (own.given if isinstance(own, OfLoad) else own)
    places = 2 - math.floor(math.log10(exact))
    capacity = float(f"{exact:.3g}")
    if capacity < exact:
        capacity = round(capacity + 10.0**-places, places)
    if isinstance(own, OfLoad):
        return one._replace(capacity=OfLoad(capacity, own.whole))
    return one._replace(capacity=capacity)


def drawn_numbers(case: Transmission, seed: int) -> Transmission:
    """The same structure with other teeth, and other ratios of what has none.

    Ratios of 1 and -1 stay, as shafts and reversing wheels have them. Speed ratios of variators
    and converters are drawn for each gear. Seeds one after the other give other teeth each, until
    all that fit have been given.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> drawn = drawn_numbers(case, 7).mechanisms[0].ratio
    >>> drawn == drawn_numbers(case, 7).mechanisms[0].ratio, -3.2 < drawn < -1.8
    (True, True)
    """
    random = Random(seed)  # noqa: S311 - for exercises
    drawing = drawing_of(case)
    if not isinstance(drawing, Drawing):
        mechanisms = [_with_ratio(one, random) for one in case.mechanisms]
        return case.replace(mechanisms=mechanisms, gears=_gears(case, random))
    elements = [_with_sizes(one, place, seed) for place, one in enumerate(drawing.elements)]
    own = [_with_ratio(one, random) for one in drawing.mechanisms]
    made = replace(drawing, elements=elements, mechanisms=own)
    return case.replace(drawing=made, gears=_gears(case, random))


def unchanged(case: Transmission, made: Transmission) -> list[str]:
    """Names of elements and mechanisms that keep ratios other than 1 and -1, as no others fit."""
    before, after = ([one.ratio for one in each.mechanisms] for each in (case, made))
    return [
        one.name
        for one in case.own_devices
        if all(before[n] == after[n] and abs(before[n]) not in (0, 1) for n in one.mechanisms)
    ]


def _gears(case: Transmission, random: Random) -> list[Gear]:
    """The gears with other speed ratios of their own."""
    own = case.mechanisms[case.own_mechanisms]
    gears = []
    for gear in case.gears:
        ratios = {
            number: _speed_ratio(own[number - 1].kind, ratio, random)
            if number <= len(own)  # else of one of the converters
            else ratio
            for number, ratio in gear.speed_ratios.items()
        }
        gears.append(gear._replace(speed_ratios=ratios))
    return gears


def _speed_ratio(kind: str, ratio: float, random: Random) -> float:
    """One near it; of a converter a lower one, as the highest ones have no torque to speak of."""
    return _near(ratio, random, -FARTHEST, 0 if kind == "converter" else FARTHEST)


def _near(number: float, random: Random, least: float = -FARTHEST, most: float = FARTHEST) -> float:
    return float(f"{number * (1 + random.uniform(least, most)):.3g}")


def _with_ratio(one: Mechanism, random: Random) -> Mechanism:
    if one.kind:
        return one._replace(ratio=_speed_ratio(one.kind, one.ratio, random))
    if abs(one.ratio) == 1:
        return one
    drawn = _near(one.ratio, random)
    if (abs(drawn) > 1) != (abs(one.ratio) > 1):  # what is reduced stays so
        drawn = float(f"{2 * one.ratio - drawn:.3g}")
    return one._replace(ratio=drawn)


def _with_sizes(element: Element, place: int, seed: int) -> Element:
    """An element with other teeth, or other diameters or ratios where it has such."""
    random = Random(f"{seed} {place}")  # noqa: S311 - equal elements are not drawn alike
    if element.kind == "belt":
        half = FARTHEST / 2  # of each, so that the ratio changes by as much as others
        teeth = {name: _near(own, random, -half, half) for name, own in element.teeth.items()}
        return replace(element, teeth=teeth)
    if element.ratios:  # of both suns: 1 < -large < small
        large = 1 + _near(-element.ratios["large_sun"] - 1, random)
        more = _near(element.ratios["small_sun"] + element.ratios["large_sun"], random)
        ratios = {"small_sun": round(large + more, 6), "large_sun": round(-large, 6)}
        return replace(element, ratios=ratios)
    return _with_teeth(element, place, seed)


def _with_teeth(element: Element, place: int, seed: int) -> Element:
    """Another one of all that fit for each seed, until none is left; then the first ones again."""
    order = Random(place)  # noqa: S311 - equal elements are not drawn alike
    others = (
        one for teeth in fitting(element, order) if (one := _changed(element, teeth)) != element
    )
    found = list(islice(others, min(seed, sys.maxsize - 1) + 1))
    return found[seed % len(found)] if found else element


def _changed(element: Element, teeth: Teeth) -> Element:
    """An element with other teeth: by the index of a wheel, or the name of a rim or wheel."""
    if element.rims:
        wheels = [
            one._replace(teeth=teeth.get(index, one.teeth))
            for index, one in enumerate(element.wheels)
        ]
        rims = {
            planet: {rim: teeth.get(rim, count) for rim, count in own.items()}
            for planet, own in element.rims.items()
        }
        return replace(element, wheels=wheels, rims=rims)
    members = dict[object, str]()
    if any(isinstance(key, int) for key in teeth):
        members |= {index: one.member for index, one in enumerate(group_of(element).wheels)}
    named = {members.get(key, key): count for key, count in teeth.items()}
    kept = {name: named.get(name, count) for name, count in element.teeth.items()}
    return replace(element, teeth=kept)
