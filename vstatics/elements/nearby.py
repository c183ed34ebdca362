"""The teeth of an element, which of them mesh, and numbers of teeth near them.

Wheels around one planet cannot change their teeth one by one: axes would not coincide
any more. So a step of the search moves a rim together with the wheels that mesh with it
(a tooth more on the planet: one less on the sun, one more on the ring), or moves the axis
of a planet (all wheels around it). What is coaxial stays so, in the same modules.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import islice, pairwise
from typing import ClassVar, NamedTuple

from vstatics.elements.element import CentralWheel, Element
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import Simple

Key = str | int
"""What has teeth: a rim or a wheel by its name, a central wheel of a group by its position."""

Teeth = Mapping[Key, int]

SHIFT = 2
"""Teeth by which wheels of one axis may differ where profiles are shifted."""

TEETH_PER_RATIO = 100
"""A percent of ratio is as far away as a tooth."""

FARTHEST = 0.3
"""What a ratio may change by, as a logarithm, and still be near."""

REACH = {1: 14, 2: 14, 3: 6, 4: 4, 5: 3, 6: 3}
"""Steps in all, by the number of moves: at most some 400 places, a few milliseconds."""

FEW = 5
"""Up to so many numbers of teeth a suggestion names them all, beyond only those that change."""


class Space(NamedTuple):
    """Where to search.

    Attributes
    ----------
    given : mapping of key to teeth
        The teeth as they stand; the changes of these count.
    start : mapping of key to teeth
        The coaxial teeth nearest to them.
    moves : sequence of mappings of key to a change of teeth
    ratios : sequence of mappings of key to exponent
        Each ratio is, but for its sign, a product of powers of teeth.
    """

    given: Teeth
    start: Teeth
    moves: Sequence[Teeth]
    ratios: Sequence[Teeth]


def nearest(space: Space) -> Iterator[Teeth]:
    """Teeth around those of a space, those with the fewest changes first.

    Distance is the number of teeth changed, plus the percents by which ratios change.

    >>> pair = {"first": 20, "second": 40}
    >>> space = Space(pair, pair, [{"first": 1}, {"second": 1}], [{"first": -1, "second": 1}])
    >>> around = nearest(space)
    >>> next(around), next(around)
    ({'first': 20, 'second': 40}, {'first': 19, 'second': 38})
    """
    found: list[tuple[float, int, Teeth]] = []
    logs = {key: math.log(count) for key, count in space.given.items()}
    for number, steps in enumerate(_steps(len(space.moves))):
        teeth = dict(space.start)
        for move, step in zip(space.moves, steps, strict=True):
            if step:
                for key, change in move.items():
                    teeth[key] += step * change
        if min(teeth.values()) > 1:
            distance = _distance(space, logs, teeth)
            if distance < math.inf:
                found.append((distance, number, teeth))
    found.sort(key=lambda one: one[:2])
    return (teeth for _, _, teeth in found)


def _distance(space: Space, logs: Mapping[Key, float], teeth: Teeth) -> float:
    """Infinite where a ratio changes too much."""
    changed = [key for key, count in space.given.items() if teeth[key] != count]
    total = float(sum(abs(teeth[key] - space.given[key]) for key in changed))
    apart = {key: math.log(teeth[key]) - logs[key] for key in changed}
    for powers in space.ratios:
        change = abs(sum(power * apart.get(key, 0.0) for key, power in powers.items()))
        total += TEETH_PER_RATIO * change if change <= FARTHEST else math.inf
    return total


@lru_cache
def _steps(moves: int) -> list[tuple[int, ...]]:
    """Steps along each move, all that add up to no more than the reach."""
    found: list[tuple[tuple[int, ...], int]] = [((), REACH.get(moves, 2))]
    for _ in range(moves):
        found = [
            ((*steps, step), left - abs(step))
            for steps, left in found
            for step in range(-left, left + 1)
        ]
    return [steps for steps, _ in found]


def space_of(group: PlanetGroup, given_rims: Sequence[str]) -> Space:
    """Where to search for teeth of a group of planets.

    >>> wheels = [CentralWheel("sun", 1, 48, False, "p"), CentralWheel("ring", 2, 97, True, "p")]
    >>> space = space_of(PlanetGroup(3, wheels, {"p": {"p": Fraction(49, 2)}}), [])
    >>> space.start
    {'p': 24, 0: 48, 1: 96}
    >>> space.moves
    [{0: 1, 1: 1}, {'p': 1, 0: -1, 1: 1}]
    """
    start: dict[Key, int] = {}
    moves: list[Teeth] = []
    for rims in group.planets.values():
        spans: dict[str, int] = {}
        for rim, teeth in rims.items():
            around = _around(group, rim)
            if teeth is None:
                for place, wheel in around:
                    start[place] = wheel.teeth
                    moves.append({place: 1})
                continue
            start[rim] = count = math.floor(teeth)
            if around:
                first = around[0][1]
                spans[rim] = first.teeth + (-count if first.internal else count)
            for place, wheel in around:
                start[place] = spans[rim] + (count if wheel.internal else -count)
        steps = _axis_steps(spans)
        axis: dict[Key, int] = {
            place: step for rim, step in steps.items() for place, _ in _around(group, rim)
        }
        moves += [axis] if axis else []
        for rim in (rim for rim, teeth in rims.items() if teeth is not None):
            turned: dict[Key, int] = {rim: 1}
            for place, wheel in _around(group, rim):
                turned[place] = 1 if wheel.internal else -1
            moves.append(turned)
    given: dict[Key, int] = {place: wheel.teeth for place, wheel in enumerate(group.wheels)}
    given |= {rim: int(group.teeth(rim)) for rim in given_rims if rim in group.planet_of}
    return Space(given, start, moves, _ratios(group))


def _axis_steps(spans: Mapping[str, int]) -> dict[str, int]:
    """How an axis may move: twice as far from the center, in the modules of its rims.

    Rims of one module move together, those that need a shifted profile as well; rims of
    different modules keep the proportion of these where its steps are small.
    """
    if not spans or max(spans.values()) - min(spans.values()) <= SHIFT:
        return dict.fromkeys(spans, 1)
    unit = math.gcd(*spans.values())
    return {rim: span // unit for rim, span in spans.items() if max(spans.values()) <= FEW * unit}


def with_teeth(group: PlanetGroup, teeth: Teeth) -> PlanetGroup:
    """A group with other teeth."""
    wheels = [wheel._replace(teeth=teeth[place]) for place, wheel in enumerate(group.wheels)]
    planets = {
        planet: {rim: Fraction(teeth[rim]) if rim in teeth else None for rim in rims}
        for planet, rims in group.planets.items()
    }
    return PlanetGroup(group.carrier, wheels, planets, group.meshes)


def ratio_pairs(group: PlanetGroup) -> Iterator[tuple[CentralWheel, CentralWheel]]:
    """The wheels whose ratios matter: each of a train with the last one."""
    for train in group.trains:
        *others, last = group.wheels_of(train)
        yield from ((other, last) for other in others)


def _around(group: PlanetGroup, rim: str) -> list[tuple[int, CentralWheel]]:
    """The wheels that mesh with a rim, with their positions."""
    return [(place, wheel) for place, wheel in enumerate(group.wheels) if wheel.rim == rim]


def _ratios(group: PlanetGroup) -> list[Teeth]:
    """The ratios of a group as products of powers of teeth; what cancels is left out."""
    found: list[Teeth] = []
    wheels = list(group.wheels)
    for one, last in ratio_pairs(group):
        powers: dict[Key, int] = {wheels.index(one): -1, wheels.index(last): 1}
        way = _way(group, one.rim, last.rim)
        for driver, driven in zip(way[::2], way[1::2], strict=True):
            powers[driver] = powers.get(driver, 0) + 1
            powers[driven] = powers.get(driven, 0) - 1
        found.append({key: power for key, power in powers.items() if power})
    return found


def _way(group: PlanetGroup, first: str, last: str) -> list[str]:
    """Rims from one to another, planet by planet: where each planet is left, where entered."""
    here, way = group.planet_of[first], [first]
    for pair in group.path(here, group.planet_of[last]):
        near, far = pair if group.planet_of[pair[0]] == here else pair[::-1]
        way += [near, far]
        here = group.planet_of[far]
    return [*way, last]


@dataclass(frozen=True)
class Layout:
    """Planets around an axis: an element, and its group with these or other teeth."""

    element: Element
    group: PlanetGroup

    def teeth(self, rim: str) -> Fraction | None:
        """Teeth of a rim, None where nothing tells them."""
        return self.group.planets[self.group.planet_of[rim]][rim]

    def is_given(self, rim: str) -> bool:
        """Whether the case gives the teeth of a rim; else wheels around it may."""
        return rim in self.element.teeth or bool(self.element.rims)

    def around(self, rim: str) -> list[CentralWheel]:
        """The central wheels that mesh with a rim."""
        return [wheel for wheel in self.group.wheels if wheel.rim == rim]

    def label(self, body: CentralWheel | str) -> str:
        """How messages call a wheel or a rim."""
        if isinstance(body, str):
            return f"rim `{body}`" if self.element.rims else body
        if self.element.rims:
            return f"{'ring' if body.internal else 'sun'} `{body.member}`"
        return body.member

    def key(self, wheel: CentralWheel) -> Key:
        """What stands for a wheel in doubts."""
        return list(self.group.wheels).index(wheel)

    def span(self, wheel: CentralWheel) -> Fraction | None:
        """Twice the distance of wheel and planet, in modules."""
        teeth = self.teeth(wheel.rim)
        if teeth is None:
            return None
        return wheel.teeth - teeth if wheel.internal else wheel.teeth + teeth

    def axis(self, rim: str) -> tuple[Fraction, CentralWheel] | None:
        """Twice the distance of a rim from the axis, in modules, by which wheel.

        A rim that meshes with planets only has the module of the planet's other rims.
        """
        alike = [rim, *self.group.planets[self.group.planet_of[rim]]]
        for wheel in (wheel for one in alike for wheel in self.around(one)):
            span = self.span(wheel)
            if span is not None:
                return span, wheel
        return None


class Toothed(NamedTuple):
    """A wheel or a rim."""

    label: str
    teeth: int
    key: Key
    internal: bool = False

    def __str__(self) -> str:
        """Its name with its teeth."""
        return f"{self.label} {self.teeth}"


class Mesh(NamedTuple):
    """Two that mesh; the first one is the ring of an internal mesh."""

    first: Toothed
    second: Toothed

    @property
    def divisor(self) -> int:
        """The greatest common divisor of their teeth.

        >>> Mesh(Toothed("first", 20, "first"), Toothed("second", 42, "second")).divisor
        2
        """
        return math.gcd(self.first.teeth, self.second.teeth)


@dataclass(frozen=True)
class Subject(ABC):
    """The teeth of an element, as they are or with others in their place."""

    element: Element

    against: ClassVar = ""
    """What turns are counted against; the housing when empty."""

    @property
    @abstractmethod
    def space(self) -> Space:
        """Where nearby teeth are."""

    @property
    @abstractmethod
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """What meshes, a ring before the wheel in it."""

    @abstractmethod
    def known(self) -> Teeth:
        """The teeth that are known and whole."""

    @abstractmethod
    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratios with other teeth."""

    @abstractmethod
    def is_internal(self, key: Key) -> bool:
        """Whether teeth point inward."""

    def label(self, key: Key) -> str:
        """How messages call a wheel or a rim."""
        return str(key)

    def wheels(self, teeth: Teeth | None = None) -> dict[Key, Toothed]:
        """What has teeth, as far as these are known."""
        return {
            key: Toothed(self.label(key), count, key, self.is_internal(key))
            for key, count in (teeth or self.known()).items()
        }

    def meshes(self, teeth: Teeth | None = None) -> list[Mesh]:
        """What meshes, as far as the teeth are known."""
        wheels = self.wheels(teeth)
        return [Mesh(wheels[a], wheels[b]) for a, b in self.pairs if a in wheels and b in wheels]

    def is_hunting(self, teeth: Teeth) -> bool:
        """Whether every tooth meets every tooth."""
        return all(
            math.gcd(teeth[a], teeth[b]) == 1 for a, b in self.pairs if a in teeth and b in teeth
        )


