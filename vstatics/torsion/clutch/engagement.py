"""Dynamic factor of a clutch whose torque grows with time, in closed form.

    J23 phi'' + phi/E = M_C (1 - exp(-K t))                                          (3.69)

J23 is the inertia between clutch and spring, E the compliance of the spring, M_C the final torque
of the clutch. The twist phi and its rate are 0 at t = 0. The clutch always slips, and the wheels
are at rest.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem
from vstatics.torsion.tolerances import LEAST_RATE, SAME_ANGLE

GROWN = 3.0
"""Value of K t from which the clutch counts as engaged with the final torque. [-]"""


class Engagement(NamedTuple):
    """Rate at which a clutch engages, and the resulting dynamic factor."""

    rate: float
    """Rate K in ``1 - exp(-K t)``. [1/s]"""
    factor: float
    """First maximum of the spring torque after t = 3/K, divided by the final clutch torque. [-]"""


def engagement(rate: float, inertia: float, compliance: float) -> Engagement:
    """Calculate the dynamic factor of a gradual engagement by (3.70), the solution of (3.69).

    Parameters
    ----------
    rate : float
        Rate K of the torque of the clutch. [1/s]
    inertia : float
        Inertia J23 between clutch and spring. [kg*m^2]
    compliance : float
        Compliance E of the spring. [rad/(N*m)]

    Raises
    ------
    CaseError
        If the rate is not a finite number above 0.

    Examples
    --------
    The factor depends on K divided by the natural frequency; it is 2 for a sudden engagement.

    >>> [round(engagement(rate, 0.01, 0.01).factor, 3) for rate in (50, 100, 200, 1e9)]
    [1.443, 1.697, 1.894, 2.0]
    """
    problems = list(rate_problems(rate))
    if problems:
        raise CaseError(problems)
    return Engagement(rate, _factor(rate * math.sqrt(inertia * compliance)))


def rate_problems(rate: float | None) -> Iterator[Problem]:
    """Yield a problem if a rate is not a finite number above 0."""
    if rate is not None and not 0 < rate < math.inf:
        yield Problem("E502", f"read {rate:g}, expected a rate above 0", ("rate",))


def _factor(k: float) -> float:
    """Return the first maximum of (3.70) after t = 3/K, for k = K/K_c with K_c = 1/sqrt(J23 E).

    K is the rate of the clutch torque, and K_c the natural frequency of the inertia on the spring.
    With the angle x = K_c t, the derivative of (3.70) is 0 if ``sin(x - a) = -exp(-k x)/sqrt(1 +
    k^2)`` with a = atan(1/k), and (3.70) is then ``1 - cos x``. For x > 3/k the right-hand side is
    smaller than 0.05 in magnitude, so each turn has one maximum, slightly after ``x - a = pi``.
    """
    k = min(max(k, LEAST_RATE), 1e99)  # beyond these limits the factor is constant
    a, size = math.atan2(1, k), math.hypot(1, k)
    first = GROWN / k - math.asin(math.exp(-GROWN) / size)
    turns = math.ceil((first - a - math.pi) / math.tau)
    middle, offset, previous = a + math.pi + turns * math.tau, 0.0, -1.0
    while abs(offset - previous) > SAME_ANGLE:  # each step reduces the error at least tenfold
        previous, offset = offset, math.asin(math.exp(-k * (middle + offset)) / size)
    return 1 + math.cos(a + offset)
