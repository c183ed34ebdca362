"""Limits of tooth numbers, and equations for coincident axes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from vstatics.core.elements.teeth.conditions import UNCUT, UNCUT_SHIFTED
from vstatics.synthesis.teeth.layout import TeethLayout

Range = tuple[int, int]
"""Smallest and largest tooth number of a gear."""

MOST_TEETH = 60
"""Default largest tooth number of an external gear of a planetary gear set.

If the case gives more teeth for a gear, its limit is that number.
"""
MOST_OF_PAIR = 100
"""Default largest tooth number of a gear of a gear pair."""
MOST_OF_RING = 121
"""Default largest tooth number of a ring gear."""
CLEARANCE = 0.5
"""Default smallest distance between the tips of neighbouring planets. [modules]"""
COAXIAL = "coaxial"
"""Name, in the counts of excluded candidates, of the condition that axes coincide."""
PLANETS = (3, 4, 5)
"""Default numbers of planets, if the case does not give a number."""


@dataclass(frozen=True)
class TeethLimits:
    """Requirements on tooth numbers in addition to wanted ratios.

    Parameters
    ----------
    ranges : mapping of str to (int, int)
        Smallest and largest tooth number by gear (`sun`) or by gear set and gear (`P2.ring`); `all`
        for gears that are not named.
    planets : tuple of int
        Allowed numbers of planets around an axis; by default the number of the gear set.
    clearance : float
        Smallest distance between the tips of planets that do not mesh. [modules]
    centre : mapping of str to float
        Centre distance of each gear pair, by its name. [modules]
    modules : tuple of float
        Available modules; meshing gears of a gear set have the same module. By default all modules
        are equal. [mm]
    largest_diameter : float, optional
        Largest diameter of a gear set. [mm]
    shift : int
        Largest difference of centre distances that profile shifts can compensate, as a number of
        teeth. With 0 the axes must coincide, and gears have 17 teeth or more unless a range or the
        case gives fewer.

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
        """Return the range of each gear of a gear set. The user's most specific range applies.

        A default range includes the tooth number that the case gives.
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
        in_case = layout.own_teeth.get(number, least)
        return min(least, in_case), max(most, in_case)

    def counts(self, layout: TeethLayout) -> tuple[int, ...]:
        """Return the permitted numbers of planets of a gear set, the preferred number first."""
        if not layout.planets:
            return (1,)
        given = layout.element.planets
        allowed = sorted(set(self.planets or ((given,) if given else PLANETS)), reverse=True)
        return tuple(sorted(allowed, key=lambda count: count != given))


class AxisEquation(NamedTuple):
    """Equation for coincident axes, ``|sum of module factor teeth - value| <= tolerance``."""

    label: str
    terms: Mapping[int, tuple[float, int]]
    """Factor of each gear in the sum, and the component whose module applies to the gear."""
    value: float
    tolerance: tuple[float, tuple[int, int]]
    """Tolerance in modules, and the two components whose mean module applies."""


def axis_equations(layout: TeethLayout, limits: TeethLimits) -> Iterator[AxisEquation]:
    """Yield the equations for coincident axes, and for given centre distances of pairs.

    Examples
    --------
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> from vstatics.synthesis.teeth.layout import teeth_layouts
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> (layout,) = teeth_layouts(on_own_links(case))
    >>> [equation.terms for equation in axis_equations(layout, TeethLimits())]  # s + 2 p - r
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
