"""Motions by `scipy.integrate.solve_ivp`: the same equations with smoothed friction.

As one would write them for one case by hand, in plain NumPy: constant matrices are made once,
stiff runs get their Jacobian and go from break point to break point.
"""

from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from vstatics.core.statics.matrix import column
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.scenario.parts import Capacity, Scenario

Array = np.ndarray[Any, Any]


class Stiff(NamedTuple):
    """What a stiff run gives."""

    speeds: Array
    """Of the links at the end [rad/s]."""
    locks: dict[int, float]
    """Index of an element -> when its slip last fell to 0 [s]."""


class Passage:
    """Where the magnitude of a slip falls below a threshold."""

    direction = -1.0

    def __init__(self, row: Array, threshold: float) -> None:
        self.row, self.threshold = row, threshold

    def __call__(self, _time: float, speeds: Array) -> float:
        """By how much it is above."""
        return float(abs(self.row @ speeds) - self.threshold)


def sech2(value: Any) -> Any:
    """The slope of tanh."""
    return 1 / np.cosh(np.clip(value, -300, 300)) ** 2


class Box:
    """The box of seven links, reduced by its mechanisms to three speeds."""

    def __init__(self, scenario: Scenario) -> None:
        case = scenario.case
        rows = np.zeros((len(case.mechanisms), case.links))
        for row, one in zip(rows, case.mechanisms, strict=True):
            row[[link - 1 for link in one.links]] = column(one.ratio)
        slips = np.zeros((len(case.shift_elements), case.links + 1))
        for row, element in zip(slips, case.shift_elements, strict=True):
            row[element.first] += 1
            row[element.second] -= 1
        mass = np.diag([case.inertias[link] for link in range(1, case.links + 1)])
        controls = scenario.controls or {}
        self.laws = [one.law for one in controls.values() if isinstance(one, Capacity)]
        self.points = [one for one in self.laws if isinstance(one, Points)]
        self.tables = [(np.array(one.x), np.array(one.y)) for one in self.points]
        self.free = null_space(rows)
        self.inverse = np.linalg.inv(self.free.T @ mass @ self.free)
        self.slips: Array = slips[[number - 1 for number in controls], 1:] @ self.free
        self.ends: Array = self.free[[0, case.links - 1]]
        given = np.vstack([self.ends, self.slips[0]])
        self.start: Array = np.linalg.solve(given, np.array([60.0, 0.0, 0.0]))
        self.smoothing = 0.0

    def rates(self, capacities: Array, speeds: Array) -> Array:
        """The derivative by the capacities at an instant."""
        friction = capacities * np.tanh(self.slips @ speeds / self.smoothing)
        drag = 1200.0 * np.tanh(self.ends[1] @ speeds / 0.05)
        outside = self.ends.T @ np.array([1500.0, -drag])
        found: Array = self.inverse @ (outside - self.slips.T @ friction)
        return found

    def at(self, time: float, speeds: Array) -> Array:
        """The derivative, capacities interpolated at each call."""
        return self.rates(np.array([np.interp(time, x, y) for x, y in self.tables]), speeds)

    def on_line(self, line: Array, time: float, speeds: Array) -> Array:
        """The derivative between two break points, where capacities are straight."""
        return self.rates(line[0] + line[1] * time, speeds)

    def jacobian(self, line: Array, time: float, speeds: Array) -> Array:
        """Of `on_line`."""
        slopes = (line[0] + line[1] * time) * sech2(self.slips @ speeds / self.smoothing)
        drag = 1200.0 / 0.05 * sech2(self.ends[1] @ speeds / 0.05)
        stiff = (self.slips.T * (slopes / self.smoothing)) @ self.slips
        found: Array = -self.inverse @ (stiff + drag * np.outer(self.ends[1], self.ends[1]))
        return found

    def plain(self) -> Array:
        """As one writes it first: the default method and tolerances, tanh of .01 rad/s."""
        self.smoothing = 0.01
        run = solve_ivp(self.at, (0.0, 6.0), self.start)
        return np.asarray(self.free @ run.y[:, -1])

    def stiff(self, smoothing: float, rtol: float) -> Stiff:
        """BDF from break point to break point, with the times of locks."""
        self.smoothing = smoothing
        stops = sorted({0.0, 6.0, *(x for one in self.points for x in one.x)})
        state, locks = self.start, {}
        for begin, end in pairwise(stops):
            pieces = [one.piece(one.piece_at((begin + end) / 2)) for one in self.points]
            line = np.array(pieces).T
            run = solve_ivp(
                partial(self.on_line, line),
                (begin, end),
                state,
                "BDF",
                jac=partial(self.jacobian, line),
                events=[Passage(row, 2 * smoothing) for row in self.slips],
                rtol=rtol,
                atol=rtol,
            )
            state = run.y[:, -1]
            for number, times in enumerate(run.t_events or []):
                if len(times):
                    locks[number] = float(times[-1])
        return Stiff(self.free @ state, locks)


