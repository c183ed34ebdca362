"""All teeth of small ranges that can be built, in plain loops; nothing is shared with the program.

Source of the conditions: coaxial centre distances; the planets' angles from their phases,
which is the textbook rule of whole numbers; tip circles of height ``TIP`` with a gap between
them in the plane. Lengths are in modules, halves of tooth counts.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple

TIP = 1.0
Range = Iterable[int]


class Rules(NamedTuple):
    """What is asked of all wheels."""

    gap: float = 0.5
    """Between tips of neighbours. [modules]"""
    least: int = 17
    """Teeth without undercut."""
    less: int = 8
    """So many less than its ring has a planet."""


class Simple(NamedTuple):
    """A set of plain planets."""

    sun: int
    planet: int
    ring: int
    planets: int

    @property
    def ratio(self) -> float:
        """Sun to ring, carrier held."""
        return -self.ring / self.sun


class Meshed(NamedTuple):
    """A set of planets in meshing pairs: sun, inner, outer, ring."""

    sun: int
    inner: int
    outer: int
    ring: int
    planets: int

    @property
    def ratio(self) -> float:
        """Sun to ring, carrier held."""
        return self.ring / self.sun


class Stepped(NamedTuple):
    """A set of planets with two rims: sun with the first, ring with the second."""

    sun: int
    first: int
    second: int
    ring: int
    planets: int

    @property
    def ratio(self) -> float:
        """Sun to ring, carrier held."""
        return -self.ring * self.first / (self.sun * self.second)


class Ravigneaux(NamedTuple):
    """Two suns and a ring with one carrier."""

    small_sun: int
    large_sun: int
    ring: int
    short: int
    long: int
    planets: int


def apart(count: int, radius: float, teeth: int, gap: float) -> bool:
    """Whether the tips of like planets on one circle keep the gap."""
    return 2 * radius * math.sin(math.pi / count) > teeth + 2 * TIP + gap


def simple(wheels: Sequence[Range], counts: Range, rules: Rules) -> Iterator[Simple]:
    """All sets of plain planets without profile shift, of these suns, planets and rings."""
    suns, planets, rings = map(set, wheels)
    for sun, planet, count in product(sorted(suns), sorted(planets), counts):
        ring = sun + 2 * planet
        if ring not in rings or min(sun, planet) < rules.least or ring - planet < rules.less:
            continue
        if (sun + ring) % count == 0 and apart(count, (sun + planet) / 2, planet, rules.gap):
            yield Simple(sun, planet, ring, count)


def pair_angle(sun: int, inner: int, outer: int, ring: int) -> float:
    """Between the axes of a pair, seen from the centre; nan where no triangle closes."""
    first, second, side = (sun + inner) / 2, (ring - outer) / 2, (inner + outer) / 2
    if second <= 0 or not abs(first - second) < side < first + second:
        return math.nan
    return math.acos((first**2 + second**2 - side**2) / (2 * first * second))


def is_meshed(one: Meshed, rules: Rules) -> bool:
    """Whether a set of pairs can be built."""
    sun, inner, outer, ring, count = one
    angle, turn = pair_angle(sun, inner, outer, ring), 2 * math.pi / count
    if (ring - sun) % count or not angle < turn:
        return False
    if min(sun, inner, outer) < rules.least or ring - outer < rules.less:
        return False
    first, second = (sun + inner) / 2, (ring - outer) / 2
    across = first**2 + second**2 - 2 * first * second * math.cos(turn - angle)
    return (
        apart(count, first, inner, rules.gap)
        and apart(count, second, outer, rules.gap)
        and math.sqrt(across) > (inner + outer) / 2 + 2 * TIP + rules.gap
        and ring - sun - 2 * max(inner, outer) >= 4 * TIP + 2 * rules.gap
    )


def meshed(wheels: Sequence[Range], counts: Range, rules: Rules) -> Iterator[Meshed]:
    """All sets of meshing pairs without profile shift: suns, inner and outer planets, rings."""
    for one in product(*wheels, counts):
        if is_meshed(Meshed(*one), rules):
            yield Meshed(*one)


def stepped(wheels: Sequence[Range], counts: Range, rules: Rules) -> Iterator[Stepped]:
    """All sets of stepped planets, alike, of one module: suns, rims at sun and ring, rings."""
    suns, first, second, rings = map(set, wheels)
    for sun, near, far, count in product(sorted(suns), sorted(first), sorted(second), counts):
        ring = sun + near + far
        if ring not in rings or min(sun, near, far) < rules.least or ring - far < rules.less:
            continue
        whole = (sun * far + ring * near) % (count * math.gcd(near, far)) == 0
        if whole and apart(count, (sun + near) / 2, max(near, far), rules.gap):
            yield Stepped(sun, near, far, ring, count)


def ravigneaux(wheels: Sequence[Range], counts: Range, rules: Rules) -> Iterator[Ravigneaux]:
    """All Ravigneaux sets without profile shift: a plain set and one of pairs, one carrier.

    The wheels are small suns, large suns, rings, short and long planets.
    """
    small, large, rings, short, long = map(set, wheels)
    for plain in simple((large, long, rings), counts, rules):
        for sun, planet in product(sorted(small), sorted(short)):
            pairs = Meshed(sun, planet, plain.planet, plain.ring, plain.planets)
            if is_meshed(pairs, rules):
                yield Ravigneaux(sun, plain.sun, plain.ring, planet, plain.planet, plain.planets)


def off(gears: Mapping[str, float], targets: Mapping[str, float]) -> float:
    """The largest |ln(i/target)|."""
    return max(abs(math.log(gears[name] / target)) for name, target in targets.items())


def belaz(ratios: Iterable[float], targets: Mapping[str, float]) -> tuple[float, tuple[float, ...]]:
    """The least largest error of the BelAZ-7516 and the sizes p of its four sets.

    Gear 2 is 1 + p3, 4 is (1 + p2)(1 + p3)/(1 + p2 + p3), R2 is 1 - p3 p4, 5 is (1 + p1)/p1;
    so set 3 is tried through, and then each other set has a gear of its own.
    """
    sizes = sorted({-one for one in ratios})
    first = min((off({"5": (1 + p) / p}, {"5": targets["5"]}), p) for p in sizes)
    best: tuple[float, tuple[float, ...]] = (math.inf, ())
    for third in sizes:
        error = abs(math.log((1 + third) / targets["2"]))
        if error >= best[0]:
            continue
        second = min(
            (abs(math.log((1 + p) * (1 + third) / (1 + p + third) / targets["4"])), p)
            for p in sizes
        )
        fourth = min(
            (abs(math.log((1 - third * p) / targets["R2"])), p) for p in sizes if third * p > 1
        )
        largest = max(error, first[0], second[0], fourth[0])
        best = min(best, (largest, (first[1], second[1], third, fourth[1])))
    return best
