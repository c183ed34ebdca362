"""Links whose speeds are given, and variators whose ratios are."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded
from tests.simulation.control.written import DOG, faults, simulated, written
from vstatics import CaseError, loads, solve
from vstatics.simulation import Motion, simulate
from vstatics.simulation.scenario.checks import scenario_doubts


def test_a_ramp_takes_the_torque_of_its_inertia_besides_that_of_the_clutch() -> None:
    """From 0 to 2 s: -25 rad/s^2 on 2 kg*m^2, 40 N*m of the clutch, 7 N*m that are there."""
    speeds = "start: {speeds: {o: 0}}\nspeeds: {e: [[0, 100], [2, 50]]}"
    motion = simulated(f"duration: 2\n{speeds}\ncontrols: {{C: 40}}\ntorques: {{e: 7}}\n")
    place = motion.devices.index("e")
    assert motion.torques[:, place].tolist() == pytest.approx([-2 * 25 + 40 - 7] * len(motion.time))
    assert motion.speeds[-1].tolist() == pytest.approx([50.0, 40 * 2 / 3])
    angle = 150.0
    assert motion.energy.work == pytest.approx((-2 * 25 + 40) * angle)
    assert motion.energy.heat["C"] == pytest.approx(40 * (angle - 40 * 2 / 3))


def test_an_impact_leaves_a_given_speed_and_counts_the_work_of_its_impulse() -> None:
    """3 kg*m^2 are taken to 90 rad/s: half of what the drive gives is lost."""
    start = "duration: 1\nstart: {speeds: {o: 0}}\nspeeds: {e: 90}\n"
    motion = simulated(f"{start}controls: {{D: {{dog: [[0.5, closed]]}}}}\n", DOG)
    assert motion.speeds[-1].tolist() == pytest.approx([90.0, 90.0])
    assert motion.energy.impact == pytest.approx(0.5 * 3 * 90**2)
    assert motion.energy.work == pytest.approx(3 * 90**2)


def test_a_dog_clutch_that_opens_holds_until_then() -> None:
    """From 0.5 s on, or from the start, 3 N*m slow 3 kg*m^2 by 1 rad/s in a second."""
    for engaged, last in (("[D]", 89.5), ("[]", 89.0)):
        start = f"duration: 1\nstart: {{speeds: {{o: 90}}, engaged: {engaged}}}\n"
        start += "speeds: {e: 90}\ntorques: {o: -3}\n"
        motion = simulated(f"{start}controls: {{D: {{dog: [[0.5, open]]}}}}\n", DOG)
        assert motion.speeds[-1].tolist() == pytest.approx([90.0, last])


def test_an_impact_behind_a_differential_is_shared_by_the_inertias_of_its_sides() -> None:
    """Both sides receive the same impulse P = J w, and w_1 + w_2 = 2*90.

    Inertias of 1 and 3 kg*m^2 therefore reach 135 and 45 rad/s. With 2 kg*m^2 on the carrier, the
    impulse of the drive is 2*90 + 2 P, and half of its work is lost.
    """
    case = (
        "inertias: {e: 1, o: 2, left: 1, right: 3}\n"
        "mechanisms: {set: {first: left, second: right, third: o, ratio: -1}}\n"
        "shift_elements: {D: {kind: dog_clutch, links: [e, o]}}\ngears: {g: []}\n"
    )
    start = "duration: 1\nstart: {speeds: {o: 0, left: 0}}\nspeeds: {e: 90}\n"
    motion = simulated(f"{start}controls: {{D: {{dog: [[0.5, closed]]}}}}\n", case)
    speeds = dict(zip(motion.links, motion.speeds[-1].tolist(), strict=True))
    assert speeds == pytest.approx({"e": 90, "o": 90, "left": 135, "right": 45})
    assert motion.energy.work == pytest.approx((2 * 90 + 2 * 135) * 90)
    assert motion.energy.impact == pytest.approx((2 * 90 + 2 * 135) * 90 / 2)


def test_a_mistake_is_reported() -> None:
    for text, fault in (
        ("speeds: {e: [[0, 1], [0, 2]]}", "without a jump"),
        ('speeds: {e: "100*(t < 1)"}', "the speed jumps"),
        ("speeds: {e: \"slip('C')\"}", "expected a formula of t"),
        ("speeds: {x: 3}", "expected the name of a link"),
        ("speed_ratios: {hydro: .2}", "expected the name of a mechanism"),
    ):
        found = faults(f"duration: 1\nstart: {{speeds: {{o: 0}}}}\ncontrols: {{C: 0}}\n{text}\n")
        assert any(fault in one for one in found), found


def test_speeds_that_contradict_each_other_or_are_tied_are_reported() -> None:
    pair = """inertias: {a: 2, b: 3}
