"""Motions that have a solution on paper: each test derives its numbers where it stands."""

import math
import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.chance import each_seed, seeded
from tests.simulation.boxes import capacity, held, points
from tests.simulation.test_golden import closes, happened
from vstatics import (
    CaseError,
    Gear,
    Load,
    Mechanism,
    ShiftElement,
    Spring,
    Transmission,
    loads,
)
from vstatics.core.model.converters import Converter
from vstatics.core.model.laws import PointLaw
from vstatics.core.model.parts import Law
from vstatics.core.model.springs import between
from vstatics.core.readers.named.law_formulas import DragFormula
from vstatics.simulation import (
    Formula,
    Motion,
    Road,
    Scenario,
    Start,
    constant,
    simulate,
)
from vstatics.simulation.scenario.laws import TorqueLaw
from vstatics.simulation.scenario.parts import Control

EXACT = 1e-8


def links(
    *inertias: float, elements: tuple[ShiftElement, ...] = (), springs: tuple[Spring, ...] = ()
) -> Transmission:
    """Links with inertias (0: none), joined by elements and springs alone."""
    own = {n: inertia for n, inertia in enumerate(inertias, 1) if inertia}
    return Transmission(len(inertias), elements, [], [Gear()], springs=springs, inertias=own)


def run(  # noqa: PLR0913 - what a scenario has
    case: Transmission,
    duration: float,
    speeds: dict[int, float],
    torques: tuple[tuple[int, TorqueLaw], ...] = (),
    controls: Mapping[int, Control] | None = None,
    *,
    engaged: tuple[int, ...] = (),
    converters: tuple[Converter, ...] = (),
    targets: dict[int, tuple[float, ...]] | None = None,
) -> Motion:
    """A motion whose energy closes."""
    start, controlled = Start(speeds=speeds, engaged=engaged), controls or {}
    scenario = Scenario(case, duration, start, controlled, torques, converters)
    motion = simulate(scenario._replace(targets=targets or {}))
    assert motion.stopped is None
    assert motion.time[-1] == duration
    assert closes(motion)
    return motion


@pytest.mark.parametrize("duration", [1.0, 1e3, 1e6, 1e9])
def test_a_torque_that_dies_away_acts_however_long_the_run(duration: float) -> None:
    """The integral of 10 exp(-t); the first look ahead may come when it is over."""
    motion = run(links(2.0), duration, {1: 100.0}, ((1, Formula("10*exp(-t)")),))
    assert motion.speeds[-1, 0] == pytest.approx(100 - 10 / 2 * math.expm1(-duration), rel=1e-10)
    assert motion.energy.balance == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("freewheel", ["", "F: {kind: freewheel, links: [ring, housing]}"])
def test_drag_follows_the_speed_with_or_without_a_freewheel(freewheel: str) -> None:
    """J dw/dt = -(a + c w): w = (w0 + a/c) exp(-c t/J) - a/c, with J = 0.3 + 7/2.5^2."""
    case = loads(f"""
links: [in, ring, out]
inertias: {{in: 0.3, ring: 0.05, out: 7}}
load: {{speed: 2000 rpm, torque: 100 N*m}}
drag: {{in: "2 + 0.005*w"}}
mechanisms: {{set: {{first: in, second: ring, third: out, ratio: -1.5}}}}
shift_elements: {{B: {{links: [ring, housing], capacity: 600 N*m}}, {freewheel}}}
gears: {{low: [B]}}
""")
    motion = simulate(Scenario(case, 5.0, Start(gear="low", speed=100.0)))
    expected = (100 + 2 / 0.005) * math.exp(-0.005 * 5 / (0.3 + 7 / 2.5**2)) - 2 / 0.005
    assert motion.speeds[-1, 0] == pytest.approx(expected, rel=EXACT)


def test_speed_reached_on_a_road() -> None:
    """Constant acceleration on a slope."""
    road = Road(1000.0, 0.3, slope=0.05)
    net = 500 - 0.3 * 1000 * 9.81 * 0.05
    motion = run(links(90.0), 30.0, {1: 0.0}, ((1, constant(500)), (1, road)), targets={1: (50.0,)})
    [reached] = motion.reached
    time = 50 / (net / 90)
    found = [reached.time, reached.angle, reached.distance]
    assert found == pytest.approx([time, 25 * time, 0.3 * 25 * time], rel=EXACT)


REDUCED = 0.4 * 0.6 / (0.4 + 0.6)
OMEGA = math.sqrt(5000 / REDUCED)


