"""Springs with points of twist and torque, and dry friction beside springs."""

import math
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import count, seeded, seeds_with_slow, with_slow
from tests.simulation.test_closed_forms import links, run
from vstatics import CaseError, Damping, ShiftElement, Spring
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import (
    Capacity,
    Motion,
    Points,
    Resistance,
    Scenario,
    Start,
    constant,
    simulate,
)

Line = list[tuple[float, float]]
PLAY: Line = [(0, 0), (0.05, 0), (1.05, 500)]


def torque(motion: Motion, name: str = "S") -> Floats:
    return motion.torques[:, motion.devices.index(name)]


def test_dry_friction_takes_as_much_of_the_swing_each_time() -> None:
    """Amplitudes fall by 2 F/k from one to the next, 4 F/k a cycle, until friction holds."""
    stiffness, friction = 500.0, 14.0
    case = links(2.0, springs=(Spring(between(1), stiffness, friction=friction, name="S"),))
    motion = run(case, 5.0, {1: 3.0})
    # 9 J = k A^2/2 + F A, then 2 F/k less each time
    amplitudes = [(-friction + math.sqrt(friction**2 + 2 * stiffness * 9.0)) / stiffness]
    while amplitudes[-1] * stiffness > friction:
        amplitudes.append(amplitudes[-1] - 2 * friction / stiffness)
    way = amplitudes[0] + sum(one + other for one, other in pairwise(amplitudes))
    assert motion.energy.heat["S"] == pytest.approx(friction * way, rel=1e-9)
    assert motion.energy.elastic == pytest.approx(stiffness * amplitudes[-1] ** 2 / 2, rel=1e-8)
    assert torque(motion)[-1] == pytest.approx(0.0, abs=1e-6)  # friction bears the spring
    assert not motion.events


def test_in_its_play_a_spring_has_the_torque_of_its_friction_which_can_hold_a_link() -> None:
    spring = Spring(between(1), points=PLAY, damping=4.0, friction=14.0, name="S")
    motion = run(links(2.0, springs=(spring,)), 0.01, {1: 3.0})
    assert torque(motion) == pytest.approx(14.0)
    assert motion.energy.heat["S"] == pytest.approx(9.0 - motion.speeds[-1, 0] ** 2)
    motion = run(links(2.0, springs=(spring,)), 1.0, {1: 0.0}, ((1, constant(13.9)),))
    assert not motion.speeds.any()
    assert torque(motion) == pytest.approx(13.9)


@pytest.mark.parametrize("given", [0.0, 40.0, -40.0])
def test_settled_springs_stand_where_their_points_carry_the_torque(given: float) -> None:
    """Friction carries nothing: let go, the mass swings by ``(T - F)/k`` about where F holds it."""
    case = links(2.0, springs=(Spring(between(1), points=PLAY, friction=9.0, name="S"),))
    let_go = Points((0.0, 0.1, 0.1), (given, given, 0.0))
    start = Start(speeds={1: 0.0}, settled=True)
    motion = simulate(Scenario(case, 0.14, start, torques=((1, let_go),)))
    omega, size = math.sqrt(500 / 2), max(abs(given) - 9.0, 0.0) / 500
    swung = -math.copysign(omega * size * math.sin(omega * 0.04), given)
    assert not motion.speeds[motion.time < 0.1].any()
    assert motion.speeds[-1, 0] == pytest.approx(swung, rel=1e-9)


def test_a_torque_that_points_do_not_reach_is_reported() -> None:
    flat = Spring(between(1), points=[(0, 0), (0.1, 8), (0.3, 8)], name="S")
    case, start = links(2.0, springs=(flat,)), Start(speeds={1: 0.0}, settled=True)
    scenario = Scenario(case, 1.0, start, torques=((1, constant(9.0)),))
    with pytest.raises(CaseError, match=r"S has a torque of 9 N\*m at the start"):
        simulate(scenario)