mechanisms: {pair: {first: a, second: b, ratio: 2}}
"""
    text = "duration: 1\nstart: {speeds: {a: 10}}\nspeeds: {%s}\n"
    with pytest.raises(CaseError, match="gives 20 rad/s"):
        simulate(written(text % "a: 20", pair))
    with pytest.raises(CaseError, match="the gear train holds b"):
        simulate(written(text % "a: 10, b: 5", pair))


HYDRO = """inertias: {{a: 2, b: 3}}
mechanisms: {{hydro: {{kind: variator, first: a, second: b, speed_ratio: .2, efficiency: {eta!r}}}}}
"""


@each_seed(4, 100)
def test_a_variator_with_losses_under_load_agrees_with_an_independent_solver(seed: int) -> None:
    """By the torques (x m eta^-s, -m) and x a_a + x' w_a = a_b, solved for m at each instant."""
    random = seeded(seed)
    eta, begin, end = random.uniform(0.7, 0.98), random.uniform(-1, 1), random.uniform(-1, 1)
    pull, load = random.uniform(-30, 60), random.uniform(-0.3, 0.3)
    moved = (end - begin) / 2

    def change(t: float, y: np.ndarray) -> list[float]:
        x, first = begin + moved * t, float(y[0])
        for sign in (1.0, -1.0):
            taken = x * eta**-sign
            # 2 a = pull - taken m; 3 b = m - load w_b; x a + x' w = b
            torque = (x * pull / 2 + moved * first + load * x * first / 3) / (1 / 3 + x * taken / 2)
            if sign * torque * x * first >= 0:
                break
        return [(pull - taken * torque) / 2]

    exact = solve_ivp(change, (0, 2), [50.0], rtol=1e-11, atol=1e-10, max_step=1e-2).y[0, -1]
    given = f"speed_ratios: {{hydro: [[0, {begin!r}], [2, {end!r}]]}}"
    torques = f'torques: {{a: {pull!r}, b: "{-load!r}*speed"}}'
    text = f"duration: 2\nstart: {{speeds: {{a: 50}}}}\n{given}\n{torques}\n"
    motion = simulated(text, HYDRO.format(eta=eta))
    assert motion.speeds[-1, 0] == pytest.approx(exact, rel=1e-7, abs=1e-6)
    assert motion.energy.losses["hydro"] >= -1e-6
    assert math.isfinite(motion.energy.balance)


STATIC = """
links: [in, pump, motor, out]
input: in
output: out
load: {{speed: 955 rpm, torque: 100 N*m}}
mechanisms:
  set: {{first: in, second: out, third: motor, ratio: -2, efficiency: .98}}
  pair: {{first: in, second: pump, ratio: -1, efficiency: .99}}
  hydro: {{kind: variator, first: pump, second: motor, speed_ratio: 0.4, efficiency: 0.86}}
inertias: {{in: .1, out: .1}}
gears: {{a: [], b: {{speed_ratios: {{hydro: {x}}}}}}}
"""


def run(x: float, gear: str, out: float) -> Motion:
    text = f"duration: 1\nstart: {{gear: {gear}, speed: 100}}\ntorques: {{in: 100, out: {out}}}\n"
    return simulated(text, STATIC.format(x=x))


@pytest.mark.parametrize("gear", ["a", "b"])
@pytest.mark.parametrize("x", [-0.2, 0.7])
def test_at_the_torques_of_statics_speeds_stay(gear: str, x: float) -> None:
    case = loads(STATIC.format(x=x))
    number = case.gear_number(gear) - 1
    results = solve(case)
    out = -float(results.lossy_output_torque_Nm[number])
    turned = 100 * results.speeds[number]
    assert run(x, gear, out).speeds[-1] == pytest.approx(turned, rel=1e-6)


@pytest.mark.parametrize(
    ("given", "x", "ids"),
    [
        ("shifts: [{at: 0.5, to: b}]", 0.7, ["N615"]),
        ("shifts: [{at: 0.5, to: b}]", 0.4, []),
        ("shifts: [{at: 0.5, to: b}]\nspeed_ratios: {hydro: 0.4}", 0.7, []),
        ('sequences:\n  q: [{when: "t > 0.5", shift: {to: b}}]', 0.7, ["N615"]),
    ],
)
def test_a_variator_that_keeps_its_ratio_in_a_shift_is_noted(
    given: str, x: float, ids: list[str]
) -> None:
    """Gear a has the speed ratio 0.4."""
    start = "duration: 1\nstart: {gear: a, speed: 100}\n"
    scenario = written(f"{start}{given}\n", STATIC.format(x=x))
    assert [doubt.id for doubt in scenario_doubts(scenario)] == ids


def test_at_a_ratio_of_0_the_motor_stands_and_the_pump_carries_nothing() -> None:
    """100 N*m turn both ends of the set, of which ``J a/2 = 2 eta T`` passes to the output."""
    motion = run(0.0, "b", 0.0)
    faster = 100 / (0.1 + 0.1 / (4 * 0.98))
    assert motion.speeds[-1] == pytest.approx([100 + faster, -100 - faster, 0, -50 - faster / 2])
