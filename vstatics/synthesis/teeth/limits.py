"""Between what limits teeth are looked for, and which equations they fulfil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from vstatics.core.elements.teeth.conditions import UNCUT, UNCUT_SHIFTED
from vstatics.synthesis.teeth.layout import TeethLayout

Range = tuple[int, int]
"""Fewest and most teeth."""

MOST_TEETH = 60
"""Of a wheel or rim whose range is not given and that has no more itself: of an external one of a
planetary set."""
MOST_OF_PAIR = 100
"""The same of a wheel of a pair."""
MOST_OF_RING = 121
"""The same of a ring."""
CLEARANCE = 0.5
"""Modules between tips of neighbouring planets, when not given."""
COAXIAL = "coaxial"
"""What the condition is called that axes coincide."""
PLANETS = (3, 4, 5)
"""How many planets there may be, where neither the case nor anybody else says it."""


@dataclass(frozen=True)
class TeethLimits:
    """What is asked of teeth besides ratios.

    Parameters
    ----------
    ranges : mapping of str to (int, int)
        Fewest and most teeth, by wheel (`sun`) or by element and wheel (`P2.ring`); `all` for those
        that are not named.
    planets : tuple of int
        How many planets there may be around an axis; the element's own number when empty.
    clearance : float
        Between tips of planets that do not mesh. [modules]
    centre : mapping of str to float
        By pair: the distance of its axes. [modules]
    modules : tuple of float
        One for all wheels of an element that mesh with one another; none: all are equal. [mm]
    largest_diameter : float, optional
        Of an element. [mm]
    shift : int
        Teeth by which axes may differ, as shifted profiles make up for it. Without, they coincide,
        and no wheel with fewer than 17 teeth is looked for unless a range says so, or the case
        has such a wheel.

    Examples
    --------
    >>> TeethLimits({"sun": (17, 40)}, planets=(3, 4), clearance=1.0).planets
    (3, 4)
    """

    ranges: Mapping[str, Range] = field(default_factory=dict)
    planets: tuple[int, ...] = ()
    clearance: float = CLEARANCE
    centre: Mapping[str, float] = field(default_factory=dict)
    modules: tuple[float, ...] = ()
    largest_diameter: float | None = None
    shift: int = 0

    def of_wheels(self, layout: TeethLayout) -> list[Range]:
        """The range of each wheel of an element; the most special one that is given.

        One that is not given holds the wheel's own number of teeth.
        """
        return [self._of_wheel(layout, number) for number in range(len(layout.wheels))]

    def _of_wheel(self, layout: TeethLayout, number: int) -> Range:
        wheel = layout.wheels[number]
        for name in (f"{layout.name}.{wheel}", wheel, "all"):
            if name in self.ranges:
                return self.ranges[name]
        most = MOST_TEETH if layout.planets else MOST_OF_PAIR
        if layout.internal[number]:
            most = MOST_OF_RING
        least = UNCUT_SHIFTED if self.shift else UNCUT
        own = layout.own_teeth.get(number, least)
        return min(least, own), max(most, own)

    def counts(self, layout: TeethLayout) -> tuple[int, ...]:
        """How many planets an element may have, the number that is best liked first."""
        if not layout.planets:
            return (1,)
        own = layout.element.planets
        liked = sorted(set(self.planets or ((own,) if own else PLANETS)), reverse=True)
        return tuple(sorted(liked, key=lambda count: count != own))


class AxisEquation(NamedTuple):
    """``|sum of module factor teeth - value| <= tolerance``."""

    label: str
    terms: Mapping[int, tuple[float, int]]
    """Number of a wheel -> its factor, and the component whose module counts."""
    value: float
    tolerance: tuple[float, tuple[int, int]]
    """In modules, mean of those of two components."""


def axis_equations(layout: TeethLayout, limits: TeethLimits) -> Iterator[AxisEquation]:
    """What makes axes coincide, or gives a pair the distance that is wanted.

    Examples
    --------
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> from vstatics.synthesis.teeth.layout import teeth_layouts
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> (layout,) = teeth_layouts(on_own_links(case))
    >>> [one.terms for one in axis_equations(layout, TeethLimits())]  # sun + 2 planet - ring
    [{0: (1.0, 0), 2: (2.0, 0), 1: (-1.0, 0)}]
    """
    for rims in layout.planets:
        first, *others = [(wheel, rim) for rim in rims for wheel in layout.around_rim(rim)] or [
            (-1, -1)
        ]
        for other in others:
            terms: dict[int, tuple[float, int]] = {}
            for factor, (wheel, rim) in ((1.0, first), (-1.0, other)):
                component = layout.component[rim]
                inward = -1.0 if layout.internal[wheel] else 1.0
                for number, part in ((wheel, factor), (rim, factor * inward)):
                    terms[number] = (terms.get(number, (0.0, 0))[0] + part, component)
            terms = {number: term for number, term in terms.items() if term[0]}
            both = (layout.component[first[1]], layout.component[other[1]])
            yield AxisEquation(COAXIAL, terms, 0.0, (float(limits.shift), both))
    if layout.name in limits.centre:
        twice = 2 * limits.centre[layout.name]
        if layout.element.kind == "gear_pair":
            both_wheels = {0: (1.0, 0), 1: (1.0, 0)}
            tolerance = (float(limits.shift), (0, 0))
            yield AxisEquation("distance of the axes", both_wheels, twice, tolerance)
