"""Rates of control states and temperatures, and quantities that follow from torques."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import ControlState
from vstatics.simulation.system.known import DISTANCES, KnownMotion
from vstatics.simulation.system.sight import fixed, looking
from vstatics.simulation.tolerances import EQUAL_SIDES, LEAST_VALUE, NEAR_LIMIT

TURNING = 2
"""Mark of a control state that rests at a jump of its rate (Filippov)."""
_SIDE = 1e-9
"""Distance from a turning point at which rates are evaluated, relative to the state."""


class ValueChanges:
    """Rates of control states and temperatures between two events.

    Parameters
    ----------
    equations : KnownMotion
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system = equations.system
        states = system.scenario.states
        self.rates = [
            looking(system, state.rate)
            if isinstance(state.rate, Formula)
            else fixed(state.rate.y[0])
            for state in states
        ]
        self.held = np.zeros(len(states), dtype=int)
        """For each control state: 1 if held at its upper limit, -1 at its lower limit, else 0.

        It is `TURNING` if held at a value at which its rate jumps, with rates that lead back to it.
        """
        self.points = np.zeros(len(states))
        """Value at which each control state is held, if it is `TURNING`."""
        self.derived = [_derived(equations, quantity) for quantity in system.layout.derived]

    def at(
        self, time: float, state: Floats, rates: Floats, torques: Floats, change: Floats
    ) -> Floats:
        """Return rates of control states and temperatures; `change` contains friction powers."""
        value_rates = self.unheld(time, state, rates, torques)
        value_rates[: len(self.held)][self.held != 0] = 0.0
        self.warm(value_rates, state, change)
        return value_rates

    def warm(self, value_rates: Floats, state: Floats, change: Floats) -> None:
        """Fill in rates of temperatures; all arrays can have a last axis of several times."""
        equations = self.equations
        for place, index in enumerate(equations.layout.hot, len(self.held)):
            store = equations.system.case.shift_elements[index].heat_store
            assert store is not None  # noqa: S101 - hot elements have a heat store
            assert store.heat_capacity is not None  # noqa: S101
            over = state[equations.values][place] - store.ambient
            power = _friction_power(equations, index, change)
            value_rates[place] = (power - store.cooling * over) / store.heat_capacity

    def unheld(self, time: float, state: Floats, rates: Floats, torques: Floats) -> Floats:
        """Return the rates of control states regardless of limits, then 0 for temperatures."""
        value_rates = np.zeros(len(self.equations.layout.values))
        if self.rates:
            seen, ports = self.seen(time, state, rates, torques), self.equations.ports
            time = min(max(time, ports.after), ports.until)
            value_rates[: len(self.rates)] = [look.at(time, seen) for look in self.rates]
        return value_rates

    def along(self, times: Floats, seen: Floats) -> Floats:
        """Return the rates of control states at several times, shape (states, times)."""
        times = self.equations.ports.inside(times)
        value_rates = np.reshape([look.along(times, seen) for look in self.rates], (-1, len(times)))
        value_rates[self.held != 0] = 0.0
        return value_rates

    def seen(self, time: float, state: Floats, rates: Floats, torques: Floats) -> list[float]:
        """Return all quantities that formulas read, in a state."""
        equations = self.equations
        seen = [*rates.tolist(), *state[equations.motions : equations.values.stop].tolist()]
        seen += equations.share(time, state, rates).tolist()
        return seen + [derived(time, state, rates, torques) for derived in self.derived]

    def seen_at(self, time: float, state: Floats) -> list[float]:
        """Return all quantities that formulas read, from time and state alone."""
        return self.seen(time, state, *self.equations.acting(time, state))

    def hold_limits(self, time: float, state: Floats) -> None:
        """Hold control states at limits where their rates point outward now or soon."""
        states = self.equations.system.scenario.states
        if not states:
            return
        equations, values = self.equations, state[self.equations.values]
        within = equations.within
        self.held[:] = 0
        changes = self.unheld(time, state, *equations.acting(time, state))
        near = NEAR_LIMIT * within * np.abs(changes)
        sides = [
            _side(control_state, float(values[index]), float(near[index]))
            for index, control_state in enumerate(states)
        ]
        for index, points in enumerate(equations.system.turning_points):
            for point in points:
                least = max(float(near[index]), self._little(index, point))
                if not sides[index] and abs(values[index] - point) <= least:
                    self.points[index] = point
                    sides[index] = TURNING * self._turns(index, time, state)
        if not any(sides):
            return
        limits = np.array([(control_state.least, control_state.most) for control_state in states])
        inside = np.clip(values[: len(states)], *limits.T)
        for index, side in enumerate(sides):
            if side:
                control_state = states[index]
                ends = {-1: control_state.least, 1: control_state.most}
                values[index] = ends.get(side, self.points[index])
        self.held[:] = sides
        while self.held.any():
            changes = self._next_changes(time, state)[: len(sides)]
            inward = (self.held * changes < 0) & (self.held != TURNING)
            if not inward.any():
                return
            self.held[inward] = 0  # releasing a state can change the rates of others
            values[: len(sides)][inward] = inside[inward]  # so that states leave their limits

    def _turns(self, index: int, time: float, state: Floats) -> bool:
        """Return whether rates on both sides lead back to a turning point, now and soon after."""
        equations, later = self.equations, time + self.equations.within
        moved = equations.moved(time, state, equations.within)
        seen = np.array([self.seen_at(time, state), self.seen_at(later, moved)]).T
        return bool((self.leading(index, np.array([time, later]), seen) > 0).all())

    def leading(self, index: int, times: Floats, seen: Floats) -> Floats:
        """Return the smaller of the rates from both sides towards a turning point, (times,)."""
        times, point = self.equations.ports.inside(times), self.points[index]
        sided, rates = seen.copy(), []
        for side in (-1.0, 1.0):
            sided[self.equations.layout.seen_values + index] = point + side * self._little(
                index, point
            )
            rates.append(self.rates[index].along(times, sided))
        return np.minimum(rates[0], -rates[1])

    def _little(self, index: int, point: float) -> float:
        start = self.equations.system.scenario.states[index].start
        return _SIDE * max(abs(start), abs(point), LEAST_VALUE)

    def _next_changes(self, time: float, state: Floats) -> Floats:
        """Return the rates of control states regardless of limits, soon after an instant.

        A rate that is 0, or soon changes by its own magnitude or more, is replaced by the rate a
        little later.
        """
        equations = self.equations
        changes = self.unheld(time, state, *equations.acting(time, state))
        reached, within = 0.0, equations.within
        for distance in DISTANCES:
            length = within * distance
            state = equations.moved(time + reached, state, length - reached)
            later, reached = time + length, length
            then = self.unheld(later, state, *equations.acting(later, state))
            undecided = changes == 0 if reached > within else abs(changes) <= abs(then - changes)
            changes = np.where(undecided, then, changes)
            if changes.all():
                break
        return changes