def test_a_link_without_inertia_between_springs_passes_their_corners() -> None:
    """Both in a row are one spring whose twist is the sum at each torque."""
    first: Line = [(-0.1, -20), (0.1, 20), (0.2, 120)]
    second: Line = [(-0.1, -30), (0.1, 30), (0.2, 90)]
    # of both at -30, -20, 20, 30, 90 N*m
    both: Line = [(-0.25, -30), (-0.1 - 0.2 / 3, -20), (0.1 + 0.2 / 3, 20), (0.21, 30), (0.37, 90)]
    pair = Spring(between(1, 2), points=first), Spring(between(2, 3), points=second)
    row = links(2.0, 0.0, 3.0, springs=pair)
    one = links(2.0, 3.0, springs=(Spring(between(1, 2), points=both),))
    made = run(row, 0.6, {1: 5.0, 2: 2.0, 3: 0.0})
    expected = run(one, 0.6, {1: 5.0, 2: 0.0})
    assert made.speeds[-1, [0, 2]] == pytest.approx(expected.speeds[-1], rel=1e-8)


def random_points(rng: Random) -> Line:
    """Two to five, odd or not, with play as often as not."""
    number = rng.randint(2, 5)
    twists = sorted(rng.uniform(-0.3, 0.3) for _ in range(number))
    torques = sorted(rng.choice((0.0, rng.uniform(-200, 200))) for _ in range(number))
    torques[-1] += 20.0
    if rng.random() < 0.5:
        twists = [0.0, *sorted(map(abs, twists))]
        torques = [0.0, *sorted(map(abs, torques))]
    elif twists[0] > 0:
        twists = [one - 0.4 for one in twists]
    return list(zip(twists, torques, strict=True))


def steepest(lines: list[Line]) -> float:
    """The largest slope of all [N*m/rad]."""
    points = (np.array(line).T for line in lines)
    return max(float((np.diff(y) / np.diff(x)).max()) for x, y in points)


def extended(points: Line, twist: Floats) -> Floats:
    """Torques by NumPy, with the last slope beyond the ends."""
    x, y = np.array(points).T
    if x[0] >= 0:
        x, y = np.concatenate([-x[:0:-1], x]), np.concatenate([-y[:0:-1], y])
    made = np.interp(twist, x, y)
    made += np.where(twist > x[-1], (twist - x[-1]) * (y[-1] - y[-2]) / (x[-1] - x[-2]), 0)
    return np.asarray(
        made + np.where(twist < x[0], (twist - x[0]) * (y[1] - y[0]) / (x[1] - x[0]), 0)
    )


def random_chain(rng: Random) -> tuple[Scenario, list[Line]]:
    number = rng.randint(2, 4)
    lines = [random_points(rng) for _ in range(number - 1)]
    springs = [
        Spring(between(n, n + 1), points=line, damping=_random_damping(rng, line))
        for n, line in enumerate(lines, 1)
    ]
    case = links(*(rng.uniform(0.2, 3) for _ in range(number)), springs=tuple(springs))
    ramp = Points((0.0, 0.4), (rng.uniform(-50, 50), rng.uniform(-50, 50)))
    start = Start(speeds={n: rng.uniform(-5, 5) for n in range(1, number + 1)})
    return Scenario(case, 0.6, start, torques=((1, ramp),)), lines


def _random_damping(rng: Random, line: Line) -> float:
    """None beside a play, in whose contact an integrator without events would have it pull."""
    damping = rng.choice((0.0, rng.uniform(0, 5)))
    has_play = sum(torque == 0 for _, torque in line) > 1 or line[0][0] == line[1][1] == 0
    return 0.0 if has_play else damping


