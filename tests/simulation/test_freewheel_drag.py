"""Freewheels that drag while they overrun: their drag is dry friction, which also holds at rest.

Reference: ``M q' = Q(t) - n F`` of the free speeds q, with the slip ``n q`` and the torque F of the
freewheel: the drag while it overruns, its capacity while it slips back, anything between both while
it holds. Changes of the state are events of `solve_ivp`.
"""

import math
from itertools import pairwise
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded
from tests.simulation.control.written import simulated
from vstatics.core.numerics.arrays import Floats

WORDS = {("stick", "+"): "overruns", ("+", "stick"): "locks", ("-", "stick"): "locks"}
WORDS |= {("stick", "-"): "slips", ("+", "-"): "reverses", ("-", "+"): "reverses"}


class Wheel(NamedTuple):
    """A freewheel between bodies under given torques."""

    mass: Floats
    """Of the free speeds. [kg*m^2]"""
    row: Floats
    """Slip of the freewheel by the free speeds."""
    drag: float
    capacity: float

    def holding(self, driving: Floats) -> float:
        """Torque with which the freewheel holds its slip."""
        row, inverse = self.row, np.linalg.inv(self.mass)
        return float(row @ inverse @ driving / (row @ inverse @ row))

    def at_rest(self, driving: Floats) -> str:
        """State from an instant on at which the slip is 0."""
        held = self.holding(driving)
        return "+" if held > self.drag else "-" if held < -self.capacity else "stick"

    def rates(self, state: str, driving: Floats, speeds: Floats) -> Floats:
        """Derivatives of the free speeds, and the power lost."""
        by_state = {"+": self.drag, "-": -self.capacity, "stick": self.holding(driving)}
        friction = by_state[state]
        changes = np.linalg.solve(self.mass, driving - self.row * friction)
        slip = 0.0 if state == "stick" else self.row @ speeds
        return np.append(changes, friction * slip)

    def margin(self, state: str, driving: Floats, speeds: Floats) -> float:
        """Above 0 while the state lasts."""
        if state == "stick":
            held = self.holding(driving)
            return min(self.drag - held, held + min(self.capacity, 1e9))
        return float(self.row @ speeds) * (1 if state == "+" else -1)

    def stopped(self, values: Floats) -> Floats:
        """Free speeds and lost energy, without the rounding of the slip."""
        row = np.append(self.row, 0.0)
        without: Floats = values - row * (row @ values) / (row @ row)
        return without


def reference(
    wheel: Wheel, begin: Floats, knots: Floats, torques: Floats
) -> tuple[Floats, float, list[tuple[str, float]]]:
    """Free speeds at the end, energy lost in the freewheel, and its events."""

    def driving(time: float) -> Floats:
        return np.array([np.interp(time, knots, one) for one in torques])

    def rates(time: float, values: Floats) -> Floats:
        return wheel.rates(state, driving(time), values[:-1])

    def margin(time: float, values: Floats) -> float:
        return wheel.margin(state, driving(time), values[:-1])

    ends: Any = margin
    ends.terminal, ends.direction = True, -1
    values = np.append(begin, 0.0)
    state = wheel.at_rest(driving(1e-7)) if abs(wheel.row @ begin) < 1e-9 else "+"
    events: list[tuple[str, float]] = []
    for first, last in pairwise(knots.tolist()):
        time, step = first, (last - first) / 20
        while time < last:
            span = time, last
            motion = solve_ivp(
                rates, span, values, events=ends, rtol=1e-10, atol=1e-10, max_step=step
            )
            time, values = float(motion.t[-1]), motion.y[:, -1]
            if motion.status != 1:
                continue
            before = state
            if before == "stick":
                state = "+" if wheel.holding(driving(time)) > 0 else "-"
            else:
                values = wheel.stopped(values)
                state = wheel.at_rest(driving(time + 1e-7))
            if state != before:
                events.append((WORDS[before, state], time))
    return values[:-1], float(values[-1]), events


def trial(rng: Random) -> tuple[str, Wheel, list[str], Floats]:
    """A case, its freewheel, the links that are driven, and speeds of its links by free ones."""
    drag, capacity = rng.uniform(0.5, 30), rng.choice((math.inf, rng.uniform(30, 150)))
    inertias = [rng.uniform(0.05, 3) for _ in range(3)]
    if rng.random() < 0.5:
        names, free, ends = ["a", "b"], np.eye(2), ("a", "b")
        train, row = "", np.array([1.0, -1.0])
    else:
        ratio = rng.uniform(-3, -1.2)
        names, ends, row = ["sun", "ring", "carrier"], ("ring", "housing"), np.array([0.0, 1.0])
        free = np.array([[1, 0], [0, 1], [1 / (1 - ratio), -ratio / (1 - ratio)]])
        train = f"mechanisms: {{P: {{first: sun, second: ring, third: carrier, ratio: {ratio}}}}}\n"
    weights = dict(zip(names, inertias, strict=False))
    mass = free.T @ np.diag(list(weights.values())) @ free
    limit = "" if math.isinf(capacity) else f", capacity: {capacity!r} N*m"
    case = (
        f"links: [{', '.join(names)}]\ninertias: {weights}\n{train}shift_elements:\n"
        f"  F: {{links: [{', '.join(ends)}], kind: freewheel, drag: {drag!r} N*m{limit}}}\n"
        'gears: {"1": []}\n'
    )
    return case, Wheel(mass, row, drag, capacity), names, free


@each_seed(12, 1000)
def test_freewheels_that_drag_against_solve_ivp(seed: int) -> None:
    """Between two shafts, and at the ring of a set; torques of two links go up and down."""
    rng = seeded(seed)
    case, wheel, names, free = trial(rng)
    speed = rng.uniform(20, 90)
    begin = np.array([speed, speed if wheel.row[0] else 0.0])
    if rng.random() < 0.5:
        begin += wheel.row * rng.uniform(0, 30)
    knots = np.array([0, *sorted(rng.uniform(0.1, 1.9) for _ in range(3)), 2])
    driven = [names[0], names[-1]]
    outside = np.array([[rng.uniform(-60, 60) for _ in knots] for _ in driven])
    laws = [np.column_stack([knots, one]).tolist() for one in outside]
    torques = np.array([free[names.index(name)] for name in driven]).T @ outside
    speeds = dict(zip(names, (free @ begin).tolist(), strict=True))
    motion = simulated(
        f"duration: 2\nstart: {{speeds: {speeds}}}\n"
        f"torques: {dict(zip(driven, laws, strict=True))}\ncontrols: {{}}\n",
        case,
    )
    last, lost, events = reference(wheel, begin, knots, torques)
    assert motion.speeds[-1] == pytest.approx(free @ last, abs=1e-5)
    assert [one.word for one in motion.events] == [word for word, _ in events]
    times = [one.time for one in motion.events]
    assert times == pytest.approx([time for _, time in events], abs=1e-6)
    taken = sum(motion.energy.losses.values()) + sum(motion.energy.heat.values())
    assert taken == pytest.approx(lost, abs=1e-3)
