"""Numbers of an independent calculation of the source's examples, to eight digits and more.

They follow from the equations of motion, with all inertias, in another program; what can be
told in closed form is so here.
"""

import math
from typing import Any

import numpy as np
import pytest

from tests.simulation.boxes import (
    BOX_GEARS,
    BOX_INERTIAS,
    BOX_RATIOS,
    RPM,
    box,
    first_gear,
    planetary_set,
    run_of_box,
    second_gear,
)
from tests.simulation.reference import start_speeds
from vstatics.simulation import Dog, Motion, Scenario, Start, constant, simulate


def happened(motion: Motion) -> list[tuple[str, str, Any]]:
    return [(one.element, one.event, one.time) for one in motion.events]


def closes(motion: Motion, part: float = 1e-8) -> bool:
    energy = motion.energy
    heat, given = sum(energy.heat.values()), (energy.work, energy.kinetic, energy.elastic)
    largest = max(heat, *map(abs, given))
    parts = (*energy.heat.values(), *energy.losses.values(), energy.impact)
    left = energy.work - math.fsum(parts) - energy.kinetic - energy.elastic
    heats = [energy.heat.get(name, 0.0) for name in motion.elements]
    is_last = np.allclose(motion.heat[-1], heats, rtol=1e-9, atol=part * largest)
    return is_last and abs(energy.balance) <= part * largest and abs(left) <= part * largest


def test_brake_stops_the_ring() -> None:
    motion = simulate(first_gear())
    [(element, event, time)] = happened(motion)
    assert (element, event) == ("F1", "locks")
    assert time == pytest.approx(34.906585039886586 / 85.126799, rel=1e-8)
    assert time == pytest.approx(0.410054006, abs=6e-10)
    at_lock = motion.speeds[np.searchsorted(motion.time, time)]
    assert at_lock[:2] == pytest.approx([52.135036, 20.854015], abs=6e-7)
    assert motion.speeds[-1, :2] == pytest.approx([67.165507611, 26.866203045], rel=1e-10)
    assert motion.speeds[-1, 2] == pytest.approx(0, abs=1e-12)
    assert motion.energy.heat["F1"] == pytest.approx(858.815102, abs=6e-7)
    assert closes(motion)
    energy = simulate(first_gear(duration=34.906585039886586 / 85.126799)).energy
    assert energy.work == pytest.approx(600.432996, rel=1e-7)
    assert energy.kinetic == pytest.approx(-258.382107, rel=1e-7)


def test_lock_up() -> None:
    motion = simulate(second_gear())
    [(element, event, time)] = happened(motion)
    assert (element, event) == ("F2", "locks")
    assert time == pytest.approx(0.255352851, abs=6e-10)
    at_lock = motion.speeds[np.searchsorted(motion.time, time)]
    assert at_lock == pytest.approx([58.018828] * 3, abs=6e-7)
    assert motion.energy.heat["F2"] == pytest.approx(6016.609814, abs=6e-7)
    assert closes(motion)


def test_dog_brake_joins_at_once() -> None:
    start, controls = Start(speeds={1: 500 * RPM, 2: 0.0}), {1: Dog(((0.5, True),))}
    motion = simulate(Scenario(planetary_set(), 1.0, start, controls))
    [event] = motion.events
    assert (event.time, event.element, event.event) == (0.5, "F1", "impact")
    assert event.energy == pytest.approx(566.161548, abs=6e-7)
    assert motion.energy.impact == pytest.approx(566.161548, abs=6e-7)
    assert motion.speeds[-1] == pytest.approx([41.687801, 16.675120, 0], abs=6e-7)
    assert list(motion.time).count(0.5) == 2
    assert closes(motion)


def test_efficiency_of_a_locked_gear() -> None:
    """The first gear of the set, locked, losing 3 %: .95 in the set, as 1 + 1.5*.95 = 2.5*.97."""
    loads = ((1, constant(40)), (2, constant(-60)))
    motion = simulate(Scenario(planetary_set(0.95), 0.1, Start("1", 50.0), torques=loads))
    rate = (motion.speeds[-1, 0] - motion.speeds[0, 0]) / 0.1
    assert rate == pytest.approx(24.143556, abs=6e-7)
    assert rate == pytest.approx((40 - 60 / 2.425) / (0.5 + 0.8 / (2.5 * 2.425)), rel=1e-10)
    assert closes(motion)


ACCELERATIONS = (
    *(170.419842, 97.241908, 61.255805, 21.768664),
    *(6.369427, -2.908760, 252.133635, 176.871320),
)
INERTIAS = (7.041434, 10.820837, 14.741460, 27.973937, 47.1, 100.058008, 6.878793, 10.458527)


@pytest.mark.parametrize("number", range(8))
def test_acceleration_of_a_locked_gear(number: int) -> None:
    """Given in the source's note to six decimals, and ``(T_in - 1200/u)/sum J (w/w_in)^2``."""
    case, ratio = box(), BOX_RATIOS[number]
    loads = ((1, constant(1500)), (7, constant(-1200)))
    motion = simulate(Scenario(case, 0.25, Start(BOX_GEARS[number], 100.0), torques=loads))
    assert not motion.events
    rate = (motion.speeds[-1, 0] - motion.speeds[0, 0]) / 0.25
    assert rate == pytest.approx(ACCELERATIONS[number], abs=6e-7)
    speeds = start_speeds(case, {1: 1.0}, case.gears[number].engaged)
    assert 1 / speeds[6] == pytest.approx(ratio, abs=6e-7)
    inertia = float(np.array(BOX_INERTIAS) @ speeds**2)
    assert inertia == pytest.approx(INERTIAS[number], abs=6e-7)
    assert rate == pytest.approx((1500 - 1200 * speeds[6]) / inertia, rel=1e-10)
    assert closes(motion)


EVENTS = (
    ("F1", "locks", 0.293875320),
    ("FH", "slips", 2.0),
    ("FB", "locks", 2.133597924),
    ("FB", "slips", 4.0),
    ("F1", "slips", 4.05),
    ("FH", "reverses", 4.130035579),
    ("FH", "locks", 4.242217328),
    ("F2", "locks", 4.280416335),
)
HEATS = {"FH": 21790.6352, "FB": 61723.2090, "F1": 15642.6422, "F2": 162234.0869}


def test_run_of_the_box() -> None:
    motion = simulate(run_of_box(), step=1.0)
    found = happened(motion)
    assert [one[:2] for one in found] == [one[:2] for one in EVENTS]
    assert [one[2] for one in found] == pytest.approx([one[2] for one in EVENTS], abs=2e-9)
    for element, heat in HEATS.items():
        assert motion.energy.heat[element] == pytest.approx(heat, rel=1e-8)
    assert motion.energy.work == pytest.approx(2196239.208, abs=6e-3)
    assert sum(motion.energy.heat.values()) == pytest.approx(261390.573, abs=6e-4)
    assert motion.energy.kinetic == pytest.approx(1934848.635, abs=6e-3)
    expected = {1.0: [209.5976, 52.3994], 3.0: [388.0379, 144.7903], 6.0: [513.4905, 255.4615]}
    for time, speeds in expected.items():
        row = motion.speeds[np.searchsorted(motion.time, time)]
        assert row[[0, 6]] == pytest.approx(speeds, abs=6e-5)
    assert closes(motion)


def test_run_of_the_box_with_losses() -> None:
    motion = simulate(run_of_box(0.98, duration=3.0))
    meshes = sum(motion.energy.losses.values())
    assert meshes == pytest.approx(14120.093, abs=6e-3)
    assert closes(motion)
