"""Motions by an integrator that knows no events: friction smoothed, equations reduced.

Written without the engine, for comparison with it: ``w = N q``, N the null space of the
mechanisms' columns, ``(N^T J N) q' = N^T (T - A_F M_F - A_S M_S)`` (or, with losses, the whole
system with its torques), friction ``capacity tanh(slip/smoothing)``, by `scipy.integrate`. It
tends to the motion with events as the smoothing shrinks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from vstatics.core.model.parts import damping
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Mechanism, ShiftElement, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.laws import Points, Resistance, Road, TorqueLaw
from vstatics.simulation.scenario.parts import Capacity, Scenario

LOSS_SMOOTHING = 1e-3
"""Speed against the third link over which the flow of a mesh turns. [rad/s]"""
STOP = 1e6
"""Of a freewheel against its stop. [N*m*s/rad]"""


class Smoothed(NamedTuple):
    """A motion by smoothed friction, at the instants that were asked for."""

    time: Floats
    speeds: Floats
    """(instants, links). [rad/s]"""
    springs: Floats
    """(instants, springs), their torques without damping. [N*m]"""
    work: Floats
    """Of outside torques up to an instant. [J]"""
    heat: Floats
    """(instants, elements). [J]"""
    mesh_heat: Floats
    """[J]"""


def mechanism_column(mechanism: Mechanism, links: int, exponent: float = 0.0) -> Floats:
    """What a mechanism gives its links by a unit of torque at the first: +1, -u, u - 1."""
    ratio = mechanism.ratio * mechanism.efficiency**exponent
    column = np.zeros(links + 1)
    for link, part in zip(mechanism.links, (1.0, -ratio, ratio - 1.0), strict=True):
        column[link] += part
    return column[1:]


def element_column(element: ShiftElement, links: int) -> Floats:
    """Slip = first less second."""
    column = np.zeros(links + 1)
    column[element.first] += 1
    column[element.second] -= 1
    return column[1:]


def spring_column(spring: Spring, links: int) -> Floats:
    """The form of its twist."""
    column = np.zeros(links)
    for link, part in spring.form.items():
        column[link - 1] = part
    return column


def start_speeds(case: Transmission, speeds: dict[int, float], engaged: Iterable[int]) -> Floats:
    """The speeds of all links that the mechanisms, engaged elements and given speeds allow."""
    rows = [mechanism_column(one, case.links) for one in case.mechanisms]
    rows += [element_column(case.shift_elements[n - 1], case.links) for n in engaged]
    right = [0.0] * len(rows) + list(speeds.values())
    rows += [np.eye(case.links)[link - 1] for link in speeds]
    found, _, rank, _ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    assert rank == case.links
    assert np.allclose(np.array(rows) @ found, right)
    return np.asarray(found, dtype=float)


Evaluated = Callable[[float, float, float], float]


class _Equations:
    """The derivative of a state: speeds, torques of springs, angles, work, heat."""

    def __init__(self, scenario: Scenario, smoothing: float) -> None:
        case = scenario.case
        self.scenario, self.case, self.smoothing, self.links = (
            scenario,
            case,
            smoothing,
            case.links,
        )
        self.inertia = np.array([case.inertias.get(n, 0.0) for n in range(1, case.links + 1)])
        gear = [mechanism_column(one, case.links) for one in case.mechanisms]
        self.gear = np.array(gear).reshape(-1, case.links).T
        slip = [element_column(one, case.links) for one in case.shift_elements]
        self.slip = np.array(slip).reshape(-1, case.links)
        self.twist = np.array([spring_column(s, case.links) for s in case.springs]).reshape(
            -1, case.links
        )
        self.rates = np.array([one.rate for one in case.springs])
        self.damping = np.array([damping(one.damping).viscous for one in case.springs])
        self.limits = np.array([one.limit or np.inf for one in case.springs])
        basis = null_space(self.gear.T) if case.mechanisms else np.eye(case.links)
        self.inverse = basis @ np.linalg.inv((basis.T * self.inertia) @ basis) @ basis.T
        self.lossy = any(one.efficiency != 1 for one in case.mechanisms)
        self.signs = np.ones(len(case.mechanisms))
        counts = (case.links, len(case.springs), case.links, 1, len(case.shift_elements), 1)
        self.parts = np.cumsum(counts)[:-1]
        self.size = sum(counts)
        self.begin(0.0, scenario.duration)

    def begin(self, start: float, end: float) -> None:
        """Fix which pieces of the laws hold between two instants."""
        middle = (start + end) / 2
        controls = self.scenario.controls or {}
        self.capacity: list[tuple[int, Callable[[float], float]]] = []
        for number, control in controls.items():
            assert isinstance(control, Capacity)
            law = _law(control.law, middle, self.smoothing)
            self.capacity.append((number - 1, partial(_capacity, law, control.scale)))
        self.torques = [
            (link - 1, _law(law, middle, self.smoothing)) for link, law in self.scenario.torques
        ]

    def outside(self, time: float, speeds: Floats, angles: Floats) -> Floats:
        """Outside torques on the links."""
        found = np.zeros(self.links)
        for link, law in self.torques:
            found[link] += law(time, speeds[link], angles[link])
        return found

    def friction(self, time: float, slips: Floats) -> Floats:
        """Torques of elements, given to them by the first link."""
        found = np.zeros(len(slips))
        for number, law in self.capacity:
            element = self.case.shift_elements[number]
            capacity = law(time)
            if element.friction is not None:
                radius, area, surfaces, coefficient = element.friction[:4]
                x, y = zip(*coefficient, strict=True)
                capacity *= radius * area * surfaces * np.interp(abs(slips[number]), x, y)
            found[number] = capacity * np.tanh(slips[number] / self.smoothing)
        for number, element in enumerate(self.case.shift_elements):
            if element.is_freewheel:
                found[number] = STOP * min(slips[number], 0.0)
        return found

    def converters(self, speeds: Floats) -> Floats:
        """What converters give their links."""
        found = np.zeros(self.links)
        for one in self.scenario.converters:
            pump, turbine = speeds[one.pump - 1], speeds[one.turbine - 1]
            i, factors, lambdas = zip(*one.points, strict=True)
            ratio = turbine / pump if pump else 0.0
            torque = np.interp(ratio, i, lambdas) * pump * abs(pump)
            found[one.pump - 1] -= torque
            found[one.turbine - 1] += np.interp(ratio, i, factors) * torque
        return found

    def accelerations(self, loads: Floats, speeds: Floats) -> tuple[Floats, float]:
        """Of the links under all torques but those of mechanisms; and power lost in meshes."""
        if not self.lossy:
            return self.inverse @ loads, 0.0
        size, links = self.links + len(self.case.mechanisms), self.links
        matrix = np.zeros((size, size))
        matrix[:links, :links] = np.diag(self.inertia)
        matrix[links:, :links] = self.gear.T
        right = np.concatenate([loads, np.zeros(size - links)])
        whole = np.concatenate([[0.0], speeds])
        for _ in range(20):
            for number, one in enumerate(self.case.mechanisms):
                inner = whole[one.first] - whole[one.third]
                exponent = np.tanh(inner / LOSS_SMOOTHING) * self.signs[number]
                matrix[:links, links + number] = mechanism_column(one, links, exponent)
            found = np.linalg.solve(matrix, right)
            signs = np.sign(found[links:])
            if np.array_equal(signs, self.signs):
                break
            self.signs = signs
        lost = float(found[links:] @ (matrix[:links, links:].T @ speeds))
        return found[:links], lost

    def __call__(self, time: float, state: Floats) -> Floats:
        """The derivative."""
        speeds, springs, angles, _, _, _ = np.split(state, self.parts)
        slips = self.slip @ speeds
        outside = self.outside(time, speeds, angles)
        friction = self.friction(time, slips)
        rates = self.twist @ speeds
        total = np.clip(springs + self.damping * rates, -self.limits, self.limits)
        kept = rates.copy()
        limited = np.isfinite(self.limits) & (self.damping > 0)
        kept[limited] = (total - springs)[limited] / self.damping[limited]
        undamped = np.isfinite(self.limits) & (self.damping == 0)
        kept[undamped & (np.abs(springs) >= self.limits) & (springs * rates > 0)] = 0.0
        loads = outside + self.converters(speeds) - self.slip.T @ friction - self.twist.T @ total
        found, lost = self.accelerations(loads, speeds)
        heat = friction * slips
        return np.concatenate([found, self.rates * kept, speeds, [outside @ speeds], heat, [lost]])


class _Piece(NamedTuple):
    """The piece of points over time that holds between two instants."""

    value: float
    slope: float


def _law(law: TorqueLaw, middle: float, smoothing: float) -> Evaluated:
    """The torque by time, speed and angle; of points over time the piece of an instant."""
    if isinstance(law, Points) and law.over == "time":
        return partial(_torque, _Piece(*law.piece(law.piece_at(middle))), smoothing)
    return partial(_torque, law, smoothing)


def _torque(
    law: TorqueLaw | _Piece, smoothing: float, time: float, speed: float, angle: float
) -> float:
    match law:
        case _Piece():
            return law.value + law.slope * time
        case Points():
            return law.at(speed if law.over == "speed" else angle)
        case Resistance():
            return -law.torque * float(np.tanh(speed / smoothing))
        case Road():
            return _road(law, speed, smoothing)
    return law.function(time, speed, angle)


def _road(road: Road, speed: float, smoothing: float) -> float:
    assert not isinstance(road.rolling, tuple), "by points: tests/simulation/test_rolling.py"
    travel = speed * road.radius
    assert not isinstance(road.rolling, tuple)
    rolling = road.rolling * float(np.tanh(speed / smoothing)) + road.slope
    air = 1.2 * road.drag_area * travel * abs(travel) / 2
    return -road.radius * (road.mass * 9.81 * rolling + air)


def _capacity(law: Evaluated, scale: float, time: float) -> float:
    return max(law(time, 0.0, 0.0) * scale, 0.0)


def breaks(scenario: Scenario) -> list[float]:
    """Instants between which laws of time are smooth."""
    laws: list[Any] = [law for _, law in scenario.torques]
    laws += [c.law for c in (scenario.controls or {}).values() if isinstance(c, Capacity)]
    found = {0.0, scenario.duration}
    for law in laws:
        if isinstance(law, Points) and law.over == "time":
            found |= {x for x in law.x if 0 < x < scenario.duration}
    return sorted(found)


def smoothed(  # noqa: PLR0913 - what an integration has
    scenario: Scenario,
    start: Floats,
    smoothing: float = 1e-5,
    *,
    times: Iterable[float] = (),
    rtol: float = 1e-9,
    method: Literal["RK45", "BDF", "Radau"] = "BDF",
    max_step: float = np.inf,
) -> Smoothed:
    """Integrate from start speeds, springs at rest; at instants, the last is the duration."""
    equations = _Equations(scenario, smoothing)
    state = np.zeros(equations.size)
    state[: equations.links] = start
    stops = sorted({*breaks(scenario), *times})
    wanted = sorted({*times, scenario.duration})
    kept = []
    for begin, end in pairwise(stops):
        equations.begin(begin, end)
        run = solve_ivp(
            equations,
            (begin, end),
            state,
            method=method,
            rtol=rtol,
            atol=rtol * np.maximum(np.abs(state).max(), 1.0),
            max_step=max_step,
        )
        assert run.success, run.message
        state = run.y[:, -1]
        if end in wanted:
            kept.append(state)
    columns = [np.split(one, equations.parts) for one in kept]
    speeds, springs, _, work, heat, mesh = (np.array(one) for one in zip(*columns, strict=True))
    return Smoothed(np.array(wanted), speeds, springs, work[:, 0], heat, mesh[:, 0])
