"""Ratios and efficiencies of the mechanisms of a case as formulas of the numbers it gives.

They go the way of `lower`, with teeth that keep their paths in place of whole numbers. So who
has the formulas follows numbers that change, and needs to know no elements.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, permutations
from typing import Any, Literal, NamedTuple

from vstatics.elements.drawing import drawing_of
from vstatics.elements.element import CentralWheel, DrawingFields, Element
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.group_checks import wheel_path
from vstatics.elements.kinds import Simple
from vstatics.elements.lower import at_meshes, reduced_pairs
from vstatics.elements.mesh_losses import LEAST_RING, mesh_losses
from vstatics.elements.quotients import Formula, Quotient, product
from vstatics.errors import Path
from vstatics.model.parts import Mechanism
from vstatics.model.transmission import Transmission


class MechanismFormulas(NamedTuple):
    """What of a mechanism follows from numbers of the case."""

    ratio: Formula
    efficiency: Formula
    back_efficiency: Formula | None = None
    planet_ratio: Formula | None = None


Condition = tuple[Literal["above", "not", "is"], Formula]
"""A formula is above 0, is not 0, or is 0; else there is no such case."""


class Formulas:
    """The formulas of a case, and the numbers that they are made of.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear
    >>> from vstatics.elements.drawing import Drawing, transmission
    >>> links, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> drawing = Drawing(3, [Element("P", "planetary", links, teeth, efficiency=0.97)])
    >>> made = Formulas(transmission(drawing, gears=[Gear()]))
    >>> made.mechanisms[0][:2]
    (['/', ['*', -1, 'P.teeth.ring'], 'P.teeth.sun'], 'P.efficiency')
    >>> made.numbers
    {'P.teeth.sun': 30, 'P.teeth.ring': 75, 'P.efficiency': 0.97}
    >>> made.conditions
    [('above', ['-', 'P.teeth.ring', 'P.teeth.sun'])]
    """

    def __init__(self, case: Transmission) -> None:
        self.numbers: dict[str, float] = {}
        """By their paths."""
        self.conditions: list[Condition] = []
        self.groups: list[PlanetGroup | None] = []
        """Of each device the group of planets that it is, with teeth that are quotients."""
        self.mechanisms: list[MechanismFormulas] = []
        drawing = drawing_of(case)
        for element in drawing.elements if drawing else ():
            self.mechanisms += self._of_element(element, drawing)  # type: ignore[arg-type] # there is one
        given = drawing.mechanisms if drawing else case.mechanisms
        self.groups += [None] * len(given)
        self.mechanisms += map(self._given, given)

    def number(self, path: str, value: float) -> str:
        """Keep a number that the case gives; its formula is its path."""
        self.numbers.setdefault(path, value)
        return path

    def _given(self, one: Mechanism) -> MechanismFormulas:
        """Of a mechanism that is given as such."""
        ratio: Formula = one.ratio
        if not math.isnan(one.ratio):  # that of a variator in each gear
            ratio = self.number(f"{one.name}.{'speed_ratio' if one.kind else 'ratio'}", one.ratio)
        back = one.back_efficiency
        return MechanismFormulas(
            ratio,
            self.number(f"{one.name}.efficiency", one.efficiency),
            None if back is None else self.number(f"{one.name}.back_efficiency", back),
            one.planet_ratio,
        )

    def _of_element(self, element: Element, drawing: DrawingFields) -> Iterator[MechanismFormulas]:
        meshes = _Meshes(self, element, drawing)
        if isinstance(element.shape, Simple):
            self.groups.append(None)
            yield self._simple(element, element.shape, meshes)
            return
        group = self._group(element)
        self.groups.append(group)
        self._with_friction(meshes, [one.teeth for one in group.wheels if one.internal])
        if at_meshes(element, group_of(element), drawing):
            yield from _at_meshes(group, meshes)
        else:
            yield from _reduced(group, meshes)

    def _simple(self, element: Element, kind: Simple, meshes: _Meshes) -> MechanismFormulas:
        """Of a gear pair, a chain, a shaft, a support."""
        teeth = {
            name: Quotient.of(self.number(f"{element.name}.{kind.size}.{name}", count), count)
            for name, count in element.teeth.items()
        }
        ratio: Formula = kind.sign
        if kind.toothed and kind.toothed[0] in teeth:
            first, last = teeth[kind.toothed[0]], teeth[kind.toothed[-1]]
            ratio = (kind.sign * last / first).formula
            if element.kind == "internal_pair":
                self.conditions.append(("not", ["-", last.formula, first.formula]))
                self._with_friction(meshes, [last])
        pairs = [*pairwise(teeth.get(name) for name in kind.toothed)]
        every = [*pairs, *[(None, None)] * (len(kind.meshes) - len(pairs))]
        between = [teeth[name] for name in kind.toothed[1:-1] if name in teeth]
        back = element.back_efficiency
        return MechanismFormulas(
            ratio,
            meshes.whole([meshes.of(*one) for one in zip(kind.meshes, every, strict=False)]),
            None if back is None else self.number(f"{element.name}.back_efficiency", back),
            (-between[0] / teeth[kind.toothed[0]]).formula if between else None,
        )

    def _with_friction(self, meshes: _Meshes, rings: Sequence[Any]) -> None:
        """Where friction gives the efficiency of rings they have teeth enough."""
        if meshes.has_friction("internal"):
            least = LEAST_RING - 1
            self.conditions += [("above", ["-", ring.formula, least]) for ring in rings]

    def _group(self, element: Element) -> PlanetGroup:
        """The group of planets that an element is, with teeth that keep their paths."""
        own = group_of(element)
        wheels: list[Any] = []
        for wheel in own.wheels:
            way: Path = ("teeth", wheel.member)
            if element.rims:
                way = (*wheel_path(element, wheel), "teeth")
            path = ".".join(map(str, (element.name, *way)))
            formula = wheel.teeth if element.ratios else self.number(path, wheel.teeth)
            teeth = Quotient.of(formula, wheel.teeth)
            wheels.append(wheel._replace(teeth=teeth))  # type: ignore[arg-type] # counts like them
        planets: dict[str, Any] = {
            planet: {rim: self._rim(element, planet, rim, wheels) for rim in rims}
            for planet, rims in own.planets.items()
        }
        for ring, sun in permutations(wheels, 2):
            if ring.internal and not sun.internal and ring.rim == sun.rim:
                self.conditions.append(("above", ["-", ring.teeth.formula, sun.teeth.formula]))
        made = replace(own, wheels=wheels, planets=planets)
        for train in made.trains:
            for one, other in pairwise(sorted(made.wheels_of(train), key=lambda one: one.link)):
                if one.link == other.link:
                    speeds: list[Any] = [made.relative(each, train) for each in (one, other)]
                    self.conditions.append(("is", ["-", *(each.formula for each in speeds)]))
        return made

    def _rim(self, element: Element, planet: str, rim: str, wheels: Sequence[Any]) -> Any:
        """The teeth of a rim: given, as a sun and a ring leave room, or not known."""
        for way, given in (
            ("rims." + planet, element.rims.get(planet, {})),
            ("teeth", element.teeth),
        ):
            if rim in given:
                path = self.number(f"{element.name}.{way}.{rim}", given[rim])
                return Quotient.of(path, int(given[rim]))
        around = {one.internal: one.teeth for one in wheels if one.rim == rim}
        if len(around) < 2 or element.rims:
            return None
        gap = ["-", around[True].formula, around[False].formula]
        return Quotient.of(gap, around[True].value - around[False].value) / 2


class _Meshes:
    """Efficiencies of the meshes of an element as formulas."""

    def __init__(self, formulas: Formulas, element: Element, drawing: DrawingFields) -> None:
        self.formulas, self.element = formulas, element
        self.losses = mesh_losses(drawing.mesh_efficiency, element.mesh_efficiency)

    def has_friction(self, mesh: str) -> bool:
        """Whether friction tells the efficiency of such meshes, where teeth are known."""
        of_meshes = mesh != "bevel" and mesh not in self.losses.given
        return self.losses.friction is not None and of_meshes and self.element.efficiency is None

    def whole(self, by_mesh: Sequence[Formula]) -> Formula:
        """Of the whole element: given, or that of its meshes."""
        if self.element.efficiency is None:
            return product(by_mesh)
        return self.formulas.number(f"{self.element.name}.efficiency", self.element.efficiency)

    def of(self, mesh: str, teeth: Sequence[Any]) -> Formula:
        """Of one mesh, by its two wheels."""
        if self.element.efficiency is not None:
            return 1
        if self.has_friction(mesh) and all(teeth):
            sizes = [one.formula for one in teeth]
            friction = self._number("friction", self.losses.friction or 0.0)
            return ["mesh", friction, *sizes, int(mesh == "internal")]
        return self._number(mesh, getattr(self.losses.numbers, mesh))

    def _number(self, name: str, value: float) -> str:
        own = f"{self.element.name}." * (name in self.element.mesh_efficiency)
        return self.formulas.number(f"{own}mesh_efficiency.{name}", value)

    def of_wheel(self, wheel: CentralWheel, group: PlanetGroup) -> Formula:
        """Of the mesh of a central wheel."""
        rim = group.planets[group.planet_of[wheel.rim]][wheel.rim]
        if not group.is_known(group.planet_of[wheel.rim]):
            rim = _gap(group, wheel.rim)
        return self.of("internal" if wheel.internal else "external", (rim, wheel.teeth))

    def of_planets(self, group: PlanetGroup, pair: Sequence[str]) -> Formula:
        """Of the mesh of two rims of planets."""
        known = [group.is_known(group.planet_of[rim]) for rim in pair]
        teeth = [
            group.teeth(rim) if is_known else _gap(group, rim)
            for rim, is_known in zip(pair, known, strict=True)
        ]
        return self.of("external", teeth)


def _gap(group: PlanetGroup, rim: str) -> Any:
    """Teeth that fill the gap between a sun and a ring around a rim; None without these."""
    around: dict[bool, Any] = {}
    for one in group.wheels:
        if one.rim == rim:
            around.setdefault(one.internal, one.teeth)
    if len(around) < 2:
        return None
    value = Fraction(around[True].value - around[False].value)
    return Quotient.of(["-", around[True].formula, around[False].formula], value) / 2


def _reduced(group: PlanetGroup, meshes: _Meshes) -> Iterator[MechanismFormulas]:
    """As `lower` has them: from each wheel of a train of planets to one of them."""
    for wheel, reference in reduced_pairs(group):
        ratio: Any = group.ratio(wheel, reference)
        between = group.path(group.planet_of[wheel.rim], group.planet_of[reference.rim])
        passed = [
            meshes.of_wheel(wheel, group),
            *(meshes.of_planets(group, pair) for pair in between),
            meshes.of_wheel(reference, group),
        ]
        yield MechanismFormulas(ratio.formula, meshes.whole(passed))


def _at_meshes(group: PlanetGroup, meshes: _Meshes) -> Iterator[MechanismFormulas]:
    """One for each mesh."""
    for wheel in group.wheels:
        to_planet: Any = group.mesh_ratio(wheel)
        yield MechanismFormulas(to_planet.formula, meshes.of_wheel(wheel, group))
    for pair in group.meshes:
        one, other = (group.teeth(rim) for rim in pair)
        ratio: Any = -other / one
        yield MechanismFormulas(ratio.formula, meshes.of_planets(group, pair))
