"""Torques of a gear: what equilibrium determines and what it leaves open."""

import numpy as np
import pytest

from tests.core.statics.differential import SET, train
from vstatics import Gear
from vstatics.core.numerics.traced import plain
from vstatics.core.statics import matrix
from vstatics.core.statics.torques import NO_DRAG, solve_sums, solve_torques


def test_a_sum_may_be_determined_where_its_parts_are_not() -> None:
    """Two brakes on the ring share its 2; what each carries is open."""
    case = train([(2, 0), (2, 0)], Gear([1, 2]))
    gear, columns = case.gears[0], matrix.columns(case, [SET.ratio])
    torques = solve_torques(case, gear, columns)
    assert np.isnan([plain(one) for one in torques.on_first_link[:2]]).all()
    both, one = solve_sums(case, gear, columns, [{0: 1.0, 1: 1.0}, {0: 1.0}], NO_DRAG)
    assert plain(both) == pytest.approx(-2)
    assert np.isnan(plain(one))