class OfPlanets(Subject):
    """The teeth of an element with planets."""

    against = " against the carrier"

    @cached_property
    def given(self) -> Layout:
        """The element as it stands."""
        return Layout(self.element, group_of(self.element))

    @cached_property
    def space(self) -> Space:
        """Coaxial teeth."""
        rims = filter(self.given.is_given, self.given.group.planet_of)
        return space_of(self.given.group, [*rims])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Wheels and rims, then rims of meshed planets."""
        group = self.given.group
        return [*((place, wheel.rim) for place, wheel in enumerate(group.wheels)), *group.meshes]

    def layout(self, teeth: Teeth | None = None) -> Layout:
        """The element as it stands, or with other teeth."""
        if teeth is None:
            return self.given
        return Layout(self.element, with_teeth(self.given.group, teeth))

    def known(self) -> Teeth:
        """Teeth of the central wheels, and of the rims where they are told."""
        group = self.given.group
        known: dict[Key, int] = {place: wheel.teeth for place, wheel in enumerate(group.wheels)}
        for rim in group.planet_of:
            count = self.given.teeth(rim)
            if count is not None and count.denominator == 1 and count > 0:
                known[rim] = int(count)
        return known

    def is_internal(self, key: Key) -> bool:
        """Whether it is a ring."""
        return isinstance(key, int) and self.given.group.wheels[key].internal

    def label(self, key: Key) -> str:
        """Its member, or what it is and its name."""
        return self.given.label(key if isinstance(key, str) else self.given.group.wheels[key])

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratios between central wheels, the carrier held."""
        group = self.layout(teeth).group
        return [group.ratio(*pair) for pair in ratio_pairs(group)]


