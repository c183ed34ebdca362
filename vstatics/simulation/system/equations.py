"""The equations of motion between two events, as a solver of differential equations takes them.

The state is ``[q, e, phi, W]``: motions with inertia, twists of springs, angles that are followed,
works of ports, losses of dampers, slip work of springs, losses of meshes. Motions without inertia
are no state: their speeds are those at which the torques along them balance.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.simulation.system.affine import Affine
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.ports import PortLayout, Ports, States
from vstatics.simulation.system.structure import MotionStructure, null

_MOST_CONVERTER_STEPS = 100
_NEWTON = 30
"""So many steps at most."""


class Equations:
    """What holds between two events, on one piece of time.

    Raises
    ------
    CaseError
        Of a link without inertia whose speed nothing determines.
    """

    def __init__(
        self,
        system: MotionSystem,
        layout: PortLayout,
        structure: MotionStructure,
        states: States,
        time: float,
    ) -> None:
        self.system, self.layout, self.structure, self.states = system, layout, structure, states
        self.time = time
        """From when on they hold. [s]"""
        self.ports = Ports(system, layout, states, time)
        self.motions = structure.free.shape[1]
        self.springs = len(system.springs)
        self.twists = slice(self.motions, self.motions + self.springs)
        self.angles = slice(self.twists.stop, self.twists.stop + len(layout.angles))
        self.works = slice(self.angles.stop, self.angles.stop + layout.ports)
        self.damped = slice(self.works.stop, self.works.stop + self.springs)
        self.slipped = slice(self.damped.stop, self.damped.stop + self.springs)
        self.meshed = slice(self.slipped.stop, self.slipped.stop + len(system.meshes))
        self.size = self.meshed.stop
        self.spring_ports = slice(layout.springs, layout.springs + self.springs)
        self.viscous = np.array([one.viscous for one in system.springs])
        slips = np.array([state != "stick" for state in states.springs], dtype=bool)
        self.creeps: Booleans = slips & (self.viscous > 0)
        self.limited: Booleans = slips & (self.viscous == 0)
        self.angle_rows = np.array([structure.free[link] for link in layout.angles])
        self.light = structure.light.shape[1]
        self.longest = system.scenario.duration / _MOST_CONVERTER_STEPS
        """Of a step where a torque is a formula of time, which may have a pulse. [s]"""
        self.within = 1e-7 * max(system.scenario.duration, 1e-9)
        if self.light:
            self._split_light()

    def _split_light(self) -> None:
        """Which motions without inertia are found by torques, which by slopes of torques."""
        structure, ports = self.structure, self.ports
        sensed = np.where(ports.senses_rate, np.maximum(np.abs(ports.by_rate), 1e-30), 0.0)
        scale = sensed.max(initial=0.0) or 1.0
        sensed = np.where(ports.senses_rate, np.maximum(sensed / scale, 1e-6), 0.0)
        by_speed = structure.balances @ (sensed[:, None] * structure.light_rates)
        self.by_slope = null(by_speed.T)
        """Combinations of balances that no speed changes, as columns."""
        kept = null(self.by_slope.T) if self.by_slope.size else np.eye(self.light)
        self.by_torque = kept
        if self.by_slope.shape[1]:
            elastic = np.zeros(self.layout.ports)
            elastic[self.spring_ports] = ports.elastic
            along = null(by_speed)
            changes = structure.balances @ (elastic[:, None] * structure.light_rates)
            stiff = self.by_slope.T @ changes @ along
            self._check_determined(stiff, along)
            self.along = along
            self.stiff = stiff

    def _check_determined(self, stiff: Floats, along: Floats) -> None:
        scale = np.abs(stiff).max(initial=0.0)
        undetermined = null(stiff / scale) if scale else np.eye(along.shape[1])
        if undetermined.shape[1]:
            speeds = np.abs(self.structure.light @ along @ undetermined).max(axis=1)
            name = self.system.names[int(speeds.argmax())]
            message = (
                f"link {name} has no inertia, and nothing determines its speed at "
                f"{self.time:g} s: give it an inertia, or hold it"
            )
            raise CaseError([Problem(message, ("case", "inertias", name))])

    def light_motions(self, time: float, rates: Floats, twists: Floats, angles: Floats) -> Floats:
        """Speeds of the motions without inertia, by the rates that those with inertia give."""
        structure, ports = self.structure, self.ports

        def rest(speeds: Floats) -> Floats:
            at = rates + structure.light_rates @ speeds
            torques = ports.torques(time, at, twists, angles)
            left: Floats = self.by_torque.T @ (structure.balances @ torques)
            if not self.by_slope.shape[1]:
                return left
            slopes = ports.slopes(time, at, angles, self.within)
            return np.concatenate([left, self.by_slope.T @ (structure.balances @ slopes)])

        speeds = np.zeros(self.light)
        left = rest(speeds)
        for _ in range(_NEWTON):
            step = 1e-6 * max(1.0, float(np.abs(speeds).max()))
            changes = np.empty((self.light, self.light))
            for index in range(self.light):
                moved = speeds.copy()
                moved[index] += step
                changes[:, index] = (rest(moved) - left) / step
            try:
                change = np.linalg.solve(changes, left)
            except np.linalg.LinAlgError:
                return np.full(self.light, np.nan)
            speeds = speeds - change
            left = rest(speeds)
            if np.abs(change).max() <= 1e-13 * max(1.0, float(np.abs(speeds).max())):
                break
        return speeds

    def rates(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Rates of ports, and speeds of the motions without inertia."""
        rates = self.structure.rates @ state[: self.motions]
        if not self.light:
            return rates, _NONE
        if self.light_is_straight:
            light = self.affine.light_at(np.array([time]), state[:, None])[:, 0]
        else:
            light = self.light_motions(time, rates, state[self.twists], state[self.angles])
        return rates + self.structure.light_rates @ light, light

    def speeds(self, time: float, state: Floats) -> Floats:
        """Of links [rad/s]."""
        speeds: Floats = self.structure.free @ state[: self.motions]
        if self.light:
            speeds = speeds + self.structure.light @ self.rates(time, state)[1]
        return speeds

    def rates_at(self, times: Floats, states: Floats) -> Floats:
        """Rates of ports at several times, shape (ports, times)."""
        if self.light and not self.light_is_straight:
            columns = [self.rates(float(time), states[:, n])[0] for n, time in enumerate(times)]
            return np.array(columns).T
        rates: Floats = self.structure.rates @ states[: self.motions]
        if self.light:
            rates += self.structure.light_rates @ self.affine.light_at(times, states)
        return rates

    def powers_at(self, times: Floats, states: Floats) -> Floats:
        """Changes of the works and losses of a state at several times, of straight equations."""
        structure = self.structure
        rates = self.rates_at(times, states)
        torques = self.torques_at(times, states, rates)
        made = np.zeros((self.size - self.works.start, len(times)))
        made[: self.layout.ports] = torques * rates
        if self.springs:
            sprung, twisting = torques[self.spring_ports], rates[self.spring_ports]
            growing = twisting.copy()
            creeps, limited = self.creeps, self.limited
            elastic = self.ports.stiffness[creeps, None] * states[self.twists][creeps]
            growing[creeps] = (sprung[creeps] - elastic) / self.viscous[creeps, None]
            if limited.any():
                slopes = self.affine.given_at(times)[1][self.spring_ports][limited]
                growing[limited] = slopes / self.ports.stiffness[limited, None]
            first = self.layout.ports
            made[first : first + self.springs] = self.viscous[:, None] * growing**2
            made[first + self.springs : first + 2 * self.springs] = sprung * (twisting - growing)
        if structure.loses:
            lost = structure.mesh_rates @ states[: self.motions]
            if self.light:
                lost += structure.mesh_light_rates @ self.affine.light_at(times, states)
            made[self.meshed.start - self.works.start :] = (structure.torques @ torques)[
                : len(lost)
            ] * lost
        return made

    def torques_at(self, times: Floats, states: Floats, rates: Floats) -> Floats:
        """Torques of ports at several times, shape (ports, times) [N*m]."""
        return self.ports.torques_at(times, rates, states[self.twists], states[self.angles])

    def speeds_at(self, times: Floats, states: Floats) -> Floats:
        """Of links at several times, shape (links, times) [rad/s]."""
        if self.light and not self.light_is_straight:
            columns = [self.speeds(float(time), states[:, n]) for n, time in enumerate(times)]
            return np.array(columns).T
        speeds: Floats = self.structure.free @ states[: self.motions]
        if self.light:
            speeds += self.structure.light @ self.affine.light_at(times, states)
        return speeds

    @cached_property
    def light_is_straight(self) -> bool:
        """Whether no torque that bends acts along the motions without inertia."""
        along = np.abs(self.structure.balances[:, self.ports.bending])
        return bool((along <= 1e-12).all())

    def slopes_by_rate(self, time: float, state: Floats) -> Floats:
        """Change of each torque with its rate, in a state [N*m*s/rad]."""
        rates, _ = self.rates(time, state)
        step = 1e-6 * max(1.0, float(np.abs(rates).max(initial=0.0)))
        slopes = self.ports.by_rate.copy()
        for port in self.ports.bending:
            near = [rates.copy(), rates.copy()]
            near[0][port] -= step
            near[1][port] += step
            low, high = (self.torques(time, state, one)[port] for one in near)
            slopes[port] = (high - low) / (2 * step)
        return np.where(np.isfinite(slopes), slopes, 0.0)

    @cached_property
    def affine(self) -> Affine:
        """The equations as maps, where all torques are straight."""
        return Affine(self)

    def torques(self, time: float, state: Floats, rates: Floats) -> Floats:
        """Of ports [N*m]."""
        return self.ports.torques(time, rates, state[self.twists], state[self.angles])

    def derivative(self, time: float, state: Floats) -> Floats:
        """Change of the state with time."""
        structure = self.structure
        rates, light = self.rates(time, state)
        torques = self.torques(time, state, rates)
        change = np.empty(self.size)
        change[: self.motions] = structure.accelerations @ torques
        change[self.works] = torques * rates
        if self.springs:
            sprung, twisting = torques[self.spring_ports], rates[self.spring_ports]
            growing = twisting
            if self.creeps.any() or self.limited.any():
                growing = twisting.copy()
                creeps, limited = self.creeps, self.limited
                elastic = self.ports.stiffness[creeps] * state[self.twists][creeps]
                growing[creeps] = (sprung[creeps] - elastic) / self.viscous[creeps]
                slopes = self.limit_slopes(time, rates, state)
                growing[limited] = slopes[limited] / self.ports.stiffness[limited]
            change[self.twists] = growing
            change[self.damped] = self.viscous * growing * growing
            change[self.slipped] = sprung * (twisting - growing)
        if self.angles.stop > self.angles.start:
            turning = self.angle_rows @ state[: self.motions]
            if self.light:
                turning = turning + structure.light[list(self.layout.angles)] @ light
            change[self.angles] = turning
        if structure.loses:
            lost = structure.mesh_rates @ state[: self.motions]
            if self.light:
                lost = lost + structure.mesh_light_rates @ light
            change[self.meshed] = (structure.torques @ torques)[: len(lost)] * lost
        else:
            change[self.meshed] = 0.0
        return change

    def limit_slopes(self, time: float, rates: Floats, state: Floats) -> Floats:
        """Changes of the limits of springs with time [N*m/s]."""
        slopes = self.ports.c1
        if self.ports.timed:
            slopes = self.ports.slopes(time, rates, state[self.angles], self.within)
        return slopes[self.spring_ports]

    def elastic_energy(self, state: Floats) -> float:
        """Of all springs [J]."""
        return float(self.ports.stiffness @ state[self.twists] ** 2) / 2

    def multipliers(self, torques: Floats) -> Floats:
        """Torques of what holds, by those of ports; of redundant ones the least [N*m]."""
        made: Floats = self.structure.torques @ torques
        return made


_NONE = np.zeros(0)
