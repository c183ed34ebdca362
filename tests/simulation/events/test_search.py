"""The search for what sticks: bounded, however many sets and brakes may stick or slip."""

from __future__ import annotations

from time import process_time

import pytest

from tests.simulation.boxes import capacity
from tests.simulation.test_golden import closes
from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.simulation import Scenario, Start, constant, simulate
from vstatics.simulation.scenario.parts import Control


def cascade(count: int, ratio: float, efficiency: float) -> Transmission:
    """Equal sets in series, each with a brake on its ring; inertia on both ends alone."""
    rings = range(count + 2, 2 * count + 2)
    return Transmission(
        2 * count + 1,
        [ShiftElement(ring, 0) for ring in rings],
        [
            Mechanism(number, ring, number + 1, ratio, efficiency)
            for number, ring in enumerate(rings, 1)
        ],
        [Gear([*range(1, count + 1)], name="1")],
        output=count + 1,
        inertias={1: 0.1, count + 1: 1.0},
    )


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
    case = cascade(count, ratio, 0.9)
    controls: dict[int, Control] = {
        number: capacity((0, 0), (0.3, 1e6)) for number in range(1, count + 1)
    }
    laws = ((1, constant(torques[0])), (count + 1, constant(torques[1])))
    begin = process_time()
    motion = simulate(Scenario(case, 0.5, Start(gear="1"), controls, laws))
    assert process_time() - begin < 10  # minutes before; on two threads, waiting counts
    assert motion.stopped is None
    assert closes(motion)
    whole = (1 - ratio) ** count
    assert motion.speeds[-1, 0] == pytest.approx(whole * motion.speeds[-1, count], rel=1e-9)
