"""A front of a limited number of points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.core.numerics.test_fronts import RANDOM, points
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.fronts import non_dominated
from vstatics.sweep.results.selection import limited


@RANDOM
@given(points(st.integers(1, 4)), st.integers(1, 30))
def test_a_limited_front_is_a_part_of_it(objectives: Floats, count: int) -> None:
    front = objectives[non_dominated(objectives)]
    rows = limited(front, count)
    assert len(rows) == min(count, len(front))
    assert all(one < other for one, other in pairwise(rows.tolist()))
    if len(front) > 0 and front.shape[1] <= count:
        assert (front[rows].min(axis=0) == front.min(axis=0)).all()


def test_a_limited_front_is_spread() -> None:
    """101 points on a line: ends, middle, quarters."""
    line = np.column_stack([np.arange(101.0), np.arange(100.0, -1, -1)])
    assert limited(line, 1).tolist() == [0]
    assert limited(line, 2).tolist() == [0, 100]
    assert limited(line, 3).tolist() == [0, 50, 100]
    assert limited(line, 5).tolist() == [0, 25, 50, 75, 100]
    assert limited(line * [1, 1000], 5).tolist() == [0, 25, 50, 75, 100]


def test_equal_points_come_last_in_a_limited_front() -> None:
    front = np.array([[0.0, 2.0], [0.0, 2.0], [1.0, 1.0], [2.0, 0.0]])
    assert limited(front, 3).tolist() == [0, 2, 3]
