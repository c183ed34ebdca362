"""The dynamic factor of a clutch whose torque grows with time, in closed form.

    J23 phi'' + phi/E = M_C (1 - exp(-K t))                                          (3.69)

with phi and its speed 0 at first: a clutch that slips throughout, before wheels that stand.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem
from vstatics.torsion.tolerances import LEAST_RATE, SAME_ANGLE

GROWN = 3.0
"""Rate by time from which on the clutch is taken to have its torque. [-]"""


class Engagement(NamedTuple):
    """How fast a clutch is engaged, and what that does."""

    rate: float
    """K of ``1 - exp(-K t)``. [1/s]"""
    factor: float
    """Torque of the spring by that of the clutch, at its first maximum after t = 3/K. [-]"""


def engagement(rate: float, inertia: float, compliance: float) -> Engagement:
    """The dynamic factor of (3.70).

    Parameters
    ----------
    rate : float
        K. [1/s]
    inertia : float
        J23, between clutch and spring. [kg*m^2]
    compliance : float
        E, of the spring. [rad/(N*m)]

    Raises
    ------
    CaseError
        Of a rate that is not above 0, or infinite.

    Examples
    --------
    Only K by the natural frequency counts; a clutch that is engaged at once gives 2.

    >>> [round(engagement(rate, 0.01, 0.01).factor, 3) for rate in (50, 100, 200, 1e9)]
    [1.443, 1.697, 1.894, 2.0]
    """
    problems = list(rate_problems(rate))
    if problems:
        raise CaseError(problems)
    return Engagement(rate, _factor(rate * math.sqrt(inertia * compliance)))


def rate_problems(rate: float | None) -> Iterator[Problem]:
    """Of a rate that cannot be."""
    if rate is not None and not 0 < rate < math.inf:
        yield Problem("E502", f"read {rate:g}, expected a rate above 0", ("rate",))


def _factor(k: float) -> float:
    """The first maximum of (3.70) from t = 3/K on, for k = K/K_c.

    In the angle x = K_c t its slope is 0 where ``sin(x - a) = -exp(-k x)/sqrt(1 + k^2)`` with
    a = atan(1/k), and there (3.70) is ``1 - cos x``. From x = 3/k on the right side is less
    than .05, so there is one maximum in each turn, a little behind ``x - a = pi``.
    """
    k = min(max(k, LEAST_RATE), 1e99)  # beyond, nothing changes
    ahead, size = math.atan2(1, k), math.hypot(1, k)
    first = GROWN / k - math.asin(math.exp(-GROWN) / size)
    turns = math.ceil((first - ahead - math.pi) / math.tau)
    middle, behind, before = ahead + math.pi + turns * math.tau, 0.0, -1.0
    while abs(behind - before) > SAME_ANGLE:  # each step is at least ten times nearer
        before, behind = behind, math.asin(math.exp(-k * (middle + behind)) / size)
    return 1 + math.cos(ahead + behind)
