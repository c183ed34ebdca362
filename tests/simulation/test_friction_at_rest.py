"""Mechanisms and freewheels that friction holds still for a while: events by their names.

Reference of freewheels that drag: ``M q' = Q(t) - n F`` of the free speeds q, with the slip ``n q``
and the torque F of the freewheel: the drag while it overruns, its capacity while it slips back,
anything between both while it holds. Changes of the state are events of `solve_ivp`.
"""

import math
from itertools import pairwise
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.simulation.control.written import simulated
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.record.motion import Event

PAIR = """links: [a, b]
inertias: {{a: {first!r}, b: {second!r}}}
mechanisms: {{g: {{first: a, second: b, ratio: {ratio!r}, efficiency: {eta!r}}}}}
"""
RUN = """duration: {duration!r}
start: {{speeds: {{b: 0}}}}
torques: {{a: "{size!r}*sin({often!r}*t)", b: "{begin!r} + {change!r}*t"}}
"""


def of_mechanism(events: tuple[Event, ...]) -> list[tuple[str, str, float]]:
    assert {(one.event, one.word) for one in events} <= {("locks", "sticks"), ("slips", "moves")}
    return [(one.element, str(one.word), one.time) for one in events]


def test_the_lossy_gear_of_the_modelica_library_sticks_twice() -> None:
    """Modelica.Mechanics.Rotational.Examples.LossyGearDemo1: 0.0805-0.1995 s, 0.3714-0.4646 s."""
    motion = simulated(
        RUN.format(duration=0.5, size=10, often=2 * np.pi, begin=-10, change=2.5),
        PAIR.format(first=1, second=1.5, ratio=2, eta=0.5),
    )
    found = of_mechanism(motion.events)
    assert [word for _, word, _ in found] == ["sticks", "moves"] * 2
    assert {name for name, *_ in found} == {"g"}
    times = [time for *_, time in found]
    assert times == pytest.approx([0.0805, 0.1995, 0.3714, 0.4646], abs=1e-4)


class Lossy(NamedTuple):
    """A pair with losses whose torques depend on the time alone."""

    first: float
    second: float
    ratio: float
    eta: float
    size: float
    often: float
    begin: float
    change: float
    duration: float

    def acceleration(self, time: float, sign: int) -> float:
        """Return that of the first link while it turns in a direction [rad/s^2].

        ``J1 a = T1 - m`` and ``J2 a/u = T2 + u m eta^s``, s by the direction of the power.
        """
        pull = self.size * np.sin(self.often * time)
        load = self.begin + self.change * time
        for power in (1, -1):
            factor = self.ratio * self.eta**power
            # m = T1 - J1 a
            turned = (load + factor * pull) / (self.second / self.ratio + factor * self.first)
            carried = pull - self.first * turned
            if power * carried * sign >= 0:
                return float(turned)
        raise AssertionError

    def events(self) -> list[tuple[str, float]]:
        """Return when it comes to rest and stays, and when it moves again, by SciPy."""
        time, sign, found = 0.0, 0, list[tuple[str, float]]()
        while time < self.duration:
            if sign:
                time = self._zero(time, sign)
                rests = self._margin(time) >= 0
                found += [("sticks", time)] if rests and time < self.duration else []
                sign = 0 if rests else -sign
                continue
            if self._margin(time + 1e-9) >= 0:
                grid = np.linspace(time + 1e-9, self.duration, 20001).tolist()
                moves = [n for n, at in enumerate(grid) if self._margin(at) < 0]
                if not moves:
                    break
                time = brentq(self._margin, grid[moves[0] - 1], grid[moves[0]])
                found.append(("moves", time))
            sign = 1 if self.acceleration(time + 1e-9, 1) > 0 else -1
        return found

    def _margin(self, time: float) -> float:
        """Return the smaller acceleration towards rest, at least 0 where it stays at rest."""
        return min(-self.acceleration(time, 1), self.acceleration(time, -1))

    def _zero(self, begin: float, sign: int) -> float:
        """Return when it comes to rest, or the end."""

        def stops(_: float, state: np.ndarray) -> float:
            return float(state[0]) + sign * 1e-14

        stops.terminal, stops.direction = True, -sign  # type: ignore[attr-defined]
        span = begin, self.duration
        exact: dict[str, Any] = {"max_step": 1e-3, "rtol": 1e-9, "atol": 1e-12}
        made = solve_ivp(
            lambda t, _: [self.acceleration(t, sign)], span, [0.0], events=stops, **exact
        )
        return float(made.t[-1])


def random_pair(rng: Random) -> Lossy:
    ranges = (0.3, 3), (0.3, 3), (0.5, 3), (0.3, 0.9), (5, 20), (3, 20), (-15, 15), (-10, 10)
    pair = Lossy._make([*(rng.uniform(*ends) for ends in ranges), 0.6])
    return pair._replace(ratio=rng.choice((-1, 1)) * pair.ratio)


@seeds_with_slow(4, 12, 300)
def test_a_random_gear_sticks_and_moves_when_an_integrator_says_so(seed: int) -> None:
    pair = random_pair(seeded(seed))
    motion = simulated(RUN.format(**pair._asdict()), PAIR.format(**pair._asdict()))
    found = of_mechanism(motion.events)
    wanted = pair.events()
    assert [word for _, word, _ in found] == [word for word, _ in wanted]
    assert [time for *_, time in found] == pytest.approx([time for _, time in wanted], abs=1e-5)


def test_a_gear_that_a_brake_holds_has_no_event() -> None:
    case = PAIR.format(first=1, second=2, ratio=2, eta=0.9)
    case += "shift_elements: {B: {links: [b], capacity: 100 N*m}}\n"
    motion = simulated("duration: 2\nstart: {speeds: {b: 5}}\ncontrols: {B: 50}\n", case)
    assert [(one.element, one.word) for one in motion.events] == [("B", "locks")]


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
