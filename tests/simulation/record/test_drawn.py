"""Runs of more parts than are drawn: what is left of them is theirs, extremes and jumps first.

A mass of 1 kg*m^2 on 100 N*m/rad that starts with 1 rad/s turns with cos 10 t rad/s, and the
spring has 10 sin 10 t N*m. Beside it a brake of 5 N*m stops a mass of 1 kg*m^2, which has 10 rad/s
and 3 N*m, after 5 s; from 7 s on that has 4 N*m.
"""

import tracemalloc

import numpy as np
import pytest

from tests.simulation.test_closed_forms import links
from vstatics import ShiftElement, Spring
from vstatics.simulation import Capacity, Motion, Points, Scenario, Start, constant, simulate
from vstatics.simulation.record import drawn, record

SPRING = Spring({1: 1}, 100.0, name="s")
CASE = links(1.0, 1.0, elements=(ShiftElement(2, name="B"),), springs=(SPRING,))
START, BRAKE = Start(speeds={1: 1.0, 2: 10.0}), {1: Capacity(constant(5.0))}
TORQUE = Points((0.0, 7.0, 7.0), (3.0, 3.0, 4.0))


def swing(duration: float, until: float = np.inf, step: float | None = None) -> Motion:
    scenario = Scenario(CASE, duration, START, BRAKE, ((2, TORQUE),))
    return simulate(scenario, step=step, watch=lambda at: "enough" if at >= until else "")


def is_the_swing(motion: Motion) -> None:
    times = motion.time
    assert motion.speeds[:, 0] == pytest.approx(np.cos(10 * times), abs=1e-6)
    assert motion.torques[:, 1] == pytest.approx(10 * np.sin(10 * times), abs=1e-5)
    assert motion.speeds[:, 1] == pytest.approx(np.maximum(10 - 2 * times, 0), abs=1e-6)
    for values, largest in ((motion.speeds[:, 0], 1), (motion.torques[:, 1], 10)):
        assert [values.min(), values.max()] == pytest.approx([-largest, largest], rel=1e-10)
    assert motion.peaks["s"].time == pytest.approx(np.pi / 20, rel=1e-6)
    jumps = np.flatnonzero(np.diff(times) == 0)
    assert times[jumps] == pytest.approx([5, 7])
    assert motion.torques[jumps, 0] == pytest.approx([5, 3])
    assert motion.torques[jumps + 1, 0] == pytest.approx([3, 4])
    assert motion.heat[-1, 0] == pytest.approx(125)


@pytest.mark.parametrize("numbers", [0, 10**9])
def test_a_run_that_was_stopped_has_few_instants(
    numbers: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "_MOST_NUMBERS", numbers)
    monkeypatch.setattr(drawn, "_MOST_HURRIED", (100, 500))
    motion = swing(1000, until=200)
    assert motion.time[-1] >= 200
    assert 30 < len(motion.time) <= 100
    is_the_swing(motion)


def test_a_run_has_no_more_instants_than_may_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its 7000 parts begin at as many points of integration, and are 30 chords each."""
    monkeypatch.setattr(record, "_MOST_NUMBERS", 100_000)
    monkeypatch.setattr(drawn, "_MOST_DRAWN", (20_000, 10**6))
    motion = swing(2000)
    assert motion.stopped is None
    assert 5000 < len(motion.time) <= 20_000
    is_the_swing(motion)


def test_multiples_of_the_step_are_never_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawn, "_MOST_HURRIED", (100, 500))
    motion = swing(1000, until=200, step=0.3)
    assert np.isin(np.arange(600) * 0.3, motion.time).all()
    is_the_swing(motion)


def test_memory_does_not_grow_with_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record, "_MOST_NUMBERS", 50_000)
    monkeypatch.setattr(drawn, "_MOST_DRAWN", (10**6, 25_000))
    taken = []
    for until in (500, 2000):
        tracemalloc.start()
        swing(1e6, until=until)
        taken.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert taken[1] < 1.2 * taken[0]
