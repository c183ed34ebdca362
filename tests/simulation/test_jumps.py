"""Torques that jump over the speed or the angle of their link: the motion slides on the jump.

Where both sides push a motion back to a jump the torque is what keeps it there, between both
values (A. F. Filippov, Differential equations with discontinuous righthand sides, 1988).
"""

import math
from functools import partial
from itertools import product

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import count, examples, seeded, seeds_with_slow, with_slow
from tests.simulation.boxes import held, planetary_set, points
from tests.simulation.control.written import simulated
from tests.simulation.test_closed_forms import EXACT, links, run
from tests.simulation.test_golden import happened
from vstatics import ShiftElement, Spring
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Formula, Points, Resistance, Scenario, Start, constant, simulate
from vstatics.simulation.bounds import wall_limit
from vstatics.simulation.scenario.laws import TorqueLaw

LIMITERS: list[str | Points] = [
    Points((0.0, 300.0, 300.0), (100.0, 100.0, 0.0), "speed"),
    "100*(speed < 300)",
    "100 - 50*(1 + sign(speed - 300))",
    "100*(not abs(speed) >= 300)",
]
"""100 N*m up to 300 rad/s, nothing above."""

Laws = tuple[tuple[int, TorqueLaw], ...]


@pytest.mark.parametrize("limiter", LIMITERS)
def test_a_limiter_keeps_its_speed_with_the_torque_of_the_load(limiter: str | Points) -> None:
    """J = 2, 50 N*m of friction: 300 rad/s after 8 s, then 50 N*m for 12 s."""
    law = Formula(limiter) if isinstance(limiter, str) else limiter
    motion = run(links(2.0), 20.0, {1: 100.0}, ((1, law), (1, Resistance(50.0))))
    sliding = motion.time >= 8 + 1e-6
    assert motion.speeds[sliding, 0] == pytest.approx(np.full(sliding.sum(), 300.0), rel=1e-14)
    speeding = (100 + 300) / 2 * 8
    assert motion.energy.work == pytest.approx(100 * speeding + 50 * 300 * 12, rel=EXACT)
    assert motion.energy.heat["1"] == pytest.approx(50 * (speeding + 300 * 12), rel=EXACT)
    assert not motion.events


def test_a_limiter_can_name_its_own_link() -> None:
    """J = 2 kg*m^2, 100 N*m: 300 rad/s after 6 s."""
    torque = "torques: {e: \"100*(speed('e') < 300)\"}\ntargets: {e: [300]}\n"
    motion = simulated(
        f"duration: 20\nstart: {{speeds: {{e: 0, o: 0}}}}\ncontrols: {{C: 0}}\n{torque}"
    )
    assert motion.speeds[-1].tolist() == pytest.approx([300, 0])
    assert motion.reached[0].time == pytest.approx(6)


def test_a_limiter_on_a_link_without_inertia() -> None:
    """It gives the 60 N*m at which the clutch slips, until 3 kg*m^2 turn with 300 rad/s."""
    case = links(0.0, 3.0, elements=(ShiftElement(1, 2, "C"),))
    laws: Laws = ((1, Formula("100*(speed < 300)")),)
    motion = run(case, 20.0, {1: 300.0, 2: 0.0}, laws, {1: held(60)})
    assert happened(motion) == [("C", "locks", pytest.approx(15.0, rel=EXACT))]
    assert motion.speeds[-1] == pytest.approx([300.0, 300.0], rel=1e-9)


LOAD = points((0, -50), (10, -50), (20, -150))
ENDS: list[tuple[str | Points, TorqueLaw, float, float, float]] = [
    # 100 N*m of load at 15 s: 62.5 rad/s are lost in 5 s more
    *((limiter, LOAD, 300.0, 20.0, 237.5) for limiter in LIMITERS),
    # from rest, a jump that pushes away starts as the formula has it: 0, 100 and -100 N*m
    ("100*(speed > 0)", constant(0), 0.0, 3.0, 0.0),
    ("100*(speed >= 0)", constant(0), 0.0, 3.0, 150.0),
    ("100*sign(speed - 1)", constant(0), 0.0, 3.0, -150.0),
    # a spring of constant force holds at rest; 40 N*m are left of 140
    ("-100*sign(angle)", constant(60), 0.0, 2.0, 0.0),
    ("-100*sign(angle)", constant(-60), 0.0, 2.0, 0.0),
    ("-100*sign(angle)", constant(140), 0.0, 2.0, 40.0),
]


