"""Mechanical model of a scenario: inertias, constraints, and rows of ports.

``M dw/dt = T - A m`` for speeds w, inertia matrix M, external torques T, component torques m;
A is the structural-distribution matrix of statics. The columns of mechanisms are constraints, the
columns of shift elements carry friction, and the columns of springs carry elastic torques. A port
is a torque that follows from the motion. Its speed row times the speeds of the links is the rate of
the port; the torque acts on the links along the same row.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import HOUSING, Friction, Law
from vstatics.core.model.springs import TwistCurve
from vstatics.core.model.struts import StrutCurve
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.algebra import applied, variables
from vstatics.simulation.scenario.corners import corners
from vstatics.simulation.scenario.crossings import met
from vstatics.simulation.scenario.formula import OF_TORQUES, Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.jumps import LawJump
from vstatics.simulation.scenario.laws import Curve, Points, Road
from vstatics.simulation.scenario.parts import ControlState, Scenario, formulas
from vstatics.simulation.scenario.programme import Programme
from vstatics.simulation.system.shares import LEAVING, Slide, share_name
from vstatics.simulation.tolerances import LEAST_EFFICIENCY


class Switch(NamedTuple):
    """Jump of an external torque over the speed or angle of a link."""

    link: int
    """Index of the link on which the torque acts."""
    jump: LawJump


class Contact(NamedTuple):
    """Contact with dry friction: sticks up to a static torque, slips with a kinetic torque."""

    name: str
    row: Floats
    programme: Programme
    friction: Friction | Law | None = None
    """Coefficient of friction that multiplies the programme, or the law of a drag over speed."""
    static: float = 1.0
    one_way: bool = False
    """True for a freewheel, which overruns while the slip is positive."""
    overrun_drag: float = 0.0
    """Drag torque of an overrunning freewheel. [N*m]"""
    element: int | None = None
    """Index of the shift element to which the contact belongs, if any."""
    is_drag: bool = False
    """True for a drag. It has no events, and its energy is a loss unless `beside` is given."""
    while_open: int | None = None
    """Index of a shift element; the drag acts only while its capacity is 0."""
    beside: int | None = None
    """Index, among components, of a spring to which the contact is parallel."""
    switch: Switch | None = None
    """Jump of an external torque, for a contact that represents the jump and not friction.

    The slip is the distance of the motion from the jump. While the contact sticks, the motion
    slides along the jump, with a torque between the torques of both sides (Filippov). A link with a
    given speed always slides.
    """
    is_given: bool = False
    """True if the speed of the link is given."""
    is_variator: bool = False
    """True for the constraint of a moving variator."""

    @property
    def drives(self) -> bool:
        """True if the contact sticks at a speed other than 0."""
        return self.is_variator or (self.switch is not None and not self.switch.jump.rests)

    @property
    def device(self) -> int | None:
        """Index of the component to whose torque the contact contributes."""
        if self.element is not None:
            return self.element
        return self.beside if self.while_open is None else self.while_open

    @property
    def corners(self) -> tuple[float, ...]:
        """Slips at which the coefficient of friction has corners [rad/s]; empty for a constant."""
        points = self.friction.points if self.friction else ()
        return tuple(slip for slip, _ in points) if len(points) > 1 else ()


class RigidMechanism(NamedTuple):
    """Rigid mechanism with basic ratio u and basic efficiencies."""

    name: str
    device: int
    """Index of the mechanism among components: shift elements, mechanisms, springs."""
    row: Floats
    """Constraint row: 1, -u and u - 1 for the first, second and third link."""
    slip: Floats
    """Speed row of the first link relative to the third: 1, 0, -1."""
    friction: Floats
    """Row along which the friction torque acts: 0, -u and u for the three links."""
    efficiency: float
    """Efficiency with power entering at the first link; its value at 0 if it is a law. [-]"""
    back: float
    """Efficiency with power entering at the second link; its value at 0 if it is a law. [-]"""
    planets: Floats
    """Inertia of the planets: torque on the first link per acceleration of each link. [kg*m^2]"""
    laws: tuple[float, float] | None = None
    """Both efficiencies, if at least one is a law over speed or torque."""

    @property
    def lossless(self) -> bool:
        """True if the mechanism has no losses."""
        return self.efficiency == 1.0 and self.back == 1.0 and self.laws is None

    def friction_at_rest(self, torques: Floats) -> tuple[Floats | float, Floats | float]:
        """Return the limits of friction at rest, in both directions, per torque on the first link.

        Parameters
        ----------
        torques : ndarray
            Torques on the first link. [N*m]
        """
        if self.laws is None:
            return 1 - self.efficiency, 1 / self.back - 1
        still, sizes = np.zeros(len(torques)), np.abs(torques)
        efficiency, back = (
            np.clip(law.at(*law.sizes_of(still, sizes)), LEAST_EFFICIENCY, 1.0)
            if isinstance(law, Law)
            else law
            for law in self.laws
        )
        return 1 - efficiency, 1 / back - 1


class Elastic(NamedTuple):
    """Spring, or elastic shift element or mechanism."""

    name: str
    device: int
    row: Floats
    curve: TwistCurve | StrutCurve
    viscous: float
    """Viscous damping. [N*m*s/rad]"""
    loss_factor: float
    programme: Programme
    """Torque at which the spring slips, over time. [N*m]"""
    element: int | None = None

    @property
    def stiffness(self) -> float:
        """Largest stiffness of the curve [N*m/rad]."""
        return self.curve.steepest

    @property
    def can_part(self) -> bool:
        """True if the spring has play and a damper; the damper can push but not pull."""
        return self.viscous > 0 and isinstance(self.curve, TwistCurve) and self.curve.has_gap

    def side(self, piece: int) -> float:
        """Return the sign of the torque on a linear piece of the curve; 0 within play."""
        return self.curve.side(piece) if isinstance(self.curve, TwistCurve) else 0.0

    def carried(self, twist: float, rate: float) -> float:
        """Return the torque of spring and damper without any limit [N*m].

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
        """True if the torque of the spring has a limit at any time."""
        curve = self.programme.curve
        limited = not isinstance(curve, Points) or {*curve.y} != {math.inf}
        return limited or self.element is not None

    @property
    def is_damper(self) -> bool:
        """True for a damper without stiffness."""
        return self.stiffness == 0


