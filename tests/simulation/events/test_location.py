"""Events that are short against a time step."""

import math

import pytest

from tests.chance import examples, seeded
from tests.simulation.control.written import simulated

STOP = "inertias: {a: 1}\nsprings: {stop: {links: [a], points: [[-1, -1e6], [0, 0], [1, 0]]}}\n"


@examples(15, 60, 1000)
def test_a_stop_that_is_touched_for_a_moment_is_not_passed(examples: int) -> None:
    """A step over several zeros must find the first (https://github.com/scipy/scipy/issues/9228).

    A torque turns a drum of 1 kg*m^2 back just below an elastic stop (w = 1000 rad/s). From contact
    at the speed v, the drum returns after 2 atan(v w/torque)/w with the speed v.
    """
    rng = seeded(73)
    for _ in range(examples):
        torque, depth = rng.choice((1, 5, 20)), 10 ** rng.uniform(-6, -2)
        away = -torque * rng.uniform(0.1, 9.9)
        angle = away**2 / (2 * torque) - depth
        start = f"start: {{speeds: {{a: {away!r}}}, angles: {{a: {angle!r}}}}}"
        speed = math.sqrt(2 * torque * depth)
        contact = 2 * math.atan(speed * 1000 / torque) / 1000
        expected = speed + torque * (10 - (-away - speed) / torque - contact)
        motion = simulated(f"duration: 10\n{start}\ntorques: {{a: {torque}}}\n", STOP)
        assert motion.speeds[-1, 0] == pytest.approx(expected, rel=1e-8)


def test_a_condition_that_is_true_for_a_moment_is_met() -> None:
    """The state 5 t - t^2 exceeds 6.24 from 2.4 s to 2.6 s."""
    for duration in (4, 10, 100):
        motion = simulated(f"""duration: {duration}
start: {{speeds: {{a: 0}}}}
set: {{n: 0}}
states: {{x: {{rate: "5 - 2*t"}}}}
sequences: {{s: [{{when: "x > 6.24", set: {{n: 1}}}}]}}
""", "inertias: {a: 1}")  # fmt: skip
        assert [event.time for event in motion.events] == pytest.approx([2.4])