def test_step_on_a_damped_shaft() -> None:
    """A damped oscillator: theta'' + 2 d theta' + omega^2 theta = M/J1."""
    shaft = Spring(between(1, 2), 5000.0, damping=8.0)
    motion = run(links(0.4, 0.6, springs=(shaft,)), 0.1, {1: 0.0, 2: 0.0}, ((1, constant(100)),))
    decay = 8 / (2 * REDUCED)
    own = math.sqrt(OMEGA**2 - decay**2)
    rest = 100 / 0.4 / OMEGA**2
    swing = np.exp(-decay * motion.time)
    wave = own * motion.time
    twist = rest * (1 - swing * (np.cos(wave) + decay / own * np.sin(wave)))
    rate = rest * swing * OMEGA**2 / own * np.sin(wave)
    assert motion.torques[:, 0] == pytest.approx(5000 * twist + 8 * rate, abs=EXACT * 120)
    assert motion.speeds[:, 0] - motion.speeds[:, 1] == pytest.approx(rate, abs=EXACT)


def test_shaft_that_saturates() -> None:
    """It swings up to its limit, slips while the inertias differ in speed, swings back.

    With v the difference of speeds where the limit is reached, the heat is J v^2/2.
    """
    limit, start = 100.0, 5.0
    shaft = Spring(between(1, 2), 5000.0, limit=limit)
    motion = run(links(0.4, 0.6, springs=(shaft,)), 0.2, {1: start, 2: 0.0})
    squared = start**2 - limit**2 / (5000 * REDUCED)
    heat = sum(motion.energy.heat.values()) + sum(motion.energy.losses.values())
    assert heat == pytest.approx(REDUCED * squared / 2, rel=EXACT)
    reached = math.asin(limit / 5000 / (start / OMEGA)) / OMEGA
    end = reached + math.sqrt(squared) / (limit / REDUCED)
    swing = limit * np.cos(OMEGA * (motion.time - end))
    late = motion.time > end
    assert motion.torques[late, 0] == pytest.approx(swing[late], abs=EXACT * limit)
    assert abs(motion.peaks["S1"].torque) == pytest.approx(limit, rel=EXACT)


def test_clutch_on_a_link_without_inertia_is_a_limit_of_the_shaft() -> None:
    """The disc between clutch and shaft takes the speed at which they balance."""
    clutch, shaft = ShiftElement(1, 2, "C"), Spring(between(2, 3), 5000.0)
    case = links(0.4, 0.0, 0.6, elements=(clutch,), springs=(shaft,))
    motion = run(case, 0.2, {1: 5.0, 3: 0.0}, controls={1: held(100)}, engaged=(1,))
    heat = REDUCED * (25 - 100**2 / (5000 * REDUCED)) / 2
    assert motion.energy.heat["C"] == pytest.approx(heat, rel=EXACT)


def test_converters_at_equilibrium() -> None:
    """M_P = M_engine, K(i) = M_load/M_engine: here K = 2 - i, lambda = (2 - i)/1000."""
    points = ((0.0, 2.0, 2e-3), (1.0, 1.0, 1e-3))
    converters = Converter("TC", 1, 2, points), Converter("TD", 3, 4, points)
    loads = tuple((n, constant(each)) for n, each in enumerate((100, -150, 50, -75), 1))
    start = {1: 200.0, 2: 50.0, 3: 200.0, 4: 50.0}
    motion = run(links(0.05, 0.05, 0.05, 0.05), 20.0, start, loads, converters=converters)
    pumps = [math.sqrt(torque / 1.5e-3) for torque in (100, 50)]
    assert motion.speeds[-1, ::2] == pytest.approx(pumps, rel=1e-7)
    assert motion.speeds[-1, 1::2] == pytest.approx([pump / 2 for pump in pumps], rel=1e-7)
    assert motion.torques[-1, motion.devices.index("TC")] == pytest.approx(100, rel=1e-6)


@each_seed(6)
def test_a_pump_turns_back_while_its_turbine_turns(seed: int) -> None:
    """By J dw/dt = -T - lambda w |w|, with lambda of the first and then of the last point."""
    rng, (first, last) = seeded(seed), (3.1e-3, 2e-3)
    torque, speed = rng.uniform(20, 80), rng.uniform(1, 9)
    points = (0.0, 2.2, first), (0.8, 1.05, 2.6e-3), (1.0, 1.0, 0.0), (1.4, 1.0, -last)
    case = links(0.4, 0.05, 1.0, elements=(ShiftElement(2, 3, "C"),))
    start = {1: speed, 2: -100.0, 3: -100.0}
    loads, converters = ((1, constant(-torque)),), (Converter("TC", 1, 2, points),)
    motion = run(case, 0.2, start, loads, {1: held(20.0)}, engaged=(1,), converters=converters)
    left = 0.2 - 0.4 * math.atan(speed * math.sqrt(first / torque)) / math.sqrt(torque * first)
    expected = -math.sqrt(torque / last) * math.tan(math.sqrt(torque * last) * left / 0.4)
    assert motion.speeds[-1, 0] == pytest.approx(expected, abs=1e-9)


