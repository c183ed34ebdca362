"""Fixed points of e = law(T), where T = 1/(a + b e^x): roots of a quadratic in each cell of a law."""

from collections.abc import Sequence
from itertools import pairwise
from random import Random

import numpy as np
import pytest

from tests.chance import each_seed, examples, seeded
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.fixed_points import (
    Extremes,
    Laws,
    TorquesAt,
    TrialTorques,
    find_fixed_points,
)
from vstatics.core.numerics.lookup_table import LookupTable

NEVER = np.full((1, 1), np.nan)


def laws_over(tables: Sequence[LookupTable], torques_at: TorquesAt) -> Laws:
    def bounds(over: str, ends: tuple[Floats, Floats]) -> Extremes:
        each = zip(tables, *ends, strict=True)
        found = [getattr(table, over)(np.zeros(x.shape), x, y) for table, x, y in each]
        return Extremes(*map(np.array, zip(*found, strict=True)))

    return Laws(
        torques_at,
        lambda _, *of: bounds("values_over", of),
        lambda _, *of: bounds("slopes_over", of),
    )


def laws_of(table: LookupTable, a: float, b: float, x: int) -> Laws:
    def torques_at(_: Integers, e: Floats) -> TrialTorques:
        return TrialTorques(1 / (a + b * e**x), np.full(e.shape, float(x)), a + b * e[0] ** x > 0)

    return laws_over([table], torques_at)


def by_quadratics(table: LookupTable, a: float, b: float, x: int) -> list[float]:
    """E (a + b e^x) = c (a + b e^x) + s in a cell where the law is c + s T, multiplied by e^-x."""
    places, values = [-1e9, *table.columns, 1e9], table.values[0]
    values = (values[0], *values, values[-1])
    roots: list[float] = []
    for (left, low), (right, high) in pairwise(zip(places, values, strict=True)):
        s = (high - low) / (right - left)
        c = low - s * left
        terms = (b, a - c * b, -c * a - s) if x == 1 else (a, b - c * a - s, -c * b)
        real = [float(e.real) for e in np.roots(terms) if abs(e.imag) < 1e-12 and e.real > 0.5]
        for e in real:
            t = 1 / (a + b * e**x or 1e-300)
            is_new = all(abs(e - root) > 1e-9 for root in roots)
            roots += [e] * (is_new and t > 0 and left - 1e-11 <= t <= right + 1e-11)
    return sorted(roots)


def jagged(rng: Random, x: int) -> tuple[LookupTable, float, float]:
    """A law, of which a corner can be at a solution."""
    e = rng.uniform(0.6, 0.95)
    b = rng.choice((-1, 1)) * rng.uniform(0.2, 3)
    a = rng.uniform(0.1, 2) - b * e**x
    t = 1 / (a + b * e**x)
    corners = {t * rng.uniform(0.7, 1.3): rng.uniform(0.55, 0.99) for _ in range(rng.randrange(6))}
    corners |= {0.7 * t: rng.uniform(0.55, 0.99), (t if rng.random() < 0.5 else 1.2 * t): e}
    columns, values = zip(*sorted(corners.items()), strict=True)
    return LookupTable((0.0,), (values,), columns), a, b


@pytest.mark.parametrize("x", [1, -1])
@examples(12, 20, 2000)
def test_all_roots_of_quadratics_are_fixed_points(x: int, examples: int) -> None:
    rng, numbers = seeded(51), set()
    for _ in range(examples):
        table, a, b = jagged(rng, x)
        low, high = (np.array([[f(table.values[0])]]) for f in (min, max))
        fixed = find_fixed_points(laws_of(table, a, b, x), low, high, NEVER)
        expected = by_quadratics(table, a, b, x)
        assert sorted(fixed.efficiencies[0]) == pytest.approx(expected, abs=1e-9), (table, a, b)
        numbers.add(len(expected))
    assert numbers >= {1, 2, 3}


def test_a_tangent_counts_as_one_fixed_point_and_a_gap_as_none() -> None:
    """A line of slope -e^2 through (1/e, e) touches e = 1/T, which its last value meets behind."""
    for gap, number in ((0.0, 1), (1e-9, 0), (-1e-7, 2)):
        e = 0.8
        values = tuple(e - e * e * (t - 1 / e) - gap for t in (1.0, 1.5))
        laws = laws_of(LookupTable((0.0,), (values,), (1.0, 1.5)), 0.0, 1.0, 1)
        low, high = (np.array([[end]]) for end in (min(values), max(values)))
        assert find_fixed_points(laws, low, high, NEVER).point.size == number + 1


@each_seed(4, 200)
def test_a_torque_that_turns_at_the_solution_hides_no_fixed_point(seed: int) -> None:
    """The laws have the value `e` at the torques 0, 10 and 7, where the first torque turns."""
    rng = seeded(seed)
    e, ends = rng.uniform(0.7, 0.9), (rng.uniform(0.6, 0.95), rng.uniform(0.6, 0.95))
    tables = [LookupTable((0.0,), ((ends[0], e, ends[1]),), (t - 5, t, t + 5)) for t in (0, 10, 7)]

    def torques_at(_: Integers, tried: Floats) -> TrialTorques:
        turning = (tried - e)[1:].sum(axis=0)
        signs = np.array([np.sign(turning), *np.ones((2, len(turning)))])
        return TrialTorques(np.array([turning, 10 + turning, 7 - turning]), signs, turning < 9)

    low, high = np.full((3, 1), min(e, *ends)), np.full((3, 1), max(e, *ends))
    fixed = find_fixed_points(laws_over(tables, torques_at), low, high, np.full((3, 1), np.nan))
    assert np.abs(fixed.efficiencies - e).max(axis=0).min() < 1e-9
