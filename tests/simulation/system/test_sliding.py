"""Motions that slide along jumps of formulas, as Filippov's convex combination demands.

The references are closed forms, and Radau of scipy with signs smoothed over two widths,
extrapolated to a width of 0.
"""

import math
from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import seeded, some
from tests.simulation.control.written import simulated

LINKS = "links: [a, b]\ninertias: {a: 1, b: 5}\n"
CLUTCH = LINKS + "shift_elements: {C: {links: [a, b]}}\n"
Smooth = Callable[[float, Any, Callable[[float], float]], list[float]]


def extrapolated(change: Smooth, begin: list[float], duration: float, widest: float = 1e-3) -> Any:
    """Return final values of ``dy/dt = change(t, y, sign)``, extrapolated to an exact sign."""

    def final(width: float) -> Any:
        def smooth(t: float, y: Any) -> list[float]:
            return change(t, y, lambda apart: math.tanh(apart / width))

        steps: Any = {"rtol": 1e-8, "atol": 1e-9, "max_step": 0.02}
        return solve_ivp(smooth, (0, duration), begin, "Radau", **steps).y[:, -1]

    narrow = final(widest / 10)
    return narrow + (narrow - final(widest)) / 9


@pytest.mark.parametrize("least", [0, 40])
def test_a_slide_with_a_clipped_control_ends_where_the_clutch_would_have_to_drive(
    least: int,
) -> None:
    """From 1 s on the torque falls to -900 N*m: the clutch opens at 0 N*m, closes at no slip."""
    given = f"""duration: 1.02
start: {{speeds: {{a: 100, b: 0}}}}
controls: {{C: "300*(slip('C') > 20) - {least}"}}
torques: {{a: [[0, 50], [1, 50], [1.01, -900]]}}
"""
    begin = 80 / (310 - 1.2 * least)
    free = 1 + 50 / 95000
    last = 20 + (60 - 0.2 * least) * begin + 50 / 6 * (1 - begin) + 25 / 6 * (free - 1)
    fall = 95000 / 2 * (1.01 - free) ** 2 + 900 * 0.01
    assert simulated(given, CLUTCH).speeds[-1] == pytest.approx([last - fall, last - 20], rel=1e-8)


BRAKE = "links: [a]\ninertias: {a: 1}\nshift_elements: {B: {links: [a, housing]}}\n"
GEARED = BRAKE.replace("[a]", "[a, b]") + "mechanisms: {m: {first: a, second: b, ratio: -0.5}}\n"


@pytest.mark.parametrize("case", [BRAKE, GEARED])
@pytest.mark.parametrize(
    ("control", "below", "above"),
    [
        ("25 - 15*sign(2*speed('a'))", 40, 10),
        ("60*(speed('a') > 0)", 0, 60),
        ("30*(abs(slip('B')) > 0)", 30, 30),
    ],
)
def test_a_brake_that_depends_on_its_direction_holds_with_the_torques_of_both_directions(
    control: str, below: float, above: float, case: str
) -> None:
    if case == GEARED:
        control = control.replace("speed('a')", "-speed('b')")

    def change(t: float, y: Any, sign: Callable[[float], float]) -> list[float]:
        side = sign(y[0])
        return [30 + 40 * math.sin(9 * t) - (above * (1 + side) - below * (1 - side)) / 2]

    given = f"""duration: 1.1
start: {{speeds: {{a: -3}}}}
controls: {{B: "{control}"}}
torques: {{a: [30, "40*sin(9*t)"]}}
"""
    motion = simulated(given, case)
    assert motion.speeds[-1, 0] == pytest.approx(extrapolated(change, [-3.0], 1.1)[0], abs=1e-4)


@pytest.mark.parametrize("slip", [2, 8])
def test_a_slip_that_a_sequence_changes_is_reached_and_held(slip: int) -> None:
    """The momentum is 20 + 50 t in any case."""
    given = f"""duration: 2
start: {{speeds: {{a: 20, b: 0}}}}
set: {{k: 5}}
sequences: {{s: [{{when: t >= 1, set: {{k: {slip}}}}}]}}
controls: {{C: "300*(slip('C') > k)"}}
torques: {{a: 50}}
"""
    speeds = [20 + 5 * slip / 6, 20 - slip / 6]
    assert simulated(given, CLUTCH).speeds[-1] == pytest.approx(speeds, rel=1e-8)


