"""How states of a control and temperatures change, and what formulas see that torques tell."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import ControlState
from vstatics.simulation.system.known import DISTANCES, KnownMotion
from vstatics.simulation.system.sight import fixed, looking
from vstatics.simulation.tolerances import EQUAL_SIDES, NEAR_LIMIT


class ValueChanges:
    """Changes of states and temperatures with time, while equations hold.

    Parameters
    ----------
    equations : KnownMotion
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system = equations.system
        states = system.scenario.states
        self.rates = [
            looking(system, one.rate) if isinstance(one.rate, Formula) else fixed(one.rate.y[0])
            for one in states
        ]
        self.held = np.zeros(len(states), dtype=int)
        """1 of a state that stays at its largest value, -1 at its least, else 0."""
        self.derived = [_derived(equations, one) for one in system.layout.derived]

    def at(
        self, time: float, state: Floats, rates: Floats, torques: Floats, change: Floats
    ) -> Floats:
        """The changes in a state; what they follow from is known of `change`."""
        made = self.unheld(time, state, rates, torques)
        made[: len(self.held)][self.held != 0] = 0.0
        equations = self.equations
        for place, index in enumerate(equations.layout.hot, len(self.held)):
            store = equations.system.case.shift_elements[index].heat_store
            assert store is not None  # noqa: S101 - it is hot
            assert store.heat_capacity is not None  # noqa: S101
            over = state[equations.values][place] - store.ambient
            power = _heat(equations, index, change)
            made[place] = (power - store.cooling * over) / store.heat_capacity
        return made

    def unheld(self, time: float, state: Floats, rates: Floats, torques: Floats) -> Floats:
        """The changes of states as if they had no limits, then 0 for each temperature."""
        made = np.zeros(len(self.equations.layout.values))
        if self.rates:
            seen, ports = self.seen(time, state, rates, torques), self.equations.ports
            time = min(max(time, ports.after), ports.until)
            made[: len(self.rates)] = [look.at(time, seen) for look in self.rates]
        return made

    def along(self, times: Floats, seen: Floats) -> Floats:
        """The changes of states at several times, with what is seen as rows."""
        times = self.equations.ports.inside(times)
        made = np.array([look.along(times, seen) for look in self.rates])
        made[self.held != 0] = 0.0
        return made

    def seen(self, time: float, state: Floats, rates: Floats, torques: Floats) -> list[float]:
        """All that is seen in a state."""
        equations = self.equations
        seen = [*rates.tolist(), *state[equations.motions : equations.values.stop].tolist()]
        return seen + [one(time, state, rates, torques) for one in self.derived]

    def seen_at(self, time: float, state: Floats) -> list[float]:
        """The same where rates and torques are not known yet."""
        return self.seen(time, state, *self.equations.acting(time, state))

    def hold_limits(self, time: float, state: Floats) -> None:
        """Hold states at a limit while their rates point outward, or are 0 and turn outward."""
        states = self.equations.system.scenario.states
        if not states:
            return
        equations, values = self.equations, state[self.equations.values]
        within = equations.within
        self.held[:] = 0
        changes = self.unheld(time, state, *equations.acting(time, state))
        sides = [
            _side(one, float(values[index]), NEAR_LIMIT * within * abs(float(changes[index])))
            for index, one in enumerate(states)
        ]
        if not any(sides):
            return
        for index, side in enumerate(sides):
            if side:
                values[index] = states[index].most if side > 0 else states[index].least
        self.held[:] = sides
        while self.held.any():
            inward = self.held * self._next_changes(time, state)[: len(sides)] < 0
            if not inward.any():
                return
            self.held[inward] = 0  # which may move others

    def _next_changes(self, time: float, state: Floats) -> Floats:
        """Changes of states as if they had no limits; where they are 0 or turn, a little later."""
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
    """1 at the largest value of a state, -1 at its least, else 0."""
    for side, limit in ((1, state.most), (-1, state.least)):
        if math.isfinite(limit) and side * (value - limit) >= -max(near, EQUAL_SIDES * abs(limit)):
            return side
    return 0


def _heat(equations: KnownMotion, element: int, change: Floats) -> float:
    """The power of the friction of a shift element [W]."""
    power = 0.0
    works = change[equations.works]
    for index, contact in enumerate(equations.system.contacts):
        if contact.element == element:
            power += works[equations.layout.contacts + index]
    for index, spring in enumerate(equations.system.springs):
        if spring.element == element:
            power += change[equations.slipped][index]
    return float(power)


Derived = Callable[[float, Floats, Floats, Floats], float]
"""By time, state, rates and torques of ports."""


def _derived(equations: KnownMotion, seen: Seen) -> Derived:
    """What follows from torques."""
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
    """Outside torques on links by the torques of ports, shape (links, ports).

    Loads, torques that jump and those that speeds which are given take are among them.
    """
    system, structure = equations.system, equations.structure
    made, by_ports = np.zeros((len(system.names), system.layout.ports)), np.eye(system.layout.ports)
    for port, one in enumerate(system.outside):
        made[one.link, port] = 1.0
    row_of = {one.of: n for n, one in enumerate(structure.multipliers) if one.kind == "contact"}
    for index, contact in enumerate(system.contacts):
        if contact.device is None and not contact.is_drag and not contact.is_variator:
            row = row_of.get(index)
            port = system.layout.contacts + index
            taken = by_ports[port] if row is None else structure.torques[row]
            made -= np.outer(contact.row, taken)
    return made


def _acceleration(equations: KnownMotion, link: int) -> Derived:
    structure = equations.structure
    row = structure.free[link] @ structure.accelerations
    if not equations.light or not structure.light[link].any():
        return lambda _time, _state, _rates, torques: float(row @ torques)

    def with_light(time: float, state: Floats, rates: Floats, torques: Floats) -> float:
        """Of a link without inertia, by what its speed is a moment later."""
        ahead = state.copy()
        ahead[: equations.motions] += equations.within * (structure.accelerations @ torques)
        ahead[equations.twists] += equations.within * rates[equations.layout.spring_ports]
        later = equations.speeds(time + equations.within, ahead)[link]
        return float(later - equations.speeds(time, state)[link]) / equations.within

    return with_light


def _ports_of(equations: KnownMotion, name: str) -> list[int]:
    """The ports of a device: what slips, a spring, a pump."""
    system, layout = equations.system, equations.layout
    devices = system.case.devices
    device = devices.index(name) if name in devices else None
    found = [layout.springs + n for n, one in enumerate(system.springs) if one.device == device]
    found += [layout.pumps + n for n, one in enumerate(system.converters) if one.name == name]
    if device is not None:
        of = enumerate(system.contacts, layout.contacts)
        found += [port for port, one in of if one.device == device]
    return found


def _torque(equations: KnownMotion, name: str) -> Derived:
    """On the first link of a device, given to it: what slips, bends and holds of it together."""
    system, structure, layout = equations.system, equations.structure, equations.layout
    ports = _ports_of(equations, name)
    by_ports = np.zeros(layout.ports)
    by_ports[ports] = 1.0
    for row, one in enumerate(structure.multipliers):
        if one.kind == "contact" and layout.contacts + one.of in ports:
            by_ports += structure.torques[row]
        elif one.kind == "mesh" and system.meshes[one.of].name == name:
            planets = system.meshes[one.of].planets
            by_ports += structure.torques[row]
            by_ports += planets @ structure.free @ structure.accelerations
    return lambda _time, _state, _rates, torques: float(by_ports @ torques)
