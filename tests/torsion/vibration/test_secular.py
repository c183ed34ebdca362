"""Frequencies by the stiffness of one device: against closed forms, and inserted in the equation."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.torsion.systems import Array
from vstatics.torsion.vibration.secular import Poles, squares_with_device

DECADES = 10.0 ** np.arange(-12, 13)
"""Of compliances."""


def squares(poles: list[float], weights: list[float], compliances: Array, mode: int) -> Array:
    return squares_with_device(Poles(np.array(poles), np.array(weights)), compliances, mode)


@pytest.mark.parametrize("mode", [0, 1])
def test_two_poles_have_a_quadratic_equation(mode: int) -> None:
    """``(x - 1)(x - 9) = c (5 x - 21)`` for weights 2 and 3; the roots' product is ``9 + 21 c``."""
    found = squares([1.0, 9.0], [2.0, 3.0], DECADES, mode)
    for compliance, x in zip(DECADES, found, strict=True):
        c = 1 / compliance
        larger = 5 + 2.5 * c + math.sqrt(16 + 4 * c + 6.25 * c**2)
        assert x == pytest.approx(larger if mode else (9 + 21 * c) / larger, rel=1e-12)


@pytest.mark.parametrize("above", [4.0, 4.0 * (1 + 1e-15)])
def test_one_of_two_modes_of_one_frequency_is_not_changed(above: float) -> None:
    """Of both, one shape can be chosen that does not twist the device."""
    assert squares([1.0, 4.0, above], [2.0, 3.0, 1.0], DECADES, 1).tolist() == [4.0] * len(DECADES)


def test_one_pole() -> None:
    """A mass of 4 on the device alone: ``omega^2 = c/4``, for any stiffness."""
    np.testing.assert_allclose(squares([0.0], [0.25], DECADES, 0), 0.25 / DECADES, rtol=1e-15)


def test_a_device_that_twists_in_no_mode_changes_none() -> None:
    assert (squares([1.0, 4.0], [0.0, 0.0], DECADES, 1) == 4).all()


def test_a_mode_in_which_the_device_is_not_twisted_stays() -> None:
    """The pole at 4 has no weight: it is the second frequency until the first one passes it."""
    for compliance in DECADES:
        alone = 1 + 1 / compliance
        both = sorted([alone, 4.0])
        found = [squares([1.0, 4.0], [1.0, 0.0], np.array([compliance]), mode) for mode in (0, 1)]
        np.testing.assert_allclose(np.ravel(found), both, rtol=1e-12)


def test_equal_poles_leave_one_of_them_where_it_is() -> None:
    """In two equal modes there is one in which the device is not twisted."""
    assert (squares([0.0, 2.0, 2.0, 5.0], [1.0, 1.0, 2.0, 1.0], DECADES, 1) == 2).all()


@st.composite
def any_poles(draw: st.DrawFn) -> tuple[list[float], list[float], float]:
    count = draw(st.integers(1, 6))
    decades = st.floats(-6, 6).map(lambda power: 10.0**power)
    poles = sorted(draw(st.lists(decades, min_size=count, max_size=count, unique=True)))
    if draw(st.booleans()):
        poles[0] = 0.0
    weights = draw(st.lists(decades, min_size=count, max_size=count))
    return poles, weights, draw(decades)


@settings(max_examples=count(32, 240))
@given(any_poles())
def test_roots_are_enclosed_in_exact_fractions(
    given: tuple[list[float], list[float], float],
) -> None:
    """A little below each root the sum is above the compliance, a little above it is below."""
    poles, weights, compliance = given
    for mode, pole in enumerate(poles):
        [x] = squares(poles, weights, np.array([compliance]), mode).tolist()
        end = poles[mode + 1] if mode + 1 < len(poles) else math.inf
        below, above = (
            Fraction(x) * (1 - Fraction(1, 10**12)),
            Fraction(x) * (1 + Fraction(1, 10**12)),
        )
        if below > pole:
            assert _sum(poles, weights, below) > compliance
        if above < end:
            assert _sum(poles, weights, above) < compliance
        assert pole * (1 - 1e-14) <= x <= end * (1 + 1e-14)


def _sum(poles: list[float], weights: list[float], x: Fraction) -> Fraction:
    terms = zip(poles, weights, strict=True)
    return sum((Fraction(weight) / (x - Fraction(pole)) for pole, weight in terms), Fraction(0))
