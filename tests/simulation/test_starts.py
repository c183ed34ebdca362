"""What determines the speeds at the start: given speeds, freewheels, links without inertia."""

from random import Random

import numpy as np
import pytest
from scipy.linalg import null_space

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.simulation.control.written import faults, simulated
from tests.simulation.reference import mechanism_columns
from tests.simulation.runs import random_box
from vstatics.simulation import Points, Scenario, simulate

STARTS = ("", "start:\n", "start: {}\n", "start: {speeds: {}}\n", "start: {engaged: []}\n")


@pytest.mark.parametrize("start", STARTS)
def test_a_start_is_needed_unless_the_speeds_of_all_links_are_given(start: str) -> None:
    """30 N*m at a slip of 20 rad/s for 60 s."""
    motion = simulated(f"duration: 60\n{start}speeds: {{e: 70, o: 50}}\ncontrols: {{C: 30}}\n")
    assert motion.energy.heat["C"] == pytest.approx(30 * 20 * 60)
    [fault] = faults(f"duration: 60\n{start}controls: {{C: 30}}\n")
    assert "expected `gear`, or `speeds`" in fault or "is empty" in fault


def free_links(columns: np.ndarray, rng: Random) -> list[int]:
    """Links, by index, whose speeds determine all others, in a random order."""
    basis = null_space(columns)
    chosen: list[int] = []
    for link in rng.sample(range(len(basis)), len(basis)):
        if np.linalg.matrix_rank(basis[[*chosen, link]], tol=1e-3) > len(chosen):
            chosen.append(link)
    return chosen


@seeds_with_slow(8, 25, 2000)
def test_the_links_of_any_train_follow_the_given_speeds(seed: int) -> None:
    """By the null space of the mechanisms."""
    rng = seeded(seed)
    case = random_box(rng)
    columns = np.array(mechanism_columns(case))
    chosen = free_links(columns, rng)
    ends = np.array([[rng.uniform(-50, 50) for _ in chosen] for _ in range(2)])
    speeds = {
        link + 1: Points((0.0, 0.5), (first, last), "time")
        for link, first, last in zip(chosen, *ends.tolist(), strict=True)
    }
    motion = simulate(Scenario(case, 0.5, speeds=speeds))
    assert motion.stopped is None, motion.stopped
    basis = null_space(columns)
    wanted = ends @ np.linalg.inv(basis[chosen]).T @ basis.T
    assert motion.speeds[[0, -1]] == pytest.approx(wanted, abs=1e-7)


@each_seed(12, 200)
def test_given_speeds_are_recorded_as_given(seed: int) -> None:
    """Speeds of links that a clutch joins are exactly equal, and speeds at rest are exactly 0."""
    rng = seeded(seed)
    ratio, pair = (round(rng.uniform(-4, -1.2), 3) for _ in range(2))
    case = f"""links: [e, s, r, c, o]
inertias: {{e: 1, s: 0.1, r: 0.2, c: 0.3, o: 3}}
mechanisms:
  set: {{first: s, second: r, third: c, ratio: {ratio}}}
  pair: {{first: c, second: o, ratio: {pair}}}
shift_elements: {{C: [e, s], B: [r, housing]}}
gears: {{low: [C, B]}}
"""
    speed = rng.choice([100.0, 314.16, round(rng.uniform(1, 600), 2)])
    start = f"duration: 0.3\nstart: {{gear: low, speed: {speed}}}\ntorques: {{e: 10}}\n"
    motion = simulated(start, case)
    engine, sun, ring = motion.speeds.T[:3].tolist()
    assert engine[0] == sun[0] == speed
    assert not any([*ring, *motion.slips.ravel().tolist()])


BEHIND_FREEWHEEL = """links: [shaft, {races}]
inertias: {{shaft: {inertia!r}}}
shift_elements:
  B: {{links: [{last}, housing], capacity: 1 kN*m}}
{freewheels}gears: {{"1": []}}
"""


