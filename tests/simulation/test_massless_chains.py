"""Chains of springs, clutches and links without inertia: energy closes, whatever slips."""

import math
from collections.abc import Callable
from random import Random

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded
from tests.simulation.control.written import simulated, written
from tests.simulation.runs import random_capacity, random_torque
from tests.simulation.test_closed_forms import links, run
from tests.simulation.test_golden import closes
from vstatics import CaseError, ShiftElement, Spring
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Capacity, Formula, Points, Scenario, Start, constant, simulate
from vstatics.simulation.scenario.laws import TorqueLaw
from vstatics.simulation.scenario.parts import Control

OVER_SPEED = Points((-50.0, 0.0, 60.0), (20.0, 0.0, -15.0), "speed")


def random_chain(rng: Random) -> Scenario:
    """Three to six links in a row, most without inertia, some joints with limits."""
    count = rng.randint(3, 6)
    inertias = [rng.choice((0.0, 0.0, rng.uniform(0.05, 2))) for _ in range(count)]
    inertias[0], inertias[-1] = rng.uniform(0.1, 2), rng.uniform(0.1, 20)
    springs: list[Spring] = []
    elements: list[ShiftElement] = []
    controls: dict[int, Control] = {}
    for link in range(1, count):
        stiffness, damping = 10 ** rng.uniform(2, 5), rng.choice((0.0, 0.0, rng.uniform(0.1, 20)))
        if rng.random() < 0.55:
            limit = rng.choice((None, rng.uniform(5, 150)))
            joint = between(link, link + 1)
            springs.append(Spring(joint, stiffness, damping=damping, name=f"s{link}", limit=limit))
            continue
        bends = stiffness if rng.random() < 0.55 else None
        elements.append(ShiftElement(link, link + 1, name=f"C{link}", stiffness=bends))
        controls[len(elements)] = Capacity(random_capacity(rng))
    driven = rng.sample(range(1, count + 1), 3)
    laws = tuple((link, random_torque(rng, rests=True)) for link in driven)
    speeds = {link: rng.uniform(-100, 100) for link, one in enumerate(inertias, 1) if one}
    case = links(*inertias, elements=tuple(elements), springs=tuple(springs))
    return Scenario(case, 0.8, Start(speeds=speeds), controls, laws)


def test_where_a_torque_no_longer_changes_with_speed_a_link_follows_its_shaft() -> None:
    """Beyond -50 rad/s the law is flat: the shaft keeps its twist, both ends turn alike."""
    case = links(1.0, 0.0, 8.0, springs=(Spring(between(1, 2), 1700.0, name="s"),))
    clutch = (ShiftElement(2, 3, name="C"),)
    case = case.replace(shift_elements=clutch)
    capacity = {1: Capacity(constant(30.0))}
    motion = run(case, 0.1, {1: -90.0, 2: 0.0, 3: 10.0}, ((2, OVER_SPEED),), capacity)
    assert motion.speeds[-1, 1] == pytest.approx(motion.speeds[-1, 0], rel=1e-9)
    assert motion.torques[-1, motion.devices.index("s")] == pytest.approx(-50.0)


@pytest.mark.parametrize(
    "law", [Formula("-300*angle"), Points((-9.0, 9.0), (2700.0, -2700.0), "angle")]
)
def test_a_torque_over_the_angle_of_a_light_link_is_a_spring_to_the_housing(
    law: TorqueLaw,
) -> None:
    """At 0.1 s another torque on the link jumps, and the angle with it."""
    shafts = Spring(between(1, 2), 500.0, name="s"), Spring(between(2, 3), 4000.0, name="r")
    loads = (2, Points((0.1, 0.1), (0.0, 40.0))), (1, constant(10.0))
    start = {1: 20.0, 2: 20.0, 3: 20.0}
    by_law = run(links(0.7, 0.0, 1.5, springs=shafts), 0.5, start, (*loads, (2, law)))
    third = Spring(between(2, 0), 300.0, name="t")
    by_spring = run(links(0.7, 0.0, 1.5, springs=(*shafts, third)), 0.5, start, loads)
    assert by_law.speeds[-1] == pytest.approx(by_spring.speeds[-1], rel=1e-7)
    assert by_law.energy.impact == pytest.approx(40**2 / 2 / (500 + 4000 + 300), rel=1e-6)


def test_a_link_without_inertia_leaps_to_the_piece_where_torques_balance() -> None:
    """At -80 rad/s the law gives 20 N*m, whatever the speed; the limit of 14 balances it at -35.

    Until the clutch opens at .2 s, link 2 turns with the heavy link 3.
    """
    spring = Spring(between(1, 2), 800.0, name="s", limit=14.0)
    clutch = ShiftElement(2, 3, name="C", stiffness=1e5)
    case = links(2.0, 0.0, 1e3, elements=(clutch,), springs=(spring,))
    opens = {1: Capacity(Points((0.2, 0.2), (160.0, 0.0), "time"))}
    start = {1: -50.0, 2: -80.0, 3: -80.0}
    motion = run(case, 0.4, start, ((2, OVER_SPEED),), opens)
    assert motion.speeds[-1, 1] == pytest.approx(-14 / 0.4)