class MovingVariator(NamedTuple):
    """Variator whose speed ratio changes over time; see `variators`."""

    name: str
    device: int
    """Index of the variator among the components."""
    first: int
    """Index of the first link of the variator."""
    ratio: Curve
    """Speed ratio ``w_second/w_first`` over time."""
    change: Curve
    """Derivative of the ratio with respect to time. [1/s]"""
    reference: float
    """Constant ratio x0 in the row of the contact."""
    contact: int
    """Index of the contact that enforces the ratio, in `MotionSystem.contacts`."""
    efficiency: float
    back: float
    """Efficiency with power entering at the second link."""


class OutsideTorque(NamedTuple):
    """External torque on a link, other than dry friction."""

    link: int
    """Index of the link on which the torque acts."""
    law: Points | Formula | Road
    when: tuple[tuple[int, str], ...] = ()
    """Jump contacts, each with its index and the side of the jump on which the torque acts."""

    def acts(self, contacts: Sequence[str]) -> bool:
        """Return whether the torque acts; while a jump contact sticks, both sides act."""
        return all(contacts[index] in (side, "stick") for index, side in self.when)

    @property
    def needs_angle(self) -> bool:
        """True if the torque depends on the angle of the link."""
        if isinstance(self.law, Points):
            return self.law.over == "angle"
        return isinstance(self.law, Formula) and "angle" in self.law.variables


SIGNS = {"+": 1.0, "-": -1.0}
"""Values of the signs of slips, and of torques at a limit."""


def sign(value: float) -> str:
    """Return the sign of a number; the sign of 0 is `-`."""
    return "+" if value > 0 else "-"


