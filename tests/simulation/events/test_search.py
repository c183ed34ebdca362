"""The search for what sticks: bounded, however many sets and brakes may stick or slip.

Whatever the sets: a motion exists, since a brake that slips is a given torque. What is found closes
its energy, and no brake carries more than it can.
"""

from collections.abc import Mapping, Sequence
from random import Random
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import seeded, seeds_with_slow, with_slow
from tests.simulation.boxes import capacity
from tests.simulation.test_closed_forms import links, run
from tests.simulation.test_golden import closes
from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.simulation import Motion, Scenario, Start, constant, simulate


class Set(NamedTuple):
    """A set of a cascade, and what the brake of its ring can carry in the end."""

    ratio: float
    efficiency: float
    capacity: float
    """[N*m]"""


def cascade(sets: Sequence[Set], inertias: Mapping[int, float]) -> Transmission:
    count = len(sets)
    rings, gear = range(count + 2, 2 * count + 2), Gear([*range(1, count + 1)], name="1")
    brakes = [ShiftElement(ring, 0) for ring in rings]
    mechanisms = [
        Mechanism(number, ring, number + 1, one.ratio, one.efficiency)
        for number, (ring, one) in enumerate(zip(rings, sets, strict=True), 1)
    ]
    links, output = 2 * count + 1, count + 1
    return Transmission(links, brakes, mechanisms, [gear], output=output, inertias=inertias)


def closing(sets: Sequence[Set], inertias: Mapping[int, float], *torques: float) -> Motion:
    """All brakes close within .3 s; torques on both ends."""
    case = cascade(sets, inertias)
    controls = {number: capacity((0, 0), (0.3, one.capacity)) for number, one in enumerate(sets, 1)}
    laws = tuple(zip((1, len(sets) + 1), map(constant, torques), strict=True))
    return simulate(Scenario(case, 0.5, Start(gear="1"), controls, laws))


def runs(motion: Motion, sets: Sequence[Set]) -> bool:
    """Whether it comes to its end, its energy closes, and no brake carries more than it can."""
    limits = np.minimum(motion.time / 0.3, 1)[:, None] * [one.capacity for one in sets]
    brakes = [motion.devices.index(f"T{number}") for number in range(1, len(sets) + 1)]
    over = np.abs(motion.torques[:, brakes]) - limits
    return motion.stopped is None and closes(motion) and bool((over <= 1e-6 * limits.max()).all())


@pytest.mark.parametrize("given", with_slow([(4, -2.0)], [(8, 0.6), (10, 0.6), (10, -2.0)]))
def test_a_cascade_whose_brakes_close_ends_with_all_rings_at_rest(given: tuple[int, float]) -> None:
    """Each set has the ratio 1 - u while its ring is held."""
    count, ratio = given
    torques = (-100.0, -1e4) if ratio > 0 else (100.0, 0.0)
    sets = count * [Set(ratio, 0.9, 1e6)]
    motion = closing(sets, {1: 0.1, count + 1: 1.0}, *torques)
    assert runs(motion, sets)
    whole = (1 - ratio) ** count
    assert motion.speeds[-1, 0] == pytest.approx(whole * motion.speeds[-1, count], rel=1e-9)


@pytest.mark.parametrize("torque", [1.2e-3, 1.6e-3, 0.1])
def test_a_wheel_slips_for_less_than_a_nanosecond(torque: float) -> None:
    """J dw/dt = T - c t: it sticks again at t = 2 T/c, before what is looked ahead by."""
    growth = 1e6 / 0.3
    brake = {1: capacity((0, 0), (0.3, 1e6))}
    case = links(1.0, elements=(ShiftElement(1, 0, "B"),))
    motion = run(case, 0.5, {1: 0.0}, controls=brake, torques=((1, constant(torque)),))
    [event] = motion.events
    assert event.event == "locks"
    assert event.time == pytest.approx(2 * torque / growth, rel=1e-6)
    assert motion.speeds.max() == pytest.approx(torque**2 / (2 * growth), rel=1e-6)


def some_sets(random: Random) -> list[Set]:
    ranges, sets = ((-4, -1.3), (1.3, 4), (0.25, 0.8)), []
    for _ in range(random.randint(2, 10)):
        ratio, efficiency = random.uniform(*random.choice(ranges)), random.uniform(0.85, 0.99)
        sets.append(Set(ratio, efficiency, 10 ** random.uniform(1.5, 5)))
    return sets


@seeds_with_slow(2, 20, 300)
def test_any_cascade_runs(seed: int) -> None:
    random = seeded(seed)
    sets = some_sets(random)
    end = len(sets) + 1
    heavy = [link for link in range(2, 2 * end) if random.random() < 0.4]
    inertias = {link: 10 ** random.uniform(-2.5, -0.5) for link in heavy}
    inertias |= {1: 10 ** random.uniform(-1, 0), end: 10 ** random.uniform(-1, 1)}
    torques = random.choice([-1, 1]) * random.uniform(20, 200), random.uniform(-2000, 2000)
    assert runs(closing(sets, inertias, *torques), sets)
