"""What sticks and what moves: steady drives, in and beside what friction would hold at rest.

Expected are `plain`, which tries all signs in closed form, the static torques of the gear with
losses (`statics`), and ``dw/dt = (T i eta - T_out)/(J_in i^2 eta + J_out)`` of one set.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from tests.chance import count, each_seed, examples, seeded, with_slow
from tests.commands import CASES
from tests.simulation.events.plain import PlainGear
from tests.simulation.reference import element_column, mechanism_columns
from tests.trains import random_train
from vstatics import Gear, Mechanism, Spring, Transmission, load, solve
from vstatics.core.model.springs import between
from vstatics.simulation import Motion, Scenario, Start, constant, simulate

SHIPPED = sorted([path.name for path in (*CASES.glob("*.yaml"), *CASES.glob("*.dat"))])
QUICK = ("simpson.yaml", "gm-6t70.yaml", "mercedes-7g.yaml", "ravigneaux-gf4a.yaml")
ROUNDING = 1e-6
"""What may be left where the input works 1e4 J, all of which is taken or lost. [J]"""


def driven(case: Transmission, gear: Gear, torques: dict[int, float], speed: float) -> Motion:
    laws = tuple((link, constant(torque)) for link, torque in torques.items())
    start = Start(gear=gear.name, speed=speed, settled=True)
    return simulate(Scenario(case, 1.0, start, None, laws))


def ran(motion: Motion) -> bool:
    return motion.stopped is None or abs(motion.energy.balance) < ROUNDING


def steady(name: str) -> Iterator[tuple[Transmission, Gear, float]]:
    """The gears of a case with one motion, and their output torques at 100 N*m."""
    case = load(CASES / name)
    case = case.replace(
        shift_elements=[one._replace(capacity=None, drag=0.0) for one in case.shift_elements],
        gears=[one._replace(drag={}, open_drag={}) for one in case.gears],
        springs=[one._replace(limit=None) for one in case.springs],
    )
    results = solve(case)
    for number, gear in enumerate(case.gears, 1):
        torque = -100.0 * float(results.lossy_output_torque[number - 1])
        if math.isfinite(torque) and not (gear.speeds or gear.torques):
            inertias = {case.gear_input(gear): 1.0, case.gear_output(gear): 1.0}
            yield case.replace(inertias=inertias), gear, torque


@pytest.mark.parametrize("name", with_slow(QUICK, sorted({*SHIPPED} - {*QUICK})))
def test_a_shipped_gear_runs_on_at_its_static_load_and_up_to_2_percent_more(name: str) -> None:
    for case, gear, torque in steady(name):
        ends = case.gear_input(gear), case.gear_output(gear)
        for more in (0.0, 0.01, 0.02):
            loads = dict(zip(ends, (100.0, torque * (1 + more)), strict=True))
            motion = driven(case, gear, loads, 100.0)
            speed = motion.speeds[:, ends[0] - 1]
            assert ran(motion)
            assert not motion.events
            assert speed[-1] == pytest.approx(100, rel=0.05 if more else 1e-8)


def random_gear(seed: int) -> tuple[Transmission, Gear, dict[int, float], float]:
    """A random box in a gear, with torques in and beside what friction holds, and a speed."""
    rng = seeded(seed)
    while True:
        case = random_train(rng, regular=True, gears=1, coast=False)
        [gear] = case.gears
        rows = mechanism_columns(case)
        rows += [element_column(case.shift_elements[n - 1], case.links) for n in gear.engaged]
        free = null_space(np.array(rows))
        if free.shape[1] != 1 or len(rows) != case.links - 1 or case.gear_input(gear) != 1:
            continue
        # in such a set, friction at the other two links could hold the third at any torque
        jams = (
            n.efficiency <= n.ratio <= 1 / n.efficiency and n.third != 0 for n in case.mechanisms
        )
        if len(case.mechanisms) > 5 or any(jams):
            continue
        first, last = free[[0, case.output - 1], 0]
        if case.output != 1 and abs(first) > 1e-6 and 1e-3 < abs(last / first) < 1e3:
            break
    speed = float(last / first)
    elements = [one._replace(drag=0.0) for one in case.shift_elements]
    gear = gear._replace(name="1", drag={}, open_drag={})
    inertias = {1: round(rng.uniform(0.1, 3), 2), case.output: round(rng.uniform(0.1, 3), 2)}
    case = case.replace(gears=[gear], shift_elements=elements, inertias=inertias)
    lossy = math.prod(one.efficiency for one in case.mechanisms)
    parts = (lossy, 1.0, rng.uniform(lossy, 1 / lossy), lossy * rng.uniform(0.99, 1.01))
    part = rng.choice((*parts, 0.0, rng.uniform(-2, 2)))
    torque = rng.choice((100.0, -100.0))
    torques = {1: torque, case.output: -torque * part / speed}
    return case, gear, torques, rng.choice((100.0, -100.0, 5.0, -5.0, 0.0))


def agrees(seed: int) -> bool:
    case, gear, torques, speed = random_gear(seed)
    motion = driven(case, gear, torques, speed)
    ends = [*PlainGear(case, gear, torques).ends(speed, 1.0)]
    close = 1e-6 * max(1.0, abs(speed), *map(abs, ends))
    return ran(motion) and any(abs(motion.speeds[-1, 0] - end) < close for end in ends)


@examples(3, 12, 200)
def test_random_gears_move_as_by_the_signs_that_fit(examples: int) -> None:
    assert [seed for seed in range(examples) if not agrees(seed)] == []


@pytest.mark.slow
@settings(max_examples=count(100, 400))
@given(st.integers(0, 10**6))
def test_any_random_gear_moves_as_by_the_signs_that_fit(seed: int) -> None:
    assert agrees(seed)


@each_seed(4)
def test_a_pair_before_a_shaft_loses_from_the_first_instant_on_by_the_way_power_flows(
    seed: int,
) -> None:
    """The shaft is not twisted at the start: only the change of its rate tells the way.

    Expected is the integral of ``J_in w_in' = T_in - S/(u eta^p)``, ``J_out w_out' = T_out + S``
    with the torque S = c twist of the shaft, p the sign of its power.
    """
    chance = np.random.default_rng(seed)
    ratio, efficiency = chance.uniform(1.5, 4) * chance.choice([-1, 1]), chance.uniform(0.9, 0.99)
    inertias, stiffness = chance.uniform(0.5, 20, 2), 10 ** chance.uniform(3, 5)
    torques, start = chance.uniform(-60, 60, 2), chance.uniform(50, 200)
    pair = Mechanism(1, 2, 0, ratio, efficiency, back_efficiency=efficiency, name="pair")
    shaft, own = Spring(between(2, 3), stiffness, name="shaft"), {1: inertias[0], 3: inertias[1]}
    case = Transmission(3, [], [pair], [], springs=[shaft], inertias=own, output=3)
    laws = ((1, constant(torques[0])), (3, constant(torques[1])))
    motion = simulate(Scenario(case, 0.2, Start(speeds={1: start}), None, laws))

    def rates(_: float, state: Any) -> tuple[float, float, float]:
        first, last, twist = state
        shaft = stiffness * twist
        way = math.copysign(1.0, shaft * first / ratio)
        changes = np.array([-shaft / (ratio * efficiency**way), shaft]) + torques
        return (*(changes / inertias), first / ratio - last)

    found = solve_ivp(rates, (0, 0.2), (start, start / ratio, 0), rtol=1e-9, atol=1e-9)
    assert motion.stopped is None
    assert motion.speeds[-1, [0, 2]] == pytest.approx(found.y[:2, -1], rel=1e-6)
