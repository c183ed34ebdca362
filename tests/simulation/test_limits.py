"""Limits of springs over time and by what is seen: how they slip, and when they grip again."""

import math
from collections.abc import Callable
from random import Random
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from tests.chance import each_seed, seeded
from tests.simulation.control.written import faults, simulated
from tests.simulation.test_golden import closes
from vstatics.core.numerics.arrays import Floats

WHEEL = "{links: [w], inertias: {w: 2}, springs: {S: {links: [w, housing], stiffness: 3000%s}}}"
"""A wheel on a spring to the housing, J = 2 and k = 3000: under T it carries T (1 - cos(q t))."""
PULLED = "duration: 0.4\nstart: {speeds: {w: 0}}\ntorques: {w: 500}\n"
Q = math.sqrt(3000 / 2)


def begins(limit: Callable[[float], float], torque: float) -> float:
    first = math.pi / Q
    return brentq(lambda t: torque * (1 - math.cos(Q * t)) - limit(t), 0, first, xtol=1e-15)


@pytest.mark.parametrize("limit", ["[[0, 100], [0.4, 180]]", '"100 + 200*t"'])
def test_a_limit_that_rises_with_time_takes_what_it_is(limit: str) -> None:
    """``J dw/dt = T - L(t)`` from when it slips on, ``L (w - dL/dt/k)`` is heat."""
    made = simulated(f"{PULLED}limits: {{S: {limit}}}\n", WHEEL % "")
    t0 = begins(lambda t: 100 + 200 * t, 500)
    w0 = 500 / (2 * Q) * math.sin(Q * t0)

    def speed(t: float) -> float:
        return w0 + (400 * (t - t0) - 100 * (t**2 - t0**2)) / 2

    [slips] = made.events
    assert slips.event == "slips"
    assert slips.time == pytest.approx(t0, abs=1e-9)
    assert made.speeds[-1, 0] == pytest.approx(speed(0.4), rel=1e-9)
    heat, _ = quad(lambda t: (100 + 200 * t) * (speed(t) - 200 / 3000), t0, 0.4)
    assert made.energy.heat["S"] == pytest.approx(heat, rel=1e-8)
    assert made.energy.elastic == pytest.approx(180**2 / 6000, rel=1e-9)
    assert closes(made)


@pytest.mark.parametrize("after", [40.0, 0.0])
def test_what_a_limit_that_drops_no_longer_holds_is_heat(after: float) -> None:
    limit = f"limits: {{S: [[0, 100], [0.2, 100], [0.2, {after}]]}}\n"
    made = simulated(PULLED + limit, WHEEL % "")
    t0 = begins(lambda _: 100, 500)
    w1 = 500 / (2 * Q) * math.sin(Q * t0) + 200 * (0.2 - t0)
    assert made.speeds[-1, 0] == pytest.approx(w1 + (500 - after) / 2 * 0.2, rel=1e-9)
    assert made.energy.elastic == pytest.approx(after**2 / 6000)
    assert closes(made)


def test_the_limit_of_the_case_counts_where_the_scenario_has_none() -> None:
    own = simulated(PULLED, WHEEL % ", limit: 90")
    given = simulated(PULLED + "limits: {S: 90 N*m}\n", WHEEL % ", limit: 200")
    assert given.speeds[-1] == pytest.approx(own.speeds[-1], rel=1e-12)
    assert given.events == own.events


def test_sequences_change_a_limit_and_damped_springs_have_one() -> None:
    """From 0.1 s on the wheel runs free: the damper has let go of what it carried."""
    made = simulated(
        "duration: 0.3\nstart: {speeds: {w: 5}}\nset: {grip: 30}\nlimits: {S: grip*1}\n"
        'sequences: {ice: [{when: "t >= 0.1", set: {grip: 0}}]}\n',
        WHEEL % ", damping: 4",
    )
    after = made.time > 0.1
    assert not made.torques[after].any()
    assert made.speeds[after][:, 0] == pytest.approx(made.speeds[-1, 0])
    assert closes(made)


def test_a_kink_at_equal_speeds_is_passed() -> None:
    """A limit with its peak where both turn alike, passed while the spring swings back."""
    made = simulated(
        "duration: 1\nstart: {speeds: {w: 0, v: 0}}\ntorques: {w: '500*(t<0.5) - 800*(t>0.6)'}\n"
        "limits: {S: \"150 - 60*tanh(abs(speed('w') - speed('v'))/30)\"}\n",
        "{links: [w, v], inertias: {w: 2, v: 30}, springs: {S: {links: [w, v], stiffness: 3000, "
        "damping: 5}}}",
    )
    assert [one.event for one in made.events] == ["slips", "locks", "slips"]
    assert closes(made)


@pytest.mark.parametrize("damping", ["", ", damping: 3"])
def test_a_link_without_inertia_stands_beside_a_limit_that_sees(damping: str) -> None:
    """30 dv/dt = 100 + 2 v from the slip on; what Z carries is what S carries."""
    case = (
        "{links: [w, m, v], inertias: {w: 2, v: 30}, springs: {Z: {links: [w, m], stiffness: 2000"
        f"{damping}}}, S: {{links: [m, v], stiffness: 3000}}}}}}"
    )
    start = "duration: 0.2\nstart: {speeds: {w: 0, v: 0}}\ntorques: {w: 500}\n"
    made = simulated(f"{start}limits: {{S: \"100 + 2*speed('v')\"}}\n", case)
    assert closes(made)
    [slips] = made.events
    behind = made.time > slips.time
    begin = made.speeds[~behind][-1, 2]
    exact = (begin + 50) * np.exp((made.time[behind] - slips.time) / 15) - 50
    assert made.speeds[behind, 2] == pytest.approx(exact, rel=1e-8)
    assert made.torques[:, 0] == pytest.approx(made.torques[:, 1], rel=1e-8)


