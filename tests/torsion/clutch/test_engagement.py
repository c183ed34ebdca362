"""The dynamic factor of a clutch that is engaged in time: (3.70), its equation integrated."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from vstatics.core.errors import CaseError
from vstatics.torsion.clutch.engagement import engagement

AT_A_MAXIMUM = (0.27850147, 0.72749923)
"""K/K_c with which a maximum is at t = 3/K: 3/k = atan(1/k) + n pi + asin(exp(-3)/sqrt(1 + k^2)),
n = 3 and 1, as (3.70) differentiated has it."""


@pytest.mark.parametrize(
    "ratio",
    [part * ratio for ratio in AT_A_MAXIMUM for part in (1.001, 0.999)]
    + [0.03, 0.1, 0.31, 0.5, 1.0, 2.0, 5.0, 30.0],
)
def test_it_is_the_first_maximum_of_the_equation_of_motion(ratio: float) -> None:
    """(3.69) with J23 = E = M_C = 1, K = ratio."""

    def still(_: float, y: np.ndarray) -> float:
        return float(y[1])

    still.direction = -1  # type: ignore[attr-defined]
    made = solve_ivp(
        lambda t, y: [y[1], 1 - math.exp(-ratio * t) - y[0]], (0, 3 / ratio + 4 * math.pi),
        [0.0, 0.0], events=still, rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert made.t_events is not None
    assert made.y_events is not None
    maxima = zip(made.t_events[0], made.y_events[0], strict=True)
    first = next(y[0] for t, y in maxima if t > 3 / ratio)
    assert engagement(ratio, 1, 1).factor == pytest.approx(first, rel=1e-7)
    assert engagement(ratio / 6, 4, 9).factor == pytest.approx(first, rel=1e-7)  # K_c = 1/6


def test_a_clutch_that_is_engaged_at_once_doubles_the_torque() -> None:
    """Very slowly, it has its torque after three time constants."""
    assert engagement(1e12, 1, 1).factor == pytest.approx(2)
    assert engagement(1e200, 1e200, 1).factor == 2
    assert engagement(1e-300, 1e-100, 1e-100).factor == pytest.approx(1 - math.exp(-3))


@pytest.mark.parametrize("rate", [0.0, -1.0, math.nan, math.inf])
def test_a_rate_is_above_0(rate: float) -> None:
    with pytest.raises(CaseError, match="expected a rate above 0"):
        engagement(rate, 1, 1)
