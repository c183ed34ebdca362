"""Controls that see the box, states and temperatures: closed forms and solvers of others."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import seeded, seeds_with_slow
from tests.simulation.control.written import simulated, steps_of, written
from vstatics.simulation import simulate


@pytest.mark.parametrize("control", ["12.5*speed('x')", "p + 0*speed('e')", "p"])
def test_a_controlled_clutch_gives_its_torque_to_a_spring_over_a_link_without_inertia(
    control: str,
) -> None:
    """T = 50 t slows 2 kg*m^2 and moves 3; the spring grows with 50/2000 rad/s."""
    motion = simulated(
        f"""duration: 0.6
start: {{speeds: {{e: 100, m: 0, o: 0, x: 0}}}}
states: {{p: {{rate: 50}}}}
controls: {{C: "{control}"}}
torques: {{x: 4}}
""",
        "links: [e, m, o, x]\ninertias: {e: 2, o: 3, x: 1}\nshift_elements: {C: {links: [e, m]}}\n"
        "springs: {S: {links: [m, o], stiffness: 2000}}\n",
    )
    engine, output = 100 - 50 * 0.36 / 4, 50 * 0.36 / 6
    assert motion.speeds[-1, :3] == pytest.approx([engine, output + 50 / 2000, output], rel=1e-8)
    assert motion.torques[:, 0] == pytest.approx(motion.torques[:, 1], abs=1e-6)


CUT = """inertias: {e: 2, o: 3}
load: {speed: 100 rpm, torque: 1 N*m}
shift_elements: {C: {links: [e, o], capacity: 200 N*m}}
"""


SINE_CUT, PERIOD = math.asin(0.5) / 3, 2 * math.pi / 3
SINE = 800 / 3 * (1 - math.cos(3 * SINE_CUT)) + 200 * (PERIOD / 2 - 2 * SINE_CUT)
"""The integral of 400 sin 3t over a period of 2 pi/3, within 0 and 200 from and to its cuts."""


def test_a_control_is_cut_at_0_and_at_the_capacity_whatever_it_follows_from() -> None:
    for control, impulse, cut in (
        ('"400*sin(3*t)"', SINE, SINE_CUT),
        ("[[0, -100], [1, 300]]", 0.5 * 200 * 0.5 + 200 * (PERIOD - 0.75), 0.75),
        ('"400*t - 100"', 0.5 * 200 * 0.5 + 200 * (PERIOD - 0.75), 0.75),
        ("{points: [[0, 0], [1, 800]], scale: 0.5}", 50 + 200 * (PERIOD - 0.5), 0.5),
        ("{formula: 800*x, scale: 0.5}", 50 + 200 * (PERIOD - 0.5), 0.5),
        ("300", 200 * PERIOD, 0.0),
    ):
        motion = simulated(
            f"""duration: {PERIOD!r}
start: {{speeds: {{e: 900, o: 0}}}}
states: {{x: {{rate: 1}}}}
controls: {{C: {control}}}
""",
            CUT,
        )
        assert motion.speeds[-1] == pytest.approx([900 - impulse / 2, impulse / 3], rel=1e-10)
        assert motion.peaks["C"].torque == pytest.approx(200.0, rel=1e-12)
        [note] = [one.text for one in motion.messages if one.id == "N605"]
        assert note.startswith(f"at {cut:.6g} s the control of C is above the capacity")


def test_where_a_control_is_cut_its_clutch_slips_at_the_exact_instant() -> None:
    """It sticks while 1.2 of it is above 225 N*m, 3/5 of 375; from pi/6 on it is open."""
    start = "duration: 1.5\nstart: {speeds: {e: 100, o: 100}}\n"
    scenario = f'{start}controls: {{C: "400*cos(3*t)"}}\ntorques: {{e: 375}}\n'
    motion = simulated(scenario, CUT.replace("200 N*m", "900 N*m, static: 1.2"))
    [slips] = motion.events
    slipped, open_at = math.acos(225 / 480) / 3, math.pi / 6
    assert slips.time == pytest.approx(slipped, abs=1e-9)
    output = 100 + 375 / 5 * slipped + 400 / 3 * (1 - math.sin(3 * slipped)) / 3
    place = int(np.abs(motion.time - open_at).argmin())
    assert motion.time[place] == pytest.approx(open_at, abs=1e-9)
    assert motion.speeds[place:, 1] == pytest.approx(output, rel=1e-10)


@pytest.mark.parametrize("back", [False, True])
def test_an_open_clutch_drags_up_to_the_instant_at_which_its_control_leaves_0(back: bool) -> None:
    """6 N*m of drag for .5 s, and again from 1.5 s on if it opens; a lag or a ramp between."""
    motion = simulated(
        f"""duration: 3