def test_a_formula_acts_on_a_link_without_inertia_while_a_spring_slips() -> None:
    """The limit of 40 N*m balances ``-2*speed``: it turns by 20 rad/s, as long as it slips."""
    spring = Spring(between(1, 2), 5000.0, name="s", limit=40.0)
    case = links(1.0, 0.0, springs=(spring,))
    motion = run(case, 0.5, {1: 100.0}, ((2, Formula("-2*speed")),))
    assert motion.speeds[-1, 1] == pytest.approx(20.0)
    assert motion.speeds[-1, 0] == pytest.approx(100 - 40 * 0.5, rel=2e-3)


def test_an_elastic_clutch_begins_to_slip_either_way() -> None:
    """Its capacity rises from 0 by 100 N*m/s while the first link is the faster one."""
    clutch = ShiftElement(1, 2, name="C", stiffness=30000.0)
    case = links(1.0, 2.0, elements=(clutch,))
    rising = {1: Capacity(Points((0.1, 0.4), (0.0, 30.0), "time"))}
    motion = run(case, 0.4, {1: 100.0, 2: 0.0}, controls=rising)
    assert motion.speeds[-1, 0] == pytest.approx(100 - 100 * 0.3**2 / 2)


@pytest.mark.slow
@each_seed(25, 400)
def test_energy_of_any_chain_closes(seed: int) -> None:
    """Also of a run that had to stop: what could not be chosen is no loss of energy."""
    try:
        motion = simulate(random_chain(seeded(seed)))
    except CaseError:  # the start, or a link, is open
        return
    energy = motion.energy
    parts = [energy.work, energy.kinetic, energy.elastic, *energy.heat.values()]
    assert abs(energy.balance) <= 1e-8 * max(1.0, *map(abs, parts))


@pytest.mark.parametrize("step", ["15*(t > {0})", "-15*({0} < t)", "3*(t >= {0})"])
@pytest.mark.parametrize("friction", ["", ", friction: 1"])
def test_the_time_at_which_a_formula_jumps_is_not_seen_before(step: str, friction: str) -> None:
    """Momentum and energy close with friction on a link without inertia, also near a jump."""
    for at in (0.36, 0.375, 0.38, 0.5):
        made = simulated(
            f"duration: 1\nstart: {{speeds: {{a: 4, c: -2}}}}\n"
            f'torques: {{b: "{step.format(at)}", c: -100}}\n',
            "{links: [a, b, c], inertias: {a: 1, c: 1}, springs: {"
            f"S: {{links: [a, b], stiffness: 1000{friction}}}, "
            "T: {links: [b, c], stiffness: 400, friction: 14.5}}}",
        )
        momentum = 4 - 2 - 100 + float(step.split("*", maxsplit=1)[0]) * (1 - at)
        assert made.speeds[-1, [0, 2]].sum() == pytest.approx(momentum, rel=1e-9)
        assert closes(made)


def test_a_run_ends_where_the_root_of_a_falling_number_ends() -> None:
    """Parts of a stretch that are shorter than the time can show do not hold up the run."""
    made = simulate(
        written(
            "duration: 1\nstart: {speeds: {e: 100, o: 0, s: 0}}\ntorques: {o: sqrt(0.2 - t)}\n",
            "inertias: {e: 2, o: 3, s: 1}\nshift_elements: {C: [e, o]}\ngears: {g: [C]}\n"
            "springs: {S: {links: [o, s], stiffness: 100, friction: 3}}\n",
        )
    )
    assert made.time[-1] == pytest.approx(0.2, rel=1e-9)
    assert made.stopped is not None


BARE = """inertias: {a: 0.05649, b: 0.003077, e: 10.16}
shift_elements:
  C0: {links: [a, b], capacity: 175 N*m}
  C1:
    links: [b, c]
    friction: {radius: 1, area: 1, surfaces: 8, coefficient: [[0, 0.12], [5, 0.1], [50, 0.14]]}
    capacity: 537.8 N*m
  B2: {links: [c, housing], capacity: 413.2 N*m}
  C3: {links: [a, d], capacity: 612.7 N*m}
  C5: {links: [d, e], capacity: 462.8 N*m}
gears: {'1': []}
converters:
  T0: {links: [a, d], points: [[0, 1.95, 1.337e-3], [0.85, 1, 8e-4], [1, 1, 0], [2, 1, -1e-3]]}
"""
LOOP = """duration: 0.01
start: {speeds: {a: 104.4, b: 146.5, c: 146.5, d: 52.2, e: 259.7}}
controls:
  C0: 175
  C1: "147.4 + 0.8263*abs(slip('C1'))"
  B2: "min(max(5.019*(speed('c') - 34.21), 0), 413.2)"
  C3: 612.7
  C5: 225.4
torques: {e: -46.95}
"""


