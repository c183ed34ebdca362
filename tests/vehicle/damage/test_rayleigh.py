"""Random stresses: lives from the book, by quadrature and of samples; shafts of equal life."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from tests.commands import json_answer, vstatics
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.rayleigh import rayleigh_life, scattered_life
from vstatics.vehicle.damage.resize import resized, resized_by_ratio
from vstatics.vehicle.damage.scatter import LifeSamples, Scattered, read_scattered

STEEL = Fatigue(100e6, 3, 4e6)


def test_the_example_of_the_book() -> None:
    """Tsitovich and Algin, after (4.40), print 3.62 and 51 000 km; the digits are by quadrature."""
    for exponent, integral, life in (
        (3, 3.6191919, 51167.55),
        (6, 47.915922, 17892.57),
    ):
        made = rayleigh_life(STEEL._replace(exponent=exponent), 60e6, 100)
        assert made.integral == pytest.approx(integral, rel=1e-7)
        assert made.life == pytest.approx(life, rel=3e-7)


@pytest.mark.parametrize("exponent", [0.5, 2.7, 12.5])
@pytest.mark.parametrize("threshold", [0.0, 0.3, 2.0])
def test_the_integral_by_a_sum(exponent: float, threshold: float) -> None:
    """The trapezoidal rule over x^(m+1) exp(-x^2/2); (4.40): N = a cycles r^m/integral."""
    x = np.linspace(threshold / 0.6, 40, 400_001)
    y = x ** (exponent + 1) * np.exp(-x * x / 2)
    expected = (y.sum() - (y[0] + y[-1]) / 2) * (x[1] - x[0])
    strength = STEEL._replace(exponent=exponent, threshold=threshold, sum=0.7)
    found = rayleigh_life(strength, 60e6)
    assert found.integral == pytest.approx(expected, rel=1e-6)
    assert found.life == pytest.approx(0.7 * 4e6 / 0.6**exponent / expected, rel=1e-6)
    for deviation in (1e5, 1e-300):  # never reaches the threshold
        assert rayleigh_life(STEEL, deviation)[:2] == (0.0, None)


def test_a_life_is_stated_up_to_a_logarithm_of_700() -> None:
    """Without a threshold the mean of s^2 is 2 D: of exponent 2, life = (endurance/D)^2/2."""
    below, above = (
        Fatigue(math.sqrt(2) * math.exp(logarithm / 2), 2, 1.0, threshold=0.0)
        for logarithm in (699.99, 700.01)
    )
    assert math.log(rayleigh_life(below, 1.0).life or 0.0) == pytest.approx(699.99)
    assert math.isfinite(rayleigh_life(STEEL._replace(exponent=100), 60e6).life or math.nan)
    large = STEEL._replace(exponent=1e4, threshold=0)
    strong = STEEL._replace(endurance=1e300, threshold=0)
    for strength, deviation in ((above, 1.0), (large, 60e6), (strong, 1e-300)):
        with pytest.raises(ValueError, match="too large"):
            rayleigh_life(strength, deviation)


def test_the_half_shaft_of_the_book_resized() -> None:
    """(2.3) to (2.7): d i^(5/18), compliance on the faster shaft i^(8/9); printed 56.5 mm, 2.6.

    (2.8) by its own formula, i^(8/9) of 2.71, is 2.4258; the printed 3.79 is i^(4/3).
    """
    made = resized_by_ratio(42.0, 2.9)
    assert made.diameter == pytest.approx(42 * 2.9 ** (5 / 18), rel=1e-14)
    assert made.diameter == pytest.approx(56.454, abs=5e-4)
    assert made.reduced_compliance == pytest.approx(2.9 ** (8 / 9), rel=1e-14)
    assert made.reduced_compliance == pytest.approx(2.5764, abs=5e-5)
    assert resized_by_ratio(1.0, 2.71).reduced_compliance == pytest.approx(2.4258, abs=5e-5)
    assert resized(42.0, 2.9, 1 / 2.9)[:2] == pytest.approx(made[:2])


def test_shafts_of_equal_life() -> None:
    """sigma^m N = const with sigma ~ M/d^3; the cube root of the torque is exp(150) at most."""
    made = resized(30.0, 1.7, 12.0, 3.0)
    assert (1.7 / (made.diameter / 30) ** 3) ** 3 * 12 == pytest.approx(1.0)
    assert made.compliance == pytest.approx((30 / made.diameter) ** 4)
    for sign in (1, -1):
        largest = resized(1.0, math.exp(sign * 449.9), 1.0).diameter
        assert largest == pytest.approx(math.exp(sign * 449.9 / 3))
        with pytest.raises(ValueError, match="to give a diameter"):
            resized(1.0, math.exp(sign * 450.1), 1.0)
    with pytest.raises(ValueError, match="to give a diameter"):
        resized(1.0, 1e300, 1e300, 1e-3)


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


def test_the_command_prints_the_distribution() -> None:
    given = ["--exponent", "3", "--cycles", "4e6", "--deviation", "60 MPa", "-f", "json"]
    scattered = ["--endurance", "lognormal(100 MPa, 0.08)", "--samples", "500", "--seed", "2"]
    answer = json_answer("damage", "rayleigh", *given, *scattered)
    plain = json_answer("damage", "rayleigh", *given, "--endurance", "100 MPa")
    assert answer["life"] == plain["life"]
    assert answer["samples"]["count"] == 500
    assert answer["samples"]["B10"] < answer["samples"]["B50"] < answer["samples"]["mean"]
    assert answer == json_answer("damage", "rayleigh", *given, *scattered)


def test_wrong_scatters_are_wrong_use() -> None:
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
