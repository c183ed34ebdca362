"""A case in motion as matrices: what is heavy, what is rigid, what gives torques.

``M dw/dt = T - A M_devices``: the columns of mechanisms are constraints, those of shift elements
carry friction, those of springs elastic torques (the structural-distribution matrix of statics,
with inertias on the links). Everything that gives a torque by what it sees is a port: a row that
gives its rate, and a torque along the same row.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.model.damping import damping
from vstatics.model.parts import Friction
from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.arrays import Floats
from vstatics.simulation.formula import Formula
from vstatics.simulation.laws import Points, Resistance, Road, TorqueLaw, constant
from vstatics.simulation.programme import Programme, drags, newton_metres
from vstatics.simulation.rows import between, combination, unit
from vstatics.simulation.scenario import Converter, Scenario
from vstatics.statics.matrix import column
from vstatics.torsion.planets import planet_bodies

GRAVITY = 9.81
"""[m/s^2]"""
AIR = 1.2
"""Density. [kg/m^3]"""


class Contact(NamedTuple):
    """Dry friction along a row: it slips with its capacity, or sticks within it."""

    name: str
    row: Floats
    programme: Programme
    friction: Friction | None = None
    static: float = 1.0
    one_way: bool = False
    """A freewheel: it carries nothing while its slip is above 0."""
    overrun_drag: float = 0.0
    """Of a freewheel. [N*m]"""
    element: int | None = None
    """Index of its shift element."""
    is_drag: bool = False
    """Its heat is a loss, and it has no events."""
    while_open: int | None = None
    """Index of the element while whose capacity is 0 it acts."""


class RigidMechanism(NamedTuple):
    """A rigid mechanism."""

    name: str
    device: int
    """Index among the devices."""
    row: Floats
    """(1, -u, u - 1)."""
    slip: Floats
    """First link against the third."""
    friction: Floats
    """Column of what its losses take: second link against the third, (0, -u, u)."""
    efficiency: float
    back: float

    @property
    def lossless(self) -> bool:
        """Whether it takes nothing."""
        return self.efficiency == 1.0 and self.back == 1.0


class Elastic(NamedTuple):
    """A spring, or a shift element or mechanism that bends."""

    name: str
    device: int
    row: Floats
    stiffness: float
    """[N*m/rad]"""
    viscous: float
    """[N*m*s/rad]"""
    loss_factor: float
    limit: Programme
    """Within which its torque stays. [N*m]"""
    element: int | None = None


class OutsideTorque(NamedTuple):
    """A torque on a link that is no dry friction."""

    link: int
    """Index."""
    law: Points | Formula | Road


@dataclass(frozen=True)
class MotionSystem:
    """All of a scenario that does not change while it runs."""

    scenario: Scenario
    names: tuple[str, ...]
    """Of links."""
    heavy: Floats
    """Speeds of bodies with an inertia by those of links, shape (bodies, links)."""
    inertias: Floats
    """Of these. [kg*m^2]"""
    meshes: tuple[RigidMechanism, ...]
    contacts: tuple[Contact, ...]
    springs: tuple[Elastic, ...]
    outside: tuple[OutsideTorque, ...]
    converters: tuple[Converter, ...]

    @property
    def case(self) -> Transmission:
        """The case."""
        return self.scenario.case

    @property
    def mass(self) -> Floats:
        """Inertia matrix of the links [kg*m^2]."""
        mass: Floats = (self.heavy.T * self.inertias) @ self.heavy
        return mass

    def port_rows(self) -> Floats:
        """Rows of outside torques, contacts, springs, pumps, turbines: their rates by speeds."""
        links = len(self.names)
        rows = [unit(one.link, links) for one in self.outside]
        rows += [contact.row for contact in self.contacts]
        rows += [spring.row for spring in self.springs]
        rows += [unit(one.pump - 1, links) for one in self.converters]
        rows += [unit(one.turbine - 1, links) for one in self.converters]
        return np.array(rows).reshape(len(rows), links)


def motion_system(
    scenario: Scenario, capacities: list[Programme], gear: Gear | None
) -> MotionSystem:
    """The system of a scenario.

    Parameters
    ----------
    scenario : Scenario
    capacities : sequence of Programme
        Of the shift elements.
    gear : Gear, optional
        That of the start, for the drag of its links.

    Raises
    ------
    CaseError
    """
    case = scenario.case
    bodies = [
        (unit(link - 1, case.links), inertia) for link, inertia in case.inertias.items() if inertia
    ]
    for body, _ in planet_bodies(case):
        if body.inertia:
            by_number = [(index + 1, part) for index, part in body.form.items()]
            bodies.append((combination(by_number, case.links), body.inertia))
    if not bodies:
        message = "the case has no `inertias`, so nothing can be in motion: give those of its links"
        raise CaseError([Problem(f"{message} in kg*m^2", ("case",))])
    contacts, outside = _loads(scenario)
    return MotionSystem(
        scenario=scenario,
        names=tuple(case.link_names),
        heavy=np.array([row for row, _ in bodies]),
        inertias=np.array([inertia for _, inertia in bodies]),
        meshes=tuple(_meshes(case)),
        contacts=(*_elements(case, capacities), *contacts, *_drag_contacts(case, gear)),
        springs=tuple(_springs(case, capacities)),
        outside=tuple(outside),
        converters=scenario.converters,
    )


def _meshes(case: Transmission) -> list[RigidMechanism]:
    start = len(case.shift_elements)
    found = []
    for index, one in enumerate(case.mechanisms):
        if one.stiffness is not None:
            continue
        back = one.efficiency if one.back_efficiency is None else one.back_efficiency
        if back == 0:
            message = f"{one.name} is self-locking, which a scenario can't have yet"
            raise CaseError([Problem(message, ("case",))])
        u = one.ratio
        found.append(
            RigidMechanism(
                one.name,
                start + index,
                combination(zip(one.links, column(u), strict=True), case.links),
                between(one.first, one.third, case.links),
                combination([(one.second, -u), (one.third, u)], case.links),
                one.efficiency,
                back,
            )
        )
    return found


def _elements(case: Transmission, capacities: list[Programme]) -> list[Contact]:
    """The shift elements that do not bend."""
    found = []
    for index, (element, programme) in enumerate(zip(case.shift_elements, capacities, strict=True)):
        if element.stiffness is not None and not element.is_freewheel:
            continue
        drag = abs(newton_metres(element.drag, case) or 0.0) if element.is_freewheel else 0.0
        found.append(
            Contact(
                element.name,
                between(element.first, element.second, case.links),
                programme,
                element.friction,
                element.static,
                one_way=element.is_freewheel,
                overrun_drag=drag,
                element=index,
            )
        )
    return found


def _drag_contacts(case: Transmission, gear: Gear | None) -> list[Contact]:
    found = []
    for is_element, number, torque in drags(case, gear):
        programme = Programme(constant(torque))
        if is_element:
            element = case.shift_elements[number - 1]
            if element.is_freewheel:
                continue
            row = between(element.first, element.second, case.links)
            open_of = number - 1
            found.append(Contact(element.name, row, programme, is_drag=True, while_open=open_of))
        else:
            row = unit(number - 1, case.links)
            found.append(Contact(case.link_name(number), row, programme, is_drag=True))
    return found


def _springs(case: Transmission, capacities: list[Programme]) -> list[Elastic]:
    links, found = case.links, []
    unlimited = Programme(constant(math.inf))
    for index, element in enumerate(case.shift_elements):
        if element.stiffness is not None and not element.is_freewheel:
            row = between(element.first, element.second, links)
            damped = damping(element.damping)
            found.append(
                Elastic(
                    element.name, index, row, element.stiffness, *damped, capacities[index], index
                )
            )
    start = len(case.shift_elements)
    for index, mechanism in enumerate(case.mechanisms, start):
        if mechanism.stiffness is not None:
            row = combination(zip(mechanism.links, column(mechanism.ratio), strict=True), links)
            damped = damping(mechanism.damping)
            found.append(
                Elastic(mechanism.name, index, row, mechanism.stiffness, *damped, unlimited)
            )
    for index, spring in enumerate(case.springs, start + len(case.mechanisms)):
        row = combination(spring.form.items(), links)
        limit = unlimited if spring.limit is None else Programme(constant(spring.limit))
        damped = damping(spring.damping)
        found.append(Elastic(spring.name, index, row, spring.rate, *damped, limit))
    return found


def _loads(scenario: Scenario) -> tuple[list[Contact], list[OutsideTorque]]:
    """Outside torques: what of them is dry friction, and what is not."""
    contacts, outside = [], []
    for link, law in scenario.torques:
        friction = _dry(law)
        if friction:
            name = scenario.case.link_name(link)
            row = unit(link - 1, scenario.case.links)
            contacts.append(Contact(name, row, Programme(constant(friction))))
        if not isinstance(law, Resistance):
            outside.append(OutsideTorque(link - 1, law))
    return contacts, outside


def _dry(law: TorqueLaw) -> float:
    """The dry friction of a load [N*m]."""
    if isinstance(law, Resistance):
        return law.torque
    if isinstance(law, Road):
        return law.radius * law.mass * GRAVITY * law.rolling
    return 0.0