def test_an_inertia_is_the_remedy_where_no_state_of_links_without_it_is_consistent() -> None:
    with pytest.raises(CaseError, match=r"no state is consistent.*give c, d an inertia") as caught:
        simulated(LOOP, BARE)
    [problem] = caught.value.problems
    assert problem.path == ("case", "inertias")
    simulated(LOOP, BARE.replace("inertias: {", "inertias: {c: 0.001, d: 0.001, "))


CONVERTER = """
converters:
  TC: {links: [p, t], points: [[0, 2.2, 3e-3], [0.8, 1, 2e-3], [1, 1, 0], [1.3, 1, -3e-3]]}
"""


def _by_pump(torque: Callable[[float], float], ends: tuple[float, float], start: float) -> Floats:
    """Speed and angular impulse on the turbine of a pump of 1 kg*m^2 below a speed ratio of 0."""

    def rates(time: float, state: Floats) -> list[float]:
        taken = 3e-3 * state[0] * abs(state[0])
        return [torque(time) - taken, 2.2 * taken]

    return np.asarray(solve_ivp(rates, ends, [start, 0.0], rtol=1e-12, atol=1e-12).y[:, -1])


def test_a_turbine_without_inertia_turns_backward_with_its_shaft() -> None:
    """Below a speed ratio of 0 the torque is 2.2 lambda w_P^2, so it sets the twist of the shaft."""
    case = "links: [p, t, s]\ninertias: {p: 1, s: 2}\ngears: {'1': []}\n"
    case += "springs: {d: {links: [t, s], stiffness: 500}}"
    start = "start: {speeds: {p: 100, t: -10, s: -10}, twists: {d: 0.132}}"
    motion = simulated(f"duration: 2\n{start}\ntorques: {{p: 60, s: -100}}{CONVERTER}", case)
    pump, impulse = _by_pump(lambda _: 60.0, (0.0, 2.0), 100.0)
    shaft = -10 + (impulse - 100 * 2) / 2
    twisting = 2 * 2.2 * 3e-3 * pump * (60 - 3e-3 * pump**2) / 500
    assert motion.speeds[-1] == pytest.approx([pump, shaft + twisting, shaft], rel=1e-7)


def test_a_pump_that_slowly_begins_to_turn_backward_takes_the_torque_of_ratios_below_0() -> None:
    case = "links: [p, t]\ninertias: {p: 1, t: 1}\ngears: {'1': [B]}\n"
    case += "shift_elements: {B: [p, housing]}"
    torque = "torques: {p: '-60 - 300*max(t - 0.3, 0)^2'}\ncontrols: {B: 60}"
    start = "duration: 1\nstart: {speeds: {p: 0, t: 6.9}}"
    motion = simulated(f"{start}\n{torque}{CONVERTER}", case)
    pump, impulse = _by_pump(lambda time: -300 * (time - 0.3) ** 2, (0.3, 1.0), 0.0)
    assert motion.speeds[-1] == pytest.approx([pump, 6.9 + impulse], rel=1e-8)


def test_a_pump_without_inertia_starts_from_rest_at_a_speed_ratio_of_0() -> None:
    """At rest, 77.3 = 0.9557 w + 0.003 w^2; at ratios above 1.3 no speed would balance."""
    case = "links: [p, t]\ninertias: {t: 1}\ngears: {'1': []}"
    torque = "torques: {p: '77.3 - 0.9557*speed'}"
    motion = simulated(
        f"duration: 1e-6\nstart: {{speeds: {{p: 0, t: 0}}}}\n{torque}{CONVERTER}", case
    )
    pump = (-0.9557 + math.sqrt(0.9557**2 + 4 * 0.003 * 77.3)) / (2 * 0.003)
    assert motion.speeds[0] == pytest.approx([pump, 0], rel=1e-9)


def test_a_law_and_a_damper_of_equal_slopes_determine_the_speed_of_a_link() -> None:
    """30 - p = p - t on the link without inertia, so t' = (30 - t)/2."""
    case = "links: [p, t]\ninertias: {t: 1}\nsprings: {d: {links: [p, t], damping: 1}}"
    torque = "torques: {p: {over: speed, points: [[-100, 130], [100, -70]]}}"
    motion = simulated(f"duration: 1\nstart: {{speeds: {{p: 0, t: 0}}}}\n{torque}", case)
    reached = 30 * (1 - math.exp(-0.5))
    assert motion.speeds[-1] == pytest.approx([15 + reached / 2, reached], rel=1e-9)
