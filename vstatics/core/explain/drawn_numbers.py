"""Random numbers for exercises: teeth that can be assembled, and ratios similar to the case."""

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
"""Largest relative change of a ratio by random numbers. [-]"""


def drawn(results: Results, seed: int) -> Results:
    """Return results for random numbers, with unchanged torque margins of shift elements.

    Torque capacities are scaled with the torques, because shift elements could be overloaded.
    """
    other_results = solve(drawn_numbers(results.case, seed))
    if not any(element.capacity for element in results.case.shift_elements):
        return other_results
    with np.errstate(all="ignore"):
        factors = (_largest(other_results) / _largest(results)).tolist()
    elements = [
        _with_capacity(element, factor)
        for element, factor in zip(other_results.case.shift_elements, factors, strict=True)
    ]
    return solve(other_results.case.replace(shift_elements=elements))


def _largest(results: Results) -> Floats:
    """Return the largest torque of each shift element in any gear [-]."""
    load = results.case.load
    torques, carrying = carried_torques(results, load.torque_size if load else 0.0)
    largest: Floats = np.where(carrying, torques, 0.0).max(axis=0)
    return largest


def _with_capacity(element: ShiftElement, factor: float) -> ShiftElement:
    """Return a shift element whose capacity is multiplied by a factor.

    The capacity is rounded up to three digits.
    """
    given = element.capacity
    if given is None or not 0 < factor < math.inf:
        return element
    exact = factor * (given.given if isinstance(given, OfLoad) else given)
    places = 2 - math.floor(math.log10(exact))
    capacity = float(f"{exact:.3g}")
    if capacity < exact:
        capacity = round(capacity + 10.0**-places, places)
    if isinstance(given, OfLoad):
        return element._replace(capacity=OfLoad(capacity, given.whole))
    return element._replace(capacity=capacity)


def drawn_numbers(case: Transmission, seed: int) -> Transmission:
    """Return the case with random teeth, and random ratios of parts without teeth.

    Ratios of 1 and -1 do not change, for example of shafts and reversing gears. Variators and
    converters get a random speed ratio for each gear. Successive seeds give different teeth until
    all suitable teeth have been used.

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
        mechanisms = [_with_ratio(part, random) for part in case.mechanisms]
        return case.replace(mechanisms=mechanisms, gears=_gears(case, random))
    elements = [_with_sizes(part, place, seed) for place, part in enumerate(drawing.elements)]
    given_mechanisms = [_with_ratio(part, random) for part in drawing.mechanisms]
    other_drawing = replace(drawing, elements=elements, mechanisms=given_mechanisms)
    return case.replace(drawing=other_drawing, gears=_gears(case, random))


def unchanged(case: Transmission, changed: Transmission) -> list[str]:
    """Return the names of gear sets and mechanisms for which no other ratio was possible.

    Gear sets and mechanisms of ratio 1 or -1 are not listed.
    """
    before, after = ([part.ratio for part in each.mechanisms] for each in (case, changed))
    return [
        part.name
        for part in case.own_devices
        if all(before[n] == after[n] and abs(before[n]) not in (0, 1) for n in part.mechanisms)
    ]


def _gears(case: Transmission, random: Random) -> list[Gear]:
    given_mechanisms = case.mechanisms[case.own_mechanisms]
    gears = []
    for gear in case.gears:
        ratios = {
            number: _speed_ratio(given_mechanisms[number - 1].kind, ratio, random)
            if number <= len(given_mechanisms)  # larger numbers belong to converters
            else ratio
            for number, ratio in gear.speed_ratios.items()
        }
        gears.append(gear._replace(speed_ratios=ratios))
    return gears


def _speed_ratio(kind: str, ratio: float, random: Random) -> float:
    """Return a random speed ratio near another speed ratio [-].

    For a converter the result is not larger than `ratio`, because the torque vanishes at the
    largest speed ratio.
    """
    return _near(ratio, random, -FARTHEST, 0 if kind == "converter" else FARTHEST)


def _near(number: float, random: Random, least: float = -FARTHEST, most: float = FARTHEST) -> float:
    return float(f"{number * (1 + random.uniform(least, most)):.3g}")


def _with_ratio(mechanism: Mechanism, random: Random) -> Mechanism:
    if mechanism.kind:
        return mechanism._replace(ratio=_speed_ratio(mechanism.kind, mechanism.ratio, random))
    if abs(mechanism.ratio) == 1:
        return mechanism
    drawn = _near(mechanism.ratio, random)
    if (abs(drawn) > 1) != (abs(mechanism.ratio) > 1):  # a reduction remains a reduction
        drawn = float(f"{2 * mechanism.ratio - drawn:.3g}")
    return mechanism._replace(ratio=drawn)


def _with_sizes(element: Element, place: int, seed: int) -> Element:
    """Return a gear set with random teeth, diameters or ratios."""
    random = Random(f"{seed} {place}")  # noqa: S311 - equal gear sets get different numbers
    if element.kind == "belt":
        # Both diameters change, and together they change the ratio by up to `FARTHEST`.
        half = FARTHEST / 2
        teeth = {
            name: _near(diameter, random, -half, half) for name, diameter in element.teeth.items()
        }
        return replace(element, teeth=teeth)
    if element.ratios:  # the ratios of a Ravigneaux set must fulfil 1 < -large < small
        large = 1 + _near(-element.ratios["large_sun"] - 1, random)
        more = _near(element.ratios["small_sun"] + element.ratios["large_sun"], random)
        ratios = {"small_sun": round(large + more, 6), "large_sun": round(-large, 6)}
        return replace(element, ratios=ratios)
    return _with_teeth(element, place, seed)


def _with_teeth(element: Element, place: int, seed: int) -> Element:
    """Return a gear set with suitable teeth, different for each seed until all have been used."""
    order = Random(place)  # noqa: S311 - equal gear sets get different numbers
    others = (
        changed
        for teeth in fitting(element, order)
        if (changed := _changed(element, teeth)) != element
    )
    choices = list(islice(others, min(seed, sys.maxsize - 1) + 1))
    return choices[seed % len(choices)] if choices else element


def _changed(element: Element, teeth: Teeth) -> Element:
    """Return a gear set with other numbers of teeth, which `teeth` contains by `Key`."""
    if element.rims:
        wheels = [
            wheel._replace(teeth=teeth.get(index, wheel.teeth))
            for index, wheel in enumerate(element.wheels)
        ]
        rims = {
            planet: {rim: teeth.get(rim, count) for rim, count in rims_of_planet.items()}
            for planet, rims_of_planet in element.rims.items()
        }
        return replace(element, wheels=wheels, rims=rims)
    members = dict[object, str]()
    if any(isinstance(key, int) for key in teeth):
        members |= {index: wheel.member for index, wheel in enumerate(group_of(element).wheels)}
    named = {members.get(key, key): count for key, count in teeth.items()}
    sizes = {name: named.get(name, count) for name, count in element.teeth.items()}
    return replace(element, teeth=sizes)
