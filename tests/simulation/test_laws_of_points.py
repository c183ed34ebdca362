"""Laws of operating points in a scenario."""

from __future__ import annotations

import numpy as np
import pytest

from tests.chance import seeded
from tests.core.statics.points.test_laws import EAXLE, RPM
from tests.trains import random_train
from vstatics import CaseError, Load, solve
from vstatics.core.model.laws import PointLaw
from vstatics.core.model.parts import OfLoad
from vstatics.core.readers import loads
from vstatics.simulation.system.devices import drags


@pytest.mark.parametrize("seed", [1, 3, 5, 8, 29])
def test_freewheels_hold_as_the_drags_of_their_own_state_let_them(seed: int) -> None:
    """With the numbers that laws come to as plain ones the same freewheels hold, or there is none."""
    random = seeded(seed)
    case = random_train(random, coast=False).replace(load=Load(1500, 100))
    law = PointLaw([(0, 0), (200, 6)])
    wheels = [n for n in range(1, len(case.shift_elements) + 1) if random.random() < 0.4]
    elements = [
        one._replace(drag=law, kind="freewheel" if n in wheels else one.kind)
        for n, one in enumerate(case.shift_elements, 1)
    ]
    gears = [g._replace(engaged=[n for n in g.engaged if n not in wheels]) for g in case.gears]
    with_laws = case.replace(shift_elements=elements, gears=gears)
    results = solve(with_laws)
    for index, gear in enumerate(with_laws.gears):
        slips = np.nan_to_num(np.abs(results.slip_speeds[index])) * 1500 / RPM
        drags = {n: OfLoad(law.at(slip), 1.0) for n, slip in enumerate(slips, 1)}
        alone = solve(with_laws.replace(gears=[gear._replace(open_drag=drags)]))
        if results.undecided[index] and not alone.undecided[0]:
            assert np.isnan(results.lossy_torques[index]).all()
            continue
        assert results.holds[index].tolist() == alone.holds[0].tolist()
        expected = alone.lossy_torques[0]
        size = max(1.0, float(np.abs(np.nan_to_num(expected)).max()))
        np.testing.assert_allclose(results.lossy_torques[index], expected, atol=1e-11 * size)


def test_a_scenario_takes_no_efficiency_that_depends() -> None:
    with pytest.raises(CaseError, match="the efficiency of a depends on speed") as caught:
        list(drags(loads(EAXLE), None))
    assert "the efficiency of b depends on speed or torque" in str(caught.value)
