"""Fronts: points of which no other is better in all numbers."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from tests.chance import count
from vstatics.core.numerics import fronts
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.fronts import merged, non_dominated

RANDOM = settings(max_examples=count(30, 225))


FEW_VALUES = st.sampled_from([0.0, -0.0, 1.0, 2.0, 3.0, math.nan, math.inf, -math.inf])


ANY_VALUE = st.one_of(FEW_VALUES, st.floats())


def points(objectives: st.SearchStrategy[int], most: int = 60) -> st.SearchStrategy[Floats]:
    """Points with many ties, with NaN and infinite numbers."""
    sizes = st.tuples(st.integers(0, most), objectives)
    return sizes.flatmap(lambda size: arrays.arrays(np.float64, size, elements=ANY_VALUE))


def dominates(one: Sequence[float], other: Sequence[float]) -> bool:
    """The definition: as good in all, better in one."""
    pairs = list(zip(one, other, strict=True))
    return all(a <= b for a, b in pairs) and any(a < b for a, b in pairs)


def front_by_definition(objectives: Floats) -> list[int]:
    rows = objectives.tolist()
    existing = [row for row in rows if not any(map(math.isnan, row))]
    return [
        number
        for number, row in enumerate(rows)
        if row in existing and not any(dominates(other, row) for other in existing)
    ]


def chunks(objectives: Floats, size: int) -> list[Floats]:
    return [objectives[start : start + size] for start in range(0, len(objectives), size)]


@RANDOM
@given(points(st.integers(1, 5)))
def test_a_front_is_what_its_definition_says(objectives: Floats) -> None:
    assert non_dominated(objectives).tolist() == front_by_definition(objectives)


@RANDOM
@given(points(st.integers(2, 5), most=40), st.integers(1, 15))
def test_the_front_of_chunks_is_the_front_of_all(objectives: Floats, size: int) -> None:
    kept = np.zeros((0, objectives.shape[1]))
    rows: Integers = np.zeros(0, dtype=np.int64)
    for number, chunk in enumerate(chunks(objectives, size)):
        new = non_dominated(chunk)
        of_kept, of_new = merged(kept, chunk[new])
        rows = np.concatenate([rows[of_kept], number * size + new[of_new]])
        kept = objectives[rows]
    assert rows.tolist() == front_by_definition(objectives)


@pytest.mark.parametrize("objectives", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("levels", [4, 30, 10**6])
def test_fronts_of_many_points(
    objectives: int, levels: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """More than all numbers at which the method changes, which are made small."""
    monkeypatch.setattr(fronts, "LEAF", 32)
    monkeypatch.setattr(fronts, "BLOCK", 15)
    count = 8 * fronts.LEAF
    rng = np.random.default_rng(objectives)
    made = rng.integers(0, levels, (count, objectives)).astype(float)
    assert non_dominated(made).tolist() == front_by_definition(made)


@pytest.mark.parametrize("objectives", [2, 3, 4])
def test_points_of_which_none_is_better_are_all_kept(objectives: int) -> None:
    """All lie on one plane: what is better in one is worse in another."""
    rng = np.random.default_rng(7)
    plane = rng.integers(0, 100, (5 * fronts.BLOCK, objectives)).astype(float)
    plane[:, -1] = -plane[:, :-1].sum(axis=1)
    assert non_dominated(plane).tolist() == list(range(len(plane)))
    worse = plane + 1
    of_plane, of_worse = merged(plane, worse[non_dominated(worse)])
    assert (len(of_plane), len(of_worse)) == (len(plane), 0)
    of_worse, of_plane = merged(worse, plane)
    assert (len(of_plane), len(of_worse)) == (len(plane), 0)
