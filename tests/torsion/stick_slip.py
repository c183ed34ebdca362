"""The scheme of a dumped clutch integrated in time, from event to event, to its first peak.

It knows nothing of closed forms: the clutch slips at first with .8 of the torque at which it
breaks away, and grabs where the speeds of engine and disc meet; or it sticks from the start, and
everything before the spring turns with the engine. The engine gives no torque.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from vstatics.torsion.clutch.given import Dump


class Contacts(NamedTuple):
    """What sticks."""

    clutch: bool = False
    grip: bool = True


START = Contacts()
"""Contacts of a clutch that is dumped: it slips at first."""


def first_peak(
    given: Dump, slipping: float = 0.8, sticks: Contacts = START
) -> tuple[float, list[str]]:
    """The torque of the spring at its first maximum, and the events before it.

    `slipping` is the torque of the clutch that slips by that at which it breaks away.
    """
    disc = given.omega1 * sticks.clutch
    state = np.array([0.0, given.omega1, disc, 0.0, 0.0])  # twist; engine, disc, wheels, vehicle
    said: list[str] = []
    span = 10 * np.sqrt((given.J1 + given.J2 + given.J3) * given.E)
    while True:
        happens = _events(given, sticks)
        made = solve_ivp(
            _slopes(given, sticks, slipping), (0, span), state,
            events=[event for _, event in happens], rtol=1e-10, atol=1e-12, max_step=span / 1000,
        )  # fmt: skip
        assert made.t_events is not None
        names = zip((name for name, _ in happens), made.t_events, strict=True)
        [name] = [name for name, times in names if len(times)]
        state = made.y[:, -1]
        if name == "peak":
            return state[0] / given.E, said
        said.append(name)
        contact, sticks_now = name.split()
        sticks = sticks._replace(**{contact: sticks_now == "sticks"})
        if name == "clutch sticks":
            state[1] = state[2]


def _slopes(given: Dump, sticks: Contacts, slipping: float) -> Callable[[float, Any], list[float]]:
    near, far, friction = given.J2 + given.J3, given.J4, slipping * given.M_C0

    def slopes(_: float, y: Any) -> list[float]:
        twist, _, disc, wheels, _ = y
        torque = twist / given.E
        engine, turns = -friction / given.J1, (friction - torque) / near
        if sticks.clutch:
            engine = turns = -torque / (given.J1 + near)
        rolls, moves = torque / (far + given.J5), torque / (far + given.J5)
        if not sticks.grip:
            rolls, moves = (torque - given.M_phi) / far, given.M_phi / given.J5
        return [disc - wheels, engine, turns, rolls, moves]

    return slopes


def _events(given: Dump, sticks: Contacts) -> list[tuple[str, Any]]:
    """What ends a stage: the speeds of a contact meet, its torque is too large, or the peak."""
    breaks = given.M_C0 * (given.J1 + given.J2 + given.J3) / given.J1 * given.E
    grip = given.M_phi * (given.J4 + given.J5) / given.J5 * given.E
    happens: dict[str, tuple[int, Any]] = {"peak": (-1, lambda _, y: float(y[2] - y[3]))}
    if sticks.clutch:
        happens["clutch slips"] = 1, lambda _, y: float(y[0] - breaks)
    else:
        happens["clutch sticks"] = -1, lambda _, y: float(y[1] - y[2])
    if sticks.grip:
        happens["grip slips"] = 1, lambda _, y: float(y[0] - grip)
    for direction, event in happens.values():
        event.terminal, event.direction = True, direction
    return [(name, event) for name, (_, event) in happens.items()]
