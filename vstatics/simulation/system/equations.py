"""Equations of motion between two events, as a system of first-order differential equations.

A torque acts at a port, for example between the two links of a spring. The rate of a port [rad/s]
is the speed by which its torque is multiplied to obtain power. The state is ``[q, e, phi, v, W]``:

- q: generalised speeds of the independent motions with inertia; ``dq/dt`` is linear in the torques
  of the ports;
- e: twists of springs; ``de/dt`` is the rate of the port, unless the spring slips;
- phi: recorded angles of links;
- v: control states and temperatures;
- W: work of ports, and energy lost in dampers, slipping springs and mechanisms.

`Equations.derivative` returns the derivative of the state. Motions without inertia are not part of
the state: their speeds follow from the balance of torques along them.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.scenario.programme import Look
from vstatics.simulation.system.affine import Affine
from vstatics.simulation.system.curves import slope_ahead
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import MotionSystem, MovingVariator, RigidMechanism
from vstatics.simulation.system.ports import States
from vstatics.simulation.system.sliding import Sliding
from vstatics.simulation.system.structure import MotionStructure, null
from vstatics.simulation.system.values import OfTorques, ValueChanges
from vstatics.simulation.system.variators import VariatorTorques
from vstatics.simulation.system.varying_losses import VaryingLosses
from vstatics.simulation.tolerances import (
    DIFFERENCE_STEP,
    LEAST_SENSE,
    NEWTON_STEP,
    NO_SENSE,
    SIGHT,
    STANDING,
    STRAIGHT_BALANCE,
)

_NONE = np.zeros(0)
_FEWEST_STEPS = 100
"""Smallest number of time steps of a run if a torque is a formula of time."""
_NEWTON = 30
"""Largest number of Newton iterations for the speeds of motions without inertia."""
_LIMIT_ROUNDS = 8
"""Largest number of iterations for derivatives of spring limits that depend on the motion."""


class Equations(KnownMotion):
    """Equations of motion between two events, during which all inputs are smooth.

    Parameters
    ----------
    system : MotionSystem
    structure : MotionStructure
    states : States
    time : float
        Time of the first event. [s]
    rounding : float
        Largest slip that counts as 0, because it can be rounding error. [rad/s]
    carried : sequence of float
        Torques on the first links of mechanisms with varying efficiency, at the end of the previous
        stretch; empty at the start. [N*m]

    Raises
    ------
    CaseError
        If the speed of a link without inertia is not determined.
    """

    def __init__(  # noqa: PLR0913, PLR0917
        self,
        system: MotionSystem,
        structure: MotionStructure,
        states: States,
        time: float,
        rounding: float = STANDING,
        carried: Sequence[float] = (),
    ) -> None:
        super().__init__(system, structure, states, time, rounding)
        layout = self.layout
        self.seen_limits = [limit for limit in self.ports.limits if self.limited[limit[0]]]
        """Springs that slip at a limit under feedback control: index, sign of the torque, limit."""
        limits = {layout.springs + index for index, *_ in self.seen_limits}
        self.seeing = [port for port, _ in self.ports.looks if port not in limits]
        """Ports with feedback torques, except springs in `seen_limits`."""
        self.coupled = [*self.seeing, *range(layout.losses, layout.ports)]
        """Ports with torques that depend on more than the rate of the port."""
        self.driving = [
            (layout.contacts + index, row)
            for index, row in structure.contact_rows.items()
            if system.contacts[index].drives
        ]
        """Drivers (contacts that stick at a speed other than 0): port, row of constraint torque."""
        self.longest = system.scenario.duration / _FEWEST_STEPS
        """Longest time step if a torque is a formula of time, since it can contain a pulse. [s]"""
        self.last_light = np.zeros(self.light)
        """Speeds of motions without inertia, near which Newton's method looks for a balance."""
        if self.light:
            self._split_light()
        self.variators = VariatorTorques(self) if system.variators else None
        self.losses = VaryingLosses(self, carried) if system.varying else None
        self.sliding = Sliding(self) if self.layout.shares else None
        self.changes: ValueChanges = ValueChanges(self)
        """Rates of change of control states and temperatures."""

    def _split_light(self) -> None:
        """Separate torque balances that depend on speeds from balances that do not.

        The balances along motions without inertia determine the speeds of these motions. If a
        balance does not depend on speeds, its time derivative determines them.
        """
        structure, ports = self.structure, self.ports
        self.unsensed: list[tuple[int, Look]] = []
        """Feedback torques independent of motions without inertia: port and torque."""
        for port, look in ports.looks:
            rates = [place for place in look.places if place < self.layout.ports]
            ports.senses_rate[port] = structure.light_rates[rates].any()
            if not ports.senses_rate[port]:
                self.unsensed.append((port, look))
        self.level = [
            turbine for pump, turbine in ports.level if not structure.light_rates[pump].any()
        ]
        """Ports of turbines whose torque depends only on the speed of a pump with inertia."""
        ports.senses_rate[self.level] = False
        sensed = np.where(ports.senses_rate, np.maximum(np.abs(ports.by_rate), NO_SENSE), 0.0)
        scale = sensed.max(initial=0.0) or 1.0
        sensed = np.where(ports.senses_rate, np.maximum(sensed / scale, LEAST_SENSE), 0.0)
        sensed[: self.layout.outside] *= -1  # external torques act on links, others are taken
        by_speed = structure.balances @ (sensed[:, None] * structure.light_rates)
        self.by_slope = null(by_speed.T)
        """Combinations of balances that do not depend on speeds, as columns."""
        self.by_torque = null(self.by_slope.T) if self.by_slope.size else np.eye(self.light)
        if self.by_slope.shape[1]:
            self.along = null(by_speed)
            changes = structure.balances @ (ports.all_elastic[:, None] * structure.light_rates)
            self.stiff = self.by_slope.T @ changes @ self.along
            scale = largest(self.stiff)
            undetermined = null(self.stiff / scale) if scale else np.eye(self.along.shape[1])
            if undetermined.shape[1]:
                name = self._name_of(self.along @ undetermined)
                raise CaseError(
                    "E669",
                    f"link {name} has no inertia, and nothing determines its speed at "
                    f"{self.time:g} s: give it an inertia, or hold it",
                    ("case", "inertias", name),
                )

    def check_seen(self, time: float, state: Floats) -> None:
        """Raise an error if torques do not determine the speeds of motions without inertia.

        Raises
        ------
        CaseError
        """
        if self.light and not np.isfinite(self.rates(time, state)[1]).all():
            name = self._name_of(np.eye(self.light))
            raise CaseError(
                "E672",
                f"link {name} has no inertia, and at {time:g} s the formulas of its torques do "
                "not determine its speed: give it an inertia, or add a damper",
                ("case", "inertias", name),
            )

    def carried(self, time: float, state: Floats) -> Sequence[float]:
        """Return the torques on first links of mechanisms with varying efficiency [N*m]."""
        if not self.losses:
            return ()
        self.acting(time, state)
        return self.losses.latest

    def lacking(self, time: float, state: Floats) -> Problem | None:
        """Return a problem if the efficiencies do not agree with the torques in a state."""
        if not (self.losses or self.variators):
            return None
        self.acting(time, state)
        if self.variators and self.variators.lacks:
            first: MovingVariator | RigidMechanism = self.variators.variators[0]
            message, key = f"no torque on {first.name} agrees with its efficiency", "efficiency"
        elif self.losses and self.losses.failed:
            failed, message = self.losses.failed
            first, key = failed.mesh, failed.key
        else:
            return None
        number = first.device - len(self.system.case.shift_elements) + 1
        path = ("case", "mechanisms", number, key)
        return Problem("E695", f"at {time:.9g} s {message}", path)

    def _name_of(self, motions: Floats) -> str:
        return self.system.names[int(np.abs(self.structure.light @ motions).max(axis=1).argmax())]

    def light_motions(self, time: float, rates: Floats, state: Floats) -> Floats:
        """Return speeds of motions without inertia; `rates` are due to motions with inertia."""
        structure, ports = self.structure, self.ports
        angles = state[self.angles]

        def unbalanced(speeds: Floats) -> Floats:
            at = rates + structure.light_rates @ speeds
            left: Floats = self.by_torque.T @ (structure.balances @ self.torques(time, state, at))
            if not self.by_slope.shape[1]:
                return left
            slopes = ports.slopes(time, at, state[self.twists], angles, self.within)
            if self.unsensed or self.system.varying or self.level:
                self._see_ahead(time, state, (at, speeds), slopes)
            return np.concatenate([left, self.by_slope.T @ (structure.balances @ slopes)])

        speeds = self.last_light
        left = unbalanced(speeds)
        for _ in range(_NEWTON):
            finest = ports.finest(rates + structure.light_rates @ speeds)
            step = min(DIFFERENCE_STEP * max(1.0, largest(speeds)), finest)
            changes = np.empty((self.light, self.light))
            for index in range(self.light):
                moved = speeds.copy()
                moved[index] += step
                changes[:, index] = (unbalanced(moved) - left) / step
            try:
                change = np.linalg.solve(changes, left)
            except np.linalg.LinAlgError:
                return np.full(self.light, np.nan)
            after, share = unbalanced(speeds - change), 1.0
            least = NEWTON_STEP * max(1.0, largest(speeds))
            bends = largest(change) > finest
            while bends and not largest(after) <= (1 - share / 2) * largest(left):
                share /= 2  # a steep law near rest lets the step overshoot
                if share * largest(change) <= least:
                    break
                after = unbalanced(speeds - share * change)
            speeds, left = speeds - share * change, after
            if share * largest(change) <= least:
                break
        self.last_light = np.where(np.isfinite(speeds), speeds, 0.0)
        return speeds

    def _see_ahead(
        self, time: float, state: Floats, known: tuple[Floats, Floats], slopes: Floats
    ) -> None:
        """Fill in the time derivatives of torques that depend on the motion in `slopes`."""
        (rates, _), moving = known, slice(self.works.start)
        change = self._change(time, state, known, slopes[self.layout.spring_ports])[moving]
        torques = self.torques(time, state, rates)
        turning, sight = self.structure.rates @ change[: self.motions], self._sight(time)

        def seen_torques(ahead: float) -> Floats:
            states, turned = state[moving] + ahead * change, rates + ahead * turning
            seen = self.changes.seen(time, states, turned, torques)
            return np.array([look.at(time + ahead, seen) for _, look in self.unsensed])

        slopes[[port for port, _ in self.unsensed]] = slope_ahead(seen_torques, sight)
        losses = range(self.layout.losses, self.layout.ports) if self.losses else ()
        if places := [*self.level, *losses]:
            whole = np.append(change, np.zeros(self.size - len(change)))
            slopes[places] = slope_ahead(
                lambda ahead: self.torques(
                    time + ahead, state + ahead * whole, rates + ahead * turning
                )[places],
                sight,
            )

    def rates(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Return the rates of ports, and the speeds of motions without inertia [rad/s]."""
        rates = self.structure.rates.dot(state[: self.motions])  # `dot` is faster than `@`
        if not self.light:
            return rates, _NONE
        if self.light_is_straight:
            light = self.affine.light_at(np.array([time]), state[:, None])[:, 0]
        else:
            light = self.light_motions(time, rates, state)
        return rates + self.structure.light_rates @ light, light

    def speeds(self, time: float, state: Floats) -> Floats:
        """Return the speeds of links [rad/s]."""
        speeds = self.structure.free @ state[: self.motions]
        if self.light:
            speeds = speeds + self.structure.light @ self.rates(time, state)[1]
        return speeds

    def acting(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Return the rates and torques of ports in a state [rad/s, N*m]."""
        rates, _ = self.rates(time, state)
        return rates, self.torques(time, state, rates)

    def _light_at(self, times: Floats, states: Floats) -> Floats:
        """Return the speeds of motions without inertia at several times, shape (motions, times)."""
        if self.light_is_straight:
            return self.affine.light_at(times, states)
        columns = [self.rates(time, states[:, n])[1] for n, time in enumerate(times.tolist())]
        return np.array(columns).T

    def acting_at(self, times: Floats, states: Floats) -> tuple[Floats, Floats]:
        """Return the rates and torques of ports at several times, shape (ports, times)."""
        rates = self.structure.rates @ states[: self.motions]
        if self.light:
            rates += self.structure.light_rates @ self._light_at(times, states)
        return rates, self.torques_at(times, states, rates)

    def seen_at(self, times: Floats, states: Floats, rates: Floats, torques: Floats) -> Floats:
        """Return all quantities that formulas can read, shape (quantities, times)."""
        shares = self.shares_at(times, states, rates)
        return self.seen_with(times, states, rates, torques, shares)

    def shares_at(self, times: Floats, states: Floats, rates: Floats) -> Floats:
        """Return the shares of jumps along which the motion slides, shape (shares, times)."""
        return self.sliding.at(times, states, rates) if self.sliding else np.empty((0, len(times)))

    def seen_with(
        self, times: Floats, states: Floats, rates: Floats, torques: Floats, shares: Floats
    ) -> Floats:
        """Return all quantities that formulas can read, for given shares of jumps."""
        seen = np.vstack([rates, states[self.motions : self.values.stop], shares])
        if not self.layout.derived:
            return seen
        at = [*zip(times.tolist(), states.T, rates.T, torques.T, strict=True)]
        along = (
            derived.row @ torques
            if isinstance(derived, OfTorques)
            else [derived(*values) for values in at]
            for derived in self.changes.derived
        )
        return np.vstack([seen, *along])

    def powers_at(self, times: Floats, states: Floats) -> Floats:
        """Return the integrands of works and losses at several times [W]."""
        return self._powered(times, states, *self.acting_at(times, states))[self.works.start :]

    def _powered(self, times: Floats, states: Floats, rates: Floats, torques: Floats) -> Floats:
        """Return derivatives of states at several times, filled in only for twists and works."""
        slopes = None
        if not self.ports.is_below_limits:
            within = self.within if self.limited.any() else None
            slopes = self.ports.given_at(times, within)[1][self.layout.spring_ports]
            if self.seen_limits:
                columns = zip(times.tolist(), states.T, slopes.T, strict=True)
                slopes = np.array([self._seen_slopes(*columns_at) for columns_at in columns]).T
        change = np.zeros((self.size, len(times)))
        light = self._light_at(times, states) if self.light and self.structure.loses else _NONE
        self._fill_powers(change, states, torques, (rates, light), slopes)
        return change

    def _fill_powers(
        self,
        change: Floats,
        states: Floats,
        torques: Floats,
        known: tuple[Floats, Floats],
        slopes: Floats | None,
    ) -> None:
        """Fill in the rates of twists, works and losses in the derivative of a state.

        Arrays can have a second axis of several times. The derivatives of spring limits are None if
        no spring slips.
        """
        structure, (rates, light) = self.structure, known
        driven = self._with_driving(torques) if self.driving else torques
        np.multiply(driven, rates, out=change[self.works])
        if self.springs:
            at = self.layout.spring_ports
            sprung, twisting, twists = torques[at], rates[at], states[self.twists]
            growing = twisting
            if slopes is not None:
                growing = self._growing(twisting.T, sprung.T, twists.T, slopes.T).T
            change[self.twists] = growing
            grown, (fixed, by_twist) = growing.T, self.ports.taken
            damped = self.acting_dampers * grown**2 - (fixed + by_twist * twists.T) * grown
            change[self.damped] = damped.T
            change[self.slipped] = sprung * (twisting - growing)
        if structure.loses:
            lost = structure.mesh_rates @ states[: self.motions]
            if self.light:
                lost = lost + structure.mesh_light_rates @ light
            change[self.meshed] = (structure.torques @ torques)[: len(lost)] * lost

    def _with_driving(self, torques: Floats) -> Floats:
        """Return the torques of ports, including drivers, shape (ports,) or (ports, times)."""
        with_drivers = torques.copy()
        for port, row in self.driving:
            with_drivers[port] = self.structure.torques[row] @ torques
        return with_drivers

    def torques_at(self, times: Floats, states: Floats, rates: Floats) -> Floats:
        """Return the torques of ports at several times, shape (ports, times) [N*m]."""
        return self.torques_with(times, states, rates, self.shares_at(times, states, rates))

    def torques_with(self, times: Floats, states: Floats, rates: Floats, shares: Floats) -> Floats:
        """Return the torques of ports at several times, for given shares of jumps [N*m]."""
        values = states[self.values]
        if self.sliding:
            values = np.vstack([values, shares])
        torques = self.ports.torques_at(
            times, rates, states[self.twists], states[self.angles], values
        )
        if self.losses and not self.variators:
            for place in np.flatnonzero(self.losses.fill_all(rates, torques)).tolist():
                self._couple(float(times[place]), rates[:, place], torques[:, place])
        elif self.variators:
            for number, time in enumerate(times.tolist()):
                self._couple(time, rates[:, number], torques[:, number])
        return torques

    def speeds_at(self, times: Floats, states: Floats) -> Floats:
        """Return the speeds of links at several times, shape (links, times) [rad/s]."""
        speeds = self.structure.free @ states[: self.motions]
        if self.light:
            speeds += self.structure.light @ self._light_at(times, states)
        return speeds

    @cached_property
    def light_is_straight(self) -> bool:
        """True if all torques along motions without inertia are linear."""
        along = np.abs(self.structure.balances[:, self.ports.bending])
        return bool((along <= STRAIGHT_BALANCE).all())

    @property
    def _bends_otherwise(self) -> bool:
        """True if torques are nonlinear in quantities other than the rates of their ports."""
        by_slope = (self.system.varying or self.level) and self.by_slope.shape[1]
        return bool(self.ports.looks or self.ports.struts or by_slope)

    @property
    def has_closed_form(self) -> bool:
        """True if matrix exponentials can describe the motion."""
        if self.system.variators:
            return False
        if self.light and not self.light_is_straight and self._bends_otherwise:
            return False
        return self.ports.is_affine or bool(self.springs or self.seeing or self.layout.values)

    def value_rates_at(
        self, times: Floats, states: Floats, rates: Floats, torques: Floats
    ) -> Floats:
        """Return the rates of control states and temperatures, shape (values, times)."""
        changes = self.changes.along(times, self.seen_at(times, states, rates, torques))
        if self.layout.hot:
            changes = np.vstack([changes, np.zeros((len(self.layout.hot), len(times)))])
            self.changes.warm(changes, states, self._powered(times, states, rates, torques))
        return changes

    @cached_property
    def by_planets(self) -> Floats:
        """Matrix from port torques to torques that accelerate planets, (mechanisms, ports)."""
        planets = self.system.rows(mesh.planets for mesh in self.system.meshes)
        by_planets: Floats = planets @ self.structure.free @ self.structure.accelerations
        return by_planets

    @cached_property
    def affine(self) -> Affine:
        """Matrices of the equations, with all torques linear."""
        return Affine(self)

    def torques(self, time: float, state: Floats, rates: Floats) -> Floats:
        """Return the torques of ports [N*m]."""
        values = state[self.values]
        if self.sliding:
            values = np.append(values, self.share(time, state, rates))
        torques = self.ports.torques(time, rates, state[self.twists], state[self.angles], values)
        if self.variators or self.losses:
            self._couple(time, rates, torques)
        return torques

    def share(self, time: float, state: Floats, rates: Floats) -> Floats:
        """Return the shares of jumps along which the motion slides, shape (shares,)."""
        return self.shares_at(np.array([time]), state[:, None], rates[:, None])[:, 0]

    def _couple(self, time: float, rates: Floats, torques: Floats) -> None:
        """Fill in the torques that depend on constraint torques."""
        moving = partial(self.variators.fill, time, rates, torques) if self.variators else None
        if self.losses:
            self.losses.fill(rates, torques, moving)
        elif moving:
            moving()

    def moved(self, time: float, state: Floats, length: float) -> Floats:
        """Return the state after a step of the classical Runge-Kutta method of order 4."""
        half, end = time + length / 2, time + length
        first = self.derivative(time, state)
        second = self.derivative(half, state + length / 2 * first)
        third = self.derivative(half, state + length / 2 * second)
        fourth = self.derivative(end, state + length * third)
        return state + length / 6 * (first + 2 * (second + third) + fourth)

    def derivative(self, time: float, state: Floats, slopes: Floats | None = None) -> Floats:
        """Return the derivative of the state with respect to time.

        `slopes` are known derivatives of spring limits [N*m/s].
        """
        return self._change(time, state, self.rates(time, state), slopes)

    def _change(
        self,
        time: float,
        state: Floats,
        known: tuple[Floats, Floats],
        slopes: Floats | None = None,
    ) -> Floats:
        """Return the derivative for known rates of ports and speeds of motions without inertia."""
        structure, (rates, light) = self.structure, known
        torques = self.torques(time, state, rates)
        change = np.zeros(self.size)
        change[: self.motions] = structure.accelerations.dot(torques)
        if slopes is None and not self.ports.is_below_limits:
            slopes = self.limit_slopes(time, rates, state)
        self._fill_powers(change, state, torques, known, slopes)
        if self.angles.stop > self.angles.start:
            turning = self.angle_rows @ state[: self.motions]
            if self.light:
                turning = turning + structure.light[list(self.layout.angles)] @ light
            change[self.angles] = turning
        if self.layout.values:
            change[self.values] = self.changes.at(time, state, rates, torques, change)
        return change

    def limit_slopes(self, time: float, rates: Floats, state: Floats) -> Floats:
        """Return the derivatives of spring limits with respect to time [N*m/s]."""
        slopes = self.ports.c1
        if self.ports.timed:
            parts = (state[self.twists], state[self.angles])
            slopes = self.ports.slopes(time, rates, *parts, self.within)
        slopes = slopes[self.layout.spring_ports]
        return self._seen_slopes(time, state, slopes) if self.seen_limits else slopes

    def _seen_slopes(self, time: float, state: Floats, slopes: Floats) -> Floats:
        """Return the derivatives of spring limits, including feedback limits [N*m/s]."""
        slopes, moving = slopes.copy(), slice(self.works.start)
        step, at = self._sight(time), self.changes.seen_at(time, state[moving])
        for _ in range(_LIMIT_ROUNDS):
            change, before = self.derivative(time, state, slopes), slopes.copy()

            def limits(ahead: float, change: Floats = change) -> Floats:
                then = time + ahead
                seen = self.changes.seen_at(then, state[moving] + ahead * change[moving])
                return np.array(
                    [limit.seen_at(then, seen, clipped=False) for *_, limit in self.seen_limits]
                )

            risen = slope_ahead(limits, step)
            for (index, sign, limit), slope in zip(self.seen_limits, risen, strict=True):
                is_cut = limit.seen_at(time, at) != limit.seen_at(time, at, clipped=False)
                slopes[index] = 0.0 if is_cut else sign * slope
            if np.allclose(slopes, before):
                break
        return slopes

    def _sight(self, time: float) -> float:
        """Return the time step [s] for finite differences of quantities that formulas read.

        It is negative if possible, because a step backward cannot cross a corner that is ahead.
        """
        step = SIGHT * self.system.scenario.span
        return -step if time - step > self.time else step

    def _growing(self, twisting: Floats, sprung: Floats, twists: Floats, slopes: Floats) -> Floats:
        """Return the rates of twists; slipping springs follow their damper or their torque limit.

        The last axis of all arrays is the axis of springs.
        """
        growing = twisting.copy()
        creeps, limited, stiffness = self.creeps, self.limited, self.ports.stiffness
        elastic = stiffness[creeps] * twists[..., creeps]
        growing[..., creeps] = (sprung[..., creeps] - elastic) / self.viscous[creeps]
        growing[..., limited] = slopes[..., limited] / stiffness[limited]
        return growing
