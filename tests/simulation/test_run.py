"""When the energy of a run closes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.chance import seeded
from tests.simulation.boxes import held, planetary_set
from tests.simulation.test_closed_forms import links
from vstatics.core.model.transmission import ShiftElement
from vstatics.simulation import simulate
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.record.record import Record
from vstatics.simulation.scenario.laws import TorqueLaw, constant
from vstatics.simulation.scenario.parts import Scenario, Start


@pytest.mark.parametrize("number", range(40))
def test_a_steady_run_closes(number: int) -> None:
    """Torques that take what others give leave rounding alone, of any size."""
    rng = seeded(number)
    torque = rng.uniform(0.1, 1000) * 10 ** rng.uniform(-3, 3)
    speed = rng.uniform(-1000, 1000)
    torques: tuple[tuple[int, TorqueLaw], ...]
    if number % 2:  # a planetary set as one piece
        torques = (
            (1, constant(torque)),
            (2, constant(-0.3 * torque)),
            (3, constant(-0.7 * torque)),
        )
        clutch = {2: held(1e9)}
        start = Start(speeds={1: speed}, engaged=(2,))
        scenario = Scenario(planetary_set(), rng.uniform(0.1, 10), start, clutch, torques)
    else:
        case = links(0.3, 7.0, elements=(ShiftElement(1, 2, "C"),))
        torques = ((1, constant(torque)), (2, constant(-torque)))
        start = Start(speeds={1: speed}, engaged=(1,))
        scenario = Scenario(case, rng.uniform(0.1, 10), start, torques=torques)
    motion = simulate(scenario)
    assert motion.stopped is None
    assert motion.speeds == pytest.approx(np.full_like(motion.speeds, speed), rel=1e-9)


def test_energy_that_is_lost_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """1e-6 of the work of 100 N*m at 50 rad/s for 1 s, 5000 J, is missing."""

    def with_a_leak(record: Record, stopped: None, *, hurried: bool) -> Motion:
        made = whole(record, stopped, hurried=hurried)
        return made._replace(energy=made.energy._replace(balance=5e-3))

    whole = Record.motion
    monkeypatch.setattr(Record, "motion", with_a_leak)
    torques = ((1, constant(100.0)), (1, constant(-100.0)))
    motion = simulate(Scenario(links(2.0), 1.0, Start(speeds={1: 50.0}), torques=torques))
    assert motion.stopped is not None
    assert motion.stopped.message.startswith(
        "the energy balance does not close: 0.005 J of 1e+04 J are left"
    )
