"""What rests on a corner of a formula, a table, a state or a control, and leaves it smoothly.

Expected numbers are closed forms, or come from solvers of scipy with equations of their own.
"""

import math
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from tests.chance import count, seeded, some
from tests.simulation.control.smooth import integrated, smooth
from tests.simulation.control.smooth_rows import smooth_loop, smooth_row
from tests.simulation.control.written import simulated, written
from vstatics.simulation import Motion, simulate

START = "duration: 1\nstart: {speeds: {a: 50, b: 10}}\n"
ONE_TO_FIVE = "links: [a, b]\ninertias: {a: 1, b: 5}\nshift_elements: {C: {links: [a, b]}}\n"


def check_impulse(motion: Motion, impulse: float, near: float = 1e-9) -> None:
    """Check the speeds after an impulse of the clutch between 1 and 5 kg*m^2 [N*m*s]."""
    assert motion.speeds[-1] == pytest.approx([50 - impulse, 10 + impulse / 5], rel=near)


FORMS = ["{}", "max({}, 0)", "abs({})", "line({})", "map({}, t)", "min({}, 0.5 + {})"]
POWERS = [*product(FORMS, ["", ", min: 0"], range(1, 7), [0.0, 0.3])]


@pytest.mark.parametrize(
    ("form", "least", "order", "begin"),
    [pytest.param(*one, marks=[pytest.mark.slow] * (n % 29 > 0)) for n, one in enumerate(POWERS)],
)
def test_a_control_leaves_zero_as_any_power_of_time(
    form: str, least: str, order: int, begin: float
) -> None:
    """States one behind the other are powers of the time, divided by factorials."""
    states = [f"x1: {{rate: 't >= {begin}', start: 0{least}}}"]
    states += [f"x{n}: {{rate: 'x{n - 1}', start: 0{least}}}" for n in range(2, order + 1)]
    control = form.replace("{}", f"x{order}")
    tables = "{line: [[0, 0], [2, 2]], map: {columns: [0, 9], rows: [[0, 0, 0], [2, 2, 2]]}}"
    states_and_control = f'states: {{{", ".join(states)}}}\ncontrols: {{C: "7*{control}"}}\n'
    motion = simulated(f"{START}tables: {tables}\n{states_and_control}", ONE_TO_FIVE)
    check_impulse(motion, 7 * (1 - begin) ** (order + 1) / math.factorial(order + 1))


@pytest.mark.parametrize("begin", [0.0, 0.3])
@pytest.mark.parametrize("least", ["", ", min: 0"])
def test_a_relay_switches_as_a_lag_leaves_its_limit(least: str, begin: float) -> None:
    """The lag follows max(t - begin, 0), so it is above 0 after `begin`, and C carries 7 N*m."""
    states = f"states: {{x: {{rate: '(max(t - {begin}, 0) - x)/0.2'{least}}}}}\n"
    motion = simulated(f"{START}{states}controls: {{C: 7*(x > 0)}}\n", ONE_TO_FIVE)
    check_impulse(motion, 7 * (1 - begin), 1e-8)


@pytest.mark.parametrize(("power", "sign"), [(2, 1), (2, -1), (3, 1), (4, 1), (4, -1)])
def test_a_corner_that_is_touched_or_passed_with_zero_slope(power: int, sign: int) -> None:
    """The state is sign (t - 0.4)^power, so the control is its positive part."""
    rate, start = f"{sign * power}*(t - 0.4)^{power - 1}", sign * (-0.4) ** power
    states = f'states: {{x: {{start: {start}, rate: "{rate}"}}}}\n'
    control = 'controls: {C: "30*max(x, 0) + 20*abs(x)"}\n'
    motion = simulated(START + states + control, ONE_TO_FIVE)

    def capacity(t: float) -> float:
        x = sign * (t - 0.4) ** power
        return 30 * max(x, 0) + 20 * abs(x)

    check_impulse(motion, quad(capacity, 0, 1, points=[0.4], epsabs=1e-13)[0])


TABLES = [
    [[0, 200], [400, 100]],
    [[0, 0], [50, 40], [200, 300]],
    [[0, 100], [2, 0], [50, -20]],
    [[-10, 0], [0, 0], [10, 90]],
]


OVER = [*product(TABLES, ["speed"], [0, 2, 50]), *product(TABLES, ["angle", "time"], [0])]