def _side(state: ControlState, value: float, near: float) -> int:
    for side, limit in ((1, state.most), (-1, state.least)):
        if math.isfinite(limit) and side * (value - limit) >= -max(near, EQUAL_SIDES * abs(limit)):
            return side
    return 0


def _friction_power(equations: KnownMotion, element: int, change: Floats) -> Floats:
    first = equations.works.start + equations.layout.contacts
    contacts = enumerate(equations.system.contacts, first)
    springs = enumerate(equations.system.springs, equations.slipped.start)
    places = [place for place, contact in contacts if contact.element == element]
    places += [place for place, spring in springs if spring.element == element]
    return np.asarray(change[places].sum(axis=0))


Derived = Callable[[float, Floats, Floats, Floats], float]
"""Quantity as a function of time, state, rates of ports and torques of ports."""


@dataclass(frozen=True)
class OfTorques:
    """Quantity that is a sum of multiples of the torques of ports."""

    row: Floats
    """Factors of the torques, shape (ports,)."""

    def __call__(self, _time: float, _state: Floats, _rates: Floats, torques: Floats) -> float:
        """Return the quantity in a state, as a `Derived` function."""
        return float(self.row @ torques)


def _derived(equations: KnownMotion, seen: Seen) -> Derived:
    names = equations.system.names
    if seen.word == "acceleration":
        return _acceleration(equations, names.index(seen.of))
    if seen.word == "torque":
        return _torque(equations, seen.of)
    if seen.of in names:
        link = names.index(seen.of)
        row = outside_torques(equations)[link]
        return lambda time, state, _rates, torques: float(
            row @ torques * equations.speeds(time, state)[link]
        )
    torque = _torque(equations, seen.of)
    [place] = _ports_of(equations, seen.of)[:1]
    return lambda time, state, rates, torques: float(
        rates[place] * torque(time, state, rates, torques)
    )


def outside_torques(equations: KnownMotion) -> Floats:
    """Return the matrix from torques of ports to external torques, shape (links, ports).

    Torques at jumps, and torques that enforce given speeds, are included.
    """
    system, structure = equations.system, equations.structure
    by_link = np.zeros((len(system.names), system.layout.ports))
    for port, load in enumerate(system.outside):
        by_link[load.link, port] = 1.0
    for index, contact in enumerate(system.contacts):
        if contact.device is None and not contact.is_drag and not contact.is_variator:
            row = structure.contact_rows.get(index)
            if row is None:
                by_link[:, system.layout.contacts + index] -= contact.row
            else:
                by_link -= np.outer(contact.row, structure.torques[row])
    return by_link


def _acceleration(equations: KnownMotion, link: int) -> Derived:
    structure = equations.structure
    row = structure.free[link] @ structure.accelerations
    if not equations.light or not structure.light[link].any():
        return OfTorques(row)

    def with_light(time: float, state: Floats, rates: Floats, torques: Floats) -> float:
        """Return the acceleration of a link without inertia from a difference of speeds."""
        ahead = state.copy()
        ahead[: equations.motions] += equations.within * (structure.accelerations @ torques)
        ahead[equations.twists] += equations.within * rates[equations.layout.spring_ports]
        later = equations.speeds(time + equations.within, ahead)[link]
        return float(later - equations.speeds(time, state)[link]) / equations.within

    return with_light


def _ports_of(equations: KnownMotion, name: str) -> list[int]:
    system, layout = equations.system, equations.layout
    devices = system.case.devices
    device = devices.index(name) if name in devices else None
    port_list = [
        layout.pumps + n for n, converter in enumerate(system.converters) if converter.name == name
    ]
    if device is not None:
        parts = enumerate(system.may_slip, layout.contacts)
        port_list += [port for port, part in parts if part.device == device]
    return port_list


def _torque(equations: KnownMotion, name: str) -> Derived:
    """Return the torque on a component from its first link, as a function."""
    system, structure, layout = equations.system, equations.structure, equations.layout
    ports = _ports_of(equations, name)
    by_ports = np.zeros(layout.ports)
    by_ports[ports] = 1.0
    for row, mesh in enumerate(system.meshes):
        if mesh.name == name:
            by_ports += structure.torques[row]
            by_ports += mesh.planets @ structure.free @ structure.accelerations
    for index, row in structure.contact_rows.items():
        if layout.contacts + index in ports:
            by_ports += structure.torques[row]
    return OfTorques(by_ports)
