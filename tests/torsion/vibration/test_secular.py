"""Frequencies by the stiffness of one device: closed forms, and inserted in the equation."""

import itertools
import math
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.torsion.systems import Array
from vstatics.torsion.vibration.secular import Poles, squares_with_device

DECADES = 10.0 ** np.arange(-12, 13)
"""Of compliances."""


def squares(poles: list[float], weights: list[float], compliances: Array, mode: int) -> Array:
    return squares_with_device(Poles(np.array(poles), np.array(weights)), compliances, mode)


def test_one_of_two_modes_of_one_frequency_is_not_changed() -> None:
    """Of both, one shape can be chosen that does not twist the device; or none has a weight."""
    for poles, weights, stays in (
        ([1.0, 4.0, 4.0], [2.0, 3.0, 1.0], 4), ([1.0, 4.0, 4.0 * (1 + 1e-15)], [2.0, 3.0, 1.0], 4),
        ([0.0, 2.0, 2.0, 5.0], [1.0, 1.0, 2.0, 1.0], 2), ([1.0, 4.0], [0.0, 0.0], 4),
    ):  # fmt: skip
        assert (squares(poles, weights, DECADES, 1) == stays).all()


def test_a_mode_in_which_the_device_is_not_twisted_stays() -> None:
    """The pole at 4 has no weight: it is the second frequency until the first one passes it."""
    for compliance in DECADES:
        both = sorted([1 + 1 / compliance, 4.0])
        found = [squares([1.0, 4.0], [1.0, 0.0], np.array([compliance]), mode) for mode in (0, 1)]
        np.testing.assert_allclose(np.ravel(found), both, rtol=1e-12)


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

    def total(x: Fraction) -> Fraction:
        terms = zip(poles, weights, strict=True)
        return sum((Fraction(part) / (x - Fraction(pole)) for pole, part in terms), Fraction(0))

    for mode, (pole, end) in enumerate(itertools.pairwise((*poles, math.inf))):
        [x] = squares(poles, weights, np.array([compliance]), mode).tolist()
        below, above = (Fraction(x) * (1 + sign * Fraction(1, 10**12)) for sign in (-1, 1))
        assert below <= pole or total(below) > compliance
        assert above >= end or total(above) < compliance
        assert pole * (1 - 1e-14) <= x <= end * (1 + 1e-14)