def test_body_pulled_by_a_spring() -> None:
    """It sticks from F_k - (F_s - F_k) to F_s, and slips the rest of the circle around F_k."""
    inertia, rate, kinetic, static, speed = 0.5, 200.0, 10.0, 1.3, 0.8
    case = links(inertia, elements=(ShiftElement(1, 0, "C", static=static),))
    pull = Formula(f"{rate}*({speed}*t - angle)")
    motion = run(case, 5.0, {1: 0.0}, ((1, pull),), {1: held(kinetic)}, engaged=(1,))
    own = math.sqrt(rate / inertia)
    beyond = (static - 1) * kinetic / rate
    slips = (math.pi + 2 * math.atan2(speed / own, beyond)) / own
    sticks = 2 * beyond / speed
    time, expected = static * kinetic / (rate * speed), []
    while time < 5:
        expected += [("C", "slips", time), ("C", "locks", time + slips)]
        time += slips + sticks
    expected = [one for one in expected if one[2] < 5]
    assert len(expected) > 6
    assert [one[:2] for one in happened(motion)] == [one[:2] for one in expected]
    assert [one[2] for one in happened(motion)] == pytest.approx([e[2] for e in expected], abs=1e-7)


def test_redundant_clutches_share_what_they_hold() -> None:
    """Two between the same links hold the sum of their capacities."""
    pair = (ShiftElement(1, 2, "A"), ShiftElement(1, 2, "B"))
    case = links(1.0, 1.0, elements=pair)
    ramp = points((0, 0), (2, 200))
    controls = {1: held(30), 2: held(50)}
    for end, torques in ((1.0, [25, 25]), (1.4, [30, 40])):
        motion = run(case, end, {1: 5.0, 2: 5.0}, ((1, ramp),), controls, engaged=(1, 2))
        assert not motion.events
        assert motion.torques[-1, :2] == pytest.approx(torques)
    assert motion.messages
    motion = run(case, 2.0, {1: 5.0, 2: 5.0}, ((1, ramp),), controls, engaged=(1, 2))
    assert {(name, what) for name, what, _ in happened(motion)} == {("A", "slips"), ("B", "slips")}
    assert [time for _, _, time in happened(motion)] == pytest.approx([1.6, 1.6], abs=EXACT)
    assert motion.torques[-1, :2] == pytest.approx([30, 50])


def test_two_lock_at_one_instant() -> None:
    pair = (ShiftElement(1, 0, "A"), ShiftElement(2, 0, "B"))
    controls = {1: held(5), 2: held(5)}
    motion = run(links(1.0, 1.0, elements=pair), 3.0, {1: 10.0, 2: 10.0}, controls=controls)
    assert [one[1] for one in happened(motion)] == ["locks", "locks"]
    assert [one[2] for one in happened(motion)] == pytest.approx([2, 2], abs=EXACT)


def test_capacity_that_returns() -> None:
    """A brake is let go and gripped again at once: no event where nothing moves."""
    case = links(1.0, elements=(ShiftElement(1, 0, "B"),))
    control = capacity((0, 50), (1, 50), (1, 0), (1.5, 0), (1.5, 50))
    motion = run(case, 3.0, {1: 0.0}, ((1, constant(10)),), {1: control}, engaged=(1,))
    # free from 1 to 1.5 s: 5 rad/s, then -40 rad/s^2
    slips, locks = pytest.approx(1, abs=1e-12), pytest.approx(1.625, abs=EXACT)
    assert happened(motion) == [("B", "slips", slips), ("B", "locks", locks)]


@pytest.mark.parametrize("step", [0.0371, 0.0037])
def test_heat_up_to_each_step(step: float) -> None:
    """Between the points of integration, too: capacity by the angle of slip, (w0^2 - w^2) J/2."""
    brake, spring = ShiftElement(1, 0, "B"), Spring(between(2), 4e4, damping=2.0)
    case = links(0.5, 1.0, elements=(brake,), springs=(spring,))
    start = Start(speeds={1: 100.0, 2: 1.0})
    motion = simulate(Scenario(case, 0.5, start, {1: held(60)}), step=step)
    expected = 0.25 * (100**2 - motion.speeds[:, 0] ** 2)
    assert motion.heat[:, 0] == pytest.approx(expected, abs=1e-7)
    assert len(motion.time) > 0.5 / step