@pytest.mark.parametrize(("points", "over", "start"), some(OVER))
def test_a_table_is_the_same_as_points(points: Any, over: str, start: float) -> None:
    """A clutch begins to drive a link that rests on a point, or is on one at the start."""
    word = "t" if over == "time" else over
    given = START.replace("a: 50, b: 10", f"a: 100, b: {start}") + f"tables: {{m: {points}}}\n"
    given += "controls: {C: [[0, 0], [1, 300]]}\n"
    laws = f'"m({word})"', f"{{over: {over}, points: {points}}}"
    first, second = (simulated(f"{given}torques: {{b: {law}}}\n", ONE_TO_FIVE) for law in laws)
    assert first.speeds[-1] == pytest.approx(second.speeds[-1], rel=1e-8)
    events = [[(one.event, one.time) for one in motion.events] for motion in (first, second)]
    assert [one for one, _ in events[0]] == [one for one, _ in events[1]]
    assert [at for _, at in events[0]] == pytest.approx([at for _, at in events[1]], abs=1e-8)


JUMPS_OF_LIMITS = [
    "400 + 500*(speed('wheel') - speed('road') > 10)",
    *some([f"400 + 500*(speed('wheel') - speed('road') > {n})" for n in (9.99, 5, 20)]),
    "300 + 500*(twist('tyre') < 0.02)",
    *some(["300 + 500*(abs(twist('tyre')) < 0.02)", "250 + 400*(twist('tyre') < 0.017)"]),
]


@pytest.mark.parametrize("text", JUMPS_OF_LIMITS)
def test_an_undamped_limit_that_jumps_with_its_own_motion_is_reported(text: str) -> None:
    case = """inertias: {wheel: 1.2, road: 40}
springs: {tyre: {links: [wheel, road], stiffness: 20000}}
"""
    start = "duration: 2\nstart: {speeds: {wheel: 0, road: 0}}\n"
    given = f'torques: {{wheel: [[0, 0], [1, 900]]}}\nlimits: {{tyre: "{text}"}}\n'
    motion = simulate(written(start + given, case))
    assert motion.stopped is not None
    assert (motion.stopped.id, motion.stopped.path) == ("E601", ("limits", "tyre"))
    assert text[:30] in motion.stopped.message
    assert "replace the jump with a ramp" in motion.stopped.message


@pytest.mark.slow
def test_a_relay_of_constant_period_goes_on() -> None:
    """A state with x'' = 60 - 120 (x > 0) moves along parabolas of equal length."""
    states = 'states: {v: {rate: "60 - 120*(x > 0)"}, x: {start: 0.012, rate: v}}\n'
    given = START.replace("duration: 1", "duration: 4") + states
    motion = simulated(f'{given}controls: {{C: "5 + 2*(x > 0)"}}\n', ONE_TO_FIVE)
    # from a crest to the zero 60 q^2/2 = 0.012, so q = 0.02; x > 0 in half of 50 periods 4 q
    check_impulse(motion, 4 * 6, 1e-7)


def test_a_clutch_of_a_loop_has_no_events_while_its_links_are_held_together() -> None:
    """C and D hold a and d together, so E has no slip, and F no capacity.

    Of the torque 30 t on c, the other links take three quarters, which H passes on up to 3 N*m.
    """
    motion = simulated(
        "duration: 0.5\nstart: {speeds: {a: 5, b: 5, c: 5, d: 5}}\n"
        'controls: {C: 50, D: "40 + t", E: "abs(slip(\'H\'))", F: "20*abs(slip(\'E\'))", H: 3}\n'
        "torques: {c: [[0, 0], [1, 30]]}\n",
        "links: [a, b, c, d]\ninertias: {a: 1, b: 1, c: 1, d: 1}\n"
        "shift_elements: {C: [a, b], D: [b, d], E: [a, d], F: [a, c], H: [c, d]}\n",
    )
    begin, end = 3 / 0.75 / 30, 0.5
    others = 15 * begin**2 / 4 + 3 / 3 * (end - begin)
    last = 15 * begin**2 / 4 + 15 * (end**2 - begin**2) - 3 * (end - begin)
    assert [(one.element, one.event) for one in motion.events] == [("F", "slips"), ("H", "slips")]
    assert [one.time for one in motion.events] == pytest.approx([begin] * 2, abs=1e-9)
    speeds = [5 + others, 5 + others, 5 + last, 5 + others]
    assert motion.speeds[-1] == pytest.approx(speeds, abs=1e-9)


@pytest.mark.parametrize(
    ("kind", "seed"),
    [
        pytest.param(kind, n, marks=[pytest.mark.slow] * (n != 2))
        for kind, few in ((smooth, 300), (smooth_row, 100), (smooth_loop, 60))
        for n in range(count(few, 10 * few))
    ],
)
def test_random_scenarios_that_start_on_corners_agree_with_an_implicit_solver(
    kind: Any, seed: int
) -> None:
    given = kind(seeded(seed))
    motion = simulated(given.scenario, given.case)
    speeds = integrated(given)
    accuracy = 1e-3 if kind is smooth_loop else 1e-4  # of creep, which laws of slip take up there
    assert motion.speeds[-1] == pytest.approx(speeds, abs=accuracy * max(1, np.abs(speeds).max()))