start: {{speeds: {{e: 500, o: 0}}}}
set: {{command: 0}}
states: {{p: {{rate: {"command" if back else '"(command - p)/0.1"'}, min: 0}}}}
controls: {{C: p}}
sequences:
  s:
    - {{when: "t >= 0.5", set: {{command: 80}}}}
    - {{when: "t >= 1", set: {{command: {-80 if back else 80}}}}}
""",
        "links: [e, o]\ninertias: {e: 2, o: 3}\n"
        "shift_elements: {C: {links: [e, o], drag: 6 N*m}}\ngears: {g: [C]}\n"
        "load: {speed: 100 rpm, torque: 1 N*m}\n",
    )
    impulse = 80 * 0.5**2 + 6 * 2.0 if back else 80 * (2.5 - 0.1 * (1 - math.exp(-25))) + 6 * 0.5
    assert motion.speeds[-1] == pytest.approx([500 - impulse / 2, impulse / 3], rel=1e-10)


def test_a_clutch_that_is_heated_by_a_constant_power_is_cooled() -> None:
    """C dT/dt = P - h (T - T0): T = T0 + P/h (1 - exp(-h t/C)), with P of a constant slip."""
    case = """inertias: {e: 2, o: 3}
shift_elements:
  C: {links: [e, o], friction: {heat_capacity: 900 J/K, cooling: 40 W/K, ambient: 90}}
"""
    motion = simulated(
        """duration: 30
start: {speeds: {e: 130, o: 100}}
controls: {C: 80}
torques: {e: 80, o: -80}
sequences:
  hot: [{when: "temperature('C') > 110", set: {seen: 1}}]
set: {seen: 0}
""",
        case,
    )
    power = 80 * 30
    when = -900 / 40 * math.log(1 - (110 - 90) * 40 / power)
    [(step, time)] = steps_of(motion)
    assert step == 1
    assert time == pytest.approx(when, abs=1e-9 * 30)


def test_what_a_table_gives_drives_an_engine() -> None:
    """Between rows and columns it is bilinear: 110 - w/10 at pedal 0.6, so w decays."""
    motion = simulated("""duration: 4
start: {speeds: {e: 100, o: 0}}
tables:
  engine: {columns: [.2, 1], rows: [[0, 20, 200], [1000, 20, 0]]}
  pedal: [[0, 0.6], [1, 0.6]]
controls: {C: 0}
torques: {e: "engine(speed, pedal(t))"}
""")
    value, slope = 110.0, -(200 * 0.5) / 1000
    rest = -value / slope
    exact = rest + (100 - rest) * math.exp(slope * 4 / 2)
    assert motion.speeds[-1, 0] == pytest.approx(exact, rel=1e-9)


def test_power_torque_and_acceleration_are_seen_as_they_are() -> None:
    """Their integrals are heat, an impulse, a change of speed, and what one torque works.

    The clutch slips throughout: 3 dw/dt = 40 + 10 t - 20 on the output.
    """
    scenario = written("""duration: 2
start: {speeds: {e: 300, o: 0}}
states:
  heat: {rate: "power('C')"}
  impulse: {rate: "torque('C')"}
  gain: {rate: "acceleration('o')"}
  work: {rate: "power('o')"}