class PortLayout:
    """Order of the ports, and of the recorded angles and values.

    Ports: external torques, contacts, springs, pumps and turbines of converters, links whose speeds
    formulas read, variators, mechanisms with varying efficiency.
    """

    def __init__(self, system: MotionSystem) -> None:
        self.outside = self.contacts = len(system.outside)
        self.springs = self.contacts + len(system.contacts)
        self.pumps = self.springs + len(system.springs)
        self.spring_ports = slice(self.springs, self.pumps)
        self.converters = len(system.converters)
        self.turbines = self.pumps + self.converters
        self.sensors = self.turbines + self.converters
        seen = {quantity for formula in formulas(system.scenario) for quantity in formula.seen}
        of_links = {quantity for quantity in seen if quantity.word == "speed"}
        self.sensed = tuple(sorted(system.names.index(quantity.of) for quantity in of_links))
        """Indices of the links whose speeds formulas read; their ports have no torque."""
        self.variators = self.sensors + len(self.sensed)
        self.losses = self.variators + len(system.variators)
        self.ports = self.losses + len(system.varying)
        self.frictions = self.outside + self.converters
        """Index of the first contact in `States.pieces`, after external torques and converters."""
        self.curves = self.frictions + len(system.contacts)
        """Index of the first spring in `States.pieces`, after the contacts."""
        angles = {load.link for load in system.outside if load.needs_angle}
        angles |= {contact.switch.link for contact in system.contacts if contact.switch}
        angles |= {system.names.index(quantity.of) for quantity in seen if quantity.word == "angle"}
        self.angles = tuple(sorted(angles | {link - 1 for link in system.scenario.targets}))
        """Indices of the links with recorded angles."""
        elements = system.case.shift_elements
        self.hot = tuple(n for n, element in enumerate(elements) if element.heat_store)
        """Indices of the shift elements whose temperatures are calculated."""
        self.values = (
            *(Seen("value", state.name) for state in system.scenario.states),
            *(Seen("temperature", elements[index].name) for index in self.hot),
        )
        self.derived = tuple(sorted(quantity for quantity in seen if quantity.word in OF_TORQUES))
        """Quantities that formulas read and that follow from torques."""
        self.seen_angles = self.ports + len(system.springs)
        """Index of the first angle among the quantities that formulas read; see `sight`."""
        self.seen_values = self.seen_angles + len(self.angles)
        count = len({slide.share for slide in system.slides} - {LEAVING})
        self.shares = tuple(Seen("value", share_name(number)) for number in range(count))
        """Shares of the jumps along which the motion slides."""
        self.seen_shares = self.seen_values + len(self.values)
        self.seen_derived = self.seen_shares + count
        self.quantities = self.seen_derived + len(self.derived)
        """Number of quantities that formulas can read."""


