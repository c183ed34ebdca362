"""Motions with efficiencies over speed and torque, compared with an integrator written here."""

import math
from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded
from tests.simulation.control.written import simulated
from tests.simulation.reference import mechanism_column
from tests.simulation.runs import random_run
from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.laws import MapLaw, PointLaw
from vstatics.core.model.parts import RAD_PER_RPM, Law
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.law_formulas import EfficiencyFormula
from vstatics.simulation import Points, Scenario, Start, constant, simulate

FALLING = PointLaw([(0, 0.99), (100, 0.2)], "torque")


def some_efficiency(random: Random) -> float:
    values = sorted(random.uniform(0.8, 0.99) for _ in range(9))
    torques = sorted(random.uniform(0, 150) for _ in range(3))
    speeds = sorted(random.uniform(0, 90) for _ in range(3))
    a, b, c = random.uniform(0.9, 0.99), random.uniform(0.5, 3), random.uniform(0, 2e-4)
    rows = [[speed, *values[3 * n : 3 * n + 3]] for n, speed in enumerate(speeds)]
    by_torque, by_speed = ([*zip(x, values[::3], strict=True)] for x in (torques, speeds))
    laws = [PointLaw(by_torque, "torque"), PointLaw(by_speed, "speed")]
    formula = EfficiencyFormula(f"{a!r} - {b!r}/(T + 15) - {c!r}*w")
    return random.choice([MapLaw(torques, rows), *laws, formula, values[4]])


def some_motion(random: Random, masses: int) -> Scenario:
    """Gear pairs in a row, of three masses the last pair around a carrier; flows reverse."""
    ratios = [random.choice((-1, 1)) * random.uniform(0.5, 3) for _ in range(masses - 1)]
    parts = [
        Mechanism(n, n + 1, 0, ratio, some_efficiency(random)) for n, ratio in enumerate(ratios, 1)
    ]
    if masses == 3:
        ratio, back = random.uniform(-3, -1.5), some_efficiency(random)
        parts[-1] = parts[-1]._replace(third=4, ratio=ratio, back_efficiency=back)
    links = masses + (masses == 3)
    inertias = {link: random.uniform(0.2, 3) for link in range(1, links + 1)}
    start = {link: random.uniform(150, 300) for link in ([1] if links == 2 else [1, links])}
    times = (0.0, 1.0, 2.0)
    first = Points(times, (random.uniform(20, 90), random.uniform(-60, 10), 40.0))
    last = Points(times, tuple(random.uniform(*ends) for ends in ((-80, 0), (0, 90), (-60, 60))))
    case = Transmission(links, [], parts, [], inertias=inertias)
    return Scenario(case, 2.0, Start(speeds=start), torques=((1, first), (links, last)))


def columns_at(mechanisms: list[Mechanism], slips: Floats, torques: Floats) -> Floats:
    """Return the torques of mechanisms on links, by the efficiencies at their slips and torques."""
    columns = []
    for mechanism, slip, torque in zip(mechanisms, slips, torques, strict=True):
        back, drives = mechanism.back_efficiency, slip * torque > 0
        number = mechanism.efficiency if drives or back is None else back
        sizes = number.sizes_of(abs(slip), abs(torque)) if isinstance(number, Law) else ()
        value = number.at(*sizes) if isinstance(number, Law) else number
        plain = mechanism._replace(efficiency=float(value), back_efficiency=None)
        columns.append(mechanism_column(plain, 4, 1.0 if drives else -1.0))
    return np.array(columns).T