def test_formulas_in_other_words_and_of_other_links_share_the_mean_of_a_jump() -> None:
    """With the share s, dw/dt of a is 33 - 100 s, of b 15 s - 1, and dx/dt (1 + s)/2."""
    case = "links: [a, b, c]\ninertias: {a: 1, b: 5, c: 1}\n"
    given = """duration: 2
start: {speeds: {a: 0, b: 0, c: 0}}
states: {x: {start: 1, rate: "2*speed('b') < 2*speed('a')"}}
torques:
  a: ["-100*sign(speed - speed('b'))", 33]
  b: ["20 - 100*(speed >= speed('a'))", "50*(not speed('b') > speed('a'))"]
  c: x
"""
    share = 34 / 115
    speed = 2 * (33 - 100 * share)
    speeds = [speed, speed, 2 + 1 + share]
    assert simulated(given, case).speeds[-1] == pytest.approx(speeds, abs=1e-7)


def test_products_of_jumps_have_the_mean_of_their_values_on_both_sides() -> None:
    """Until 4/9 s b receives 18 N*m, then 16 N*m below the jump and 18 above, of weight 7/16."""
    of_b = "8*sign(speed('a') - 5*t)**2 + 10*max(speed('a') > 5*t, 0.8)"
    given = f"""duration: 2
start: {{speeds: {{a: 20, b: 0}}}}
torques: {{a: "-40*sign(speed - 5*t)", b: "{of_b}"}}
"""
    speed = (18 * 4 / 9 + (16 + 2 * 7 / 16) * 14 / 9) / 5
    assert simulated(given, LINKS).speeds[-1] == pytest.approx([10, speed], rel=1e-9)


TABLE = "tables: {m: [[-9, 30], [4, 30], [4, -70], [30, -70]]}\n"
CASES: list[tuple[str, Smooth, list[float]]] = [
    (
        """torques:
  a: ["20*sin(t)", "-60*sign(speed('a') - speed('b'))"]
  b: [-10, "-150*sign(speed('b') - 4*t)"]
""",
        lambda t, y, sign: [
            20 * math.sin(t) - 60 * sign(y[0] - y[1]), (-10 - 150 * sign(y[1] - 4 * t)) / 5
        ],
        [20.0, -10.0],
    ),
    (
        f"""{TABLE}torques:
  a: ["30*sin(2*t)", "m(speed('a') - speed('b'))"]
  b: "-m(speed('a') - speed('b'))"
""",
        lambda t, y, sign: [
            30 * math.sin(2 * t) - 20 - 50 * sign(y[0] - y[1] - 4),
            (20 + 50 * sign(y[0] - y[1] - 4)) / 5,
        ],
        [20.0, 0.0],
    ),
    (
        """torques:
  a: ["80*(speed('a') < 40)*(speed('b') < 30)", "-10 - 5*sin(3*t)"]
  b: ["60*(speed('b') < 30)*(0.3 + 0.7*(speed('a') < 40))", -20]
""",
        lambda t, y, sign: [
            20 * (1 - sign(y[0] - 40)) * (1 - sign(y[1] - 30)) - 10 - 5 * math.sin(3 * t),
            (30 * (1 - sign(y[1] - 30)) * (0.65 - 0.35 * sign(y[0] - 40)) - 20) / 5,
        ],
        [20.0, 20.0],
    ),
    (  # the friction of a ends while the motion slides
        """torques:
  a: [{resistance: 5}, "-2.7 - 115*(speed('a') - speed('b') > 20)"]
  b: "115*(speed('a') - speed('b') > 20) - 9"
""",
        lambda _, y, sign: [
            -2.7 - 5 * sign(y[0]) - 57.5 * (1 + sign(y[0] - y[1] - 20)),
            (57.5 * (1 + sign(y[0] - y[1] - 20)) - 9) / 5,
        ],
        [0.0, -18.5],
    ),
    (
        """torques:
  a:
    - "-20*sign(speed('a') - speed('b'))*sqrt(abs(speed('a') - speed('b')))"
    - "3*sin(5*t)"
  b: 2
""",
        lambda t, y, sign: [
            -20 * sign(y[0] - y[1]) * math.sqrt(abs(y[0] - y[1])) + 3 * math.sin(5 * t), 0.4
        ],
        [20.0, 0.0],
    ),
]  # fmt: skip


