"""States that rest at corners and jumps of rates, and leave them in mid-run.

A lag leads to the corner of a formula, the formula to a state, and the state to a control or a
torque. Expected numbers are closed forms, or come from scipy with separate equations. Sources
of jumps of a state's own rate: github.com/OpenModelica/OpenModelica/issues/9711 and 12621,
github.com/mtiller/ModelicaBook/issues/205.
"""

import math
from random import Random
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import count, seeded, some, with_slow
from tests.simulation.control.written import simulated

CASE = "links: [a, b]\ninertias: {a: 0.3, b: 0.6}\nshift_elements: {C: {links: [a, b]}}\n"


@pytest.mark.parametrize("jump", ["t > 1", "t >= 1"])
def test_a_rate_that_jumps_by_the_time_fills_a_clutch_as_a_root(jump: str) -> None:
    """The slip is 100 - (1/0.3 + 1/0.6) 40 (2/3) (t - 1)^(3/2) from 1 s on."""
    start = "duration: 2\nstart: {speeds: {a: 100, b: 0}}\n"
    states = f'states: {{q: {{rate: "({jump})"}}}}\n'
    motion = simulated(f'{start}{states}controls: {{C: "40*sqrt(q)"}}\n', CASE)
    [locks] = motion.events
    assert locks.time == pytest.approx(1 + 0.75 ** (2 / 3), abs=1e-9)


class Chain(NamedTuple):
    """States one behind the other, and what the last one does."""

    states: dict[str, tuple[str, float]]
    """Rate and start."""
    table: list[list[float]]
    control: str
    torque: str

    def scenario(self, duration: float) -> str:
        """The scenario, as it is written."""
        lines = [f'  {n}: {{rate: "{rate}", start: {x}}}' for n, (rate, x) in self.states.items()]
        head = f"duration: {duration!r}\nstart: {{speeds: {{a: 50, b: 0}}}}"
        torques = f'torques: {{a: "{self.torque}", b: "2 - speed"}}'
        control = f'controls: {{C: "{self.control}"}}'
        return "\n".join(
            [head, f"tables: {{fill: {self.table}}}", "states:", *lines, control, torques]
        )

    def integrated(self) -> tuple[float, np.ndarray]:
        """Time and speeds at 1 s, or shortly before the clutch locks, by DOP853."""
        texts = [self.control, self.torque, *(rate for rate, _ in self.states.values())]
        codes = [compile(one.replace("^", "**"), "formula", "eval") for one in texts]
        x, y = zip(*self.table, strict=True)
        known = {
            "max": max, "min": min, "abs": abs, "sqrt": lambda m: math.sqrt(max(m, 0.0)),
            "fill": lambda at: float(np.interp(at, x, y)),
        }  # fmt: skip

        def change(_t: float, now: np.ndarray) -> list[float]:
            _, b, *states = now.tolist()
            seen = {"speed": lambda _of: b, **dict(zip(self.states, states, strict=True))}
            carried, drive, *rates = (eval(one, known, seen) for one in codes)  # noqa: S307
            return [(drive - carried) / 0.3, (2 - b + carried) / 0.6, *rates]

        def slip(_t: float, now: np.ndarray) -> float:
            return float(now[0] - now[1]) - 5

        slip.terminal = True  # type: ignore[attr-defined] # as scipy asks for
        start = [50.0, 0.0, *(one for _, one in self.states.values())]
        found = solve_ivp(
            change, (0, 1), start, "DOP853", events=slip, rtol=1e-11, atol=1e-13, max_step=0.02
        )
        return float(found.t[-1]), found.y[:2, -1]


def chain(rng: Random) -> Chain:
    """A random chain: what feeds a corner, the corner, one or two states behind it."""

    def number(low: float, high: float) -> float:
        return round(rng.uniform(low, high), 3)

    kink, start = number(0.1, 0.4), rng.choice([0.0, 0.0, number(-0.5, 0.0)])
    states = {"u": (f"({number(0.7, 1.5)} - u)/{number(0.2, 1)}", start)}
    word = rng.choice(["u", "u", "v", "speed('b')"])
    if word == "v":
        states["v"] = f"(u - v)/{number(0.05, 0.3)}", start
    above = f"max({word} - {kink}, 0)"
    forms = (
        "{0}; abs({1} - {2}) + {1} - {2}; {1} - min({1}, {2}); fill({1}); {0}*(1 + u); "
        "{0}*max({1} - {3}, 0); {0}^2; ({1} > {2}); ({1} > {2})*({1} - {2})"
    )
    corner = rng.choice(forms.format(above, word, kink, kink + 0.1).split("; "))
    speed, last = number(1, 20), "m"
    states["m"] = rng.choice([f"{speed}*({corner})", f"{speed}*({corner} - m)"]), 0.0
    if rng.random() < 0.3:
        states["n"], last = (f"{number(1, 20)}*(m - n)", 0.0), "n"
    size = number(1, 60)
    root = f"sqrt(max({last}, 0))" if "abs" in corner else f"sqrt({last})"  # rounding is left of it
    effect = rng.choice([last, f"1 + {last}", f"{size}*{last}", f"{size}*{root}"])
    table = [[-1.0, 0.0], [kink, 0.0], [3.0, number(1, 9)]]
    control, torque = rng.choice([(effect, "0"), ("0", effect)])
    return Chain(states, table, control, torque)


@pytest.mark.parametrize(
    "seed", with_slow([0, 1, 2, 3, 14], [*range(4, 14), *range(15, count(100, 1000))])
)
def test_a_chain_of_lags_over_a_corner_agrees_with_dop853(seed: int) -> None:
    given = chain(seeded(seed))
    end, speeds = given.integrated()
    motion = simulated(given.scenario(end), CASE)
    assert motion.speeds[-1] == pytest.approx(speeds, abs=2e-7)


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