class Chain:
    """A chain of springs behind a clutch; one of them, with a damper, slips at its limit."""

    def __init__(self, scenario: Scenario) -> None:
        case = scenario.case
        self.scenario, self.smoothing = scenario, 0.0
        self.inertias = np.array([case.inertias[link] for link in range(1, case.links + 1)])
        self.twists = np.zeros((len(case.springs), case.links))
        for row, spring in zip(self.twists, case.springs, strict=True):
            for link, part in spring.form.items():
                row[link - 1] = part
        self.rates = np.array([one.rate for one in case.springs])
        self.damping = np.array([getattr(one.damping, "viscous", 0.0) for one in case.springs])
        [self.limited] = [n for n, one in enumerate(case.springs) if one.limit is not None]
        limit = case.springs[self.limited].limit
        assert isinstance(limit, float)  # noqa: S101 - it follows nothing
        self.limit = limit
        [self.law] = [
            one.law for one in (scenario.controls or {}).values() if isinstance(one, Capacity)
        ]
        self.slip = np.zeros(case.links)
        self.slip[:2] = 1.0, -1.0
        self.linear = self._matrix()

    def _matrix(self) -> Array:
        """Of the linear part, nothing at its limit."""
        links, springs = self.twists.shape[1], len(self.twists)
        found = np.zeros((links + springs, links + springs))
        by_speed = (self.twists.T * self.damping) @ self.twists
        found[:links, :links] = -by_speed / self.inertias[:, None]
        found[:links, links:] = -(self.twists.T * self.rates) / self.inertias[:, None]
        found[links:, :links] = self.twists
        return found

    def _capacity(self, time: float) -> float:
        if isinstance(self.law, Points):
            return self.law.at(time)
        return self.law.function(time, 0.0, 0.0)

    def derivative(self, time: float, state: Array) -> Array:
        """Of speeds and twists."""
        links, tyre = self.twists.shape[1], self.limited
        found = self.linear @ state
        twist, rate = state[links + tyre], found[links + tyre]
        torque = self.rates[tyre] * twist + self.damping[tyre] * rate
        if abs(torque) > self.limit:
            held = np.copysign(self.limit, torque)
            found[:links] += self.twists[tyre] * (torque - held) / self.inertias
            found[links + tyre] = (held - self.rates[tyre] * twist) / self.damping[tyre]
        friction = self._capacity(time) * np.tanh(self.slip @ state[:links] / self.smoothing)
        found[:links] -= self.slip * friction / self.inertias
        return np.asarray(found)

    def jacobian(self, time: float, state: Array) -> Array:
        """Of `derivative`."""
        links, tyre = self.twists.shape[1], self.limited
        found = self.linear.copy()
        row = self.twists[tyre]
        by_state = np.zeros(len(state))
        by_state[:links] = self.damping[tyre] * row
        by_state[links + tyre] = self.rates[tyre]
        if abs(by_state @ state) > self.limit:
            found[:links] += np.outer(row / self.inertias, by_state)
            found[links + tyre] = 0.0
            found[links + tyre, links + tyre] = -self.rates[tyre] / self.damping[tyre]
        slope = sech2(self.slip @ state[:links] / self.smoothing) / self.smoothing
        steep = self._capacity(time) * slope
        found[:links, :links] -= np.outer(self.slip / self.inertias, self.slip) * steep
        return found

    def stiff(self, smoothing: float, rtol: float) -> Stiff:
        """BDF from break point to break point, with the time of the last lock."""
        self.smoothing = smoothing
        links = self.twists.shape[1]
        state = np.zeros(links + len(self.twists))
        for link, speed in self.scenario.start.speeds.items():
            state[link - 1] = speed
        slip = np.concatenate([self.slip, np.zeros(len(self.twists))])
        breaks = self.law.x if isinstance(self.law, Points) else ()
        stops = sorted({0.0, self.scenario.duration, *breaks})
        locks: dict[int, float] = {}
        for begin, end in pairwise(stops):
            run = solve_ivp(
                self.derivative,
                (begin, end),
                state,
                "BDF",
                jac=self.jacobian,
                events=Passage(slip, 2 * smoothing),
                rtol=rtol,
                atol=rtol,
            )
            state = run.y[:, -1]
            for times in run.t_events or []:
                if len(times):
                    locks[0] = float(times[-1])
        return Stiff(state[:links], locks)
