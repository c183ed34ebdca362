"""Where everything is at an instant, and the state of equations that stands for it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.equations import Equations
from vstatics.simulation.margins import LargeSizes

STANDING = 1e-9
"""A speed or torque that is 0 but for rounding, by the largest of its kind."""


class Instant(NamedTuple):
    """Where everything is."""

    time: float
    """[s]"""
    speeds: Floats
    """Of links. [rad/s]"""
    twists: Floats
    angles: Floats
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
    time = equations.time
    rates, _ = equations.rates(time, state)
    torques = equations.torques(time, state, rates)
    rest = equations.by_slope.T @ (equations.structure.balances @ torques)
    if np.abs(rest).max() <= STANDING * scales.torque:
        return state, None
    motion = equations.along @ -np.linalg.solve(equations.stiff, rest)
    turned = equations.structure.light_rates @ motion
    made = state.copy()
    made[equations.twists] += np.where(equations.ports.bends, turned[equations.spring_ports], 0.0)
    given = torques * turned
    given[equations.spring_ports] = 0.0
    made[equations.works] += given
    before, after = (equations.elastic_energy(one) for one in (state, made))
    signs = np.ones(len(given))
    signs[equations.layout.outside :] = -1.0
    lost = float(signs @ given) - (after - before)
    links = np.abs(equations.structure.light @ motion)
    return made, Jump(equations.system.names[int(links.argmax())], lost)


def state_of(equations: Equations, at: Instant) -> Floats:
    """The state of equations at an instant."""
    state = np.empty(equations.size)
    structure = equations.structure
    motions = structure.free.T @ at.speeds
    motions += structure.projection @ (at.speeds - structure.free @ motions)
    state[: equations.motions] = motions
    state[equations.twists] = at.twists
    state[equations.angles] = at.angles
    state[equations.works.start :] = at.accounts
    return state


def instant_of(equations: Equations, time: float, state: Floats) -> Instant:
    """The instant that a state of equations stands for."""
    return Instant(
        time,
        equations.speeds(time, state),
        state[equations.twists].copy(),
        state[equations.angles].copy(),
        state[equations.works.start :].copy(),
    )
