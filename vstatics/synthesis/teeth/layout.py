"""What of a case has teeth to be found: wheels, what meshes, what ratios the teeth make."""

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
"""Kinds of wheels without planets whose teeth are looked for."""


class TeethRatio(NamedTuple):
    """A ratio of an element, but for its sign a product of powers of teeth."""

    mechanism: int
    """Index of the mechanism on the case's own links."""
    name: str
    sign: int
    powers: Mapping[int, int]
    """Number of a wheel -> exponent."""


@dataclass(frozen=True)
class TeethLayout:
    """An element whose teeth are looked for; wheels and rims are numbered from 0.

    Parameters
    ----------
    element : Element
        As it is drawn, or as a mechanism of the case would be; its teeth do not matter.
    wheels : tuple of str
        Central wheels, then rims of planets; or the wheels of a pair.
    internal : tuple of bool
        Which of them are rings.
    around : tuple of (int, int)
        Central wheels with the rims that they mesh with.
    planets : tuple of tuples of int
        The rims of each planet.
    meshes : tuple of (int, int)
        Rims of planets that mesh with one another.
    ratios : tuple of TeethRatio
    is_drawn : bool
        Whether the case has it as an element, not as a mechanism.
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
        """That of the element."""
        return self.element.name

    @cached_property
    def own_teeth(self) -> dict[int, int]:
        """By wheel: how many it has in the case, where the case tells them."""
        if not self.is_drawn or self.element.ratios:
            return {}
        given: list[Fraction | float | None]
        if self.planets:
            group = group_of(self.element)
            given = [wheel.teeth for wheel in group.wheels]
            given += [teeth for rims in group.planets.values() for teeth in rims.values()]
        else:
            given = [self.element.teeth.get(wheel) for wheel in self.wheels]
        return {n: int(one) for n, one in enumerate(given) if one is not None and one == int(one)}

    @cached_property
    def component(self) -> tuple[int, ...]:
        """By wheel: what meshes has one module, and one number here, from 0."""
        if not self.planets:
            return (0,) * len(self.wheels)
        return tuple(_groups(len(self.wheels), (*self.around, *self.meshes)))

    def around_rim(self, rim: int) -> list[int]:
        """The central wheels that mesh with a rim."""
        return [wheel for wheel, other in self.around if other == rim]

    def axis(self, rim: int) -> tuple[int, int] | None:
        """A central wheel and the rim of the same planet that tell how far out its axis is."""
        planet = next(rims for rims in self.planets if rim in rims)
        for one in (rim, *planet):
            for wheel in self.around_rim(one):
                return wheel, one
        return None

    @cached_property
    def passing(self) -> list[tuple[int, int]]:
        """Rims, and wheels in the same plane that they must keep clear of.

        So does a rim whose partner meshes with the wheel, unless it has such a wheel itself: then
        the two stand in different planes. In a Ravigneaux set it is always asked of the long
        planet and the small sun.
        """
        named = [
            (self.wheels.index(rim), self.wheels.index(wheel))
            for rim, wheel in PASSING.get(self.element.kind, ())
            if rim in self.wheels and wheel in self.wheels
        ]
        for pair in self.meshes:
            for rim, partner in (pair, pair[::-1]):
                own = {self.internal[wheel] for wheel in self.around_rim(rim)}
                others = self.around_rim(partner)
                named += [(rim, wheel) for wheel in others if self.internal[wheel] not in own]
        return [pair for pair in dict.fromkeys(named) if self.axis(pair[0])]

    @cached_property
    def trains(self) -> list[list[int]]:
        """Planets that mesh with one another, directly or not."""
        planet_of = {rim: number for number, rims in enumerate(self.planets) for rim in rims}
        pairs = [(planet_of[one], planet_of[other]) for one, other in self.meshes]
        trains: dict[int, list[int]] = {}
        for planet, train in enumerate(_groups(len(self.planets), pairs)):
            trains.setdefault(train, []).append(planet)
        return [*trains.values()]


def _groups(count: int, pairs: Sequence[tuple[int, int]]) -> list[int]:
    """The group of each of so many that pairs join, numbered as they come."""
    group = list(range(count))
    for one, other in pairs:
        old, new = sorted((group[one], group[other]), reverse=True)
        group = [new if number == old else number for number in group]
    numbers = sorted(set(group))
    return [numbers.index(number) for number in group]


def named_ratios(layouts: Sequence[TeethLayout]) -> dict[str, TeethRatio]:
    """Ratios of elements by their names; of an element with several each has its own."""
    found: dict[str, TeethRatio] = {}
    for layout in layouts:
        found |= {ratio.name: ratio for ratio in layout.ratios}
        if len(layout.ratios) == 1:
            found[layout.name] = layout.ratios[0]
    return found


def teeth_layouts(own: OwnLinks) -> list[TeethLayout]:
    """Everything of a case whose teeth can be looked for.

    A mechanism without teeth is what it would be as an element: with a third link, also with the
    housing in its place, a planetary set, of meshed planets where its ratio is above 0, else a pair
    of wheels.

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
    found, last = [], 0
    for part in own.parts:
        mechanisms = range(last, last + len(part.lowered))
        last += len(part.lowered)
        element = part.element or _stand_in(part.lowered[0].mechanism)
        is_set = part.element is not None and isinstance(part.element.shape, Planetary)
        is_fixed = any(own.is_fixed(number) for number in mechanisms)
        if element is None or (is_fixed and not is_set):
            continue
        if isinstance(element.shape, Planetary):
            found.append(_of_planets(element, part, mechanisms))
        elif element.kind in PAIRS:
            found.append(_of_pair(element, part, mechanisms[0]))
    return found


def _stand_in(mechanism: Mechanism) -> Element | None:
    """The element that a mechanism would be, with teeth that do not matter; none of a worm pair."""
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
    """What the first and second link of a mechanism are of a planetary set."""
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
        tuple(tuple(numbers[rim] for rim in own) for own in group.planets.values()),
        tuple((numbers[one], numbers[other]) for one, other in group.meshes),
        tuple(_ratios(group, numbers, part, mechanisms)),
        part.element is not None,
    )


def _ratios(
    group: PlanetGroup, numbers: Mapping[str, int], part: DrawnPart, mechanisms: Sequence[int]
) -> Iterator[TeethRatio]:
    """What the mechanisms of an element are by its teeth."""
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
    made = part.lowered[0].mechanism
    last = len(shape.toothed) - 1
    ratio = TeethRatio(mechanism, made.name, shape.sign, {0: -1, last: 1})
    internal = (False,) * (last + 1)
    return TeethLayout(
        element, shape.toothed, internal, (), (), (), (ratio,), part.element is not None
    )
