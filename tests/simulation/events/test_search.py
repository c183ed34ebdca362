"""The search for what sticks: bounded, however many sets and brakes may stick or slip.

Whatever the sets: a motion exists, since a brake that slips is a given torque. What is found closes
its energy, and no brake carries more than it can.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random
from time import process_time
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.simulation.boxes import capacity
from tests.simulation.control.written import simulated
from tests.simulation.test_closed_forms import links, run
from tests.simulation.test_golden import closes
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.simulation import Motion, Scenario, Start, constant, simulate
from vstatics.simulation.scenario.parts import Control


class Set(NamedTuple):
    """A set of a cascade, and what the brake of its ring can carry in the end."""

    ratio: float
    efficiency: float
    capacity: float
    """[N*m]"""


def cascade(sets: Sequence[Set], inertias: Mapping[int, float]) -> Transmission:
    """Sets in series, each with a brake on its ring."""
    count = len(sets)
    rings = range(count + 2, 2 * count + 2)
    return Transmission(
        2 * count + 1,
        [ShiftElement(ring, 0) for ring in rings],
        [
            Mechanism(number, ring, number + 1, one.ratio, one.efficiency)
            for number, (ring, one) in enumerate(zip(rings, sets, strict=True), 1)
        ],
        [Gear([*range(1, count + 1)], name="1")],
        output=count + 1,
        inertias=inertias,
    )


def closing(sets: Sequence[Set], inertias: Mapping[int, float], *torques: float) -> Motion:
    """All brakes close within .3 s; torques on both ends."""
    case = cascade(sets, inertias)
    controls: dict[int, Control] = {
        number: capacity((0, 0), (0.3, one.capacity)) for number, one in enumerate(sets, 1)
    }
    laws = tuple(zip((1, len(sets) + 1), map(constant, torques), strict=True))
    return simulate(Scenario(case, 0.5, Start(gear="1"), controls, laws))


def runs(motion: Motion, sets: Sequence[Set]) -> bool:
    """Whether it comes to its end, its energy closes, and no brake carries more than it can."""
    limits = np.minimum(motion.time / 0.3, 1)[:, None] * [one.capacity for one in sets]
    brakes = [motion.devices.index(f"T{number}") for number in range(1, len(sets) + 1)]
    over = np.abs(motion.torques[:, brakes]) - limits
    return motion.stopped is None and closes(motion) and bool((over <= 1e-6 * limits.max()).all())


@pytest.mark.parametrize(
    ("count", "ratio", "torques"),
    [
        (4, -2.0, (100.0, 0.0)),
        pytest.param(8, 0.6, (-100.0, -1e4), marks=pytest.mark.slow),
        pytest.param(10, 0.6, (-100.0, -1e4), marks=pytest.mark.slow),
        pytest.param(10, -2.0, (100.0, 0.0), marks=pytest.mark.slow),
    ],
)
def test_a_cascade_whose_brakes_close_starts_within_seconds(
    count: int, ratio: float, torques: tuple[float, float]
) -> None:
    """All rings stand in the end: each set turns by i = 1 - u."""
    sets = count * [Set(ratio, 0.9, 1e6)]
    begin = process_time()
    motion = closing(sets, {1: 0.1, count + 1: 1.0}, *torques)
    assert process_time() - begin < 2  # minutes before; on two threads, waiting counts
    assert runs(motion, sets)
    whole = (1 - ratio) ** count
    assert motion.speeds[-1, 0] == pytest.approx(whole * motion.speeds[-1, count], rel=1e-9)


def test_a_cascade_begins_where_nothing_carries_yet() -> None:
    """At t = 0 all brakes begin at 0: what slips is decided by how their capacities grow."""
    sets = [
        Set(-2.22, 0.86, 497),
        Set(2.91, 0.86, 1980),
        Set(-1.87, 0.96, 100),
        Set(2.02, 0.94, 39.5),
        Set(0.77, 0.95, 359),
        Set(2.36, 0.86, 58e3),
        Set(-3.88, 0.9, 8200),
    ]
    inertias = {1: 0.24, 2: 0.0065, 3: 0.0085, 7: 0.23, 8: 1.63, 10: 0.21, 11: 0.041}
    assert runs(closing(sets, inertias, 93, 1270), sets)


@pytest.mark.parametrize("torque", [1.2e-3, 1.6e-3, 0.1])
def test_a_wheel_slips_for_less_than_a_nanosecond(torque: float) -> None:
    """J dw/dt = T - c t: it sticks again at t = 2 T/c, before what is looked ahead by."""
    growth = 1e6 / 0.3
    brake: dict[int, Control] = {1: capacity((0, 0), (0.3, 1e6))}
    case = links(1.0, elements=(ShiftElement(1, 0, "B"),))
    motion = run(case, 0.5, {1: 0.0}, controls=brake, torques=((1, constant(torque)),))
    [event] = motion.events
    assert event.event == "locks"
    assert event.time == pytest.approx(2 * torque / growth, rel=1e-6)
    assert motion.speeds.max() == pytest.approx(torque**2 / (2 * growth), rel=1e-6)


def some_sets(random: Random) -> list[Set]:
    """Two to ten sets with ratios that can be built."""
    ranges = ((-4, -1.3), (1.3, 4), (0.25, 0.8))
    return [
        Set(
            random.uniform(*random.choice(ranges)),
            random.uniform(0.85, 0.99),
            10 ** random.uniform(1.5, 5),
        )
        for _ in range(random.randint(2, 10))
    ]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(count(20, 300)))
def test_any_cascade_runs(seed: int) -> None:
    random = seeded(seed)
    sets = some_sets(random)
    end = len(sets) + 1
    inertias = {
        link: 10 ** random.uniform(-2.5, -0.5)
        for link in range(2, 2 * end)
        if random.random() < 0.4
    }
    inertias |= {1: 10 ** random.uniform(-1, 0), end: 10 ** random.uniform(-1, 1)}
    torques = random.choice([-1, 1]) * random.uniform(20, 200), random.uniform(-2000, 2000)
    assert runs(closing(sets, inertias, *torques), sets)


@pytest.mark.slow
@pytest.mark.parametrize("torque", [140, 149, 150, 151, 160])
def test_sets_that_are_locked_up_carry_torques_that_pass_zero(torque: float) -> None:
    """The torque of a locked-up set passes 0 with the friction that it could take."""
    count_of_sets = 8
    sets, names = range(count_of_sets), range(count_of_sets + 1)
    rows = [f"links: [{', '.join([f'c{n}' for n in names] + [f'r{n}' for n in sets])}]"]
    inertias = {f"{kind}{n}": 0.05 for kind in "cr" for n in sets} | {"c0": 0.3, "c8": 80}
    rows.append(f"inertias: {{{', '.join(f'{name}: {one}' for name, one in inertias.items())}}}")
    rows.append("mechanisms:")
    for n in sets:
        links_of_set = f"first: c{n}, second: r{n}, third: c{n + 1}"
        rows.append(f"  P{n}: {{{links_of_set}, ratio: {-2 - 0.1 * n:.1f}, efficiency: 0.97}}")
    rows.append("shift_elements:")
    for n in sets:
        rows.append(f"  B{n}: {{links: [r{n}, housing], capacity: {400 * 3**n} N*m}}")
        rows.append(f"  C{n}: {{links: [c{n}, r{n}], capacity: {400 * 3**n} N*m}}")
    low, top = (", ".join(f"{kind}{n}" for n in sets) for kind in "BC")
    other = ", ".join(f"{'BC'[n % 2]}{n}" for n in sets)
    rows.append(f"gears: {{low: [{low}], other: [{other}], top: [{top}]}}")
    motion = simulated(
        f"""duration: 1.5
start: {{gear: low, speed: 200}}
shifts: [{{at: 0.3, to: other, overlap: 0.3}}, {{at: 1, to: top, overlap: 0.3}}]
torques: {{c0: {torque}, c8: -50}}
""",
        "\n".join(rows) + "\n",
    )
    assert closes(motion)
