"""Control states that rest at a jump of their own rate, as Filippov's convex combination demands.

Sources of the cases: github.com/OpenModelica/OpenModelica/issues/9711 and 12621,
github.com/mtiller/ModelicaBook/issues/205.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import seeded, some
from tests.simulation.control.written import simulated

START = "duration: 2\nstart: {speeds: {a: 0}}\ntorques: {a: x}\n"
RATES = [
    ("-2*sign(x)", 0.3, 0.15 * 0.3 / 2),
    ("-2*sign(x)*sqrt(abs(x))", 0.3, 0.3**1.5 / 3),
    ("1 - 2*(x >= 0)", 1.0, 0.5),
    ("1 - 1.01*(x > 0.5)", 0.0, 0.125 + 0.75),
    ("1 - 2*(x^2 > 0.25)", 0.0, 0.125 + 0.75),
    ("t - sign(x)", 0.0, 1 / 6),
]


@pytest.mark.parametrize(("rate", "begin", "integral"), RATES)
def test_a_state_rests_at_a_jump_to_which_both_sides_lead(
    rate: str, begin: float, integral: float
) -> None:
    """The inertia is 1 kg*m^2, so the speed is the integral of the state, in closed form."""
    motion = simulated(
        f'{START}states: {{x: {{rate: "{rate}", start: {begin}}}}}\n', "inertias: {a: 1}\n"
    )
    assert motion.speeds[-1] == pytest.approx([integral], abs=1e-8)


@pytest.mark.parametrize("seed", some([*range(60)]))
def test_states_rest_at_jumps_and_leave_them(seed: int) -> None:
    """The reference is Radau of scipy with the sign smoothed over 1e-7."""
    rng = seeded(seed)
    drive, gain, point, power = (
        rng.choice([0.3, 1.0, 2.5]), rng.choice([0.5, 1.5, 3.0]), rng.choice([0.0, 0.2, -1.0]),
        rng.choice([0.0, 0.0, 0.5, 1.0]),
    )  # fmt: skip
    wave, begin, drag = rng.choice([2, 5, 9]), rng.choice([-1.0, 0.0, 0.2, 1.0]), rng.choice([0, 1])
    rate = f"{drive}*sin({wave}*t) - {gain}*sign(x - {point})*abs(x - {point})^{power}"
    given = f"{START}states: {{x: {{rate: \"{rate} - {drag}*speed('a')\", start: {begin}}}}}\n"
    motion = simulated(given, "inertias: {a: 1}\n")

    def change(t: float, y: np.ndarray) -> list[float]:
        apart = y[0] - point
        pull = gain * np.tanh(apart / 1e-7) * abs(apart) ** power
        return [drive * np.sin(wave * t) - pull - drag * y[1], y[0]]

    smooth = solve_ivp(change, (0, 2), [begin, 0], "Radau", rtol=1e-9, atol=1e-11, max_step=0.05)
    assert motion.speeds[-1] == pytest.approx(smooth.y[1, -1:], abs=1e-5)


def test_another_formula_has_the_mean_of_a_jump_at_which_a_state_rests() -> None:
    """From 0.5 s on, x = 0.5 and half of the comparison is true."""
    states = 'states: {x: {rate: "1 - 2*(x > 0.5)", start: 0}}\n'
    given = START.replace("x}", '"x + (x > 0.5)"}') + states
    motion = simulated(given, "inertias: {a: 1}\n")
    assert motion.speeds[-1] == pytest.approx([0.125 + 1.5], abs=1e-7)