def equations_of(scenario: Scenario) -> Callable[[float, Floats], Floats]:
    """Return ``J w' = T - B m``, ``C w' = 0``, and the losses of mechanisms, as a derivative."""
    case, mechanisms = scenario.case, [*scenario.case.mechanisms]
    inertia = np.diag([case.inertias.get(link, 1.0) for link in range(1, 5)])
    rows = np.array([mechanism_column(mechanism, 4) for mechanism in mechanisms])
    unit = np.eye(5)[:, 1:]  # the housing has no speed
    to_slips = np.array([unit[one.first] - unit[one.third] for one in mechanisms])
    torques, none = np.zeros(len(rows)), np.zeros((len(rows),) * 2)

    def derivative(time: float, state: Floats) -> Floats:
        load, slips = np.zeros(4 + len(rows)), to_slips @ state[:4]
        for link, law in scenario.torques:
            assert isinstance(law, Points)
            load[link - 1] += law.at(time)
        for _ in range(80):
            columns, before = columns_at(mechanisms, slips, torques), torques.copy()
            both = np.linalg.solve(np.block([[inertia, columns], [rows, none]]), load)
            torques[:] = both[4:]
            if np.abs(torques - before).max() <= 1e-13 * np.abs(torques).max():
                break
        return np.append(both[:4], torques * (state[:4] @ (columns - rows.T)))

    return derivative


@each_seed(5, 30)
@pytest.mark.parametrize("masses", [2, 3])
def test_random_trains_move_as_a_plain_integrator(masses: int, seed: int) -> None:
    """Speeds within 1e-8 of the largest, losses within 1e-6, energy within 1e-9 of the turnover."""
    scenario = some_motion(seeded(100 * masses + seed), masses)
    motion, links = simulate(scenario), scenario.case.links
    assert motion.stopped is None
    state = np.zeros(4 + len(scenario.case.mechanisms))
    state[:links] = motion.speeds[0]
    exact: dict[str, Any] = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-8}
    for span in ((0, 1), (1, 2)):
        state = solve_ivp(equations_of(scenario), span, state, **exact).y[:, -1]
    size = np.abs(motion.speeds).max()
    assert motion.speeds[-1] == pytest.approx(state[:links], abs=1e-8 * size)
    losses = [*motion.energy.losses.values()]
    assert losses == pytest.approx(state[4:], abs=1e-6 * max(losses), rel=0)
    assert abs(motion.energy.balance) <= 1e-9 * (abs(motion.energy.kinetic) + sum(losses))


def with_efficiencies(scenario: Scenario, given: Callable[[Mechanism], float]) -> Scenario:
    own = [(part, given(part)) for part in scenario.case.mechanisms]
    parts = [part._replace(efficiency=one, back_efficiency=None) for part, one in own]
    return scenario._replace(case=replace(scenario.case, mechanisms=parts))


def constant_map(part: Mechanism) -> float:
    value = part.efficiency
    return MapLaw([0, 100], [[0, value, value], [50, value, value]])


@each_seed(6, 60)
def test_constant_maps_equal_numbers_and_random_boxes_run_to_their_end(seed: int) -> None:
    random = seeded(seed)
    scenario = random_run(random, losses=True)
    expected = simulate(with_efficiencies(scenario, lambda part: part.efficiency))
    motion, near = simulate(with_efficiencies(scenario, constant_map)), 1e-12
    near *= np.abs(expected.speeds).max()
    assert motion.speeds[-1] == pytest.approx(expected.speeds[-1], abs=near)
    motion = simulate(with_efficiencies(scenario, lambda _: some_efficiency(random)))
    assert motion.stopped is None
    through = abs(motion.energy.work) + sum(motion.energy.heat.values()) + 1
    assert abs(motion.energy.balance) <= 1e-9 * through


@each_seed(4, 20)
def test_a_steady_state_has_the_losses_of_statics(seed: int) -> None:
    """After many time constants, the power at a viscous load is the power of `vstatics run`."""
    random = seeded(seed)
    parts = [
        Mechanism(1, 2, 3, random.uniform(-3, -1.5), some_efficiency(random)),
        Mechanism(3, 4, 0, random.uniform(1, 3), some_efficiency(random)),
    ]
    brake, torque, inertias = (
        ShiftElement(2, name="B"),
        random.uniform(30, 120),
        {1: 0.1, 4: 0.1},
    )
    case = Transmission(4, [brake], parts, [Gear([1])], inertias=inertias, output=4)
    load = Points((-1e3, 1e3), (2e4, -2e4), "speed")
    torques = ((1, constant(torque)), (4, load))
    motion = simulate(Scenario(case, 60.0, Start(speed=20.0, gear="1"), torques=torques))
    speeds = motion.speeds[-1]
    [statics] = solve(replace(case, load=Load(speeds[0] / RAD_PER_RPM, torque))).efficiency
    assert 20 * speeds[3] ** 2 == pytest.approx(statics * torque * speeds[0], rel=1e-9)