LOAD = Load(100, 20)


def dragged_link(law: Law, inertia: float = 0.5) -> Transmission:
    return replace(links(inertia), gears=[Gear(drag={1: law})], load=LOAD)


def joined(element: ShiftElement, *inertias: float) -> Transmission:
    return replace(links(*inertias), shift_elements=[element], load=LOAD)


@each_seed(6)
def test_coast_down_by_a_constant_and_a_slope(seed: int) -> None:
    """J dw/dt = -a - b w: w + a/b = (w0 + a/b) exp(-b t/J) until it rests, backward as forward."""
    random = seeded(seed)
    a, b, inertia, w0 = (random.uniform(*ends) for ends in ((1, 5), (0.1, 0.5), (0.5, 2), (20, 90)))
    rest = inertia / b * math.log(1 + b * w0 / a)
    steep = PointLaw([(0, a), (100, a + 100 * b)])
    for law in (steep, DragFormula(f"{a!r} + {b!r}*w")):
        for way in (1, -1):
            motion = run(dragged_link(law, inertia), rest * 1.5, {1: way * w0})
            moving = motion.time < rest
            expected = (w0 + a / b) * np.exp(-b * motion.time[moving] / inertia) - a / b
            np.testing.assert_allclose(
                motion.speeds[moving, 0] * way, expected, atol=w0 * EXACT, rtol=0
            )
            assert motion.speeds[-1, 0] == 0
            assert sum(motion.energy.losses.values()) == pytest.approx(inertia * w0**2 / 2)


def test_a_drag_that_begins_with_the_speed_holds_nothing_at_rest() -> None:
    """J dw/dt = T - b w from rest: w = T/b (1 - exp(-b t/J))."""
    for law in (PointLaw([(0, 0), (100, 20)]), DragFormula("0.2*w")):
        motion = run(dragged_link(law), 4.0, {1: 0.0}, ((1, constant(5)),))
        assert motion.speeds[-1, 0] == pytest.approx(25 * (1 - math.exp(-0.4 * 4)), rel=EXACT)
        assert run(dragged_link(law), 4.0, {1: 0.0}).speeds[-1, 0] == 0
        # -9 rad/s and 5 N*m: through 0 to +25 rad/s in the end
        through = run(dragged_link(law), 4.0, {1: -9.0}, ((1, constant(5)),)).speeds[-1, 0]
        assert through == pytest.approx(25 - 34 * math.exp(-0.4 * 4), rel=EXACT)


def test_a_link_is_held_up_to_its_drag_at_rest() -> None:
    """1.2 N*m holds 1 N*m, and 1.5 N*m turn the link with what is left."""
    case = dragged_link(DragFormula("1.2 + 0.02*w"))
    assert run(case, 4.0, {1: 0.0}, ((1, constant(1)),)).speeds[-1, 0] == 0
    turned = run(case, 4.0, {1: 0.0}, ((1, constant(1.5)),)).speeds[-1, 0]
    assert turned == pytest.approx(15 * (1 - math.exp(-0.02 * 4 / 0.5)), rel=EXACT)


def test_an_open_clutch_drags_by_points_of_its_slip() -> None:
    """Two links, s' = -T(s)/J with J = 1/(1/J1 + 1/J2): 4 N*m above 40 rad/s, to 6 at 20, to 0.

    From 50 to 40 rad/s: 10 J/4 s; to 20, where T = 8 - s/10: 10 J ln(6/4); then exp(-0.3 t/J).
    """
    drag = PointLaw([(0, 0), (20, 6), (40, 4)])
    case = joined(ShiftElement(1, 2, "C", drag=drag), 0.5, 0.2)
    motion = run(case, 3.0, {1: 50.0, 2: 0.0})
    together = 1 / (1 / 0.5 + 1 / 0.2)
    at_20 = together * (2.5 + 10 * math.log(1.5))
    left = 20 * math.exp(-0.3 * (3 - at_20) / together)
    assert motion.speeds[-1, 0] - motion.speeds[-1, 1] == pytest.approx(left, rel=1e-7)
    # no torque acts from outside
    assert 0.5 * motion.speeds[-1, 0] + 0.2 * motion.speeds[-1, 1] == pytest.approx(25, rel=EXACT)
    assert motion.energy.losses["C"] == pytest.approx(together * (50**2 - left**2) / 2, rel=1e-7)