def test_a_jump_holds_up_to_its_torques() -> None:
    """On 2 kg*m^2; what a jump holds does not move."""
    for law, other, start, duration, end in ENDS:
        own = Formula(law) if isinstance(law, str) else law
        motion = run(links(2.0), duration, {1: start}, ((1, own), (1, other)))
        assert motion.speeds[-1, 0] == pytest.approx(end, rel=EXACT, abs=1e-12)


def test_a_jump_over_the_angle_is_passed() -> None:
    """100 N*m over 30 rad, then -50: J w^2/2 is 3000 J there, and 0 after 60 rad more."""
    points_over = Points((0.0, 30.0, 30.0), (100.0, 100.0, -50.0), "angle")
    there, back = math.sqrt(2 * 30 * 2 / 100), math.sqrt(3000.0) / 25
    for law in (points_over, Formula("100*(angle < 30) - 50*(angle >= 30)")):
        start = Start(speeds={1: 0.0})
        motion = simulate(Scenario(links(2.0), there + back, start, torques=((1, law),)))
        assert motion.stopped is None
        assert motion.speeds[-1, 0] == pytest.approx(0.0, abs=1e-6)
        assert motion.energy.work == pytest.approx(0.0, abs=1e-6)


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


@pytest.mark.slow
def test_swings_between_two_jumps_of_a_clutch_and_a_load_come_to_rest() -> None:
    """J = 1 kg*m^2 at 3 rad/s, drawn back by 98 N*m; the clutch takes all of its 4.5 J."""
    case = (
        "inertias: {a: 1}\nsprings: {s: {links: [a, housing], stiffness: 1000}}\n"
        "shift_elements: {B: {links: [a, housing], capacity: 300 N*m}}\n"
    )
    control = "10 + 5*sign(slip('B')) + 20*sign(twist('s'))"
    motion = simulated(
        f'duration: 0.5\nstart: {{speeds: {{a: 3}}}}\ncontrols: {{B: "{control}"}}\n'
        "torques: {a: \"-98*sign(twist('s'))\"}\n",
        case,
    )
    assert motion.speeds[-1, 0] == pytest.approx(0.0, abs=1e-6)
    assert motion.energy.heat["B"] == pytest.approx(4.5, rel=1e-5)
    assert len(motion.events) < 100


MOVING = [
    "100*(speed < 300 + t)",
    "100*(300 > speed - t)",
    "50 - 50*sign(2*speed - 600 - 2*t)",
    "100*(abs(speed) < 300 + t)",
    "100*(max(speed, -speed) < min(t, 99) + 300)",
    "100*(not speed >= 300 + 2*sin(t/2)*cos(t/2) - sin(t) + t)",
]
"""100 N*m up to 300 rad/s + t, nothing above."""


@pytest.mark.parametrize("law", MOVING)
def test_a_limiter_that_rises_with_time_is_followed(law: str) -> None:
    """J = 2, 50 N*m of load: 25 rad/s^2 up to 300 + t after 1/24 s, then 2*1 + 50 N*m hold it."""
    laws: Laws = ((1, Formula(law)), (1, constant(-50.0)))
    motion = run(links(2.0), 3.0, {1: 299.0}, laws)
    sliding = motion.time >= 1 / 24 + 1e-6
    expected = 300 + motion.time[sliding]
    assert motion.speeds[sliding, 0] == pytest.approx(expected, rel=1e-13)
    assert motion.energy.work == pytest.approx(303**2 - 299**2, rel=EXACT)
    assert not motion.events


def test_a_law_that_brings_speed_and_angle_to_rest() -> None:
    """Sliding mode: from w = -10 angle on both die away as exp(-10 t) (V. I. Utkin, 1977).

    3 rad/s fall by 50 rad/s^2: 3 - 50 t = -10 (3 t - 25 t^2) after (sqrt(3400) - 20)/500 s.
    """
    motion = run(links(2.0), 0.5, {1: 3.0}, ((1, Formula("-100*sign(speed + 10*angle)")),))
    met = (math.sqrt(3400) - 20) / 500
    later = motion.time > met + 1e-6
    expected = (3 - 50 * met) * np.exp(-10 * (motion.time[later] - met))
    assert motion.speeds[later, 0] == pytest.approx(expected, rel=1e-7)


