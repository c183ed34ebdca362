"""Torques that jump over the speed or the angle of their link: the motion slides on the jump.

Where both sides push a motion back to a jump the torque is what keeps it there, between both
values (A. F. Filippov, Differential equations with discontinuous righthand sides, 1988).
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.simulation.boxes import RPM, held, planetary_set, points
from tests.simulation.test_closed_forms import EXACT, links, run
from tests.simulation.test_golden import happened
from vstatics.model.springs import Spring, between
from vstatics.model.transmission import ShiftElement
from vstatics.simulation import simulate
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points, Resistance, TorqueLaw, constant
from vstatics.simulation.scenario.parts import Scenario, Start

LIMITERS = [
    pytest.param(Points((0.0, 300.0, 300.0), (100.0, 100.0, 0.0), "speed"), id="points"),
    pytest.param(Formula("100*(speed < 300)"), id="comparison"),
    pytest.param(Formula("100 - 50*(1 + sign(speed - 300))"), id="sign"),
    pytest.param(Formula("100*(not abs(speed) >= 300)"), id="abs"),
]
"""100 N*m up to 300 rad/s, nothing above."""

Laws = tuple[tuple[int, TorqueLaw], ...]


@pytest.mark.parametrize("limiter", LIMITERS)
def test_a_limiter_keeps_its_speed_with_the_torque_of_the_load(limiter: TorqueLaw) -> None:
    """J = 2, 50 N*m of friction: 300 rad/s after 8 s, then 50 N*m for 12 s."""
    motion = run(links(2.0), 20.0, {1: 100.0}, ((1, limiter), (1, Resistance(50.0))))
    sliding = motion.time >= 8 + 1e-6
    assert motion.speeds[sliding, 0] == pytest.approx(np.full(sliding.sum(), 300.0), rel=1e-14)
    speeding = (100 + 300) / 2 * 8
    assert motion.energy.work == pytest.approx(100 * speeding + 50 * 300 * 12, rel=EXACT)
    assert motion.energy.heat["1"] == pytest.approx(50 * (speeding + 300 * 12), rel=EXACT)
    assert not motion.events


@pytest.mark.parametrize("limiter", LIMITERS)
def test_a_limiter_is_left_where_the_load_exceeds_its_torque(limiter: TorqueLaw) -> None:
    """Load 50 N*m up to 10 s, 150 at 20 s, so 100 at 15 s: 62.5 rad/s are lost in 5 s more."""
    load = points((0, -50), (10, -50), (20, -150))
    motion = run(links(2.0), 20.0, {1: 300.0}, ((1, limiter), (1, load)))
    assert np.interp(15.0, motion.time, motion.speeds[:, 0]) == pytest.approx(300.0, rel=1e-9)
    assert motion.speeds[-1, 0] == pytest.approx(237.5, rel=EXACT)


@pytest.mark.parametrize("speed", [80.0, -80.0])
def test_friction_as_a_formula_stops_and_holds(speed: float) -> None:
    """At rest after J w/100 = 1.6 s; 60 N*m do not move it, 140 do after 3 s."""
    push = points((0, 0), (2, 0), (2, 60), (3, 60), (3, 140))
    motion = run(links(2.0), 4.0, {1: speed}, ((1, Formula("-100*sign(speed)")), (1, push)))
    resting = (motion.time > 1.6 + 1e-6) & (motion.time <= 3)
    assert motion.speeds[resting, 0] == pytest.approx(np.zeros(resting.sum()), abs=1e-12)
    assert motion.speeds[-1, 0] == pytest.approx(20.0, rel=EXACT)


def test_friction_as_a_formula_is_a_resistance() -> None:
    """A ring that it brakes, in a set with losses that is driven and loaded."""
    case = planetary_set(0.96)
    speeds = {1: 500 * RPM, 2: 0.0}
    apart = []
    for law in (Resistance(120.0), Formula("-120*sign(speed)")):
        laws: Laws = ((1, constant(40.0)), (2, constant(-60.0)), (3, law))
        apart.append(run(case, 1.0, speeds, laws))
    assert apart[0].speeds[-1] == pytest.approx(apart[1].speeds[-1], rel=1e-12, abs=1e-12)
    heat = sum(apart[0].energy.heat.values())
    assert apart[1].energy.work == pytest.approx(apart[0].energy.work - heat, rel=1e-10)


def test_a_limiter_through_a_clutch_gives_the_clutch_the_load() -> None:
    case = links(2.0, 3.0, elements=(ShiftElement(1, 2, "C"),))
    laws: Laws = ((1, Formula("100*(speed < 300)")), (2, constant(-30.0)))
    start = Start(speeds={1: 300.0}, engaged=(1,))
    motion = simulate(Scenario(case, 4.0, start, {1: held(200)}, laws))
    assert motion.stopped is None
    assert motion.speeds == pytest.approx(np.full_like(motion.speeds, 300.0), rel=1e-13)
    assert motion.torques[-1, 0] == pytest.approx(30.0, rel=1e-12)


def test_a_limiter_on_a_link_without_inertia() -> None:
    """It gives the 60 N*m at which the clutch slips, until 3 kg*m^2 turn with 300 rad/s."""
    case = links(0.0, 3.0, elements=(ShiftElement(1, 2, "C"),))
    laws: Laws = ((1, Formula("100*(speed < 300)")),)
    motion = run(case, 20.0, {1: 300.0, 2: 0.0}, laws, {1: held(60)})
    assert happened(motion) == [("C", "locks", pytest.approx(15.0, rel=EXACT))]
    assert motion.speeds[-1] == pytest.approx([300.0, 300.0], rel=1e-9)


def test_a_limiter_beside_a_spring() -> None:
    """Both wheels at 300 rad/s; the first is kept there, the second swings by sin(10 t)."""
    case = links(2.0, 3.0, springs=(Spring(between(1, 2), stiffness=300.0),))
    laws: Laws = ((1, Formula("900*(speed < 300)")), (1, constant(-300.0)))
    motion = run(case, 1.0, {1: 300.0, 2: 301.0}, laws)
    assert motion.speeds[:, 0] == pytest.approx(np.full(len(motion.time), 300.0), rel=1e-12)
    assert motion.speeds[:, 1] == pytest.approx(300 + np.cos(10 * motion.time), rel=1e-9)


def test_a_jump_that_changes_with_time() -> None:
    """100 (1 - t/4) N*m below 300 rad/s, 25 N*m of load: left at 3 s, 1/4 (1 s)^2/2 100/2 less."""
    laws: Laws = ((1, Formula("100*(1 - t/4)*(speed < 300)")), (1, constant(-25.0)))
    motion = run(links(2.0), 4.0, {1: 300.0}, laws)
    assert motion.speeds[-1, 0] == pytest.approx(300 - 25 / 2 / 2, rel=EXACT)


@pytest.mark.parametrize(
    ("law", "speed"),
    [("100*(speed > 0)", 0.0), ("100*(speed >= 0)", 150.0), ("100*sign(speed - 1)", -150.0)],
)
def test_what_a_jump_pushes_away_starts_as_the_formula_has_it(law: str, speed: float) -> None:
    """From rest: 0, 100 and -100 N*m on 2 kg*m^2 for 3 s."""
    motion = run(links(2.0), 3.0, {1: 0.0}, ((1, Formula(law)),))
    assert motion.speeds[-1, 0] == pytest.approx(speed, rel=EXACT)


STEPS = [
    pytest.param(Points((0.0, 30.0, 30.0), (100.0, 100.0, -50.0), "angle"), id="points"),
    pytest.param(Formula("100*(angle < 30) - 50*(angle >= 30)"), id="comparison"),
]


@pytest.mark.parametrize("law", STEPS)
def test_a_jump_over_the_angle_is_passed(law: TorqueLaw) -> None:
    """100 N*m over 30 rad, then -50: J w^2/2 is 3000 J there, and 0 after 60 rad more."""
    there = math.sqrt(2 * 30 * 2 / 100)
    back = math.sqrt(3000.0) / 25
    laws: Laws = ((1, law),)
    motion = simulate(Scenario(links(2.0), there + back, Start(speeds={1: 0.0}), torques=laws))
    assert motion.stopped is None
    assert motion.speeds[-1, 0] == pytest.approx(0.0, abs=1e-6)
    assert motion.energy.work == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("push", "speed"), [(60.0, 0.0), (-60.0, 0.0), (140.0, 40.0)])
def test_a_spring_of_constant_force_holds_at_rest(push: float, speed: float) -> None:
    """-100 N*m sign(angle): 40 N*m are left of 140, on 2 kg*m^2 for 2 s."""
    laws: Laws = ((1, Formula("-100*sign(angle)")), (1, constant(push)))
    motion = run(links(2.0), 2.0, {1: 0.0}, laws)
    assert motion.speeds[-1, 0] == pytest.approx(speed, rel=EXACT, abs=1e-12)


def test_bounces_that_become_ever_shorter_come_to_rest() -> None:
    """100 N*m towards angle 0, 20 of friction: each swing has sqrt(2/3) of the last speed.

    Away from 0 with w it slows by 60 rad/s^2, back it speeds up by 40: sqrt(2/3) of w comes
    back, after w/60 + w sqrt(2/3)/40. A swing of less than 1e-9 rad, of 3.5e-4 rad/s, is none.
    """
    laws: Laws = ((1, Formula("-100*sign(angle)")), (1, Resistance(20.0)))
    part = math.sqrt(80 / 120)
    rest = 12 * (1 / 60 + part / 40) / (1 - part)
    motion = run(links(2.0), 2 * rest, {1: 12.0}, laws)
    moving = np.abs(motion.speeds[:, 0]) > 1e-6
    assert motion.time[moving].max() == pytest.approx(rest, rel=1e-4)
    assert motion.speeds[-1, 0] == 0
    assert motion.energy.heat["1"] == pytest.approx(144.0, rel=1e-6)


def test_a_formula_that_jumps_over_both() -> None:
    """100 N*m below 20 rad/s and 30 rad: 20 rad/s after .4 s and 4 rad, 30 rad at 1.7 s."""
    laws: Laws = ((1, Formula("100*(speed < 20)*(angle < 30)")), (1, constant(-50.0)))
    motion = run(links(1.0), 2.0, {1: 0.0}, laws)
    assert np.interp(1.5, motion.time, motion.speeds[:, 0]) == pytest.approx(20.0)
    assert motion.speeds[-1, 0] == pytest.approx(20 - 50 * 0.3, rel=EXACT)


def test_a_jump_on_a_link_without_inertia_behind_a_spring() -> None:
    """It slides at 60.41 rad/s, while the other link swings about that: its energy closes."""
    case = links(3.0, 0.0, springs=(Spring(between(1, 2), stiffness=2060.0),))
    laws: Laws = ((2, Formula("-130.5*sign(speed - 60.41)")),)
    motion = run(case, 2.0, {1: 100.0, 2: 100.0}, laws)
    sliding = motion.time > 1
    assert motion.speeds[sliding, 1] == pytest.approx(np.full(sliding.sum(), 60.41), rel=1e-9)
    assert np.abs(motion.speeds[sliding, 0] - 60.41).max() <= 130.5 / math.sqrt(2060 * 3) + 1e-9