@dataclass(frozen=True)
class MotionSystem:
    """Mechanical model of a scenario, constant between steps of sequences."""

    scenario: Scenario
    names: tuple[str, ...]
    """Names of the links."""
    heavy: Floats
    """Matrix from speeds of links to speeds of bodies with inertia, shape (bodies, links)."""
    inertias: Floats
    """Inertias of the bodies. [kg*m^2]"""
    meshes: tuple[RigidMechanism, ...]
    contacts: tuple[Contact, ...]
    springs: tuple[Elastic, ...]
    outside: tuple[OutsideTorque, ...]
    converters: tuple[Converter, ...]
    settings: Mapping[str, float]
    """Current values of the numbers that sequences set."""
    variators: tuple[MovingVariator, ...] = ()
    slides: tuple[Slide, ...] = ()
    """Jumps of formulas along which the motion slides."""

    @property
    def case(self) -> Transmission:
        """Case of the scenario."""
        return self.scenario.case

    @property
    def may_slip(self) -> tuple[Contact | Elastic, ...]:
        """All contacts, then all springs, which can slip at a torque limit."""
        return (*self.contacts, *self.springs)

    @cached_property
    def by_element(self) -> Mapping[int, Contact | Elastic]:
        """Contact or spring of each shift element, by index."""
        return {device.element: device for device in self.may_slip if device.element is not None}

    @cached_property
    def varying(self) -> tuple[int, ...]:
        """Indices of the mechanisms whose efficiency depends on speed or torque."""
        return tuple(index for index, mesh in enumerate(self.meshes) if mesh.laws)

    @cached_property
    def turning_points(self) -> tuple[tuple[float, ...], ...]:
        """Values of each control state at which its own rate jumps, but no other formula."""
        return tuple(_turning_points(self.scenario, state) for state in self.scenario.states)

    @cached_property
    def layout(self) -> PortLayout:
        """Order of the ports."""
        return PortLayout(self)

    @cached_property
    def mass(self) -> Floats:
        """Inertia matrix of the links, shape (links, links) [kg*m^2]."""
        return (self.heavy.T * self.inertias) @ self.heavy

    @cached_property
    def stiffness(self) -> Floats:
        """Largest stiffnesses of the springs [N*m/rad]."""
        return np.array([spring.stiffness for spring in self.springs])

    @cached_property
    def straight(self) -> Floats:
        """Stiffnesses of the springs, with 0 for nonlinear springs [N*m/rad]."""
        stiffness = self.stiffness.copy()
        stiffness[list(self.nonlinear)] = 0.0
        return stiffness

    @cached_property
    def nonlinear(self) -> tuple[int, ...]:
        """Indices of the springs whose torque is not proportional to the twist."""
        return tuple(index for index, spring in enumerate(self.springs) if spring.curve.bends)

    def elastic_energy(self, twists: Floats) -> float:
        """Return the elastic energy of all springs [J]."""
        if not self.springs:
            return 0.0
        bent = ((self.springs[index].curve, float(twists[index])) for index in self.nonlinear)
        stored = sum(curve.energy(twist) for curve, twist in bent)
        return float(self.straight @ twists**2) / 2 + stored

    def rows(self, rows: Iterable[Floats]) -> Floats:
        """Return speed rows as a matrix, which can be empty, shape (rows, links)."""
        return np.array([*rows]).reshape(-1, len(self.names))

    @cached_property
    def port_rows(self) -> Floats:
        """Speed rows of all ports, in the order of `PortLayout`, shape (ports, links)."""
        links = len(self.names)
        rows = [unit(load.link, links) for load in self.outside]
        rows += [device.row for device in self.may_slip]
        rows += [unit(converter.pump - 1, links) for converter in self.converters]
        rows += [unit(converter.turbine - 1, links) for converter in self.converters]
        rows += [unit(link, links) for link in self.layout.sensed]
        rows += [unit(variator.first, links) for variator in self.variators]
        rows += [self.meshes[index].friction for index in self.varying]
        return self.rows(rows)


def _turning_points(scenario: Scenario, state: ControlState) -> tuple[float, ...]:
    points: set[float] = set()
    if sum(formula is state.rate for formula in formulas(scenario)) != 1:
        return ()  # equal texts of two states are the same formula
    for formula in formulas(scenario):
        for pair in chain.from_iterable(met(formula.whole)):
            apart = applied("-", pair.first, pair.second)
            if not pair.jumps or state.name not in variables(apart):
                continue
            if formula is not state.rate or variables(apart) != {state.name}:
                return ()
            points.update(corners(applied("sign", apart), state.name))
    return tuple(sorted(points))


def efficiency_at(number: float, speed: float, torque: float) -> float:
    """Return an efficiency, given as a number or a law of magnitudes, at a speed and torque.

    >>> efficiency_at(0.95, -3.0, 20.0)
    0.95
    """
    if not isinstance(number, Law):
        return number
    return number.at(*number.sizes_of(abs(speed), abs(torque)))


def unit(index: int, links: int) -> Floats:
    """Return the speed row of a link."""
    return combination([(index + 1, 1.0)], links)


def combination(parts: Iterable[tuple[int, float]], links: int) -> Floats:
    """Return a speed row from pairs of link number and coefficient; the housing is left out.

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
    """Return the speed row of a link relative to a second link, both given by number.

    Examples
    --------
    >>> between(2, 0, 3)
    array([0., 1., 0.])
    """
    return combination([(first, 1.0), (second, -1.0)], links)