def train(efficiency: float) -> Transmission:
    return Transmission(2, [], [Mechanism(1, 2, 0, 1, efficiency)], [], inertias={1: 100, 2: 0.01})


def test_a_run_stops_where_no_torque_agrees_with_its_efficiency() -> None:
    """M (0.99 - 0.0079 m) is at most 31.015 N*m, which a load of 60 N*m/s reaches in 0.517 s."""
    ramp = ((2, Points((0.0, 1.0), (0.0, -60.0))),)
    motion = simulate(Scenario(train(FALLING), 1.0, Start(speeds={1: 50.0}), torques=ramp))
    assert motion.stopped is not None
    assert motion.stopped.id == "E695"
    assert motion.stopped.path == ("case", "mechanisms", 1, "efficiency")
    assert motion.time[-1] == pytest.approx(0.99**2 / (4 * 0.0079) / 60, rel=1e-3)


def test_a_coast_with_a_formula_without_a_value_at_torque_0() -> None:
    """By m - 50 = 2 (60 - 2 m/(0.97 - 1/m))/1.5, with the torque m on the first link."""
    law = EfficiencyFormula("0.97 - 1/T")
    case = Transmission(2, [], [Mechanism(1, 2, 0, 2, law)], [], inertias={1: 1, 2: 1.5})
    m = max(np.roots([5.455, -190.65, 195]))
    torques = (1, constant(-50.0)), (2, constant(60.0))
    motion = simulate(Scenario(case, 1, Start(speeds={1: 50.0}), torques=torques))
    assert motion.speeds[-1, 0] == pytest.approx(m, rel=1e-10)


BLOCK = """inertias: {a: 0.3, b: 0.04, c: 2.3}
shift_elements:
  C: {links: [a, b], capacity: 300 N*m}
  B: {links: [b, housing], capacity: 900 N*m}
  D: {links: [b, c], drag: 2 N*m}
  E: {links: [a, c], drag: 1 N*m}
mechanisms:
  P: {first: a, second: b, third: c, ratio: -1.5, efficiency: 0.98 - 0.03*exp(-T/50)}
"""


def test_a_block_slips_apart_although_a_formula_has_no_torque_in_trials() -> None:
    """At the end ``dw_a/dt + 1.5 dw_b/dt = 2.5 dw_c/dt`` determines the torque -m of the set."""
    text = "start: {speeds: {a: 100, b: 100, c: 100}, engaged: [C]}\nduration: 0.12\n"
    text += "controls: {C: [[0, 209], [0.1, 0]], B: 344}\ntorques: {a: 22, c: -40}\n"
    motion, m = simulated(text, BLOCK), 200.0
    for _ in range(9):
        u = 1.5 / (0.98 - 0.03 * math.exp(-m / 50))
        known = 21 / 0.3 - 1.5 * 342 / 0.04 + 2.5 * 41 / 2.3
        m = -known / (1 / 0.3 + 1.5 * u / 0.04 + 2.5 * (u + 1) / 2.3)
    assert motion.torques[-1, motion.devices.index("P")] == pytest.approx(-m)


def test_a_formula_that_gives_no_efficiency_is_refused_at_the_start() -> None:
    law = EfficiencyFormula("0.98 - 10/T")
    with pytest.raises(CaseError, match=r"no torque on D1 agrees with its efficiency.*-inf"):
        simulate(Scenario(train(law), 1.0, Start(speeds={1: 50.0})))
