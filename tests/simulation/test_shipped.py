"""Shipped scenarios run to their ends; what their sources print of them holds.

Of the dump truck (V. P. Tarasik, Planetary gearbox simulation, 2018, figures 6 and 7) the source
prints no data, but relations: they are checked with the ratios chosen in the case. Of the car whose
clutch is dumped (Tsitovich, Algin, Vehicle dynamics, 1981, table 3.9, variant 1.2) it prints the
largest torques and the work of friction; an independent integration of the same scheme, 1e-5 s a
step, gave 165.5 N*m at .04615 s and 1193 J for what it prints as 169 and 1180.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.chance import with_marked
from tests.commands import CASES
from tests.simulation.test_golden import closes
from vstatics.simulation import Motion, simulate
from vstatics.simulation.scenario.file import load_scenario

NAMES = sorted(path.stem for path in (CASES / "scenarios").glob("*.yaml"))
QUICK = ["tarasik-set-lock", "tarasik-set-upshift"]


@cache
def run(name: str) -> Motion:
    scenario = load_scenario(CASES / "scenarios" / f"{name}.yaml")
    return simulate(scenario, step=scenario.duration / 100)


def speed(motion: Motion, link: str) -> np.ndarray:
    return motion.speeds[:, motion.links.index(link)]


@pytest.mark.parametrize("name", with_marked(QUICK, sorted({*NAMES} - {*QUICK}), pytest.mark.slow))
def test_a_scenario_runs_to_its_end_and_its_energy_closes(name: str) -> None:
    motion = run(name)
    assert closes(motion)
    assert motion.stopped is None
    assert motion.events


@pytest.mark.slow
def test_the_truck_starts_as_the_source_has_it() -> None:
    motion = run("tarasik-truck")
    time = motion.time
    [lock] = [one.time for one in motion.events if (one.element, one.event) == ("F1", "locks")]
    assert round(lock, 2) == 0.58
    in_first = (time >= lock) & (time < 2.9)
    ratio = speed(motion, "turbine")[in_first] / speed(motion, "pump")[in_first]
    lowest = float(ratio.min())
    torque_ratio = float(np.interp(lowest, [0, 0.36, 0.6], [2.6, 1.79, 1.36]))
    assert round(lowest, 2) == 0.36
    assert round(torque_ratio, 2) == 1.79
    assert round(lowest * torque_ratio, 2) == 0.65
    assert ratio[-1] > 0.9  # it rises again
    # w_b2 = 0 and w_b1/w_in = 1/K1 behind the closing; w_b3/w_in = (1 - K3)/(K3*(K2 - 1)), by hand
    driven = speed(motion, "a1")[in_first]
    assert speed(motion, "h1")[in_first] == pytest.approx(0, abs=1e-7)
    assert speed(motion, "b1")[in_first] == pytest.approx(-33 / 67 * driven)
    assert speed(motion, "b3")[in_first] == pytest.approx(3.04 / (-2.04 * -4) * driven)


@pytest.mark.slow
def test_the_clutch_that_is_dumped_has_the_torques_and_the_work_of_the_source() -> None:
    motion = run("moskvich-start")
    assert motion.peaks["half-shafts"].torque == pytest.approx(165.5, abs=0.1)
    assert motion.energy.heat["clutch"] == pytest.approx(1193, abs=1)
    events = [(one.element, one.event) for one in motion.events]
    assert events == [("tyres", "slips"), ("clutch", "locks"), ("tyres", "locks")]
    assert np.abs(motion.torques[:, motion.devices.index("tyres")]).max() <= 130 * (1 + 1e-9)