controls: {C: "40 + 10*t"}
torques: {e: "50 + 5*sin(3*t)", o: -20}
""")
    names = [("states", name) for name in ("heat", "impulse", "gain", "work")]
    motion = simulate(scenario, columns=names)
    heat, impulse, gain, work = (motion.asked["states"][name][-1] for _, name in names)
    assert abs(heat) == pytest.approx(motion.energy.heat["C"], rel=1e-9)
    assert abs(impulse) == pytest.approx(40 * 2 + 5 * 2**2, rel=1e-9)
    assert gain == pytest.approx((20 * 2 + 5 * 2**2) / 3, rel=1e-9)
    assert work == pytest.approx(-20 * (10 * 2**2 + 5 * 2**3 / 3) / 3, rel=1e-9)


LOOP = """duration: {duration!r}
start: {{speeds: {{e: {engine!r}, o: {output!r}}}}}
set: {{command: {command!r}}}
states:
  p: {{rate: "(command - p)/{lag!r}"}}
  x: {{rate: "{integral!r}*(slip('C') - {target!r})", min: {least!r}, max: {most!r}}}
controls: {{C: "max(p + x, 0)"}}
torques: {{e: "{pull!r} - {fade!r}*speed", o: "-{load!r}*speed"}}
sequences:
  shift:
    - {{when: "slip('C') < {near!r}", set: {{command: {later!r}}}}}
"""


def independent(given: dict[str, float]) -> tuple[float, float, np.ndarray]:
    """When the slip is near, when the clutch locks, and speeds at the end: by solvers in phases."""
    least, most = given["least"], given["most"]

    def change(_: float, y: np.ndarray, command: float) -> list[float]:
        engine, output, p, x = y
        capacity = max(p + min(max(x, least), most), 0.0)
        rate = given["integral"] * (engine - output - given["target"])
        if (x >= most and rate > 0) or (x <= least and rate < 0):
            rate = 0.0
        pull = given["pull"] - given["fade"] * engine
        changes = (pull - capacity) / 2, (capacity - given["load"] * output) / 3
        return [*changes, (command - p) / given["lag"], rate]

    def near(_: float, y: np.ndarray, *_rest: float) -> float:
        return float(y[0] - y[1] - given["near"])

    def joins(_: float, y: np.ndarray, *_rest: float) -> float:
        return float(y[0] - y[1])

    near.terminal = joins.terminal = True  # type: ignore[attr-defined]
    y, time, times = np.array([given["engine"], given["output"], 0.0, 0.0]), 0.0, []
    exact: Any = {"rtol": 1e-11, "atol": 1e-11, "max_step": 2e-3}
    for event, command in ((near, given["command"]), (joins, given["later"])):
        span = time, given["duration"]
        found = solve_ivp(change, span, y, args=(command,), events=event, **exact)
        y, time = found.y[:, -1], float(found.t[-1])
        times.append(time)
    left = given["duration"] - time
    drag = given["fade"] + given["load"]
    whole = (2 * y[0] + 3 * y[1]) / 5
    rest = given["pull"] / drag
    end = rest + (whole - rest) * math.exp(-drag * left / 5)
    return times[0], times[1], np.array([end, end])


@seeds_with_slow(1, 6, 60)
def test_random_closed_loops_agree_with_other_solvers(seed: int) -> None:
    random = seeded(seed)
    ranges = {
        "engine": (150, 300), "output": (0, 80), "command": (60, 90), "later": (150, 300),
        "lag": (0.03, 0.2), "integral": (0.5, 4), "target": (5, 20), "least": (-20, -5),
        "most": (5, 40), "pull": (20, 60), "fade": (0.02, 0.1), "load": (0.05, 0.2),
        "near": (21, 40),
    }  # fmt: skip
    given = {"duration": 12.0} | {name: random.uniform(*ends) for name, ends in ranges.items()}
    near, joins, end = independent(given)
    motion = simulated(LOOP.format(**given))
    [(_, step)] = steps_of(motion)
    locks = [one.time for one in motion.events if one.event == "locks"]
    assert step == pytest.approx(near, abs=1e-6)
    assert locks == pytest.approx([joins], abs=1e-6)
    assert motion.speeds[-1].tolist() == pytest.approx(end.tolist(), rel=1e-6)
