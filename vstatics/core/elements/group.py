"""Group of planets on one carrier: exact ratios between central gears and planets.

Every kind of planetary gear set is such a group. Relative to the carrier the group is an ordinary
gear train (Willis). The speeds of two gears in mesh are inversely proportional to their teeth, and
have opposite signs in an external mesh.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from vstatics.core.elements.element import CentralWheel, Element
from vstatics.core.elements.kinds import Planetary


@dataclass(frozen=True)
class PlanetGroup:
    """Central gears and planets on a common carrier.

    Parameters
    ----------
    carrier : int
        Link that carries the planets.
    wheels : sequence of CentralWheel
        Sun gears and ring gears.
    planets : mapping of planet to its rims with their teeth
        Rims (gears) of each planet, with teeth. Teeth can be None if no ratio of central gears
        depends on them.
    meshes : sequence of pairs of rims
        Rims of planets that mesh with each other.
    """

    carrier: int
    wheels: Sequence[CentralWheel]
    planets: Mapping[str, Mapping[str, Fraction | None]]
    meshes: Sequence[tuple[str, str]] = ()

    @cached_property
    def planet_of(self) -> dict[str, str]:
        """Name of the planet to which each rim belongs."""
        return {rim: planet for planet, rims in self.planets.items() for rim in rims}

    def teeth(self, rim: str) -> Fraction:
        """Return the teeth of a rim.

        Unknown teeth count as 1, which affects no ratio of central gears.
        """
        return self.planets[self.planet_of[rim]][rim] or Fraction(1)

    def is_known(self, planet: str) -> bool:
        """Return whether the teeth of all rims of a planet are known."""
        return all(self.planets[planet].values())

    @cached_property
    def trains(self) -> list[dict[str, Fraction]]:
        """Trains of planets, which mesh directly or through other planets, with their speeds [-].

        Each train maps planets to their speeds relative to the carrier. The first planet has speed
        1.

        Raises
        ------
        ValueError
            If planets mesh in a closed loop that cannot turn.
        """
        neighbours: dict[str, list[tuple[str, Fraction]]] = {planet: [] for planet in self.planets}
        for rim, other in self.meshes:
            a, b = self.planet_of[rim], self.planet_of[other]
            ratio = -self.teeth(rim) / self.teeth(other)
            neighbours[a].append((b, ratio))
            neighbours[b].append((a, 1 / ratio))
        trains = []
        known: dict[str, Fraction] = {}
        for start in self.planets:
            if start in known:
                continue
            train = {start: Fraction(1)}
            waiting = [start]
            while waiting:
                planet = waiting.pop()
                for other, ratio in neighbours[planet]:
                    speed = train[planet] * ratio
                    if other not in train:
                        train[other] = speed
                        waiting.append(other)
                    elif train[other] != speed:
                        raise ValueError(f"planets {planet} and {other} block each other")
            trains.append(train)
            known |= train
        return trains

    def wheels_of(self, train: Mapping[str, Fraction]) -> list[CentralWheel]:
        """Return the central gears that mesh with planets of a train."""
        return [wheel for wheel in self.wheels if self.planet_of[wheel.rim] in train]

    def relative(self, wheel: CentralWheel, train: Mapping[str, Fraction]) -> Fraction:
        """Return the speed of a central gear relative to the carrier [-].

        The first planet in the train has speed 1.

        >>> sun = CentralWheel("sun", 1, 30, False, "planet")
        >>> group = PlanetGroup(3, [sun], {"planet": {"planet": Fraction(15)}})
        >>> group.relative(sun, group.trains[0])
        Fraction(-1, 2)
        """
        return train[self.planet_of[wheel.rim]] * self.mesh_ratio(wheel)

    def mesh_ratio(self, wheel: CentralWheel) -> Fraction:
        """Return the speed of a central gear divided by the planet speed, with the carrier held."""
        ratio = self.teeth(wheel.rim) / wheel.teeth
        return ratio if wheel.internal else -ratio

    def ratio(self, first: CentralWheel, second: CentralWheel) -> Fraction:
        """Return ``(w_first - w_carrier)/(w_second - w_carrier)`` of two gears of a train.

        >>> sun = CentralWheel("sun", 1, 48, False, "planet")
        >>> ring = CentralWheel("ring", 2, 96, True, "planet")
        >>> PlanetGroup(3, [sun, ring], {"planet": {"planet": None}}).ratio(sun, ring)
        Fraction(-2, 1)
        """
        train = next(train for train in self.trains if self.planet_of[first.rim] in train)
        return self.relative(first, train) / self.relative(second, train)

    def path(self, first: str, second: str) -> list[tuple[str, str]]:
        """Return the meshes between two planets on the shortest path, as pairs of rims.

        >>> planets = {name: {name: None} for name in "abc"}
        >>> PlanetGroup(1, [], planets, [("b", "c"), ("a", "b")]).path("a", "c")
        [('a', 'b'), ('b', 'c')]
        """
        ways: dict[str, list[tuple[str, str]]] = {first: []}
        waiting = [first]
        while waiting and second not in ways:
            planet = waiting.pop(0)
            for pair in self.meshes:
                ends = [self.planet_of[rim] for rim in pair]
                for here, there in (ends, ends[::-1]):
                    if here == planet and there not in ways:
                        ways[there] = [*ways[planet], pair]
                        waiting.append(there)
        return ways[second]

    @property
    def is_shared(self) -> bool:
        """True if more than two central gears mesh with a train of planets."""
        return any(len(self.wheels_of(train)) > 2 for train in self.trains)


def group_of(element: Element) -> PlanetGroup:
    """Return the group of planets of a planetary gear set."""
    carrier = element.link("carrier")
    if element.rims:
        rims = {
            planet: {rim: Fraction(teeth) for rim, teeth in given.items()}
            for planet, given in element.rims.items()
        }
        return PlanetGroup(carrier, element.wheels, rims, element.meshes)
    kind = element.shape
    if not isinstance(kind, Planetary):
        raise TypeError(element.kind)
    sizes = _proportions(element.ratios) if element.ratios else element.teeth
    wheels = [
        CentralWheel(member, element.members[member], int(sizes[member]), *shape)
        for member, shape in kind.wheels.items()
        if member in element.members
    ]
    used = {wheel.rim for wheel in wheels}
    planets = {
        planet: {rim: _rim_teeth(element, wheels, rim) for rim in rims if rim in used}
        for planet, rims in kind.planets.items()
        if used.intersection(rims)
    }
    meshes = [pair for pair in kind.meshes if used.issuperset(pair)]
    return PlanetGroup(carrier, wheels, planets, meshes)


def _proportions(ratios: Mapping[str, float]) -> dict[str, int]:
    """Return tooth numbers, however large, with exactly the given ratios of suns to the ring.

    >>> _proportions({"small_sun": 2.5, "large_sun": -2.0})
    {'ring': 10, 'small_sun': 4, 'large_sun': 5}
    """
    exact = {sun: abs(Fraction(ratio)) for sun, ratio in ratios.items()}
    ring = math.prod(ratio.numerator for ratio in exact.values())
    return {"ring": ring} | {sun: int(ring / ratio) for sun, ratio in exact.items()}


def _rim_teeth(element: Element, wheels: Sequence[CentralWheel], rim: str) -> Fraction | None:
    """Return the teeth of a rim, calculated from a ring and a sun if omitted."""
    if rim in element.teeth:
        return Fraction(int(element.teeth[rim]))
    around = {wheel.internal: wheel.teeth for wheel in wheels if wheel.rim == rim}
    return Fraction(around[True] - around[False], 2) if len(around) == 2 else None