def integrated(scenario: Scenario, lines: list[Line]) -> Floats:
    """The speeds at the end, by an explicit method of SciPy with short steps."""
    case = scenario.case
    number = case.links
    masses = np.array([case.inertias[n] for n in range(1, number + 1)])
    damping = np.array([one.damping.viscous for one in case.springs])  # type: ignore[union-attr]
    [(_, law)] = scenario.torques
    assert isinstance(law, Points)

    def change(time: float, state: Floats) -> Floats:
        speeds, twists = state[:number], state[number:]
        rates = -np.diff(speeds)
        carried = [extended(*one) for one in zip(lines, twists, strict=True)] + damping * rates
        loads = np.zeros(number)
        loads[0] = np.interp(time, law.x, law.y)
        loads[:-1] -= carried
        loads[1:] += carried
        return np.concatenate([loads / masses, rates])

    longest = 5e-4 if steepest(lines) < 1000 else 5e-5  # it knows no corners
    state = np.concatenate([[*scenario.start.speeds.values()], np.zeros(len(lines))])
    for begin, end in ((0.0, 0.4), (0.4, 0.6)):
        found = solve_ivp(
            change, (begin, end), state, method="DOP853", rtol=1e-10, atol=1e-12, max_step=longest
        )
        state = found.y[:, -1]
    return np.asarray(state[:number])


@pytest.mark.parametrize("seed", with_slow([2], [0, *range(3, count(6, 60))]))
def test_random_chains_agree_with_an_independent_integrator(seed: int) -> None:
    rng = seeded(seed)
    scenario, lines = random_chain(rng)
    while steepest(lines) > 4000:  # the other one would take steps too short
        scenario, lines = random_chain(rng)
    motion = simulate(scenario)
    assert motion.stopped is None
    assert motion.speeds[-1] == pytest.approx(integrated(scenario, lines), rel=1e-6, abs=1e-6)


@seeds_with_slow(2, 8, 100)
def test_the_energy_of_random_chains_with_friction_closes(seed: int) -> None:
    rng = seeded(100 + seed)
    scenario, _ = random_chain(rng)
    case = scenario.case
    springs = [one._replace(friction=rng.choice((0.0, rng.uniform(1, 40)))) for one in case.springs]
    inertias = dict(case.inertias)
    if case.links > 2 and rng.random() < 0.3:
        del inertias[2]
        springs[0] = springs[0]._replace(friction=20.0)
    clutch, capacity = ShiftElement(case.links, name="C"), Points((0.0, 0.3), (0.0, 60.0))
    case = case.replace(springs=springs, inertias=inertias, shift_elements=[clutch])
    motion = simulate(scenario._replace(case=case, controls={1: Capacity(capacity)}))
    assert motion.stopped is None
    assert {event.element for event in motion.events} <= {"C"}


def test_loss_factors_damp_as_at_the_lowest_natural_frequency() -> None:
    """2 kg*m^2 on 200 N*m/rad swing with 10 rad/s; the damping ratio is half of the factor.

    The springs of 300 and 600 N*m/rad in a row, with a link without inertia between, are one spring.
    """
    springs = [
        Spring(twist, stiffness, damping=Damping(loss_factor=0.2))
        for twist, stiffness in ((between(1), 300.0), (between(2, 1), 600.0))
    ]
    motion = run(links(0.0, 2.0, springs=tuple(springs)), 1.0, {2: 1.0})
    assert [(one.id, one.text.endswith("1.592 Hz")) for one in motion.messages] == [("N601", True)]
    own = math.sqrt(1 - 0.1**2)
    phase = 10 * own * motion.time
    expected = np.exp(-motion.time) * (np.cos(phase) - 0.1 / own * np.sin(phase))
    assert motion.speeds[:, 1] == pytest.approx(expected, abs=1e-8)
    free = run(links(0.0, 2.0, springs=(springs[1],)), 1.0, {2: 1.0})
    assert [one.id for one in free.messages] == ["W601"]


def test_friction_at_rest_leaves_loss_factors_their_effect() -> None:
    """2 kg*m^2 on 200 N*m/rad swing with 10 rad/s, also if friction holds them at the start."""
    spring = Spring(between(1), 200.0, damping=Damping(loss_factor=0.2))
    for held, load in ((spring._replace(friction=3.0), 0.0), (spring, 3.0)):
        motion = run(links(2.0, springs=(held,)), 0.1, {1: 0.0}, ((1, Resistance(load)),))
        assert [(one.id, one.text[-8:]) for one in motion.messages] == [("N601", "1.592 Hz")]
