"""A case with other numbers, drawn at random: teeth that can be assembled, ratios near its own."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from itertools import islice
from random import Random

import numpy as np

from vstatics.elements.drawing import Drawing, drawing_of
from vstatics.elements.element import Element
from vstatics.elements.group import group_of
from vstatics.elements.teeth.doubtful_teeth import fitting
from vstatics.elements.teeth.layout import Teeth
from vstatics.model.parts import Law, Mechanism, OfLoad, ShiftElement
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.statics.carried import carried_torques
from vstatics.statics.results import Results
from vstatics.statics.solve import solve

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

    Ratios of 1 stay, as shafts have them; so do those that follow a law. Seeds one after the
    other give other teeth each, until all that fit have been given.

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
        return case.replace(mechanisms=[_with_ratio(one, random) for one in case.mechanisms])
    elements = [_with_teeth(one, place, seed) for place, one in enumerate(drawing.elements)]
    own = [_with_ratio(one, random) for one in drawing.mechanisms]
    return case.replace(drawing=replace(drawing, elements=elements, mechanisms=own))


def _with_ratio(one: Mechanism, random: Random) -> Mechanism:
    if isinstance(one.ratio, Law) or abs(one.ratio) == 1 or one.kind:
        return one
    drawn = one.ratio * (1 + random.uniform(-FARTHEST, FARTHEST))
    if (abs(drawn) > 1) != (abs(one.ratio) > 1):  # what is reduced stays so
        drawn = 2 * one.ratio - drawn
    return one._replace(ratio=float(f"{drawn:.3g}"))


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