class OfWheels(Subject):
    """The teeth of a pair of wheels, of an idler, of a bevel differential."""

    @cached_property
    def shape(self) -> Simple:
        """The kind of the element."""
        shape = self.element.shape
        if not isinstance(shape, Simple):
            raise TypeError(self.element.kind)
        return shape

    @cached_property
    def names(self) -> list[str]:
        """What has teeth, in the order of the meshes."""
        return [name for name in self.shape.toothed if name in self.element.teeth]

    @cached_property
    def space(self) -> Space:
        """Any teeth."""
        given: Teeth = {name: int(self.element.teeth[name]) for name in self.names}
        ratio: Teeth = {self.names[0]: -1, self.names[-1]: 1}
        return Space(given, given, [{name: 1} for name in given], [ratio])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Each with the next one, unless an idler's teeth are not told.

        Not those of a bevel differential, which hardly turn.
        """
        if self.element.kind == "bevel":
            return []
        names = sorted(self.names, key=self.is_internal, reverse=True)
        return [*pairwise(names)] if len(names) == len(self.shape.toothed) else []

    def known(self) -> Teeth:
        """All that are given."""
        return self.space.given

    def is_internal(self, key: Key) -> bool:
        """Whether it is the larger wheel of an internal pair."""
        given = self.space.given
        return self.element.kind == "internal_pair" and given[key] == max(given.values())

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratio of its first to its last wheel."""
        return [self.shape.sign * Fraction(teeth[self.names[-1]], teeth[self.names[0]])]


def suggested(subject: Subject, found: Iterator[Teeth], what: str) -> str:
    """The first two of some teeth in words: ``; nearest that fit: ...``; or nothing."""
    texts = []
    for teeth in islice(found, 2):
        given = subject.space.given
        keys = [key for key in given if len(given) <= FEW or teeth[key] != given[key]]
        names = ", ".join(f"{subject.label(key)} {teeth[key]}" for key in keys)
        ratios = [f"{float(ratio):.5g}" for ratio in subject.ratios(teeth)]
        word = "ratios" if len(ratios) > 1 else "ratio"
        texts.append(f"{names} ({word} {', '.join(ratios)})")
    return f"; nearest {what}: {' or '.join(texts)}" if texts else ""
