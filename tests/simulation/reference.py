"""Motions by an integrator that knows no events: friction smoothed, equations reduced.

Written without the engine, for comparison with it: ``w = N q``, N the null space of the
mechanisms' columns, ``(N^T J N) q' = N^T (T - A_F M_F)``, friction
``capacity tanh(slip/smoothing)``, by `scipy.integrate`. It tends to the motion with events as the
smoothing shrinks.
"""

from collections.abc import Callable, Iterable
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from vstatics import Mechanism, ShiftElement, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Capacity, Formula, Points, Resistance, Scenario


def mechanism_column(mechanism: Mechanism, links: int, exponent: float = 0.0) -> Floats:
    """What a mechanism gives its links by a unit of torque at the first: +1, -u, u - 1."""
    ratio = mechanism.ratio * mechanism.efficiency**exponent
    column = np.zeros(links + 1)
    for link, part in zip(mechanism.links, (1.0, -ratio, ratio - 1.0), strict=True):
        column[link] += part
    return column[1:]


def mechanism_columns(case: Transmission) -> list[Floats]:
    """Return the columns of all mechanisms of a case."""
    return [mechanism_column(one, case.links) for one in case.mechanisms]


def element_column(element: ShiftElement, links: int) -> Floats:
    """Slip = first less second."""
    column = np.zeros(links + 1)
    column[element.first] += 1
    column[element.second] -= 1
    return column[1:]


def start_speeds(case: Transmission, speeds: dict[int, float], engaged: Iterable[int]) -> Floats:
    """The speeds of all links that the mechanisms, engaged elements and given speeds allow."""
    rows = mechanism_columns(case)
    rows += [element_column(case.shift_elements[n - 1], case.links) for n in engaged]
    right = [0.0] * len(rows) + list(speeds.values())
    rows += [np.eye(case.links)[link - 1] for link in speeds]
    found, _, rank, _ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    assert rank == case.links
    assert np.allclose(np.array(rows) @ found, right)
    return np.asarray(found, dtype=float)


Evaluated = Callable[[float, float], float]


def _law(law: Any, middle: float, smoothing: float) -> Evaluated:
    """A torque by time and speed; of points over time the piece that holds at an instant."""
    match law:
        case Formula():
            return lambda time, speed: law.function(time, speed, 0.0)
        case Resistance():
            return lambda _, speed: -law.torque * float(np.tanh(speed / smoothing))
        case Points(over="speed"):
            return lambda _, speed: law.at(speed)
    value, slope = law.piece(law.piece_at(middle))
    return lambda time, _: value + slope * time


def _capacities(scenario: Scenario) -> list[tuple[int, Any]]:
    controls = (scenario.controls or {}).items()
    return [(number, one.law) for number, one in controls if isinstance(one, Capacity)]


def _breaks(scenario: Scenario) -> list[float]:
    laws: list[Any] = [law for _, law in (*scenario.torques, *_capacities(scenario))]
    over_time = (law for law in laws if isinstance(law, Points) and law.over == "time")
    inner = {x for law in over_time for x in law.x if 0 < x < scenario.duration}
    return sorted({0.0, scenario.duration, *inner})


def smoothed(
    scenario: Scenario, start: Floats, smoothing: float, *, rtol: float = 1e-9
) -> tuple[Floats, Floats]:
    """Integrate from start speeds; return speeds [rad/s] and heat of elements [J] at the end."""
    case, links = scenario.case, scenario.case.links
    inertia = np.array([case.inertias[n] for n in range(1, links + 1)])
    gear = np.array(mechanism_columns(case))
    slip = np.array([element_column(one, links) for one in case.shift_elements])
    basis = null_space(gear)
    inverse = basis @ np.linalg.inv((basis.T * inertia) @ basis) @ basis.T

    def change(
        capacities: list[tuple[int, Evaluated]],
        torques: list[tuple[int, Evaluated]],
        time: float,
        state: Floats,
    ) -> Floats:
        speeds = state[:links]
        slips, friction, load = slip @ speeds, np.zeros(len(slip)), np.zeros(links)
        for number, law in capacities:
            capacity = max(law(time, 0.0), 0.0)
            friction[number - 1] = capacity * np.tanh(slips[number - 1] / smoothing)
        for link, law in torques:
            load[link - 1] += law(time, speeds[link - 1])
        return np.concatenate([inverse @ (load - slip.T @ friction), friction * slips])

    state = np.concatenate([start, np.zeros(len(slip))])
    for begin, end in pairwise(_breaks(scenario)):
        middle = (begin + end) / 2
        capacities = [(n, _law(law, middle, smoothing)) for n, law in _capacities(scenario)]
        torques = [(link, _law(law, middle, smoothing)) for link, law in scenario.torques]
        part = partial(change, capacities, torques)
        atol = rtol * np.maximum(np.abs(state).max(), 1.0)
        run = solve_ivp(part, (begin, end), state, "BDF", rtol=rtol, atol=atol)
        assert run.success, run.message
        state = run.y[:, -1]
    return state[:links], state[links:]
