"""A case in motion as matrices: what is heavy, what is rigid, what gives torques, rows of speeds.

``M dw/dt = T - A M_devices``: the columns of mechanisms are constraints, those of shift elements
carry friction, those of springs elastic torques (the structural-distribution matrix of statics,
with inertias on the links). Everything that gives a torque by what it sees is a port: a row that
gives its rate, and a torque along the same row.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import HOUSING, Friction, Law
from vstatics.core.model.springs import TwistCurve
from vstatics.core.model.struts import StrutCurve
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import OF_TORQUES, Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.jumps import LawJump
from vstatics.simulation.scenario.laws import Curve, Points, Road
from vstatics.simulation.scenario.parts import Scenario, formulas
from vstatics.simulation.scenario.programme import Programme, slip_points


class Switch(NamedTuple):
    """A jump of an outside torque over the speed or the angle of its link."""

    link: int
    """Index."""
    jump: LawJump


class Contact(NamedTuple):
    """Dry friction along a row: it slips with its capacity, or sticks within it."""

    name: str
    row: Floats
    programme: Programme
    friction: Friction | Law | None = None
    """By which its programme is multiplied; of what drags by its speed its law."""
    static: float = 1.0
    one_way: bool = False
    """A freewheel: it carries nothing while its slip is above 0."""
    overrun_drag: float = 0.0
    """Of a freewheel. [N*m]"""
    element: int | None = None
    """Index of its shift element."""
    is_drag: bool = False
    """It has no events, and its heat is a loss unless it acts beside a spring."""
    while_open: int | None = None
    """Index of the element while whose capacity is 0 it acts."""
    beside: int | None = None
    """Index of the device, a spring, beside which it acts."""
    switch: Switch | None = None
    """Where a torque jumps: its side is that of the jump, and it sticks where the motion slides
    along the jump, with a torque between both (Filippov); none of it is friction. Where a speed is
    given it is as if it always slid."""
    is_given: bool = False
    """Whether its speed is given."""
    is_variator: bool = False
    """Whether it is the row of a variator that moves."""

    @property
    def drives(self) -> bool:
        """Whether it sticks at another speed than 0."""
        return self.is_variator or (self.switch is not None and not self.switch.jump.rests)

    @property
    def device(self) -> int | None:
        """Index of the device of whose torque it is a part."""
        of = (self.element, self.while_open, self.beside)
        return next((one for one in of if one is not None), None)

    @property
    def corners(self) -> tuple[float, ...]:
        """Slips at which its coefficient of friction bends [rad/s]; none where it is a number."""
        points = slip_points(self.friction)
        return tuple(slip for slip, _ in points) if len(points) > 1 else ()


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
    planets: Floats
    """What planets take of the torque on its first link, by accelerations of links. [kg*m^2]"""

    @property
    def lossless(self) -> bool:
        """Whether it takes nothing."""
        return self.efficiency == 1.0 and self.back == 1.0


class Elastic(NamedTuple):
    """A spring, or a shift element or mechanism that bends."""

    name: str
    device: int
    row: Floats
    curve: TwistCurve | StrutCurve
    viscous: float
    """[N*m*s/rad]"""
    loss_factor: float
    programme: Programme
    """Of the limit within which its torque stays. [N*m]"""
    element: int | None = None

    @property
    def stiffness(self) -> float:
        """Where it is steepest [N*m/rad]."""
        return self.curve.steepest

    @property
    def can_part(self) -> bool:
        """Whether it has a play, and so a damper that acts in contact alone and never pulls."""
        return self.viscous > 0 and isinstance(self.curve, TwistCurve) and self.curve.has_gap

    def side(self, piece: int) -> float:
        """The sign of the torque on a piece of a spring that can part; 0 in its play."""
        return self.curve.side(piece) if isinstance(self.curve, TwistCurve) else 0.0

    def carried(self, twist: float, rate: float) -> float:
        """Its torque within its limit, with its damper [N*m].

        Examples
        --------
        >>> curve = TwistCurve((-1.0, 0.0, 1.0), (0.0, 0.0, 100.0))
        >>> spring = Elastic("S", 0, np.ones(1), curve, 5.0, 0.0, Programme(Points((0.0,), (1e9,))))
        >>> [spring.carried(*at) for at in ((-0.5, 9.0), (0.1, 1.0), (0.1, -1.0), (0.1, -9.0))]
        [0.0, 15.0, 5.0, 0.0]
        """
        elastic = self.curve.at(twist)
        torque = elastic + self.viscous * rate
        if not self.can_part:
            return torque
        return torque if torque * elastic > 0 else 0.0

    @property
    def may_slip(self) -> bool:
        """Whether there is a torque that it does not carry, or may be one."""
        curve = self.programme.curve
        limited = not isinstance(curve, Points) or {*curve.y} != {math.inf}
        return limited or self.element is not None

    @property
    def is_damper(self) -> bool:
        """Whether it has no stiffness: a damper alone."""
        return self.stiffness == 0


class MovingVariator(NamedTuple):
    """A variator whose speed ratio moves; see `variators`."""

    name: str
    device: int
    """Index among the devices."""
    first: int
    """Index of its first link."""
    ratio: Curve
    """``w_second/w_first`` over time."""
    change: Curve
    """Of the ratio with time. [1/s]"""
    reference: float
    """The ratio of its row."""
    contact: int
    """Index of its contact."""
    efficiency: float


class OutsideTorque(NamedTuple):
    """A torque on a link that is no dry friction."""

    link: int
    """Index."""
    law: Points | Formula | Road
    when: tuple[tuple[int, str], ...] = ()
    """Indices of the contacts at its jumps, and on which side of each it acts."""

    def acts(self, contacts: Sequence[str]) -> bool:
        """Whether it does by the states of the contacts; with one that sticks both sides do."""
        return all(contacts[index] in (side, "stick") for index, side in self.when)

    @property
    def needs_angle(self) -> bool:
        """Whether it changes with the angle of its link."""
        if isinstance(self.law, Points):
            return self.law.over == "angle"
        return isinstance(self.law, Formula) and "angle" in self.law.variables


SIGNS = {"+": 1.0, "-": -1.0}
"""Of what slips, or of a torque at its limit."""


def sign(value: float) -> str:
    """The sign of a number; that of 0 is -."""
    return "+" if value > 0 else "-"


class PortLayout:
    """Which port is where, and what is integrated beside speeds."""

    def __init__(self, system: MotionSystem) -> None:
        self.outside = self.contacts = len(system.outside)
        self.springs = self.contacts + len(system.contacts)
        self.pumps = self.springs + len(system.springs)
        self.spring_ports = slice(self.springs, self.pumps)
        self.converters = len(system.converters)
        self.turbines = self.pumps + self.converters
        self.sensors = self.turbines + self.converters
        seen = {one for formula in formulas(system.scenario) for one in formula.seen}
        of_links = {one for one in seen if one.word == "speed"}
        self.sensed = tuple(sorted(system.names.index(one.of) for one in of_links))
        """Indices of the links whose speeds formulas see: ports without a torque."""
        self.variators = self.sensors + len(self.sensed)
        self.ports = self.variators + len(system.variators)
        self.frictions = self.outside + self.converters
        """Of the pieces on which curves are, the first of a contact; before them converters."""
        self.curves = self.frictions + len(system.contacts)
        """Of these the first of a spring."""
        angles = {one.link for one in system.outside if one.needs_angle}
        angles |= {one.switch.link for one in system.contacts if one.switch}
        angles |= {system.names.index(one.of) for one in seen if one.word == "angle"}
        self.angles = tuple(sorted(angles | {link - 1 for link in system.scenario.targets}))
        """Indices of the links whose angles are followed."""
        self.hot = tuple(
            index for index, one in enumerate(system.case.shift_elements) if one.heat_store
        )
        """Indices of the shift elements whose temperatures are known."""
        elements = system.case.shift_elements
        self.values = (
            *(Seen("value", state.name) for state in system.scenario.states),
            *(Seen("temperature", elements[index].name) for index in self.hot),
        )
        self.derived = tuple(sorted(one for one in seen if one.word in OF_TORQUES))
        """What formulas see that follows from torques."""


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
    settings: Mapping[str, float]
    """Numbers of sequences, as they are."""
    variators: tuple[MovingVariator, ...] = ()

    @property
    def case(self) -> Transmission:
        """The case."""
        return self.scenario.case

    @property
    def may_slip(self) -> tuple[Contact | Elastic, ...]:
        """What has a programme of its capacity."""
        return (*self.contacts, *self.springs)

    @cached_property
    def by_element(self) -> Mapping[int, Contact | Elastic]:
        """What stands for each shift element, by its index."""
        return {one.element: one for one in self.may_slip if one.element is not None}

    @cached_property
    def layout(self) -> PortLayout:
        """Which of its ports is where."""
        return PortLayout(self)

    @cached_property
    def mass(self) -> Floats:
        """Inertia matrix of the links [kg*m^2]."""
        mass: Floats = (self.heavy.T * self.inertias) @ self.heavy
        return mass

    @cached_property
    def straight(self) -> Floats:
        """Stiffnesses of the springs without points, 0 of others [N*m/rad]."""
        return np.array([0.0 if one.curve.bends else one.stiffness for one in self.springs])

    def elastic_energy(self, twists: Floats) -> float:
        """Of all springs [J]."""
        bent = zip(self.springs, twists.tolist(), strict=True)
        stored = sum(one.curve.energy(twist) for one, twist in bent if one.curve.bends)
        return float(self.straight @ twists**2) / 2 + stored

    def rows(self, rows: Iterable[Floats]) -> Floats:
        """Rows as a matrix, of shape (rows, links)."""
        return np.array([*rows]).reshape(-1, len(self.names))

    @cached_property
    def port_rows(self) -> Floats:
        """Rows of outside torques, contacts, springs, pumps, turbines, links that are seen."""
        links = len(self.names)
        rows = [unit(one.link, links) for one in self.outside]
        rows += [contact.row for contact in self.contacts]
        rows += [spring.row for spring in self.springs]
        rows += [unit(one.pump - 1, links) for one in self.converters]
        rows += [unit(one.turbine - 1, links) for one in self.converters]
        rows += [unit(link, links) for link in self.layout.sensed]
        rows += [unit(one.first, links) for one in self.variators]
        return self.rows(rows)


def unit(index: int, links: int) -> Floats:
    """The speed of a link, by its index."""
    return combination([(index + 1, 1.0)], links)


def combination(parts: Iterable[tuple[int, float]], links: int) -> Floats:
    """Links by their numbers, each with its coefficient; the housing stands still.

    Examples
    --------
    >>> combination([(1, 1.0), (0, 2.0), (3, -3.0)], 3)
    array([ 1.,  0., -3.])
    """
    row = np.zeros(links)
    for link, part in parts:
        if link != HOUSING:
            row[link - 1] += part
    return row


def between(first: int, second: int, links: int) -> Floats:
    """First link against second, by their numbers.

    Examples
    --------
    >>> between(2, 0, 3)
    array([0., 1., 0.])
    """
    return combination([(first, 1.0), (second, -1.0)], links)
