"""Lives of a scattered strength and stress: closed forms, and scipy's integral of each sample."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from tests.commands import json_answer, vstatics
from vstatics import Fatigue
from vstatics.vehicle.damage.rayleigh import scattered_life
from vstatics.vehicle.damage.scatter import LifeSamples, Scattered, read_scattered


def test_without_a_threshold_the_life_is_lognormal() -> None:
    """Ln N = ln N_median + m (s_e z1 - s_d z2), so its deviation is m sqrt(s_e^2 + s_d^2)."""
    m, of_strength, of_stress = 5.0, 0.07, 0.05
    strength = Fatigue(Scattered(100e6, "lognormal", of_strength), m, 4e6, threshold=0.0)
    stress = Scattered(60e6, "lognormal", of_stress)
    found = scattered_life(strength, stress, 100.0, 200_000, seed=7)
    samples, spread = found.samples, m * math.hypot(of_strength, of_stress)
    assert samples is not None
    assert found.life is not None
    assert pytest.approx(found.life * math.exp(norm.ppf(0.1) * spread), rel=0.01) == samples.B10
    assert pytest.approx(found.life, rel=0.01) == samples.B50
    assert samples.mean == pytest.approx(found.life * math.exp(spread**2 / 2), rel=0.01)
    for life, share in samples.curve:
        assert norm.cdf(math.log(life / found.life) / spread) == pytest.approx(share, abs=0.005)


def test_each_sample_has_the_life_of_its_integral() -> None:
    """(4.40): N = cycles r^m / int_x0^inf x^(m+1) exp(-x^2/2) dx with x0 = threshold r."""
    strength = Fatigue(Scattered(100e6, "normal", 8e6), 3.0, 4e6, threshold=0.6)
    found = scattered_life(strength, 60e6, 1.0, 40, seed=3)
    assert found.samples is not None
    endurance = Scattered(100e6, "normal", 8e6).samples(40, np.random.default_rng(3))
    lives = []
    for ratio in endurance / 60e6:
        integral, _ = quad(lambda x: x**4 * math.exp(-x * x / 2), 0.6 * ratio, 40)
        lives.append(4e6 * ratio**3 / integral)
    expected = LifeSamples.of(np.array(lives))
    assert found.samples[:4] == pytest.approx(expected[:4], rel=1e-8)
    np.testing.assert_allclose(found.samples.curve, expected.curve, rtol=1e-8)


def test_percents_of_lives_are_those_of_the_stepped_distribution() -> None:
    lives = np.random.default_rng(5).lognormal(size=37)
    shares = np.arange(1, 100) / 100
    expected = np.quantile(lives, shares, method="inverted_cdf")
    np.testing.assert_array_equal(LifeSamples.of(lives).curve, np.transpose([expected, shares]))


def test_stresses_are_drawn_again_until_above_0() -> None:
    drawn = Scattered(1.0, "normal", 2.0).samples(10_000, np.random.default_rng(1))
    assert drawn.min() > 0
    share = norm.cdf(0.5)  # a normal distribution cut off at 0
    assert drawn.mean() == pytest.approx(1 + 2 * norm.pdf(0.5) / share, rel=0.03)
    assert read_scattered("100 MPa") is None


def test_the_command_tells_the_distribution() -> None:
    given = ["--exponent", "3", "--cycles", "4e6", "--deviation", "60 MPa", "-f", "json"]
    scattered = ["--endurance", "lognormal(100 MPa, 0.08)", "--samples", "500", "--seed", "2"]
    answer = json_answer("damage", "rayleigh", *given, *scattered)
    plain = json_answer("damage", "rayleigh", *given, "--endurance", "100 MPa")
    assert answer["life"] == plain["life"]
    assert answer["samples"]["count"] == 500
    assert answer["samples"]["B10"] < answer["samples"]["B50"] < answer["samples"]["mean"]
    assert answer == json_answer("damage", "rayleigh", *given, *scattered)


def test_what_does_not_scatter_as_it_should_is_wrong_use() -> None:
    for given, said in (
        ("lognormal(9 MPa, 0)|--samples|9", "and a deviation, above 0"),
        ("lognormal(0 MPa, 1)|--samples|9", "and a deviation, above 0"),
        ("normal(9 MPa, 1)|--samples|9", "a unit of both numbers, or of none"),
        ("normal(9 MPa)|--samples|9", "or a distribution such as"),
        ("normal(9 MPa, 1 MPa)", "expected --samples as well"),
        ("9 MPa|--samples|9", "--samples: expected a distribution of"),
        ("9 MPa|--seed|9", "--seed: expected --samples as well"),
    ):
        others = ["--exponent", "3", "--cycles", "4e6", "--deviation", "6 MPa", "--endurance"]
        assert vstatics("damage", "rayleigh", *others, *given.split("|")).is_wrong_use(said)