def test_two_limiters_that_cross() -> None:
    """The lower one of 310 - t and 300 + t holds, each by its own torque: 305 rad/s at 5 s."""
    text = "100*(speed < 310 - t)*(speed < 300 + t)"
    motion = run(links(2.0), 8.0, {1: 300.0}, ((1, Formula(text)), (1, constant(-50.0))))
    lower = np.minimum(310 - motion.time, 300 + motion.time)
    assert motion.speeds[:, 0] == pytest.approx(lower, rel=1e-9)


def test_what_leads_a_ring_gives_what_the_set_and_its_inertias_leave() -> None:
    """Torques on the members balance, whatever a set loses: T1 + T2 + T3 = sum J dw/dt."""
    case = planetary_set(0.96)
    led = Formula("-300*sign(speed - 20*t)")
    laws: Laws = ((1, constant(40.0)), (2, constant(-60.0)), (3, led))
    motion = run(case, 1.0, {1: 50.0, 2: 20.0}, laws)
    first, last = motion.speeds[[0, -1]]
    assert last[2] == pytest.approx(20.0, rel=EXACT)
    ring = float(np.dot(last - first, [case.inertias[link] for link in (1, 2, 3)])) + 60 - 40
    turned = (first + last) / 2
    given = 40 * turned[0] - 60 * turned[1] + ring * turned[2]
    assert motion.energy.work == pytest.approx(given, rel=EXACT)
    assert sum(motion.energy.losses.values()) > 1.0


def braked(law: str) -> Scenario:
    """Return a run of a link of 2 kg*m^2 from 3 rad/s, with a torque by a formula."""
    return Scenario(links(2.0), 2.0, Start(speeds={1: 3.0}), torques=((1, Formula(law)),))


@pytest.mark.parametrize(
    ("law", "speed"), [("-100*sign(speed^3 + speed - t)", 1.0), ("-99*sign(speed*t - 2)", 1.0)]
)
def test_a_motion_slides_along_a_curve_of_its_speed(law: str, speed: float) -> None:
    assert simulate(braked(law)).speeds[-1] == pytest.approx([speed], rel=EXACT)


@pytest.mark.slow
def test_a_run_that_leads_nowhere_is_stopped_at_its_law() -> None:
    for law, identity in (
        ("-1e9*tanh(speed/1e-6)", "E608"), ("-1e12*speed", "E608"), ("-9*sqrt(speed)", "E605"),
    ):  # fmt: skip
        stopped = simulate(braked(law), watch=wall_limit(20.0)).stopped
        assert stopped is not None
        assert (stopped.id, stopped.path) == (identity, ("torques", "1"))


def test_a_speed_that_passes_a_jump_for_a_moment_slides() -> None:
    """Of sin(10 t) all above .9999 is 2.8 ms long; a third of a swing is looked at at once."""
    case = links(1.0, springs=(Spring(between(1), stiffness=100.0),))
    laws: Laws = ((1, constant(10.0)), (1, Formula("-1000*(speed > 0.9999)")))
    motion = run(case, 0.3, {1: 0.0}, laws)
    assert motion.speeds[:, 0].max() == pytest.approx(0.9999, rel=1e-9)
    # it slides until the spring carries 10 N*m: .9999 rad/s from cos(10 t) = .01414 on
    turned = (1 - math.sqrt(1 - 0.9999**2)) / 10
    leaves = math.asin(0.9999) / 10 + (0.1 - turned) / 0.9999
    end = 0.9999 * math.cos(10 * (0.3 - leaves))
    assert motion.speeds[-1, 0] == pytest.approx(end, rel=1e-9)


def test_a_jump_on_a_link_without_inertia_behind_a_spring() -> None:
    """It slides at 60.41 rad/s, while the other link swings about that: its energy closes."""
    case = links(3.0, 0.0, springs=(Spring(between(1, 2), stiffness=2060.0),))
    laws: Laws = ((2, Formula("-130.5*sign(speed - 60.41)")),)
    motion = run(case, 2.0, {1: 100.0, 2: 100.0}, laws)
    sliding = motion.time > 1
    assert motion.speeds[sliding, 1] == pytest.approx(np.full(sliding.sum(), 60.41), rel=1e-9)
    assert np.abs(motion.speeds[sliding, 0] - 60.41).max() <= 130.5 / math.sqrt(2060 * 3) + 1e-9


