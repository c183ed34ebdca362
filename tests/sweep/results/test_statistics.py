"""Statistics of numbers near the ends of the range of floats."""

import warnings
from fractions import Fraction

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from vstatics.sweep.results.statistics import statistics


@each_seed(30, 500)
def test_mean_and_deviation_of_numbers_of_any_size_are_those_of_fractions(seed: int) -> None:
    rng = seeded(seed)
    size = 10.0 ** rng.uniform(-290, 307)
    numbers = [rng.uniform(-1, 1) * size for _ in range(rng.randint(2, 20))]
    exact = [Fraction(one) for one in numbers]
    mean = sum(exact, Fraction(0)) / len(exact)
    square = sum(((one - mean) ** 2 for one in exact), Fraction(0)) / (len(exact) - 1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = statistics(np.array(numbers))
    assert abs(Fraction(found.mean) - mean) <= Fraction(size) / 10**12
    if size > 1e-140:  # squares of others vanish
        ratio = Fraction(found.deviation) ** 2 / square
        assert float(ratio) == pytest.approx(1.0, rel=1e-9)
    assert (found.least, found.largest) == (min(numbers), max(numbers))
