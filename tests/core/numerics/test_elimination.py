"""The elimination as such: what is determined, what contradicts, what depends."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.numerics.test_traced import on_tape, traced
from vstatics.core.numerics.elimination import (
    RIGHT,
    Equation,
    dependencies,
    less_of_floats,
    quotient_of_floats,
    solve,
)
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.traced import plain


def rows(matrix: list[list[float]], right: list[float]) -> list[Equation]:
    return [
        {**{j: value for j, value in enumerate(line) if value}, RIGHT: b}
        for line, b in zip(matrix, right, strict=True)
    ]


def test_what_is_determined_is_given_though_the_rest_is_open() -> None:
    # x0 = 1; x1 - x2 = 4 leaves x1 and x2 open, but not their difference
    system = rows([[1, 0, 0], [0, 1, -1]], [1, 4])
    solution = solve(system, 3, sums=[{1: 1.0, 2: -1.0}, {1: 1.0, 2: 1.0}])
    assert solution.values == pytest.approx([1, math.nan, math.nan, 4, math.nan], nan_ok=True)
    assert solution.missing == 1


def test_a_contradiction_leaves_no_value() -> None:
    solution = solve(rows([[1, 1], [2, 2], [1, 0]], [1, 3, 0]), 2)
    assert not solution.consistent
    assert all(math.isnan(plain(one)) for one in solution.values)


def test_an_equation_in_excess_that_agrees_does_no_harm() -> None:
    solution = solve(rows([[0.1, 0.2], [0.3, 0.6], [1, -1]], [0.3, 0.9, 0]), 2)
    assert solution.values == pytest.approx([1, 1])
    assert (solution.consistent, solution.excess) == (True, 1)


def test_zero_is_distinguished_from_small_by_its_terms() -> None:
    # .1 + .2 is not .3 in binary; 1e-12 is a number
    assert solve(rows([[0.1 + 0.2, 1], [0.3, 1]], [1, 1]), 2).missing == 1
    assert solve(rows([[0.3 + 1e-12, 1], [0.3, 1]], [1, 1]), 2).missing == 0


def test_sizes_grow_as_in_running_error_analysis() -> None:
    """Wilkinson 1963: |d(a/b)| <= (|da| + |a/b||db|)/|b|, |d(a - bc)| <= |da| + |db||c| + |b||dc|."""
    assert quotient_of_floats((6.0, 3.0), (-2.0, 1.0)) == (-3, (3 + 3 * 1) / 2)
    assert less_of_floats((10.0, 4.0), (-2.0, 1.0), (3.0, 2.0)) == (16, 4 + 1 * 3 + 2 * 2)


def test_scales_that_differ_widely_are_no_trouble() -> None:
    """A chain of three stages of 1e10: x3 = 1e-30."""
    chain: list[Equation] = [{0: 1.0, RIGHT: 1.0}]
    solution = solve([*chain, *({i: 1.0, i + 1: -1e10} for i in range(3))], 4)
    assert solution.values == pytest.approx([1, 1e-10, 1e-20, 1e-30], rel=1e-14)


def test_dependencies_name_their_equations() -> None:
    system = rows([[1, -1, 0], [0, 1, -1], [1, 0, -1], [0, 0, 1]], [0, 0, 0, 1])
    assert list(dependencies(system)) == [([0, 1, 2], True)]
    system = rows([[1, 0], [0, 1], [1, 1]], [1, 1, 3])
    assert list(dependencies(system)) == [([0, 1, 2], False)]


@given(st.integers(1, 6), st.integers(0, 2**32 - 1))
def test_solutions_are_those_of_dense_elimination(size: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    matrix = random.normal(size=(size, size)) * (random.random((size, size)) < 0.7)
    matrix += np.diag(random.choice([-2.0, 2.0], size))
    right = random.normal(size=size)
    if np.linalg.cond(matrix) > 1e6:
        return
    solution = solve(rows(matrix.tolist(), right.tolist()), size)
    found = [plain(one) for one in solution.values]
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=1e-8, atol=1e-8)
    assert solution[1:] == (True, 0, 0)


def test_overflow_harms_nothing_before_it() -> None:
    """The stages multiply to 1e900, or to 1e-900."""
    for stage in (1e300, 1e-300):
        chain: list[Equation] = [{0: 1.0, RIGHT: 1.0}]
        chain += [{i: 1.0, i + 1: -stage} for i in range(3)]
        values = solve(chain, 4).values
        assert values[:2] == pytest.approx([1, 1 / stage], rel=1e-14)


def test_entries_that_nearly_cancel_stand_for_no_other_variant() -> None:
    """x0 + x1 = 1, a x0 + x1 = 2: too little of ``a - 1`` is left where a is 1 + 1e-13."""

    def system(excess: float) -> list[Equation]:
        (a,) = traced(1 + excess)
        return [{0: a, 1: 1.0, RIGHT: 2.0}, {0: 1.0, 1: 1.0, RIGHT: 1.0}]

    found = solve(system(0.5), 2)
    assert (found.consistent, found.missing) == (True, 0)
    assert on_tape(found.values[0]).magnitude.value == pytest.approx(2)
    with pytest.raises(Untraceable):
        solve(system(1e-13), 2)