@pytest.mark.parametrize(
    "duration", [*(pytest.param(n, marks=pytest.mark.slow) for n in (1e7, 4e8)), 1e12]
)
def test_a_run_of_many_years_goes_on_as_a_short_one(duration: float) -> None:
    """It is stopped after 60 s: steady swings of 2 dw/dt = 20 sin 3t - w, a closed form."""
    start = f"duration: {duration}\nstart: {{speeds: {{e: 0, o: 0}}}}\ncontrols: {{C: 0}}\n"
    scenario = written(f'{start}torques: {{e: "20*sin(3*t) - speed"}}\n')
    motion = simulate(scenario, watch=lambda time: "enough" if time > 60 else "")
    assert motion.stopped is not None
    assert motion.stopped.id == "E604"
    times, speeds = motion.time, motion.speeds[:, 0]
    swings = 20 / 37 * (np.sin(3 * times) - 6 * np.cos(3 * times)) + 120 / 37 * np.exp(-times / 2)
    assert speeds == pytest.approx(swings, abs=1e-7)


FREE = """links: [a, b, c, d]
inertias: {a: 3, b: 1.5, c: 0.5, d: 0.6}
shift_elements: {C: {links: [a, b]}, D: {links: [b, c]}, F: {kind: freewheel, links: [c, d]}}
"""
GRIPS = ["max(slip('D') - 2, 0)", "max(slip('D') - 2, 0)^1.5", "(slip('D') > 2)*(slip('D') - 2)^2"]


@pytest.mark.parametrize(("first", "begin"), [("16", 0.0), ("[[0, 0], [0.1, 16]]", 0.05)])
@pytest.mark.parametrize("grip", GRIPS)
def test_a_freewheel_without_torque_waits_for_a_corner(first: str, begin: float, grip: str) -> None:
    """C accelerates b by 16/1.5 rad/s^2, so D grips from a slip of 2 rad/s on and opens F."""
    start = "duration: 0.4\nstart: {speeds: {a: 20, b: 5, c: 5, d: 5}}\n"
    motion = simulated(f'{start}controls: {{C: {first}, D: "{grip}"}}\n', FREE)
    [slips] = [event.time for event in motion.events if event.event == "slips"]
    assert slips == pytest.approx(begin + 2 * 1.5 / 16, abs=1e-8)


