"""State of the motion at an instant, and the times at which an input bends or jumps."""

from __future__ import annotations

import math
from collections.abc import Sequence
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

_MOST_JUMPS = 8
"""Largest number of iterations for balanced twists if an efficiency depends on the torque."""


class Instant(NamedTuple):
    """State of the motion at an instant, in physical quantities."""

    time: float
    """The instant. [s]"""
    speeds: Floats
    """Speeds of all links. [rad/s]"""
    twists: Floats
    angles: Floats
    values: Floats
    """Values of control states, then temperatures of shift elements."""
    accounts: Floats
    """Works and losses of all ports, springs and mechanisms since the start. [J]"""
    carried: Sequence[float] = ()
    """Torques on first links of mechanisms with varying efficiency; empty at the start. [N*m]"""


class Jump(NamedTuple):
    """Sudden change of spring twists, which balances the torques on links without inertia."""

    link: str
    energy: float
    """Energy lost in the change. [J]"""


def consistent(
    equations: Equations, state: Floats, scales: LargeSizes
) -> tuple[Floats, Jump | None]:
    """Return the state with balanced torques on links without inertia, and any jump of twists."""
    if not equations.light or not equations.by_slope.shape[1]:
        return state, None
    structure = equations.structure
    balanced, springs = state.copy(), equations.layout.spring_ports
    given = turned = last = np.zeros(equations.layout.ports)
    for _ in range(_MOST_JUMPS):
        _, torques = equations.acting(equations.time, balanced)
        given, last = given + (last + torques) / 2 * turned, torques
        unbalanced = equations.by_slope.T @ (structure.balances @ torques)
        if largest(unbalanced) <= STANDING * scales.torque:
            break
        motion = equations.along @ -np.linalg.solve(equations.stiff, unbalanced)
        turned = structure.light_rates @ motion
        balanced[equations.twists] += np.where(equations.ports.bends, turned[springs], 0.0)
        balanced[equations.angles] += structure.light[list(equations.layout.angles)] @ motion
    given[springs] = 0.0
    if not given.any() and (balanced == state).all():
        return state, None
    balanced[equations.works] += given
    before, after = (
        equations.system.elastic_energy(vector[equations.twists]) for vector in (state, balanced)
    )
    signs = np.ones(len(given))
    signs[equations.layout.outside :] = -1.0
    lost = float(signs @ given) - (after - before)
    links = np.abs(structure.light @ motion)
    return balanced, Jump(equations.system.names[int(links.argmax())], lost)


def motions_of(system: MotionSystem, structure: MotionStructure, at: Instant) -> Floats:
    """Return the coordinates of the motions with inertia, with exact speeds of sliding contacts."""
    driven = [sliding_speed(system, index, at) for index in structure.drivers]
    return structure.motions(at.speeds, np.array(driven))


def sliding_speed(system: MotionSystem, contact: int, at: Instant) -> float:
    """Return the slip speed of a variator or torque jump while its contact sticks [rad/s]."""
    now = math.nextafter(at.time, math.inf)
    for variator in system.variators:
        if variator.contact == contact:
            return (variator.reference - variator.ratio.at(now)) * float(at.speeds[variator.first])
    switch = system.contacts[contact].switch
    assert switch is not None  # noqa: S101 - drivers are variators or switches
    angle = float(at.angles[system.layout.angles.index(switch.link)])
    return switch.jump.speed.at(now) + switch.jump.by_angle * angle


def state_of(equations: Equations, at: Instant) -> Floats:
    """Return the state vector of the equations at an instant."""
    state = np.empty(equations.size)
    state[: equations.motions] = motions_of(equations.system, equations.structure, at)
    state[equations.twists] = at.twists
    state[equations.angles] = at.angles
    state[equations.values] = at.values
    state[equations.works.start :] = at.accounts
    _yield(equations, at.time, state)
    return state


def _yield(equations: Equations, time: float, state: Floats) -> None:
    """Limit the twists of slipping springs without dampers, and add the released energy to heat."""
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
    """Return the instant described by a state vector of the equations."""
    state = state.copy()
    _yield(equations, time, state)
    return Instant(
        time,
        equations.speeds(time, state),
        state[equations.twists].copy(),
        state[equations.angles].copy(),
        state[equations.values].copy(),
        state[equations.works.start :].copy(),
        equations.carried(time, state),
    )


def start_instant(
    system: MotionSystem, speeds: Floats, twists: Floats, angles: Floats | None = None
) -> Instant:
    """Return the instant t = 0 with works and losses of 0; missing angles are 0."""
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
    """Return the values of all quantities that formulas can read, except functions of torques.

    Shares of jumps are unknown, so they are 0.
    """
    rates = system.port_rows @ at.speeds
    seen = [*rates.tolist(), *at.twists.tolist(), *at.angles.tolist(), *at.values.tolist()]
    return seen + [0.0] * len(system.layout.shares)


def break_times(system: MotionSystem, until: float) -> list[float]:
    """Return the sorted times [s] before `until` at which an input over time bends or jumps."""
    curves: list[object] = [device.programme.curve for device in system.may_slip]
    curves += [load.law for load in system.outside]
    curves += [state.rate for state in system.scenario.states]
    curves += [contact.switch.jump.at for contact in system.contacts if contact.switch]
    curves += [variator.ratio for variator in system.variators]
    curves += [when.formula for _, when in conditions(system)]
    times: set[float] = set()
    for curve in curves:
        if isinstance(curve, Formula) and "t" in curve.variables:
            times.update(bends(curve.knowing(system.settings), until))
        elif isinstance(curve, Points):
            times.update(bends(curve, until))
    return sorted(time for time in times if 0 < time < until)


def large_sizes(system: MotionSystem, at: Instant) -> LargeSizes:
    """Return the largest speed and torque at an instant, at least 1, as scales of rounding."""
    times = [at.time, *break_times(system, system.scenario.duration)]
    seen = seen_at(system, at)
    torques = [
        abs(capacity_at(contact, time, seen=seen)) for contact in system.contacts for time in times
    ]
    torques += [abs(programme_at(spring.programme, at.time, seen)) for spring in system.springs]
    laws = [load.law for load in system.outside]
    torques += [abs(torque) for law in laws if isinstance(law, Points) for torque in law.y]
    for load in system.outside:
        if isinstance(load.law, Formula) and not load.law.seen:
            speed = float(at.speeds[load.link])
            torques.append(abs(load.law.function(at.time, speed, 0.0)))
    large = max(filter(math.isfinite, torques), default=0.0)
    return LargeSizes(max(1.0, largest(at.speeds)), max(1.0, large))
