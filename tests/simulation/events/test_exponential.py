"""Matrix exponentials against scipy, of matrices whose lower rows are chains of derivatives."""

import numpy as np
from scipy.linalg import expm

from tests.chance import examples, generator
from vstatics.simulation.events.exponential import Exponential


@examples(6, 20, 200)
def test_random_exponentials_with_chains_agree_with_scipy(examples: int) -> None:
    """Within 1e-12 of the largest entry, at given times, at nodes and over equal parts."""
    chance = generator(22)
    for _ in range(examples):
        rows, orders = int(chance.integers(1, 6)), [*chance.integers(1, 12, chance.integers(0, 3))]
        matrix = np.zeros((rows + sum(orders),) * 2)
        matrix[:rows] = chance.normal(size=(rows, len(matrix))) * 10 ** chance.uniform(-2, 1)
        matrix[:rows, :rows] -= np.abs(matrix).sum(axis=1).max() * np.eye(rows)  # no growth
        for length, last in zip(orders, rows + np.cumsum(orders, dtype=int), strict=True):
            inner = np.arange(last - length, last - 1)
            matrix[inner, inner + 1] = 1.0
        times = np.array([0.0, *chance.random(3), 1.0])
        exponential = Exponential(matrix, times, rows)
        states = chance.normal(size=(len(matrix), len(times)))
        exact = np.array([expm(matrix * time) for time in times])
        limit = 1e-12 * np.abs(exact).max()
        np.testing.assert_allclose(exponential.at(times), exact[:, :rows], rtol=0, atol=limit)
        moved = np.einsum("tij,jt->it", exact[:, :rows], states)
        limit = 1e-12 * np.abs(exact).max() * np.abs(states).sum()
        np.testing.assert_allclose(exponential.moved(times, states), moved, rtol=0, atol=limit)
        nodes = np.einsum("tij,jc->ict", exact[:, :rows], states).reshape(rows, -1)
        np.testing.assert_allclose(exponential.at_nodes(states), nodes, rtol=0, atol=limit)
        first = states[:, 0]
        repeated = np.array([expm(matrix * part) @ first for part in range(5)]).T
        limit = 1e-12 * np.abs(repeated).max()
        np.testing.assert_allclose(exponential.repeated(first, 5), repeated, rtol=0, atol=limit)
