"""Evenly spaced values, made only when they are asked for."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vstatics.core.numerics.steps import Steps, stepped

NUMBERS = st.floats(-1e6, 1e6).map(lambda number: round(number, 6))


@given(NUMBERS, NUMBERS, st.integers(2, 1000))
def test_steps_are_those_of_linspace(start: float, stop: float, number: int) -> None:
    steps = Steps(start, stop, number)[np.arange(number)]
    assert (steps[0], steps[-1]) == (start, stop)
    size = max(abs(start), abs(stop))
    np.testing.assert_allclose(
        steps, np.linspace(start, stop, number), rtol=1e-14, atol=1e-14 * size
    )


@given(st.floats(-1e300, 1e300), st.floats(-1e300, 1e300), st.integers(2, 9))
def test_steps_of_any_numbers_have_their_ends(start: float, stop: float, number: int) -> None:
    steps = Steps(start, stop, number)[np.arange(number)]
    assert (steps[0], steps[-1]) == (start, stop)
    assert np.isfinite(steps).all()


@given(NUMBERS, NUMBERS, st.floats(1e-3, 1e3))
def test_steps_end_at_or_before_the_stop(start: float, stop: float, step: float) -> None:
    made = stepped(start, stop, math.copysign(step, stop - start))
    assert made is not None
    assert abs(stop - made.stop) < step
    assert min(start, stop) <= made.stop <= max(start, stop)


def test_steps_are_made_only_when_they_are_asked_for() -> None:
    steps = Steps(0.0, 1.0, 10**15 + 1)
    assert steps[np.array([0, 10**15 // 2, 10**15])].tolist() == [0, 0.5, 1]
    with pytest.raises(ValueError, match="finite"):
        Steps(0.0, math.inf, 3)[np.arange(3)]
