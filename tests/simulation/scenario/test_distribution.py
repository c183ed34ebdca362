"""Numbers that are drawn: their means and deviations, and that they keep within bounds."""

import math
from statistics import NormalDist

import numpy as np
import pytest

from vstatics.simulation.scenario.distribution import Distribution

PARTS = (np.arange(20000) + 0.5) / 20000
"""So evenly spaced that means are those of the distribution."""


def test_a_normal_one_has_the_quantiles_of_the_normal_distribution() -> None:
    """Against the standard library."""
    parts = np.array([1e-9, 0.025, 0.5, 0.9])
    expected = [NormalDist(0.7, 0.05).inv_cdf(part) for part in parts]
    numbers = Distribution(normal=(0.7, 0.05)).quantiles(parts)
    np.testing.assert_allclose(numbers, expected, rtol=1e-12)


def test_mean_and_deviation() -> None:
    # the mean of a lognormal is exp(m + s^2/2), its deviation that times sqrt(exp(s^2) - 1)
    mean_of_lognormal, part = math.exp(-0.78 + 0.25**2 / 2), math.sqrt(math.expm1(0.25**2))
    lognormal = Distribution(lognormal=(-0.78, 0.25))
    for one, mean, deviation in (
        (Distribution(normal=(262.0, 6.0)), 262.0, 6.0),
        (Distribution(uniform=(1.0, 3.0)), 2.0, 2 / math.sqrt(12)),
        (lognormal, mean_of_lognormal, mean_of_lognormal * part),
    ):
        numbers = one.quantiles(PARTS)
        assert numbers.mean() == pytest.approx(mean, rel=1e-4)
        assert numbers.std() == pytest.approx(deviation, rel=2e-3)


def test_numbers_beyond_a_bound_are_the_bound() -> None:
    """As the source clips the speed of the engine to what it can turn."""
    numbers = Distribution(normal=(262.0, 6.0), min=258.0, max=270.0).quantiles(PARTS)
    assert (numbers.min(), numbers.max()) == (258.0, 270.0)
    assert (numbers == 258.0).mean() == pytest.approx(NormalDist().cdf(-4 / 6), abs=1e-4)


def test_without_deviation_all_are_the_mean() -> None:
    assert set(Distribution(normal=(0.7, 0.0)).quantiles(np.array([0.0, 0.3, 1.0]))) == {0.7}
    assert np.isfinite(Distribution(normal=(0.0, 1.0)).quantiles(np.array([0.0, 1.0]))).all()
