"""Shaft with an equal fatigue life under other torques and numbers of cycles.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), (2.3) to (2.8).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.tables.answer import Sometimes, document

SHAFT_EXPONENT = 6.0
"""Exponent of the S-N curve of shafts, given in the source. [-]"""
LARGEST_LOG_OF_DIAMETER_RATIO = 150.0
"""Largest natural logarithm of a diameter ratio without overflow."""


@document("vstatics-resize")
class ResizedShaft(NamedTuple):
    """Shaft with the same fatigue life as a present shaft."""

    diameter: float
    """Diameter, in the unit of the present diameter."""
    compliance: float
    """Compliance, relative to the present shaft. [-]"""
    reduced_compliance: Sometimes[float]
    """Compliance reduced to the faster shaft of a reduction, relative to the present shaft. [-]"""


@refusing()
def resized(
    diameter: float, torque: float, repeats: float, exponent: float = SHAFT_EXPONENT
) -> ResizedShaft:
    """Return a shaft with the life of the present shaft, for other torques and numbers of cycles.

    The diameter is D (R N^(1/m))^(1/3), for the present diameter D, R times the torque, N times the
    cycles, and the exponent m.

    Parameters
    ----------
    diameter : float
        Present diameter, in any unit of length.
    torque, repeats : float
        Torque and number of cycles, relative to the present shaft. [-]
    exponent : float, optional
        Exponent m of the S-N curve. [-]

    Returns
    -------
    ResizedShaft
        Diameter in the same unit, and compliance relative to the present shaft [-].

    Raises
    ------
    ValueError
        If an argument is invalid, or the result overflows.

    Examples
    --------
    Eight times the torque for an equal number of cycles requires twice the diameter:

    >>> shaft = resized(42.0, torque=8.0, repeats=1.0)
    >>> round(shaft.diameter, 9), round(shaft.compliance, 9)
    (84.0, 0.0625)
    """
    for name, number in (("torque", torque), ("repeats", repeats)):
        if not number > 0:
            raise ValueError(f"{name} is {number:g}, expected a number above 0")
    factor = (math.log(torque) + math.log(repeats) / exponent) / 3
    if abs(factor) > LARGEST_LOG_OF_DIAMETER_RATIO:
        raise ValueError("the numbers are too large or too small to give a diameter")
    return ResizedShaft(diameter * math.exp(factor), math.exp(-4 * factor), None)


@refusing()
def resized_by_ratio(
    diameter: float, ratio: float, exponent: float = SHAFT_EXPONENT
) -> ResizedShaft:
    """Return a shaft of equal life behind a reduction, with more torque and fewer cycles.

    Parameters
    ----------
    diameter : float
        Present diameter, in any unit of length.
    ratio : float
        Ratio of the reduction, above 0. [-]
    exponent : float, optional
        Exponent m of the S-N curve. [-]

    Returns
    -------
    ResizedShaft
        Diameter in the same unit, and compliances relative to the present shaft [-].

    Raises
    ------
    ValueError
        If an argument is invalid, or the result overflows.

    Examples
    --------
    A half-shaft of 42 mm, ratio 2.9; the book prints 56.5 mm and 2.6.

    >>> shaft = resized_by_ratio(42.0, 2.9)
    >>> round(shaft.diameter, 3), round(shaft.reduced_compliance or 0.0, 4)
    (56.454, 2.5764)
    """
    shaft = resized(diameter, ratio, 1 / ratio, exponent)
    return shaft._replace(reduced_compliance=shaft.compliance * ratio**2)