@pytest.mark.parametrize("flow", ["sqrt(x)", "x^0.5"])
def test_a_state_rests_at_a_limit_beyond_which_its_rate_is_no_number(flow: str) -> None:
    """A tank runs dry as x = (sqrt(0.3) - t)^2, so the integral of x is 0.3^1.5/3."""
    states = f'states: {{x: {{rate: "-2*{flow}", start: 0.3, min: 0}}}}\n'
    given = f"duration: 2\nstart: {{speeds: {{a: 1}}}}\n{states}torques: {{a: 2*x}}\n"
    motion = simulated(given, "inertias: {a: 2}\n")
    assert motion.speeds[-1] == pytest.approx([1 + 0.3**1.5 / 3], abs=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_a_pump_at_rest_takes_no_torque_from_any_turbine(seed: int) -> None:
    """Rounding of the gear pair moves the pump by 1e-15 rad/s, to and fro."""
    rng = seeded(seed)
    inertias = {name: round(rng.uniform(0.1, 4), 3) for name in "abc"}
    pair = f"mechanisms: {{M: {{first: b, second: c, ratio: {rng.choice([-2.5, 1.5, 0.7])}}}}}\n"
    points = "[[0, 2, 0.003], [0.85, 1, 0.002], [1, 1, 0], [1.3, 1, -0.002]]"
    start = f"start: {{speeds: {{a: 0, c: {rng.choice([-30, 30])}}}}}\n"
    given = f"duration: 1\n{start}converters: {{K: {{links: [a, b], points: {points}}}}}\n"
    motion = simulated(given, f"links: [a, b, c]\ninertias: {inertias}\n{pair}")
    assert motion.speeds[-1] == pytest.approx(motion.speeds[0], abs=1e-12)


def test_a_slip_is_kept_by_a_relay_beside_a_mechanism_with_losses() -> None:
    """The power flow of M reverses at each switch, until the motion stays at the slip of C2."""
    case = """links: [a, b, c, d, e]
inertias: {a: 3.286, b: 0.773, c: 0.197, d: 1.175, e: 5.588}
shift_elements: {C1: [a, b], C2: [b, c], C3: [d, e], D: {links: [d, e], drag: 15 N*m}}
springs: {S: {links: [a], stiffness: 200, damping: 10}}
mechanisms: {M: {first: c, second: d, ratio: 3.2, efficiency: 0.9}}
"""
    motion = simulated(
        """duration: 0.33
start: {speeds: {a: -30, b: -30, d: 0, e: -30}}
tables: {q: [[0, 0], [0.3, 40], [0.6, -40]]}
controls:
  C1: [[0.14, 80.32], [0.34, 0], [0.44, 0], [0.64, 80.32]]
  C2: [[0.27, 0], [0.37, 81.48]]
  C3: [[0, 89.76], [0.3, -20]]
torques:
  b: q(t)
  c: "40*(((2*(slip('C2') > 10) - 1) + speed('d')/60)/2)*(2 - abs(speed)/100)"
  d: ["-0.3*speed - 0.004*speed*abs(speed)", {resistance: 1.21}]
""",
        case,
    )
    slip = motion.speeds[:, 1] - motion.speeds[:, 2]
    assert np.interp([0.312, 0.317, 0.322], motion.time, slip) == pytest.approx(10, abs=1e-7)


def test_a_slide_ends_where_another_relay_removes_its_jump() -> None:
    """D carries 15 N*m, and the slip of a stays at 2 rad/s until b, free from 0.1 s on, has 0.5."""
    case = """links: [a, b]
inertias: {a: 1.5, b: 1}
shift_elements: {D: {links: [a, b], drag: 15 N*m}, B: [b, housing]}
"""
    relay = "150*max(1 - (slip('D') > 2), slip('B') > 0.5)"
    start = "duration: 0.4\nstart: {speeds: {a: 0, b: 0}}\n"
    controls = "controls: {B: [[0, 40], [0.1, 40], [0.1, 0]], D: 0}\n"
    motion = simulated(f'{start}{controls}torques: {{a: "{relay}"}}\n', case)
    end = 0.1 + 0.5 / 15
    assert motion.speeds[-1, 0] == pytest.approx(2.5 + (150 - 15) / 1.5 * (0.4 - end), rel=1e-7)


def test_a_clutch_sticks_beyond_the_speed_at_which_its_control_jumps() -> None:
    """C holds d at 1 rad/s until c has this speed; then the drag of 15 N*m moves both."""
    case = """links: [c, d, e]
inertias: {c: 0.084, d: 0.129, e: 0.104}
shift_elements: {C: [c, d], D: {links: [d, e], drag: 15 N*m}, B: [d, housing]}
"""
    motion = simulated(
        """duration: 0.03172
start: {speeds: {c: 0, d: 0, e: 0}}
controls: {C: "195*(slip('B') > 1)", D: 0}
torques: {c: "400/3*t", e: "500*t"}
""",
        case,
    )
    first = math.sqrt(2 * (0.129 + 0.104) / 500)
    pull = 200 / 3  # 200/3 t^2 + 15 (t - first) = 0.084 as c has 1 rad/s
    met = (math.sqrt(15**2 + 4 * pull * (0.084 + 15 * first)) - 15) / (2 * pull)
    beyond = (pull * (0.03172**2 - met**2) + 15 * (0.03172 - met)) / (0.084 + 0.129)
    assert motion.speeds[-1, :2] == pytest.approx(1 + beyond, rel=1e-8)


def test_a_clutch_slips_off_a_slide_as_it_reaches_its_capacity() -> None:
    """C holds b and c at rest on the jump until its capacity is below 1/2.5 of the torque of c."""
    case = """links: [a, b, c]
inertias: {a: 0.074, b: 0.244, c: 3.791}
shift_elements: {C: [a, b]}
mechanisms: {M: {first: b, second: c, ratio: -2.5}}
"""
    motion = simulated(
        """duration: 0.045
start: {speeds: {a: -1.25, c: 0.5}}
controls: {C: "206.8*(0.05 - t)"}
torques: {a: "10*(2*(speed('c') > 0.5) - 0.7)", c: "16 - 800/3*t"}
""",
        case,
    )
    rise = 2.5 * 206.8 - 800 / 3
    off = (2.5 * 206.8 * 0.05 - 16) / rise
    later = 0.5 + rise * (0.045 - off) ** 2 / 2 / (3.791 + 2.5**2 * 0.244)
    assert np.interp(off, motion.time, motion.speeds[:, 2]) == pytest.approx(0.5, rel=1e-9)
    assert motion.speeds[-1, 2] == pytest.approx(later, rel=1e-9)


def test_a_brake_holds_a_spring_at_rest_on_a_jump() -> None:
    """The torque at rest is any mean of 0 and 98 N*m, of which the brake carries up to 20 N*m."""
    motion = simulated(
        """duration: 0.5
start: {speeds: {a: 0}}
controls: {B: 20}
torques: {a: "98*(abs(twist('s')) >= abs(slip('B')))"}
""",
        "inertias: {a: 1}\nsprings: {s: {links: [a], stiffness: 1000}}\n"
        "shift_elements: {B: [a, housing]}\n",
    )
    assert motion.speeds == pytest.approx(0, abs=1e-9)
