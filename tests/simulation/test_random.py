"""Random boxes in motion: what holds for all of them, and an integrator without events."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count, seeded
from tests.simulation.reference import element_column, mechanism_column, smoothed
from tests.simulation.runs import random_run, renumbered
from tests.simulation.test_golden import closes, happened
from vstatics.simulation import simulate

SEEDS = st.integers(0, 10**6)


@pytest.mark.slow
@settings(max_examples=count(30, 60))
@given(SEEDS, st.booleans(), st.booleans())
def test_laws_of_motion(seed: int, losses: bool, dogs: bool) -> None:
    """Energy closes, nothing chatters, mechanisms and slips agree with the speeds."""
    scenario = random_run(seeded(seed), losses=losses, dogs=dogs)
    case, motion = scenario.case, simulate(scenario)
    assert motion.stopped is None
    assert closes(motion)
    assert len(motion.events) < 100
    largest = max(1.0, float(np.abs(motion.speeds).max()))
    for mechanism in case.mechanisms:
        row = mechanism_column(mechanism, case.links)
        size = np.abs(row).max()
        assert np.abs(motion.speeds @ row).max() <= 1e-9 * size * largest
    slips = np.array([element_column(one, case.links) for one in case.shift_elements])
    assert motion.slips == pytest.approx(motion.speeds @ slips.T, abs=1e-9 * largest)
    assert (np.diff(motion.time) >= 0).all()
    assert (np.diff(motion.heat, axis=0) >= -1e-9 * max(1.0, float(motion.heat.max()))).all()


@pytest.mark.slow
@settings(max_examples=count(8, 15))
@given(SEEDS)
def test_smoothed_friction_tends_to_the_events(seed: int) -> None:
    """Each step of the smoothing to a tenth brings it nearer, until rounding is left."""
    scenario = random_run(seeded(seed))
    motion = simulate(scenario)
    start = motion.speeds[0]
    size = max(1.0, float(np.abs(start).max()))
    apart = []
    for smoothing in (1e-2, 1e-3, 1e-4):
        speeds, _ = smoothed(scenario, start, smoothing, rtol=1e-8)
        apart.append(float(np.abs(speeds - motion.speeds[-1]).max()) / size)
    assert apart[-1] < 2e-5
    assert apart[-1] < 0.5 * apart[0] or apart[0] < 1e-6


@pytest.mark.slow
@settings(max_examples=count(10, 20))
@given(SEEDS)
def test_renumbering_changes_nothing(seed: int) -> None:
    scenario = random_run(seeded(seed))
    order = [*range(1, scenario.case.links + 1)]
    seeded(seed + 1).shuffle(order)
    one, other = simulate(scenario), simulate(renumbered(scenario, order))
    assert sorted(e[:2] for e in happened(one)) == sorted(e[:2] for e in happened(other))
    moved = other.speeds[-1][np.array(order) - 1]
    size = max(1.0, float(np.abs(one.speeds).max()))
    assert one.speeds[-1] == pytest.approx(moved, abs=1e-6 * size)