def test_a_clutch_that_closes_drags_no_more() -> None:
    """It drags with w/10 N*m for a second, then brakes with 30 N*m: heat is no loss."""
    drag = DragFormula("w/10")
    case = joined(ShiftElement(1, 0, "B", drag=drag), 0.5)
    motion = run(case, 3.0, {1: 60.0}, controls={1: capacity((1, 0), (1, 30))})
    after = 60 * math.exp(-0.2)
    [(name, what, time)] = happened(motion)
    assert (name, what) == ("B", "locks")
    assert time == pytest.approx(1 + 0.5 * after / 30, abs=1e-7)
    assert motion.energy.heat["B"] == pytest.approx(0.5 * after**2 / 2, rel=1e-7)


def test_an_open_brake_whose_number_exceeds_the_number_of_links_drags() -> None:
    """J w' = -T: with 3 N*m and 0.5 kg*m^2, 60 rad/s end after 10 s."""
    brakes = [ShiftElement(1, 0, name, drag=drag) for name, drag in (("A", 0.0), ("B", 0.15))]
    case = replace(links(0.5), shift_elements=brakes, load=LOAD)
    motion = run(case, 4.0, {1: 60.0})
    assert motion.speeds[-1, 0] == pytest.approx(60 - 4 * 3 / 0.5, rel=EXACT)
    assert motion.energy.losses["B"] == pytest.approx(0.25 * (60**2 - 36**2), rel=EXACT)


def test_a_freewheel_between_links_that_come_to_rest_holds_to_the_end() -> None:
    """``sinh(w/d)`` of the first falls with exp(-M t/(J d)), and 1/w of the second grows by c t/J.

    Torques are formulas alone, so their size at the start is the scale of rounding errors.
    """
    wheel = ShiftElement(1, 2, "F", kind="freewheel")
    case = links(0.404, 0.04709, elements=(wheel,))
    torques = (1, Formula("-22.67*tanh(speed/0.9451)")), (2, Formula("-0.004164*speed*abs(speed)"))
    motion = run(case, 3.955, {1: 181.4, 2: 120.93}, torques)

    def slip(time: float) -> float:
        log_sinh = 181.4 / 0.9451 - 22.67 * time / (0.404 * 0.9451) - math.log(2)  # sinh x = e^x/2
        second = 1 / (1 / 120.93 + 0.004164 * time / 0.04709)
        return 0.9451 * math.asinh(math.exp(log_sinh)) - second

    [event] = [event for event in motion.events if event.event == "locks"]
    assert event.time == pytest.approx(brentq(slip, 3.0, 3.3), abs=1e-7)
    assert motion.speeds[-1] == pytest.approx(0.0, abs=1e-7)


def test_drag_that_turns_below_0_or_that_a_freewheel_cannot_have_is_refused() -> None:
    coasting = Scenario(dragged_link(DragFormula("1 - w/30")), 30.0, Start(speeds={1: 50.0}))
    stopped = simulate(coasting).stopped
    assert stopped is not None
    assert re.search(r"the drag torque of 1 is -0\.\d+ N\*m, expected 0 or more", stopped.message)
    wheel = ShiftElement(1, 0, "F", kind="freewheel", drag=DragFormula("w/10"))
    with pytest.raises(CaseError, match="the drag of F depends on speed") as caught:
        run(joined(wheel, 0.5), 1.0, {1: 50.0})
    assert caught.value.problems[0].path == ("case", "shift_elements", 1, "drag")


def test_losses_of_one_direction_of_power_count_in_this_direction_only() -> None:
    """J_1 u^2 and J_2 accelerate together; driven by link 2, the pair passes 0.8 of the power.

    Link 1 gains T/(J_1 + J_2/u^2) or, driven, u T/(J_2 + J_1 u^2/0.8) a second.
    """
    pair = Mechanism(1, 2, 0, -2.0, 1.0, back_efficiency=0.8, name="pair")
    case = Transmission(2, [], [pair], [Gear()], inertias={1: 0.5, 2: 3.0})
    changes = {1: 10 / (0.5 + 3 / 2**2), 2: 10 * 2 / (3 + 0.5 * 2**2 / 0.8)}
    for link, torque in ((1, 10.0), (2, -10.0)):
        motion = run(case, 0.5, {1: 50.0}, ((link, constant(torque)),))
        assert motion.speeds[-1, 0] == pytest.approx(50 + 0.5 * changes[link], rel=1e-9)