@pytest.mark.parametrize("by", ["gear", "speeds"])
@seeds_with_slow(4, 12, 1000)
def test_a_brake_behind_freewheels_stops_a_shaft_in_one_direction(seed: int, by: str) -> None:
    """Closed form: only backward it brakes, by its capacity from an instant on; then it holds."""
    rng = seeded(seed)
    races = [f"race {number}" for number in range(rng.randint(1, 4))]
    chain = ["shaft", *races]
    freewheels = "".join(
        f"  F{n}: {{kind: freewheel, links: [{first}, {second}]}}\n"
        for n, (first, second) in enumerate(zip(chain, races, strict=False))
    )
    inertia, capacity = rng.uniform(0.1, 5), rng.uniform(20, 200)
    given = {"races": ", ".join(races), "last": races[-1], "inertia": inertia}
    case = BEHIND_FREEWHEEL.format(freewheels=freewheels, **given)
    begin, torque, at = rng.uniform(-80, 80), rng.uniform(-15, 15), rng.uniform(0.05, 0.5)
    start = "{gear: '1', speed: %r}" if by == "gear" else "{speeds: {shaft: %r}}"
    motion = simulated(
        f"duration: 1\nstart: {start % begin}\ntorques: {{shaft: {torque!r}}}\n"
        f"controls: {{B: [[{at!r}, 0], [{at!r}, {capacity!r}]]}}\n",
        case,
    )
    last = begin + torque / inertia * at
    if last < 0:
        stop = at - last * inertia / (torque + capacity)
        if stop > 1:
            last += (torque + capacity) / inertia * (1 - at)
        else:
            last = max(torque, 0) / inertia * (1 - stop)
    else:
        last = begin + torque / inertia
        if last < 0:
            last = 0.0  # it comes to rest on the brake, which holds
    assert motion.speeds[-1, 0] == pytest.approx(last, abs=1e-7)
    assert motion.speeds[0] == pytest.approx([begin] * len(chain))  # all races turn with it


def test_a_link_without_inertia_between_open_clutches_that_drag_needs_no_start() -> None:
    """Both drags are 1 N*m: the middle link may turn with either, and passes 1 N*m."""
    case = """links: [a, middle, b]
inertias: {a: 2, b: 3}
shift_elements:
  B: {links: [middle, b], capacity: 100 N*m, drag: 1 N*m}
  C: {links: [a, middle], capacity: 100 N*m, drag: 1 N*m}
"""
    motion = simulated(
        "duration: 1\nstart: {speeds: {a: -50, b: -30}}\ncontrols: {B: 0, C: 0}", case
    )
    assert motion.speeds[-1, [0, 2]].tolist() == pytest.approx([-50 + 1 / 2, -30 - 1 / 3])


def test_a_freewheel_holds_in_the_start_gear_although_losses_depend_on_an_unknown_load() -> None:
    """The ring is held: the ratio is 2.5, the efficiency (1 + 1.5*0.9)/2.5; the drag is 2 N*m."""
    case = """links: [in, ring, out]
input: in
output: out
inertias: {in: 0.3, out: 7}
mechanisms:
  set: {first: in, second: ring, third: out, ratio: -1.5, efficiency: 0.9 + 0*T}
shift_elements: {F: {kind: freewheel, links: [ring, housing]}}
drag: {in: 2 + 0*w}
gears: {low: []}
"""
    motion = simulated("duration: 1\nstart: {gear: low, speed: 100}\ntorques: {in: 100}\n", case)
    # sun m, carrier m (1 + 1.5*0.9): 0.3 a = 98 - m, 7 a/2.5 = 2.35 m
    assert motion.speeds[-1, 0] == pytest.approx(100 + 98 / (0.3 + 7 / 2.5 / 2.35), rel=1e-12)
    assert "speed" in motion.plot()._repr_svg_()