class Tyre(NamedTuple):
    """Two masses on a spring whose limit follows their speeds, and a torque on the first."""

    masses: tuple[float, float]
    stiffness: float
    limit: tuple[float, float, float]
    """L = a + b w + c v, which stays above 0."""
    torque: tuple[float, float]
    """Amplitude and frequency."""

    def text(self, duration: float) -> tuple[str, str]:
        """A scenario and its case."""
        (first, second), (a, b, c), (size, omega) = self.masses, self.limit, self.torque
        case = (
            f"{{links: [w, v], inertias: {{w: {first!r}, v: {second!r}}}, springs: "
            f"{{S: {{links: [w, v], stiffness: {self.stiffness!r}}}}}}}"
        )
        scenario = (
            f"duration: {duration}\nstart: {{speeds: {{w: 0, v: 0}}}}\n"
            f"torques: {{w: '{size!r}*sin({omega!r}*t)'}}\n"
            f"limits: {{S: \"{a!r} + {b!r}*speed('w') + {c!r}*speed('v')\"}}\n"
        )
        return scenario, case

    def accelerations(self, time: float, carried: float) -> Floats:
        """Of both, by what the spring carries."""
        size, omega = self.torque
        loads = size * math.sin(omega * time) - carried, carried
        return np.array([load / mass for load, mass in zip(loads, self.masses, strict=True)])

    def at(self, speeds: Floats) -> float:
        """The limit at speeds."""
        a, b, c = self.limit
        return a + b * float(speeds[0]) + c * float(speeds[1])


def integrated(tyre: Tyre, duration: float) -> tuple[Floats, int]:
    """Speeds at the end, and how often it slips: mode by mode with the events of SciPy."""
    time, state, side, slipped = 0.0, np.zeros(3), 0.0, 0
    while time < duration:

        def carried(state: Floats, side: float = side) -> float:
            return side * tyre.at(state) if side else tyre.stiffness * float(state[2])

        def change(time: float, state: Floats, side: float = side) -> Floats:
            grown = tyre.accelerations(time, carried(state, side))
            rate = side * (tyre.at(grown) - tyre.limit[0]) / tyre.stiffness
            return np.array([*grown, rate if side else state[0] - state[1]])

        def ends(time: float, state: Floats, side: float = side) -> float:
            if side:
                rate = state[0] - state[1] - change(time, state, side)[2]
                return side * float(rate)
            return tyre.at(state) - abs(tyre.stiffness * float(state[2]))

        ends.terminal, ends.direction = True, -1.0  # type: ignore[attr-defined]
        found = solve_ivp(
            change, (time, duration), state, "DOP853", events=ends, rtol=1e-10, atol=1e-12
        )
        time, state = float(found.t[-1]), found.y[:, -1]
        side = 0.0 if side else math.copysign(1.0, state[2])
        slipped += bool(side) and time < duration
    return state[:2], slipped


def random_tyre(rng: Random) -> Tyre:
    masses, stiffness = (rng.uniform(0.5, 3), rng.uniform(5, 40)), rng.uniform(500, 5000)
    limit = rng.uniform(40, 90), rng.uniform(-0.3, 0.3), rng.uniform(-3, 3)
    return Tyre(masses, stiffness, limit, (rng.uniform(100, 300), rng.uniform(5, 15)))


@each_seed(6, 60)
def test_random_tyres_agree_with_an_independent_integrator(seed: int) -> None:
    tyre = random_tyre(seeded(seed))
    made = simulated(*tyre.text(0.8))
    speeds, slipped = integrated(tyre, 0.8)
    assert sum(one.event == "slips" for one in made.events) == slipped
    assert made.speeds[-1] == pytest.approx(speeds, rel=1e-6, abs=1e-6)
    assert closes(made)


def test_mistakes_stand_where_they_are_made() -> None:
    case = (
        "{links: [w, v], inertias: {w: 2, v: 30}, springs: {S: {links: [w, v], stiffness: 3000}, "
        "P: {links: [w, v], points: [[0, 0], [1, 5]]}}}"
    )
    head = "duration: 1\nstart: {speeds: {w: 0, v: 0}}\n"
    for limits, place, expected in (
        ("{T: 30}", "4:10", "read 'T', expected the name of a spring: S, P"),
        ("{P: 30}", "4:10", "limits.P: read a limit of a spring with `points`, expected no limit"),
        ("{S: -3}", "4:10", "limits.S: read -3, expected a torque of 0 or more"),
        ("{S: [[0, 3], [1, -3]]}", "4:26", "read -3, expected a torque of 0 or more"),
        ("{S: sqrt(1 - 4*t)}", "4:10", "limits.S: is nan at 0.251 s, expected a number"),
        ("{S: 3 rpm}", "4:13", "limits.S: "),
    ):
        fault = faults(f"{head}limits: {limits}\n", case)[0]
        assert fault.startswith(place)
        assert expected in fault
    [fault] = faults(f"{head}limits: {{S: \"torque('S')\"}}\n", case)
    assert "`torque`" in fault
