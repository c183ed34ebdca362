"""Times at which links reach speeds, or come to rest: closed forms, linear systems."""

import math

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.simulation.control.written import simulated

FREE_SET = """
inertias: {{in: {0}, ring: {1}, out: {2}}}
mechanisms: {{s: {{first: in, second: ring, third: out, ratio: {ratio}}}}}
shift_elements: {{B: {{links: [ring, housing], capacity: 1 kN*m}}}}
"""
"""A set whose ring gear is braked while the other links continue to turn."""


def run_of(first: float, third: float, brake: float, duration: float) -> str:
    start = f"start: {{speeds: {{in: {first}, out: {third}}}}}"
    return f"duration: {duration}\n{start}\ncontrols: {{B: {brake}}}\n"


def time_to_rest(
    inertias: list[float], ratio: float, first: float, third: float, brake: float
) -> float:
    ring = (first + (ratio - 1) * third) / ratio
    column = np.array([1, -ratio, ratio - 1])
    matrix = np.block([[np.diag(inertias), column[:, None]], [column, np.zeros(1)]])
    change = np.linalg.solve(matrix, [0, -brake * np.sign(ring), 0, 0])
    return float(-ring / change[1])


def test_a_target_of_0_is_reached_when_a_brake_holds_the_link() -> None:
    rng = seeded(71)
    for _ in range(count(20, 300)):
        inertias = [round(rng.uniform(0.1, 3), 3) for _ in range(3)]
        speeds = round(rng.uniform(-300, 300), 2), round(rng.uniform(-50, 50), 3)
        ratio, brake = round(rng.uniform(-4, -1.3), 3), round(rng.uniform(20, 200), 1)
        expected = time_to_rest(inertias, ratio, *speeds, brake)
        text = run_of(*speeds, brake, 2 * expected) + "targets: {ring: [0]}\n"
        [target] = simulated(text, FREE_SET.format(*inertias, ratio=ratio)).reached
        assert target.time == pytest.approx(expected, rel=1e-9)


def test_a_target_that_is_reached_at_the_end_counts() -> None:
    text = "duration: 1\nstart: {speeds: {ring: 10}}\ncontrols: {B: 10}\ntargets: {ring: [0]}\n"
    case = "inertias: {ring: 1}\nshift_elements: {B: [ring, housing]}\n"
    [target] = simulated(text, case).reached
    assert (target.time, target.angle) == pytest.approx((1, 5))


def test_a_target_below_a_short_peak_is_reached() -> None:
    """With 5 - 2 t on 1 kg*m^2 the speed 5 t - t^2 is 6 at 2 s and 3 s, and at most 6.25."""
    start = 'start: {speeds: {a: 0}}\ntorques: {a: "5 - 2*t"}\n'
    for duration in (4, 10, 100):
        text = f"duration: {duration}\n{start}targets: {{a: [6, 6.2499, 6.26]}}\n"
        times = [target.time for target in simulated(text, "inertias: {a: 1}").reached]
        assert times == pytest.approx([2, 2.49, math.nan], nan_ok=True)


def test_the_first_of_several_times_counts() -> None:
    """With 3 N*m on the smaller of two inertias, its speed is t + 2/w sin(w t), w^2 = 75."""
    case = "inertias: {a: 1, b: 2}\nsprings: {s: {links: [a, b], stiffness: 50}}\n"
    start = "duration: 20\nstart: {speeds: {a: 0, b: 0}}\ntorques: {a: 3}\n"
    times, omega, rng = np.linspace(0, 20, 200_001), math.sqrt(75), seeded(72)
    speeds = times + 2 / omega * np.sin(omega * times)
    targets = [round(rng.uniform(0.1, 19), 3) for _ in range(count(40, 400))]
    reached = simulated(f"{start}targets: {{a: {targets}}}\n", case).reached
    expected = [times[np.argmax(speeds >= target)] for target in targets]
    assert [target.time for target in reached] == pytest.approx(expected, abs=2e-4)


def test_a_condition_close_to_rest_is_met() -> None:
    """Brent's method refuses ends of equal signs (https://github.com/scipy/scipy/issues/15128)."""
    inertias, ratio, first, third = [0.94, 0.518, 0.442], -3.167, 248.52, 8.16
    step = """{when: "abs(speed('ring')) < 1e-6", set: {n: 1}}"""
    text = run_of(first, third, 52.5, 30) + f"set: {{n: 0}}\nsequences: {{s: [{step}]}}\n"
    events = simulated(text, FREE_SET.format(*inertias, ratio=ratio)).events
    [time] = [event.time for event in events if event.element == "s"]
    assert time == pytest.approx(time_to_rest(inertias, ratio, first, third, 52.5), rel=1e-7)