@pytest.mark.parametrize(("given", "change", "begin"), some(CASES))
def test_a_motion_slides_along_jumps_also_where_they_meet(
    given: str, change: Smooth, begin: list[float]
) -> None:
    start = f"duration: 2\nstart: {{speeds: {{a: {begin[0]}, b: {begin[1]}}}}}\n"
    motion = simulated(start + given, LINKS)
    assert motion.speeds[-1] == pytest.approx(extrapolated(change, begin, 2), abs=1e-5)


SWITCHES = [
    "-{0}*sign({1})",
    "{0}*({1} < 0) - {0}*(0 <= {1})",
    "-{0}*({1} > 0) + {0}*(not {1} > 0)",
]
"""One relay in several words."""
SPRUNG = "springs: {s: {links: [a, b], stiffness: 60, damping: 3}}\n"


def random_relays(rng: Random) -> tuple[str, Smooth, list[float]]:
    """Links a and b with a relay each, a spring between, and a state that reads the first relay."""
    weight, place, target = rng.choice([0.0, 0.5, -1.0]), rng.choice([3, 8]), rng.choice([5, 12])
    by_state, product = rng.choice([0, 1]), rng.choice([0.0, 0.4])
    first, second = rng.choice([40, 90]), rng.choice([60, 200])
    wave, drive, load = rng.choice([2, 5]), rng.choice([10, 30]), rng.choice([-15, 20])
    begin = [rng.choice([0.0, 25.0]), rng.choice([-5.0, 10.0]), 0.0, 0.0, 0.0]
    by_angle, words = rng.choice([0, 2]), rng.choice(SWITCHES)
    apart = f"speed('a') + {weight}*speed('b') - {place} - {by_state}*x"
    less = f"*(1 - {product}*({apart} > 0))" if product else ""
    other = f"(speed - {target} - sin(t) + {by_angle}*angle)"
    text = f"""states: {{x: {{rate: "3 - 0.4*x + 2*({apart} > 0)"}}}}
torques:
  a: ["{drive}*sin({wave}*t)", "{words.format(first, f"({apart})")}"]
  b: [{load}, "({words.format(second, other)}){less}"]
"""

    def change(t: float, y: Any, sign: Callable[[float], float]) -> list[float]:
        side = sign(y[0] + weight * y[1] - place - by_state * y[2])
        held = second * sign(y[1] - target - math.sin(t) + by_angle * y[4])
        sprung = 60 * (y[3] - y[4]) + 3 * (y[0] - y[1])
        pulled = load - held * (1 - product * (1 + side) / 2) + sprung
        driven = drive * math.sin(wave * t) - first * side - sprung
        return [driven, pulled / 5, 4 - 0.4 * y[2] + side, y[0], y[1]]

    return text, change, begin


@pytest.mark.parametrize("seed", some([*range(40)]))
def test_random_relays_agree_with_smoothed_signs(seed: int) -> None:
    text, change, begin = random_relays(seeded(seed))
    start = f"duration: 1.5\nstart: {{speeds: {{a: {begin[0]}, b: {begin[1]}}}}}\n"
    motion = simulated(start + text, LINKS + SPRUNG)
    expected = extrapolated(change, begin, 1.5, 1e-4)[:2]
    assert motion.speeds[-1] == pytest.approx(expected, abs=3e-5)  # the error of the reference


def test_a_margin_of_infinite_slope_does_not_have_earlier_events_without_end() -> None:
    """The momentum changes by 62 N*m until the angle of a is 1/2, and then by -18 N*m."""
    apart = "slip('C') + sin(3*t)"
    given = f"""duration: 0.7
start: {{speeds: {{a: 20, b: 0}}}}
controls: {{C: "20 + abs(9*sign({apart})*sqrt(abs({apart})))"}}
torques: {{a: "-40*sign(2*angle - 1)", b: 22}}
"""
    motion = simulated(given, CLUTCH)
    time, speed = motion.time, motion.speeds[:, 0]
    angle = np.append(0.0, np.cumsum(np.diff(time) * (speed[1:] + speed[:-1]) / 2))
    momentum = 20 - 18 * 0.7 + 80 * np.interp(0.5, angle, time)
    assert motion.speeds[-1] @ [1, 5] == pytest.approx(momentum, abs=1e-3)


