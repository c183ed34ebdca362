"""Solutions of many variants of equations: against exact elimination of each."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from vstatics.core.numerics.motions import free_motions
from vstatics.torsion.vibration.other_ratios import followed_motions

WHOLE = st.integers(-3, 3).map(float)


@st.composite
def variants(draw: st.DrawFn) -> np.ndarray[tuple[int, int, int], np.dtype[np.float64]]:
    """Small whole numbers, so that ranks differ often."""
    shape = draw(st.integers(1, 4)), draw(st.integers(0, 4)), draw(st.integers(1, 5))
    count = shape[0] * shape[1] * shape[2]
    numbers = draw(st.lists(WHOLE, min_size=count, max_size=count))
    return np.array(numbers).reshape(shape)


@settings(max_examples=count(80, 600))
@given(variants())
def test_a_variant_is_safe_if_its_rank_is_that_of_the_first(
    equations: np.ndarray[tuple[int, int, int], np.dtype[np.float64]],
) -> None:
    """Never where it is another; where it is safe its motions solve all equations."""
    unknowns = equations.shape[2]
    counts = [
        free_motions([dict(enumerate(row)) for row in one], unknowns).shape[1] for one in equations
    ]
    found = followed_motions(equations, counts[0])
    assert found.safe[0]
    for one, motions, safe, rank in zip(equations, found.motions, found.safe, counts, strict=True):
        if safe:
            assert rank == counts[0]
            np.testing.assert_allclose(one @ motions, 0, atol=1e-9)
            np.testing.assert_array_equal(motions[found.free], np.eye(rank))
    assert sorted([*found.free, *found.others]) == list(range(unknowns))


def test_an_equation_that_vanishes_is_no_pivot() -> None:
    """``u - 1`` for u = 2, 1 + 1e-15 and 1: then nothing is said of the second unknown."""
    equations = np.array([[[0.0, 1.0]], [[0.0, 1e-15]], [[0.0, 0.0]]])
    assert followed_motions(equations, 1).safe.tolist() == [True, False, False]


def test_no_equations_leave_everything_free() -> None:
    found = followed_motions(np.zeros((2, 0, 3)), 3)
    np.testing.assert_array_equal(found.motions, [np.eye(3)] * 2)
    assert found.safe.all()