@pytest.mark.parametrize("apart", ["slip('C')", "speed('a') - speed('b')"])
def test_links_that_stick_to_each_other_have_no_speed_apart(apart: str) -> None:
    """Torques are constant until the clutch locks up; then sign(0) = 0, and only b is pulled."""
    rng = seeded(71)
    for _ in range(count(3, 60)):
        first, second = rng.uniform(0.5, 3), rng.uniform(0.5, 3)
        slip, push, pull = rng.uniform(5, 30), rng.uniform(5, 20), rng.uniform(10, 60)
        motion = simulated(
            f"duration: 3\nstart: {{speeds: {{a: {slip!r}, b: 0}}}}\ncontrols: {{C: 100}}\n"
            f'torques: {{a: "-{push!r}*sign({apart})", b: {pull!r}}}\n',
            f"{{inertias: {{a: {first!r}, b: {second!r}}}, gears: {{g: []}}, "
            "shift_elements: {C: [a, b]}}",
        )
        locks = slip / ((100 + push) / first + (100 + pull) / second)
        speed = (100 + pull) / second * locks + pull / (first + second) * (3 - locks)
        assert happened(motion) == [("C", "locks", pytest.approx(locks, rel=1e-9))]
        assert motion.speeds[-1] == pytest.approx([speed, speed], rel=1e-9)


@examples(2, 6, 60)
def test_a_clutch_at_its_capacity_and_a_jump_of_its_slip_hold_a_link_together(
    examples: int,
) -> None:
    """The clutch carries its capacity from the instant at which it alone cannot hold a to b."""
    rng = seeded(72)
    for number in range(examples):
        first, second, pull = rng.uniform(0.5, 3), rng.uniform(0.5, 3), rng.uniform(10, 60)
        needed = pull * first / (first + second)
        capacity, push = needed * rng.uniform(1.2, 3), rng.uniform(0.1, 0.9) * pull * first / second
        apart = ["slip('C')", "speed('a') - speed('b')"][number % 2]
        motion = simulated(
            "duration: 1\nstart: {speeds: {a: 0, b: 0}}\n"
            f"controls: {{C: [[0, {capacity!r}], [0.8, 0]]}}\n"
            f'torques: {{a: "-{push!r}*sign({apart})", b: {pull!r}}}\n',
            f"{{inertias: {{a: {first!r}, b: {second!r}}}, gears: {{g: []}}, "
            "shift_elements: {C: [a, b]}}",
        )
        slips = 0.8 * (1 - needed / capacity)
        parts = 0.8 * (1 - (needed - push * second / (first + second)) / capacity)

        def carried(since: float, capacity: float = capacity) -> float:
            return capacity * (0.8 - since) ** 2 / 1.6

        before = pull / (first + second) * slips
        b = before + (pull * (1 - slips) - carried(slips)) / second
        at_parting = before + (pull * (parts - slips) - carried(slips) + carried(parts)) / second
        a = at_parting + (push * (1 - parts) + carried(parts)) / first
        assert happened(motion)[0] == ("C", "slips", pytest.approx(slips, rel=1e-8))
        assert motion.speeds[-1] == pytest.approx([a, b], rel=1e-8)


@pytest.mark.parametrize(
    "drawn",
    with_slow(
        [(2, 111), (2, 126), (3, 17)],
        [(2, 107), (2, 118), (2, 132), *product((2, 3), range(count(0, 60)))],
    ),
)
def test_a_motion_leaves_some_of_the_jumps_that_it_meets_at_once(drawn: tuple[int, int]) -> None:
    """Clutches in a row grip above a slip each; the integrator has narrow ramps for jumps."""
    clutches, seed = drawn
    rng = seeded(seed)
    inertias = [rng.uniform(0.3, 3) for _ in range(clutches + 1)]
    capacities, slips = (
        [rng.uniform(*ends) for _ in range(clutches)] for ends in ((40, 150), (2, 15))
    )
    between = [rng.uniform(-10, 10) for _ in range(clutches - 1)]
    loads = [rng.uniform(-20, 20), *between, rng.uniform(-40, 0)]
    middle = [rng.uniform(20, 60) for _ in range(clutches - 2)]
    start = [0.0, rng.uniform(60, 100), *middle, rng.uniform(40, 70)]
    texts = [
        ", ".join(f"{link}: {value!r}" for link, value in zip("abcd", values, strict=False))
        for values in (inertias, loads, start)
    ]
    controls = [
        f"{name}: \"{capacity!r}*(abs(slip('{name}')) > {slip!r})\""
        for name, capacity, slip in zip("CDE", capacities, slips, strict=False)
    ]
    joined = ", ".join(["C: [a, b]", "D: [b, c]", "E: [c, d]"][:clutches])
    motion = simulated(
        f"duration: 1\nstart: {{speeds: {{{texts[2]}}}}}\ntorques: {{{texts[1]}}}\n"
        f"controls: {{{', '.join(controls)}}}\n",
        f"{{inertias: {{{texts[0]}}}, shift_elements: {{{joined}}}, gears: {{g: []}}}}",
    )

    def change(_t: float, speeds: Floats) -> list[float]:
        apart = (speeds[:-1] - speeds[1:]).tolist()
        carried = [
            capacity * (1 + math.tanh((abs(slip) - least) / 1e-4)) / 2 * math.tanh(slip / 1e-4)
            for capacity, slip, least in zip(capacities, apart, slips, strict=True)
        ]
        torques = zip(loads, [0.0, *carried], [*carried, 0.0], inertias, strict=True)
        return [(load + before - behind) / inertia for load, before, behind, inertia in torques]

    found = solve_ivp(change, (0.0, 1.0), start, "Radau", rtol=1e-7, atol=1e-8, max_step=0.01)
    assert motion.speeds[-1] == pytest.approx(found.y[:, -1], abs=5e-3)


