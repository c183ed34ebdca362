"""Fronts: points of which no other is better in all numbers."""

import math
from itertools import product
from operator import le, lt

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


def front_by_definition(objectives: Floats) -> list[int]:
    """As good in all numbers, better in one: who dominates."""
    rows = objectives.tolist()
    existing = [row for row in rows if not any(map(math.isnan, row))]

    def is_dominated(row: list[float]) -> bool:
        return any(all(map(le, one, row)) and any(map(lt, one, row)) for one in existing)

    return [n for n, row in enumerate(rows) if row in existing and not is_dominated(row)]


@RANDOM
@given(points(st.integers(1, 5)))
def test_a_front_is_what_its_definition_says(objectives: Floats) -> None:
    assert non_dominated(objectives).tolist() == front_by_definition(objectives)


@RANDOM
@given(points(st.integers(2, 5), most=40), st.integers(1, 15))
def test_the_front_of_chunks_is_the_front_of_all(objectives: Floats, size: int) -> None:
    kept = np.zeros((0, objectives.shape[1]))
    rows: Integers = np.zeros(0, dtype=np.int64)
    for start in range(0, len(objectives), size):
        chunk = objectives[start : start + size]
        new = non_dominated(chunk)
        of_kept, of_new = merged(kept, chunk[new])
        rows = np.concatenate([rows[of_kept], start + new[of_new]])
        kept = objectives[rows]
    assert rows.tolist() == front_by_definition(objectives)


def test_fronts_of_many_points(monkeypatch: pytest.MonkeyPatch) -> None:
    """More than all numbers at which the method changes, which are made small."""
    monkeypatch.setattr(fronts, "LEAF", 32)
    monkeypatch.setattr(fronts, "BLOCK", 15)
    for objectives, levels in product((1, 2, 3, 4, 5), (4, 30, 10**6)):
        rng = np.random.default_rng(objectives)
        made = rng.integers(0, levels, (8 * fronts.LEAF, objectives)).astype(float)
        assert non_dominated(made).tolist() == front_by_definition(made)


def test_points_of_which_none_is_better_are_all_kept() -> None:
    """All lie on one plane: what is better in one is worse in another."""
    for objectives in (2, 3, 4):
        rng = np.random.default_rng(7)
        plane = rng.integers(0, 100, (5 * fronts.BLOCK, objectives)).astype(float)
        plane[:, -1] = -plane[:, :-1].sum(axis=1)
        assert non_dominated(plane).tolist() == list(range(len(plane)))
        worse = plane + 1
        of_plane, of_worse = merged(plane, worse[non_dominated(worse)])
        assert (len(of_plane), len(of_worse)) == (len(plane), 0)
        of_worse, of_plane = merged(worse, plane)
        assert (len(of_plane), len(of_worse)) == (len(plane), 0)
