"""Mechanisms that their friction holds still for a while: events by their names."""

from collections.abc import Callable
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import seeded, seeds_with_slow
from tests.simulation.control.written import simulated
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
                time = self._zero(time, lambda _, y: y[0], sign)
                found += [("sticks", time)] if self._rests(time) and time < self.duration else []
                sign = 0 if self._rests(time) else -sign
                continue
            if self._rests(time + 1e-9):
                grid = np.linspace(time + 1e-9, self.duration, 20001)
                moving = [at for at in grid.tolist() if not self._rests(at)]
                if not moving:
                    break
                low, high = moving[0] - (grid[1] - grid[0]), moving[0]
                for _ in range(60):
                    middle = (low + high) / 2
                    low, high = (middle, high) if self._rests(middle) else (low, middle)
                time = high
                found.append(("moves", time))
            sign = 1 if self.acceleration(time + 1e-9, 1) > 0 else -1
        return found

    def _rests(self, time: float) -> bool:
        return self.acceleration(time, 1) <= 0 <= self.acceleration(time, -1)

    def _zero(self, begin: float, of: Callable[[float, np.ndarray], float], sign: int) -> float:
        """When it comes to rest, or the end."""

        def stops(time: float, state: np.ndarray) -> float:
            return of(time, state) + sign * 1e-14

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