@seeds_with_slow(3, 20, 60)
def test_a_clutch_breaks_away_by_a_jump_at_the_slip_of_another(seed: int) -> None:
    """C slips, and D behind a spring sticks until the jump, where the reference integrator stops."""
    rng = seeded(seed)
    inertias = [rng.uniform(0.9, 1.1) * each for each in (1.4, 2, 3, 0.5)]
    least, stiffness, damping = (rng.uniform(*ends) for ends in ((1, 4), (500, 2000), (1, 9)))
    names = [f"{link}: {value!r}" for link, value in zip("abcd", inertias, strict=True)]
    case = (
        f"inertias: {{{', '.join(names)}}}\nshift_elements: {{C: [a, b], D: [c, d]}}\n"
        f"springs: {{s: {{links: [b, c], stiffness: {stiffness!r}, damping: {damping!r}}}}}\n"
        "gears: {g: []}\n"
    )

    def change(_: float, state: Floats, jumps: float, carried: float) -> list[float]:
        a, b, c, _, twist = state.tolist()
        sprung = stiffness * twist + damping * (b - c)
        if not jumps:
            carried = sprung * inertias[3] / (inertias[2] + inertias[3])
        slips = math.copysign(200, a - b)
        torques = -slips - 800 * c, slips - sprung, jumps + sprung - carried, carried
        return [*(torque / each for torque, each in zip(torques, inertias, strict=True)), b - c]

    def reaches(_t: float, state: Floats, *_: float) -> float:
        return float(state[0] - state[1]) - least

    reaches.terminal = True  # type: ignore[attr-defined]
    integrated = partial(solve_ivp, change, method="DOP853", rtol=1e-11, atol=1e-12)
    first = integrated((0, 1), [least + 6, 0, 0, 0, 0], args=(0.0, 0.0), events=reaches)
    end = float(first.t[-1]) + 0.02
    then = integrated((first.t[-1], end), first.y[:, -1], args=(1200.0, 60.0))
    motion = simulated(
        f"duration: {end!r}\nstart: {{speeds: {{a: {least + 6!r}, b: 0, c: 0, d: 0}}}}\n"
        "controls: {C: 200, D: 60}\n"
        f"torques: {{a: \"-800*speed('c')\", c: \"1200*(slip('C') <= {least!r})\"}}\n",
        case,
    )
    assert motion.speeds[-1] == pytest.approx(then.y[:4, -1], abs=1e-5)


@pytest.mark.parametrize("law", ["25*(sin(angle) > 0)", "25*sign(sin(angle))"])
def test_a_torque_that_jumps_at_the_start_breaks_dry_friction(law: str) -> None:
    """The momentum of 0.5*5 + 2*5 grows by 25*0.3, and both links have the same speed at the end."""
    motion = simulated(
        f'duration: 0.3\nstart: {{speeds: {{b: 5, c: 5}}}}\ntorques: {{b: "{law}"}}\n',
        "inertias: {b: 0.5, c: 2}\ngears: {g: []}\n"
        "springs: {s: {links: [b, c], stiffness: 3000, friction: 3}}\n",
    )
    assert motion.speeds[-1] == pytest.approx([8.0, 8.0], rel=1e-9)
