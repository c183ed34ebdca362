"""Where everything is at an instant, its state of equations, and when something bends or jumps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.events.margins import LargeSizes
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points, bends
from vstatics.simulation.system.curves import capacity_at, programme_at
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.sight import conditions
from vstatics.simulation.system.structure import MotionStructure
from vstatics.simulation.tolerances import STANDING


class Instant(NamedTuple):
    """Where everything is."""

    time: float
    """[s]"""
    speeds: Floats
    """Of links. [rad/s]"""
    twists: Floats
    angles: Floats
    values: Floats
    """Of states and temperatures."""
    accounts: Floats
    """Works and losses up to here. [J]"""


class Jump(NamedTuple):
    """Twists that change at once, along motions without inertia."""

    link: str
    energy: float
    """Lost. [J]"""


def consistent(
    equations: Equations, state: Floats, scales: LargeSizes
) -> tuple[Floats, Jump | None]:
    """The state with the twists that balance the torques where nothing heavy moves."""
    if not equations.light or not equations.by_slope.shape[1]:
        return state, None
    _, torques = equations.acting(equations.time, state)
    rest = equations.by_slope.T @ (equations.structure.balances @ torques)
    if largest(rest) <= STANDING * scales.torque:
        return state, None
    motion = equations.along @ -np.linalg.solve(equations.stiff, rest)
    turned = equations.structure.light_rates @ motion
    made = state.copy()
    springs = equations.layout.spring_ports
    made[equations.twists] += np.where(equations.ports.bends, turned[springs], 0.0)
    given = torques * turned
    given[springs] = 0.0
    made[equations.works] += given
    before, after = (
        equations.system.elastic_energy(one[equations.twists]) for one in (state, made)
    )
    signs = np.ones(len(given))
    signs[equations.layout.outside :] = -1.0
    lost = float(signs @ given) - (after - before)
    links = np.abs(equations.structure.light @ motion)
    return made, Jump(equations.system.names[int(links.argmax())], lost)


def motions_of(system: MotionSystem, structure: MotionStructure, at: Instant) -> Floats:
    """The motions with inertia at an instant; drivers have their speeds exactly."""
    driven = [sliding_speed(system, index, at) for index in structure.drivers]
    return structure.motions(at.speeds, np.array(driven))


def sliding_speed(system: MotionSystem, contact: int, at: Instant) -> float:
    """The speed of a driver, such as that with which a motion slides along a jump [rad/s]."""
    now = math.nextafter(at.time, math.inf)
    for one in system.variators:
        if one.contact == contact:
            return (one.reference - one.ratio.at(now)) * float(at.speeds[one.first])
    switch = system.contacts[contact].switch
    assert switch is not None  # noqa: S101 - it is asked of these alone
    angle = float(at.angles[system.layout.angles.index(switch.link)])
    speed = switch.jump.speed.at(now)
    return speed + switch.jump.by_angle * angle


def state_of(equations: Equations, at: Instant) -> Floats:
    """The state of equations at an instant."""
    state = np.empty(equations.size)
    state[: equations.motions] = motions_of(equations.system, equations.structure, at)
    state[equations.twists] = at.twists
    state[equations.angles] = at.angles
    state[equations.values] = at.values
    state[equations.works.start :] = at.accounts
    _yield(equations, at.time, state)
    return state


def _yield(equations: Equations, time: float, state: Floats) -> None:
    """Twist springs without dampers that slip as far as their limits are; the rest is heat."""
    if not equations.limited.any():
        return
    twists, heat = state[equations.twists], state[equations.slipped]
    carried = equations.acting(time, state)[1][equations.layout.spring_ports]
    stiffness = equations.ports.stiffness
    yields = equations.limited & (stiffness > 0)
    change = np.where(yields, carried / np.where(yields, stiffness, 1.0) - twists, 0.0)
    heat -= stiffness * (twists + change / 2) * change
    twists += change


def instant_of(equations: Equations, time: float, state: Floats) -> Instant:
    """The instant that a state of equations stands for."""
    state = state.copy()
    _yield(equations, time, state)
    return Instant(
        time,
        equations.speeds(time, state),
        state[equations.twists].copy(),
        state[equations.angles].copy(),
        state[equations.values].copy(),
        state[equations.works.start :].copy(),
    )


def start_instant(
    system: MotionSystem, speeds: Floats, twists: Floats, angles: Floats | None = None
) -> Instant:
    """The instant t = 0, up to which nothing has worked; angles of links are 0 when not given."""
    layout, elements = system.layout, system.case.shift_elements
    accounts = np.zeros(layout.ports + 2 * len(system.springs) + len(system.meshes))
    stores = [elements[index].heat_store for index in layout.hot]
    values = [state.start for state in system.scenario.states]
    values += [store.ambient for store in stores if store]
    turned = np.zeros(len(system.names)) if angles is None else angles
    return Instant(
        0.0, speeds, twists, turned[list(layout.angles)], np.array(values, float), accounts
    )


def seen_at(system: MotionSystem, at: Instant) -> list[float]:
    """All that is seen at an instant but what follows from torques."""
    rates = system.port_rows @ at.speeds
    return [*rates.tolist(), *at.twists.tolist(), *at.angles.tolist(), *at.values.tolist()]


def break_times(system: MotionSystem, until: float) -> list[float]:
    """Times up to one at which something bends or jumps, in order [s]."""
    curves: list[object] = [device.programme.curve for device in system.may_slip]
    curves += [one.law for one in system.outside]
    curves += [one.rate for one in system.scenario.states]
    curves += [one.switch.jump.at for one in system.contacts if one.switch]
    curves += [one.ratio for one in system.variators]
    curves += [when.formula for when in conditions(system)]
    times: set[float] = set()
    for curve in curves:
        if isinstance(curve, Formula) and "t" in curve.variables:
            times.update(bends(curve.knowing(system.settings), until))
        elif isinstance(curve, Points):
            times.update(bends(curve, until))
    return sorted(time for time in times if 0 < time < until)


def large_sizes(system: MotionSystem, at: Instant) -> LargeSizes:
    """Speeds and torques that are large at the start."""
    torque = 1.0
    times = [at.time, *break_times(system, system.scenario.duration)]
    seen = seen_at(system, at)
    for contact in system.contacts:
        held = [abs(capacity_at(contact, time, seen=seen)) for time in times]
        torque = max([torque, *(one for one in held if math.isfinite(one))])
    for spring in system.springs:
        limit = abs(programme_at(spring.programme, at.time, seen))
        torque = max(torque, limit if math.isfinite(limit) else 0.0)
    for one in system.outside:
        if isinstance(one.law, Points):
            torque = max(torque, *map(abs, one.law.y))
    return LargeSizes(max(1.0, largest(at.speeds)), torque)