HOT = "friction: {radius: 1, area: 1, surfaces: 1, coefficient: 1, heat_capacity: 20, cooling: 20}"
QUICK: list[tuple[str, str, Any, list[float]]] = [
    (
        "states: {x: {rate: \"300 - 400*(acceleration('a') > 20)\"}}\ntorques: {a: x}\n",
        CLUTCH,
        lambda t, _: [min(300 * t, 20), 0],
        [0.0, 0.0],
    ),
    (
        "states: {x: {rate: \"100 - 300*(torque('C') > 40)\"}}\n"
        "controls: {C: x}\ntorques: {a: 50}\n",
        CLUTCH,
        lambda t, _: [50 - min(100 * t, 40), min(100 * t, 40) / 5],
        [100.0, 0.0],
    ),
    (
        "controls: {C: \"40*(temperature('C') < 40)\"}\ntorques: {a: 60}\n",
        CLUTCH.replace("[a, b]}", f"[a, b], {HOT}}}"),
        lambda _, y: [60 - (held := 40 if y[2] < 40 else 800 / (y[0] - y[1])), held / 5,
                      (held * (y[0] - y[1]) - 20 * y[2]) / 20],
        [50.0, 0.0, 0.0],
    ),
]  # fmt: skip


@pytest.mark.parametrize(("given", "case", "change", "begin"), QUICK)
def test_a_motion_slides_along_jumps_over_accelerations_torques_and_temperatures(
    given: str, case: str, change: Any, begin: list[float]
) -> None:
    """References: 20 rad/s^2, 40 N*m and 800 W are held from the first jump on."""
    start = f"duration: 0.8\nstart: {{speeds: {{a: {begin[0]}, b: 0}}}}\n"
    exact = solve_ivp(change, (0, 0.8), begin, rtol=1e-9, max_step=1e-3).y[:2, -1]
    assert simulated(start + given, case).speeds[-1] == pytest.approx(exact, abs=1e-3)


SPIRALS = [
    ('duration: 8\ntorques: {a: "10 - 9*speed - 20*(sin(2*angle) > 0)"}\n', [0.0, 0.0]),
    (
        "duration: 1\nstates: {x: {rate: \"(300*(slip('C') > 20) - x)/0.02\"}}\n"
        "controls: {C: x}\ntorques: {a: 50}\n",
        [250 / 6, 250 / 6 - 20],
    ),
]


@pytest.mark.parametrize(("given", "speeds"), SPIRALS)
def test_a_motion_that_switches_faster_and_faster_comes_to_rest_on_the_jump(
    given: str, speeds: list[float]
) -> None:
    """A damped motion bounces against a wall; a relay behind a lag holds a slip of 20 rad/s."""
    motion = simulated(f"{given}start: {{speeds: {{a: 100, b: 0}}}}\n", CLUTCH)
    assert motion.speeds[-1] == pytest.approx(speeds, abs=1e-4)


@pytest.mark.parametrize(
    "share",
    ["((4*(slip('C') - 10) + i < 100) or slip('C') < 10)", "(0.3 + 0.7*(slip('C') < 10))"],
)
def test_a_controller_at_rest_on_a_comparison_that_changes_nothing_goes_on(share: str) -> None:
    """At a slip of 10 rad/s, the rate does not jump; the final speeds follow from momentum."""
    given = f"""duration: 10
start: {{speeds: {{a: 50, b: 0}}}}
states: {{i: {{rate: "60*(slip('C') - 10)*{share}"}}}}
controls: {{C: "min(max(4*(slip('C') - 10) + i, 0), 100)"}}
torques: {{a: 20, b: -5}}
"""
    speeds = [190 / 6 + 10, 190 / 6]
    assert simulated(given, CLUTCH).speeds[-1] == pytest.approx(speeds, abs=1e-7)
