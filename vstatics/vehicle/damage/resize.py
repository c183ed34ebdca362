"""A shaft of equal fatigue strength under other torques and other numbers of cycles.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), (2.3) to (2.8).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.tables.answer import Sometimes, document

EXPONENT = 6.0
"""Of shafts, in the book."""
LARGEST_LOGARITHM = 150.0
"""By which a diameter may change."""


@document("vstatics-resize")
class ResizedShaft(NamedTuple):
    """A shaft of equal life."""

    diameter: float
    """In the unit of the one before."""
    compliance: float
    """By the one before. [-]"""
    reduced_compliance: Sometimes[float]
    """The same reduced to the faster shaft, where the torque is by a ratio. [-]"""


@refusing()
def resized(
    diameter: float, torque: float, repeats: float, exponent: float = EXPONENT
) -> ResizedShaft:
    """The diameter with which a shaft is borne as long: D (R N^(1/m))^(1/3).

    Parameters
    ----------
    diameter : float
        Before, in any unit of length.
    torque, repeats : float
        By those before. [-]
    exponent : float, optional
        Of the line of fatigue. [-]

    Returns
    -------
    ResizedShaft
        Its diameter in that unit, its compliance by the one before [-].

    Raises
    ------
    ValueError
        If there would be no such number.

    Examples
    --------
    Eight times the torque, as often, is borne by twice the diameter:

    >>> made = resized(42.0, torque=8.0, repeats=1.0)
    >>> round(made.diameter, 9), round(made.compliance, 9)
    (84.0, 0.0625)
    """
    for name, number in (("torque", torque), ("repeats", repeats)):
        if not number > 0:
            raise ValueError(f"{name} is {number:g}, expected a number above 0")
    factor = (math.log(torque) + math.log(repeats) / exponent) / 3
    if abs(factor) > LARGEST_LOGARITHM:
        raise ValueError("numbers so large or so small give no diameter")
    return ResizedShaft(diameter * math.exp(factor), math.exp(-4 * factor), None)


@refusing()
def resized_by_ratio(diameter: float, ratio: float, exponent: float = EXPONENT) -> ResizedShaft:
    """The same behind a reduction: torques by the ratio, so many times fewer cycles.

    Parameters
    ----------
    diameter : float
        Before, in any unit of length.
    ratio : float
        Of the reduction, above 0. [-]
    exponent : float, optional
        Of the line of fatigue. [-]

    Returns
    -------
    ResizedShaft
        Its diameter in that unit; compliances by the one before [-].

    Raises
    ------
    ValueError
        If there would be no such number.

    Examples
    --------
    A half-shaft of 42 mm, ratio 2.9; the book prints 56.5 mm and 2.6.

    >>> made = resized_by_ratio(42.0, 2.9)
    >>> round(made.diameter, 3), round(made.reduced_compliance or 0.0, 4)
    (56.454, 2.5764)
    """
    made = resized(diameter, ratio, 1 / ratio, exponent)
    return made._replace(reduced_compliance=made.compliance * ratio**2)
