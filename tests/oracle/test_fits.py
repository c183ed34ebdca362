"""The slow fit against closed forms, and two ways of it against each other."""

from fractions import Fraction

import pytest

from tests.oracle.combinations import Train
from tests.oracle.fits import Wish, fits, ratio, without_derivatives

pytestmark = pytest.mark.slow  # nothing in them is the program's own
BELAZ = Train(
    sets=[(3, 1, 2), (2, 4, 5), (2, 5, 7), (5, 6, 7)],
    ratios=[Fraction(-2)] * 4,
    elements=[(1, 2), (2, 5), (3, 0), (4, 0), (5, 0), (6, 0)],
    input=1,
    output=7,
)
"""Evseenko, tables 1 and 2: sun, ring, carrier of four sets; F1 F2 T1 T2 T3 T4."""
GEARS = {
    "F1 T3": (0, 4),
    "F1 T2": (0, 3),
    "F1 T4": (0, 5),
    "T1 F2": (1, 2),
    "T1 T3": (2, 4),
    "T1 T2": (2, 3),
}
BOUNDS = [(-5.0, -1.4)] * 4


def test_ratios_of_the_belaz_are_their_formulas() -> None:
    k1, k2, k3, k4 = ratios = (-2.0, -2.6, -2.2, -2.4)
    split, low = (k1 - 1) / k1, (1 - k2) * (1 - k3) / (1 - k2 - k3)
    forms = [1 - k3, low, 1 - k3 * k4, split, split * (1 - k3), split * low]
    found = [ratio(BELAZ, engaged, ratios) for engaged in GEARS.values()]
    assert found == pytest.approx(forms, rel=1e-13)


def test_four_ratios_are_met_by_the_explicit_solution() -> None:
    """p3 = u1 - 1, p2 = u1 (u2 - 1)/(u1 - u2), p4 = (1 - uR)/p3, p1 = 1/(us - 1)."""
    one, two, reverse, split = 4, 2.01, -5.12, 1.4925
    targets = {"F1 T3": one, "F1 T2": two, "F1 T4": reverse, "T1 F2": split}
    p3 = one - 1
    explicit = (1 / (split - 1), one * (two - 1) / (one - two), p3, (1 - reverse) / p3)
    (found,) = fits(Wish(BELAZ, GEARS, targets, BOUNDS), starts=6)
    assert [-k for k in found.ratios] == pytest.approx(explicit, rel=1e-10)
    assert found.largest < 1e-12


def test_a_search_without_derivatives_finds_the_same_compromise() -> None:
    targets = {"F1 T3": 4, "F1 T2": 2.01, "T1 F2": 1.4925, "T1 T3": 5.97, "T1 T2": 2.95}
    best, *_ = fits(Wish(BELAZ, GEARS, targets, BOUNDS), starts=6)
    other = without_derivatives(Wish(BELAZ, GEARS, targets, BOUNDS))
    assert other.squares == pytest.approx(best.squares, rel=1e-6)
    assert other.largest == pytest.approx(best.largest, rel=1e-3)
    assert best.largest > 1e-3
