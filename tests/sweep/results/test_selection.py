"""What a sweep keeps: conditions, the best by one, the non-dominated by several.

What is right comes from the definitions, written out below in plain Python.
"""

import math
import pickle
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.numerics.test_fronts import ANY_VALUE, RANDOM, points
from tests.sweep.asked import RESULTS, SET, VALUES, VARIED
from vstatics import ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.fronts import non_dominated
from vstatics.sweep.results.selection import best, limited, read_objective, read_where

NONE = np.zeros(3, dtype=np.bool_)
LOW = 'ratio["1R"]'
"""The ratio 1 - u of the gear in which the ring is held."""


def passed(text: str) -> list[int]:
    made: list[int] = read_where(text, SET, VARIED).passed(RESULTS, VALUES, NONE)[0].tolist()
    return made


def test_a_number_is_a_condition_unless_it_is_0_or_does_not_exist() -> None:
    assert passed(f"{LOW} >= 3.5") == [0, 1, 1]
    assert read_where(f"{LOW} >= 3.5", SET, VARIED).text == f"{LOW} >= 3.5"
    assert passed("D1.ratio + 2") == [0, 1, 1]
    assert passed("ratio[N]") == [0, 0, 0]
    assert passed("locked[2] == 0") == [1, 1, 1]


def test_each_part_between_ands_tells_what_it_removes() -> None:
    """Ratios are 3, 3.5 and 4 for -2, -2.5 and -3."""
    for text, removed in {
        f"{LOW} > 3 and D1.ratio > -3": (1, 1),
        f"({LOW} > 3 and D1.ratio > -3)": (2,),
        f"{LOW} > 3 and D1.ratio > -3 or 1": (0,),
        f"not locked[2] and 3 < {LOW} < 4 and 0": (0, 2, 1),
    }.items():
        assert read_where(text, SET, VARIED).passed(RESULTS, VALUES, NONE)[1] == removed, text
    unknown = np.array([False, True, False])  # nothing is known of it, so it is removed
    assert read_where("1 and 1", SET, VARIED).passed(RESULTS, VALUES, unknown)[1] == (1, 0)


def test_a_large_objective_is_a_small_negative_one() -> None:
    least, most = (read_objective(LOW, SET, VARIED, option) for option in ("--min", "--max"))
    assert (least.sign, most.sign) == (1, -1)
    assert least.expression(RESULTS, VALUES) == pytest.approx(np.array([3, 3.5, 4]))
    assert pickle.loads(pickle.dumps(most)) == most  # noqa: S301


def test_conditions_and_objectives_have_one_value() -> None:
    for text, message in {
        "ratio": "`ratio` has one value per gear: pick a gear, or use min, max or sum",
        " speeds + 1 ": "`speeds + 1` has one value per link and gear: pick a link and a gear, or",
        "torques[:,2]": "has one value per component: pick a component, or use min, max or sum",
    }.items():
        with pytest.raises(ReadError) as caught:
            read_where(text, SET, VARIED)
        with pytest.raises(ReadError) as again:
            read_objective(text, SET, VARIED, "--max")
        (told,), (told_again,) = caught.value.problems, again.value.problems
        assert message in told.message
        assert told.place is not None
        assert (told.place.file, told.place.column) == ("--where", 1 + text.startswith(" "))
        assert told_again.place == told.place._replace(file="--max")


def best_by_definition(values: Sequence[float], count: int) -> list[int]:
    existing = [(value, row) for row, value in enumerate(values) if not math.isnan(value)]
    return [row for _, row in sorted(existing)[:count]]


@RANDOM
@given(st.lists(ANY_VALUE, max_size=60), st.integers(1, 70))
def test_the_best_are_sorted_and_ties_go_to_the_first(values: list[float], count: int) -> None:
    assert best(np.array(values, dtype=float), count).tolist() == best_by_definition(values, count)


@RANDOM
@given(st.lists(ANY_VALUE, max_size=60), st.integers(1, 20), st.integers(1, 20))
def test_the_best_of_chunks_are_the_best_of_all(values: list[float], count: int, size: int) -> None:
    kept: list[int] = []
    for start in range(0, len(values), size):
        rows = [*kept, *range(start, min(start + size, len(values)))]
        kept = [rows[row] for row in best(np.array([values[row] for row in rows]), count)]
    assert kept == best_by_definition(values, count)


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
    """101 points on a line: ends, middle, quarters; equal points come last."""
    line = np.column_stack([np.arange(101.0), np.arange(100.0, -1, -1)])
    for rows in ([0], [0, 100], [0, 50, 100], [0, 25, 50, 75, 100]):
        assert limited(line, len(rows)).tolist() == rows
    assert limited(line * [1, 1000], 5).tolist() == [0, 25, 50, 75, 100]
    front = np.array([[0.0, 2.0], [0.0, 2.0], [1.0, 1.0], [2.0, 0.0]])
    assert limited(front, 3).tolist() == [0, 2, 3]
