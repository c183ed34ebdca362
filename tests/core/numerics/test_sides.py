"""Where functions change their side, against closed forms."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.sides import changes_of_side


def test_each_change_of_side_is_found() -> None:
    functions: list[tuple[Callable[[Floats], Floats], float, list[float]]] = [
        (lambda x: x - 0.3, 1.0, [0.3]),
        (lambda x: np.sin(x) - 0.5, 3.0, [math.asin(0.5), math.pi - math.asin(0.5)]),
        (lambda x: 1 / (x - 1) - 5, 3.0, [1.0, 1.2]),
        (lambda x: np.where(x < 1 / 3, 2.0, -3.0), 1.0, [1 / 3]),
        (lambda x: np.sqrt(2 - x) + 1, 3.0, [2.0]),  # no number behind
        (lambda x: np.maximum(x, 2) - 2, 3.0, [2.0]),  # 0 before
        (lambda x: abs(x - 1), 3.0, [1.0]),  # touches
        (lambda x: 1e-9 - abs(x - 1), 3.0, [1 - 1e-9, 1 + 1e-9]),
        (lambda x: 3 + 0 * x, 3.0, []),
        (lambda x: 0 * x, 3.0, []),
    ]

    def exact(function: Callable[[Floats], Floats], x: Floats) -> tuple[Floats, Floats]:
        return function(x), np.full(len(x), 1e-15)

    for function, high, places in functions:
        found = changes_of_side(partial(exact, function), 0.0, high)
        near = found[np.diff(found, prepend=-1.0) > 1e-12]
        assert near == pytest.approx(places, abs=1e-10)


def test_thousands_of_short_pulses_are_found() -> None:
    """Sin is above cos(d) for 2 d in each period: here 2e-7 of it, a hundredth of a place."""
    found = changes_of_side(
        lambda x: (np.sin(x) - math.cos(2 * math.pi * 1e-4), np.full(len(x), 1e-15)), 0.0, 3000.0
    )
    periods = math.floor((3000 - math.pi / 2) / (2 * math.pi)) + 1
    assert len(found) == 2 * periods
    assert np.diff(found)[::2] == pytest.approx(4 * math.pi * 1e-4, rel=1e-6)
