"""Gear sets with unknown tooth numbers: gears, meshes, and ratios as products of tooth numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from vstatics.core.elements.element import Element
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.kinds import Planetary, Simple
from vstatics.core.elements.lower import DrawnPart
from vstatics.core.elements.teeth.nearby import ratio_powers
from vstatics.core.elements.teeth.spacing import PASSING
from vstatics.core.explain.bodies import OwnLinks
from vstatics.core.model.parts import HOUSING, Mechanism

PAIRS = ("gear_pair", "internal_pair", "bevel_pair", "idler", "chain")
"""Kinds of gear sets without planets for which tooth numbers can be found."""


class TeethRatio(NamedTuple):
    """Ratio of a mechanism: a sign and a product of powers of tooth numbers."""

    mechanism: int
    """Index of the mechanism in the case whose links do not include planets."""
    name: str
    sign: int
    powers: Mapping[int, int]
    """Exponent of each toothed gear, by number in the layout."""


@dataclass(frozen=True)
class TeethLayout:
    """Gear set with unknown tooth numbers. The toothed gears are numbered from 0.

    Parameters
    ----------
    element : Element
        Gear set of the case, or substitute for a mechanism without teeth; its teeth do not matter.
    wheels : tuple of str
        Names of the central gears, then of the planet gears; or of the gears of a pair.
    internal : tuple of bool
        True for ring gears.
    around : tuple of (int, int)
        Pairs of a central gear and a planet gear that meshes with it.
    planets : tuple of tuples of int
        Numbers of the planet gears of each planet.
    meshes : tuple of (int, int)
        Pairs of planet gears that mesh with each other.
    ratios : tuple of TeethRatio
        Ratios of the mechanisms of the gear set.
    is_drawn : bool
        True for a gear set under `elements` of the case, False for a mechanism.
    """

    element: Element
    wheels: tuple[str, ...]
    internal: tuple[bool, ...]
    around: tuple[tuple[int, int], ...]
    planets: tuple[tuple[int, ...], ...]
    meshes: tuple[tuple[int, int], ...]
    ratios: tuple[TeethRatio, ...]
    is_drawn: bool

    @property
    def name(self) -> str:
        """Name of the gear set."""
        return self.element.name

    @cached_property
    def own_teeth(self) -> dict[int, int]:
        """Tooth numbers that the case gives, by the number of the gear."""
        if not self.is_drawn or self.element.ratios:
            return {}
        given: list[Fraction | float | None]
        if self.planets:
            group = group_of(self.element)
            given = [wheel.teeth for wheel in group.wheels]
            given += [teeth for rims in group.planets.values() for teeth in rims.values()]
        else:
            given = [self.element.teeth.get(wheel) for wheel in self.wheels]
        return {n: int(z) for n, z in enumerate(given) if z is not None and z == int(z)}

    @cached_property
    def component(self) -> tuple[int, ...]:
        """Component of each gear, from 0. Meshing gears are a component with a common module."""
        if not self.planets:
            return (0,) * len(self.wheels)
        return tuple(_groups(len(self.wheels), (*self.around, *self.meshes)))

    def around_rim(self, rim: int) -> list[int]:
        """Return the central gears that mesh with a planet gear."""
        return [wheel for wheel, other in self.around if other == rim]

    def axis(self, rim: int) -> tuple[int, int] | None:
        """Return a central gear and a meshing planet gear, which determine the axis of a planet."""
        planet = next(rims for rims in self.planets if rim in rims)
        for gear in (rim, *planet):
            for wheel in self.around_rim(gear):
                return wheel, gear
        return None

    @cached_property
    def passing(self) -> list[tuple[int, int]]:
        """Pairs of a planet gear and a central gear in a common plane that must not touch.

        A planet gear must be clear of the sun (or ring) of the planet gear that it meshes with. If
        it meshes with a sun (or ring) itself, that sun (or ring) is in another plane, and cannot be
        touched. In a Ravigneaux set, the long planet must always be clear of the small sun.
        """
        named = [
            (self.wheels.index(rim), self.wheels.index(wheel))
            for rim, wheel in PASSING.get(self.element.kind, ())
            if rim in self.wheels and wheel in self.wheels
        ]
        for pair in self.meshes:
            for rim, partner in (pair, pair[::-1]):
                sides = {self.internal[wheel] for wheel in self.around_rim(rim)}
                others = self.around_rim(partner)
                named += [(rim, wheel) for wheel in others if self.internal[wheel] not in sides]
        return [pair for pair in dict.fromkeys(named) if self.axis(pair[0])]

    @cached_property
    def trains(self) -> list[list[int]]:
        """Groups of planets that are connected by meshes."""
        planet_of = {rim: number for number, rims in enumerate(self.planets) for rim in rims}
        pairs = [(planet_of[first], planet_of[second]) for first, second in self.meshes]
        trains: dict[int, list[int]] = {}
        for planet, train in enumerate(_groups(len(self.planets), pairs)):
            trains.setdefault(train, []).append(planet)
        return [*trains.values()]


def _groups(count: int, pairs: Sequence[tuple[int, int]]) -> list[int]:
    """Return the group of each of `count` items that pairs connect, numbered in order."""
    group = list(range(count))
    for first, second in pairs:
        old, new = sorted((group[first], group[second]), reverse=True)
        group = [new if number == old else number for number in group]
    numbers = sorted(set(group))
    return [numbers.index(number) for number in group]


def named_ratios(layouts: Sequence[TeethLayout]) -> dict[str, TeethRatio]:
    """Return the ratios of gear sets by name."""
    return {ratio.name: ratio for layout in layouts for ratio in layout.ratios}


def teeth_layouts(links: OwnLinks) -> list[TeethLayout]:
    """Return all gear sets of a case whose tooth numbers can be searched.

    A mechanism without teeth is replaced by a gear set. With a third link (possibly the housing) it
    becomes a planetary gear set, with meshing planets if the ratio is positive. Any other mechanism
    becomes a gear pair.

    Examples
    --------
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Gear, Transmission
    >>> mechanisms = [Mechanism(1, 2, 3, 2.5, name="P"), Mechanism(3, 2, 0, -0.8, name="G")]
    >>> own = on_own_links(Transmission(3, [], mechanisms, [Gear()]))
    >>> for one in teeth_layouts(own):
    ...     print(one.name, one.element.kind, one.wheels, one.ratios[0].powers)
    P double_planet ('sun', 'ring', 'inner', 'outer') {0: -1, 1: 1}
    G gear_pair ('first', 'second') {0: -1, 1: 1}
    """
    layouts, last = [], 0
    for part in links.parts:
        mechanisms = range(last, last + len(part.lowered))
        last += len(part.lowered)
        element = part.element or _stand_in(part.lowered[0].mechanism)
        is_set = part.element is not None and isinstance(part.element.shape, Planetary)
        is_fixed = any(links.is_fixed(number) for number in mechanisms)
        if element is None or (is_fixed and not is_set):
            continue
        if isinstance(element.shape, Planetary):
            layouts.append(_of_planets(element, part, mechanisms))
        elif element.kind in PAIRS:
            layouts.append(_of_pair(element, part, mechanisms[0]))
    return layouts


def _stand_in(mechanism: Mechanism) -> Element | None:
    """Return a gear set with arbitrary teeth that replaces a mechanism.

    Return None for a worm pair.
    """
    name, ratio = mechanism.name, mechanism.ratio
    if mechanism.back_efficiency is not None:
        return None
    if mechanism.third != HOUSING or mechanism.is_set:
        first, second = _wheels_of(mechanism)
        members = {first: mechanism.first, second: mechanism.second, "carrier": mechanism.third}
        kind = "planetary" if ratio < 0 else "double_planet"
        return Element(name, kind, members, {"sun": 20, "ring": 60})
    members = {"first": mechanism.first, "second": mechanism.second}
    kind = "gear_pair" if ratio < 0 else "bevel_pair"
    return Element(name, kind, members, {"first": 20, "second": 20}) if ratio else None


def _wheels_of(mechanism: Mechanism) -> tuple[str, str]:
    """Return the members at the first and second link when a mechanism is a planetary gear set."""
    return ("sun", "ring") if abs(mechanism.ratio) > 1 else ("ring", "sun")


def _of_planets(element: Element, part: DrawnPart, mechanisms: Sequence[int]) -> TeethLayout:
    group = group_of(element)
    rims = list(group.planet_of)
    names = [wheel.member for wheel in group.wheels] + rims
    first = len(group.wheels)
    numbers = {rim: first + place for place, rim in enumerate(rims)}
    return TeethLayout(
        element,
        tuple(names),
        tuple([wheel.internal for wheel in group.wheels] + [False] * len(rims)),
        tuple((place, numbers[wheel.rim]) for place, wheel in enumerate(group.wheels)),
        tuple(tuple(numbers[rim] for rim in gears) for gears in group.planets.values()),
        tuple(
            (numbers[first_gear], numbers[second_gear]) for first_gear, second_gear in group.meshes
        ),
        tuple(_tooth_ratios(group, numbers, part, mechanisms)),
        part.element is not None,
    )


def _tooth_ratios(
    group: PlanetGroup, numbers: Mapping[str, int], part: DrawnPart, mechanisms: Sequence[int]
) -> Iterator[TeethRatio]:
    wheels = {wheel.member: wheel for wheel in group.wheels}
    for number, (mechanism, members) in zip(mechanisms, part.lowered, strict=True):
        first, second, _ = members
        if part.element is None:
            first, second = _wheels_of(mechanism)
        given = ratio_powers(group, wheels[first], wheels[second])
        powers = {
            numbers[key] if isinstance(key, str) else key: power for key, power in given.items()
        }
        yield TeethRatio(number, mechanism.name, 1 if mechanism.ratio > 0 else -1, powers)


def _of_pair(element: Element, part: DrawnPart, mechanism: int) -> TeethLayout:
    shape = element.shape
    assert isinstance(shape, Simple)  # noqa: S101 - for mypy
    lowered = part.lowered[0].mechanism
    last = len(shape.toothed) - 1
    ratio = TeethRatio(mechanism, lowered.name, shape.sign, {0: -1, last: 1})
    internal = (False,) * (last + 1)
    return TeethLayout(
        element, shape.toothed, internal, (), (), (), (ratio,), part.element is not None
    )
