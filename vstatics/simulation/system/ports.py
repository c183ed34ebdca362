"""Torques of ports and converters at an instant, from time, rates, twists and angles.

Torques linear in time t and rate r of the port are arrays, ``c0 + c1 t + s r``. Springs add ``k e``
for the twist e, with k and c0 of the active linear piece. All other torques are functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import Law
from vstatics.core.model.struts import StrutCurve
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points, Road
from vstatics.simulation.scenario.programme import Look, Programme, friction_at, friction_points
from vstatics.simulation.system.curves import (
    Torque,
    TorqueAlong,
    curve_along,
    one_by_one,
    programme_at,
    slope_of,
)
from vstatics.simulation.system.matrices import SIGNS, Contact, MotionSystem
from vstatics.simulation.system.shares import shared
from vstatics.simulation.system.sight import following, looking
from vstatics.simulation.tolerances import LARGEST_NUMBER, STANDING

_FINE = 0.1
"""Relative change of a slip up to which a torque that depends on the slip is nearly linear."""
_FAR = 1e6
"""Smallest slip that counts as far from 0, as a multiple of the rounding error of slips."""
SIGNS_OF_MESHES = ("++", "+-", "-+", "--")
"""States of moving mechanisms with losses; see `MeshStates`."""


class States(NamedTuple):
    """States of all contacts, mechanisms, springs and laws between two events."""

    contacts: tuple[str, ...]
    """States of contacts: `open`, `stick`, `rigid` (without limit), or the sign of the slip."""
    meshes: tuple[str, ...]
    """States of mechanisms; see `MeshStates`."""
    springs: tuple[str, ...]
    """States of springs.

    `stick`: below the torque limit; `parted`: a spring with play whose damper would pull, so that
    there is no torque; `open`: the torque limit is 0; or the sign of the torque limit at which the
    spring slips.
    """
    pieces: tuple[int, ...]
    """Index of the active linear piece of each law.

    In this order: each external torque over speed or angle (0 for other laws); each converter over
    speed ratio; the friction of each contact over slip; the curve of each spring over twist.
    """

    @property
    def held(self) -> tuple[bool, ...]:
        """Flag of each contact: True if sticking."""
        return tuple(state in ("stick", "rigid") for state in self.contacts)


class Ports:
    """Torques of all ports between two events, while inputs over time are smooth.

    Parameters
    ----------
    system : MotionSystem
    states : States
    time : float
        Time of the first event. [s]
    rounding : float
        Largest slip that counts as 0, because it can be rounding error. [rad/s]
    """

    def __init__(
        self, system: MotionSystem, states: States, time: float, rounding: float = STANDING
    ) -> None:
        layout = self.layout = system.layout
        self.system, self.rounding = system, rounding
        self.c0 = np.zeros(layout.ports)
        self.c1 = np.zeros(layout.ports)
        self.by_rate = np.zeros(layout.ports)
        """Derivative of the torque with respect to the rate of the port. [N*m*s/rad]"""
        self.by_angle: list[tuple[int, int, float]] = []
        """Torques linear in an angle: port, index of the angle, slope. [N*m/rad]"""
        self.special: list[tuple[int, int, Torque, TorqueAlong]] = []
        """Torques by other laws: port, index of the angle or -1, function, function for arrays."""
        self.roads: list[tuple[int, Callable[[Any], Any]]] = []
        """Torques of roads: port, and torque as a function of the rate or of an array of rates."""
        self.timed: list[tuple[int, Formula, float]] = []
        """Torques given over time: port, formula of time, and factor."""
        self.looks: list[tuple[int, Look]] = []
        """Feedback torques: port, and torque as a function of all quantities that formulas read."""
        self.ending: list[int] = []
        """Ports of slipping contacts with feedback torques, whose slip can end at 0."""
        self.limits: list[tuple[int, float, Programme]] = []
        """Springs that slip at a feedback limit: index, sign of the torque, programme."""
        self.after, self.until = math.nextafter(time, math.inf), math.inf
        """Open interval in which formulas are evaluated, without the jumps at its ends. [s]"""
        self.converters = tuple(
            (converter, states.pieces[layout.outside + index])
            for index, converter in enumerate(system.converters)
        )
        self.senses_rate = np.zeros(layout.ports, dtype=bool)
        """Flags of ports whose torque depends on the rate."""
        self._springs(system, states)
        self._laws(system, states, time)
        self.senses_rate[layout.pumps : layout.sensors] = True
        self.bending = sorted(
            {port for port, *_ in self.special}
            | {port for port, _ in self.roads}
            | {port for port, _ in self.looks}
            | {layout.springs + index for index, _ in self.struts}
            | set(range(layout.pumps, layout.sensors))
            | set(range(layout.losses, layout.ports))
        )
        """Ports with torques that are nonlinear in rates, twists or angles."""
        self.moves = bool(system.springs or self.by_angle or self.roads)
        """True if torques of springs, roads or laws over an angle act; see `_add_motion`."""
        self.is_rising = bool(self.c1.any())
        """True if a torque changes linearly with time."""
        self.is_affine = not self.bending
        """True if all torques are linear in rates, twists and angles."""

    def _springs(self, system: MotionSystem, states: States) -> None:
        layout = self.layout
        self.stiffness = system.stiffness
        bends = [state in ("stick", "parted") for state in states.springs]
        parted = np.array([state == "parted" for state in states.springs], dtype=bool)
        self.bends, self.is_below_limits = np.array(bends, dtype=bool), all(bends)
        pieces = zip(system.springs, states.pieces[layout.curves :], strict=True)
        lines = np.array([spring.curve.piece(piece) for spring, piece in pieces]).reshape(-1, 2).T
        self.c0[layout.spring_ports], self.elastic = np.where(self.bends & ~parted, lines, 0.0)
        self.taken = np.where(parted, lines, 0.0)
        """Elastic torque of each parted spring, which its damper cancels: value at twist 0, slope.

        A spring parts when its damper would pull. [N*m, N*m/rad]
        """
        self.all_elastic = np.zeros(layout.ports)
        """Derivative of each torque with respect to twist or angle; 0 for formulas. [N*m/rad]"""
        self.all_elastic[layout.spring_ports] = self.elastic
        self.struts = [
            (index, spring.curve)
            for index, spring in enumerate(system.springs)
            if isinstance(spring.curve, StrutCurve)
        ]
        """Springs with torques nonlinear in the twist, each with its index."""
        for index, curve in self.struts:
            self.all_elastic[layout.springs + index] = curve.steepest

    def _laws(self, system: MotionSystem, states: States, time: float) -> None:
        """Set up the torques of external loads, contacts and springs with dampers or limits."""
        layout = self.layout
        for index, load in enumerate(system.outside):
            if not load.acts(states.contacts):
                continue
            place = layout.angles.index(load.link) if load.link in layout.angles else -1
            law = load.law
            if isinstance(law, Formula):
                law = shared(law, system.slides, index, place).knowing(system.settings)
            if isinstance(law, Formula) and law.seen:
                self.looks.append((index, looking(system, law, index, place)))
            else:
                self._outside(index, law, states.pieces[index], place, time)
        for index, contact in enumerate(system.contacts):
            piece = states.pieces[layout.frictions + index]
            self._contact(layout.contacts + index, contact, states.contacts[index], piece, time)
        for index, spring in enumerate(system.springs):
            port, state = layout.springs + index, states.springs[index]
            if state == "stick":
                piece = states.pieces[layout.curves + index]
                if not spring.can_part or spring.side(piece):
                    self.by_rate[port] = spring.viscous
                    self.senses_rate[port] = spring.viscous != 0
            elif state not in ("open", "parted"):
                self._limited(index, SIGNS[state], states, time)

    @property
    def level(self) -> list[tuple[int, int]]:
        """Ports of pump and turbine of converters whose torques do not depend on the turbine."""
        pumps, turbines = self.layout.pumps, self.layout.turbines
        return [
            (pumps + index, turbines + index)
            for index, (converter, piece) in enumerate(self.converters)
            if piece in {0, len(converter.points)}
        ]

    def finest(self, rates: Floats) -> float:
        """Return a tenth of the smallest slip that can end, for finite differences [rad/s].

        Torques are nearly linear within this change; see `_FINE`.
        """
        nearest = min((abs(float(rates[port])) for port in self.ending), default=math.inf)
        return _FINE * math.hypot(nearest, self.rounding)

    def torques(
        self, time: float, rates: Floats, twists: Floats, angles: Floats, values: Floats
    ) -> Floats:
        """Return the torques of all ports [N*m]."""
        time = min(max(time, self.after), self.until)
        torques = self.c0 + self.by_rate * rates  # unknown rates (NaN) make torques unknown
        if self.is_rising:
            torques += self.c1 * time
        layout = self.layout
        if self.moves:
            self._add_motion(torques, rates, twists, angles)
        for port, formula, factor in self.timed:
            torques[port] += factor * formula.function(time, 0.0, 0.0)
        for port, place, function, _ in self.special:
            angle = float(angles[place]) if place >= 0 else 0.0
            torques[port] = function(time, float(rates[port]), angle)
        if self.looks:
            seen = [*rates.tolist(), *twists.tolist(), *angles.tolist(), *values.tolist()]
            for port, look in self.looks:
                torques[port] = look.at(time, seen)
        for index, (converter, piece) in enumerate(self.converters):
            pump, turbine = layout.pumps + index, layout.turbines + index
            torques[pump], torques[turbine] = converter_torques(
                converter, piece, float(rates[pump]), float(rates[turbine])
            )
        return torques

    def torques_at(
        self, times: Floats, rates: Floats, twists: Floats, angles: Floats, values: Floats
    ) -> Floats:
        """Return the torques of all ports at several times; time is the last axis of all arrays."""
        times = self.inside(times)
        torques = self.by_rate[:, None] * rates
        torques += self.c0[:, None]
        if self.is_rising:
            torques += self.c1[:, None] * times
        layout = self.layout
        if self.moves:
            self._add_motion(torques, rates, twists, angles)
        for port, formula, factor in self.timed:
            torques[port] += factor * curve_along(formula, times)
        for port, place, _, along in self.special:
            turned = angles[place] if place >= 0 else np.zeros(len(times))
            torques[port] = along(times, rates[port], turned)
        if self.looks:
            seen_along = np.vstack([rates, twists, angles, values])
            for port, look in self.looks:
                torques[port] = look.along(times, seen_along)
        for index, (converter, piece) in enumerate(self.converters):
            pump, turbine = layout.pumps + index, layout.turbines + index
            pair = converter_torques_at(converter, piece, rates[pump], rates[turbine])
            torques[pump], torques[turbine] = pair
        return torques

    def _add_motion(self, torques: Floats, rates: Floats, twists: Floats, angles: Floats) -> None:
        """Add the torques of springs, roads and laws over an angle; arrays can have a time axis."""
        if len(twists):
            stiff = self.elastic if twists.ndim == 1 else self.elastic[:, None]
            torques[self.layout.spring_ports] += stiff * twists
        for index, curve in self.struts:
            torques[self.layout.springs + index] += curve.at(twists[index])
        for port, place, slope in self.by_angle:
            torques[port] += slope * angles[place]
        for port, on_road in self.roads:
            torques[port] = on_road(rates[port])

    def inside(self, times: Floats) -> Floats:
        """Return times clipped to the interval in which formulas are evaluated."""
        if len(times) and (times[0] < self.after or times[-1] > self.until):
            return np.minimum(np.maximum(times, self.after), self.until)
        return times

    def given_at(self, times: Floats, within: float | None) -> tuple[Floats, Floats]:
        """Return torque terms that depend on time alone, and their time derivatives, (ports, n).

        Derivatives of formulas are difference quotients over `within` [s], or 0 without it.
        """
        times = self.inside(times)
        given = self.c0[:, None] + self.c1[:, None] * times
        slopes = np.repeat(self.c1[:, None], len(times), axis=1)
        for port, formula, factor in self.timed:
            given[port] = factor * curve_along(formula, times)
            if within is not None:
                changes = [
                    slope_of(formula.function, time, self._step(time, within))
                    for time in times.tolist()
                ]
                slopes[port] = factor * np.array(changes)
        return given, slopes

    def slopes(
        self, time: float, rates: Floats, twists: Floats, angles: Floats, within: float
    ) -> Floats:
        """Return the derivatives of torques with respect to time, at constant rates [N*m/s]."""
        slopes = self.c1.copy()
        springs = self.layout.spring_ports
        slopes[springs] += self.elastic * rates[springs]
        for port, _, slope in self.by_angle:
            slopes[port] += slope * rates[port]
        for index, curve in self.struts:
            port = self.layout.springs + index
            slopes[port] += curve.strut.slope(twists[index]) * rates[port]
        time = min(max(time, self.after), self.until)
        step = self._step(time, within)
        for port, formula, factor in self.timed:
            slopes[port] = factor * slope_of(formula.function, time, step)
        for port, place, function, _ in self.special:
            angle, rate = float(angles[place]) if place >= 0 else 0.0, float(rates[port])
            slopes[port] = slope_of(function, time, step, rate, angle)
        return slopes

    def _step(self, time: float, within: float) -> float:
        """Return a step for difference quotients that does not cross a jump ahead [s]."""
        is_near = time + within > self.until and time - within >= self.after
        return -within if is_near else within

    def _outside(
        self, port: int, law: Points | Formula | Road, piece: int, place: int, time: float
    ) -> None:
        if isinstance(law, Road):
            if law.drag_area or law.by_torque:
                self.roads.append((port, law.torque))
                self.senses_rate[port] = True
            else:
                self.c0[port] = -law.climbing_torque
        elif isinstance(law, Formula) and not law.variables & {"speed", "angle"}:
            self.timed.append((port, law, 1.0))
        elif isinstance(law, Formula):
            self.special.append((port, place, law.function, law.along))
            self.senses_rate[port] = "speed" in law.variables
        elif law.over == "time":
            self.c0[port], self.c1[port] = law.piece(law.piece_at(time))
        else:
            value, slope = law.piece(piece)
            self.c0[port] = value
            if law.over == "speed":
                self.by_rate[port] = slope
                self.senses_rate[port] = slope != 0
            else:
                self.by_angle.append((port, place, slope))
                self.all_elastic[port] = slope

    def _contact(self, port: int, contact: Contact, state: str, piece: int, time: float) -> None:
        if contact.switch:
            # the entry is not a torque but the derivative of the speed at which the contact sticks
            if state in ("stick", "rigid"):
                jump = contact.switch.jump
                self._programme(port, Programme(jump.change), 1.0, time)
                self.by_rate[port] = jump.by_angle
            return
        if state not in SIGNS:
            return
        if contact.one_way and state == "+":
            self.c0[port] = contact.overrun_drag
            return
        contact = contact._replace(programme=contact.programme.on_side(SIGNS[state]))
        if isinstance(contact.friction, Law) and contact.friction.text:
            self._formula(port, contact.friction, SIGNS[state])
        elif contact.friction is None or not contact.corners:
            mu = friction_at(contact.friction)
            self._programme(port, contact.programme, SIGNS[state] * mu, time)
        else:
            self._slipping(port, contact, state, piece, time)

    def _slipping(self, port: int, contact: Contact, state: str, piece: int, time: float) -> None:
        assert contact.friction is not None  # noqa: S101 - corners exist
        value, slope = friction_points(contact.friction).piece(piece)
        if contact.programme.look is not None:
            self._controlled(port, contact.programme, SIGNS[state], (SIGNS[state] * value, slope))
            return
        self.senses_rate[port] = slope != 0
        curve = contact.programme.curve
        if isinstance(curve, Points) and not curve.piece(curve.piece_at(time))[1]:
            normal = programme_at(contact.programme, time)
            self.c0[port] = SIGNS[state] * normal * value
            self.by_rate[port] = normal * slope
            return

        def torque(at: float, slip: float, _angle: float) -> float:
            return programme_at(contact.programme, at) * (SIGNS[state] * value + slope * slip)

        self.special.append((port, -1, torque, one_by_one(torque)))

    def _limited(self, index: int, sign: float, states: States, time: float) -> None:
        """Set up a spring at its torque limit, which can depend on another spring."""
        programme = self.system.springs[index].programme
        if programme.follows:
            pieces = states.pieces[self.layout.curves :]
            programme = programme._replace(look=following(self.system, programme.follows, pieces))
        if programme.look is not None:
            self.limits.append((index, sign, programme))
        self._programme(self.layout.springs + index, programme, sign, time)

    def _formula(self, port: int, drag: Law, sign: float) -> None:
        """Set up a drag by formula, continued without a corner beyond the end of the slip.

        A trial step can reach speeds at which the formula is infinite.
        """
        formula = Formula(drag.text)

        def torque(_time: float, slip: float, _angle: float) -> float:
            value = formula.function(0.0, sign * slip, 0.0)
            if math.isnan(value):  # such as sqrt(w) beyond the end
                value = formula.function(0.0, abs(slip), 0.0)
            return sign * min(max(value, -LARGEST_NUMBER), LARGEST_NUMBER)

        def torques(_times: Floats, slips: Floats, _angles: Floats) -> Floats:
            values: Floats = formula.along(slips, sign * slips, 0.0)
            values = np.where(np.isnan(values), formula.along(slips, np.abs(slips), 0.0), values)
            return sign * np.clip(values, -LARGEST_NUMBER, LARGEST_NUMBER)

        self.special.append((port, -1, torque, torques))
        self.senses_rate[port] = True

    def _controlled(
        self, port: int, programme: Programme, side: float, friction: tuple[float, float]
    ) -> None:
        """Set up a slipping contact under feedback control; friction has a value and a slope.

        At slips near rounding errors, the torque approaches its value at 0 linearly, like the
        torque of a damper. The line continues beyond zero slip, so Newton iterations that overshoot
        return. They converge to a slip of 0 even for very steep laws.
        """
        value, slope = friction
        looks = [look for look in (programme.look, programme.rub) if look]
        places = (*[port] * bool(slope), *(place for look in looks for place in look.places))
        rounding, far = self.rounding, self.rounding * _FAR

        def torque(time: float, seen: Sequence[float]) -> float:
            return programme.seen_at(time, seen) * (value + slope * seen[port])

        def near_end(time: float, seen: Sequence[float]) -> float:
            slip = side * seen[port]
            if slip >= far:
                return torque(time, seen)
            at_end, near, size = [*seen], [*seen], math.hypot(slip, rounding)
            at_end[port], near[port] = 0.0, side * size
            end = torque(time, at_end)
            return end + (torque(time, near) - end) * slip / size

        def torques(times: Floats, seen: Floats) -> Floats:
            values: Floats = programme.seen_along(times, seen) * (value + slope * seen[port])
            for at in np.flatnonzero(side * seen[port] < far) if ends else ():
                values[at] = near_end(float(times[at]), seen[:, at].tolist())
            return values

        ends = bool(side) and port in places
        if ends:
            self.ending.append(port)
        self.looks.append((port, Look(near_end if ends else torque, torques, places)))

    def _programme(self, port: int, programme: Programme, sign: float, time: float) -> None:
        curve, factor = programme.curve, sign * programme.factor
        if programme.look is not None:
            is_contact = port < self.layout.springs  # a spring does not stick at zero slip
            self._controlled(port, programme, sign * is_contact, (sign, 0.0))
            return
        if isinstance(curve, Points):
            value, slope = curve.piece(curve.piece_at(time))
            self.c0[port] = factor * value if math.isfinite(value) else sign * value
            self.c1[port] = factor * slope
            return
        self.timed.append((port, curve, factor))


def converter_torques(
    converter: Converter, piece: int, pump: float, turbine: float
) -> tuple[float, float]:
    """Return the torques on pump and turbine of a converter [N*m] at their speeds [rad/s].

    ``M_P = lambda w_P |w_P|`` and ``-K M_P`` (Tsitovich, Algin, (1.38)), with K and lambda linear
    in the speed ratio on a piece; both torques are 0 while the pump is at rest.
    """
    if pump == 0:
        return 0.0, 0.0
    factor, coefficient = _on_piece(converter, piece, turbine / pump)
    taken = coefficient * pump * abs(pump)
    return taken, -factor * taken


def converter_torques_at(
    converter: Converter, piece: int, pumps: Floats, turbines: Floats
) -> tuple[Floats, Floats]:
    """Return the torques of a converter at several instants; see `converter_torques`."""
    turns = pumps != 0
    ratios = np.divide(turbines, pumps, out=np.zeros_like(pumps), where=turns)
    factor, coefficient = _on_piece(converter, piece, ratios)
    taken = np.where(turns, coefficient * pumps * np.abs(pumps), 0.0)
    return taken, -factor * taken


def _on_piece(converter: Converter, piece: int, ratio: Any) -> tuple[Any, Any]:
    """Return torque ratio K and coefficient lambda at a speed ratio, on a linear piece."""
    points = converter.points
    if piece in (0, len(points)):
        _, *outside = points[min(piece, len(points) - 1)]
        return outside[0], outside[1]
    (i0, k0, l0), (i1, k1, l1) = points[piece - 1 : piece + 1]
    part = (ratio - i0) / (i1 - i0)
    return k0 + part * (k1 - k0), l0 + part * (l1 - l0)
