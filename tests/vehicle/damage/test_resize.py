"""Shafts of equal life against the book."""

import math

import pytest

from vstatics.vehicle.damage.resize import resized, resized_by_ratio


def test_the_half_shaft_of_the_book() -> None:
    """(2.3) to (2.7): d i^(5/18), compliance on the faster shaft i^(8/9); printed 56.5 mm, 2.6."""
    made = resized_by_ratio(42.0, 2.9)
    assert made.diameter == pytest.approx(42 * 2.9 ** (5 / 18), rel=1e-14)
    assert made.diameter == pytest.approx(56.454, abs=5e-4)
    assert made.reduced_compliance == pytest.approx(2.9 ** (8 / 9), rel=1e-14)
    assert made.reduced_compliance == pytest.approx(2.5764, abs=5e-5)


def test_what_the_book_prints_as_3_79() -> None:
    """(2.8) by its own formula, i^(8/9) of 2.71, is 2.4258; 3.79 is i^(4/3)."""
    assert resized_by_ratio(1.0, 2.71).reduced_compliance == pytest.approx(2.4258, abs=5e-5)


def test_both_forms_are_one_and_lives_are_equal() -> None:
    """sigma^m N = const with sigma ~ M/d^3."""
    by_parts = resized(42.0, 2.9, 1 / 2.9)
    assert by_parts[:2] == pytest.approx(resized_by_ratio(42.0, 2.9)[:2])
    made = resized(30.0, 1.7, 12.0, 3.0)
    assert (1.7 / (made.diameter / 30) ** 3) ** 3 * 12 == pytest.approx(1.0)
    assert made.compliance == pytest.approx((30 / made.diameter) ** 4)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_diameter_changes_by_a_logarithm_of_150_at_most(sign: int) -> None:
    """(2.3): the cube root of the torque, here exp(450)."""
    assert resized(1.0, math.exp(sign * 449.9), 1.0).diameter == pytest.approx(
        math.exp(sign * 449.9 / 3)
    )
    with pytest.raises(ValueError, match="to give a diameter"):
        resized(1.0, math.exp(sign * 450.1), 1.0)


def test_numbers_too_large() -> None:
    with pytest.raises(ValueError, match="to give a diameter"):
        resized(1.0, 1e300, 1e300, 1e-3)
