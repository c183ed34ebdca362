"""Laws of operating points in a scenario."""

from __future__ import annotations

import pytest

from tests.core.statics.points.test_laws import EAXLE
from vstatics import CaseError
from vstatics.core.readers import loads
from vstatics.simulation.system.devices import drags


def test_a_scenario_takes_no_efficiency_that_depends() -> None:
    with pytest.raises(CaseError, match="the efficiency of a depends on speed") as caught:
        list(drags(loads(EAXLE), None))
    assert "the efficiency of b depends on speed or torque" in str(caught.value)
