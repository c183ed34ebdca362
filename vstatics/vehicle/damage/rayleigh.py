"""Life under random stresses of one frequency, whose amplitudes have Rayleigh's distribution.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), chapter 4.6; numbers of equations
are those of the book.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.tables.answer import document
from vstatics.vehicle.case.fatigue import Fatigue

LARGEST_LOGARITHM = 700.0
"""Of a number."""


@document("vstatics-rayleigh")
class RayleighLife(NamedTuple):
    """What is borne of amplitudes that have Rayleigh's distribution."""

    integral: float
    """int_x0^inf x^(m+1) exp(-x^2/2) dx of the exponent m. [-]"""
    life: float | None
    """In cycles, or km where their number a km is given; None: for ever."""


@refusing()
def rayleigh_life(fatigue: Fatigue, deviation: float, per_unit: float = 1.0) -> RayleighLife:
    """The life under a stress of a narrow band of frequencies, by (4.40).

    Parameters
    ----------
    fatigue : Fatigue
    deviation : float
        Standard deviation of the stress. [Pa]
    per_unit : float
        Cycles in a unit of life: of a km, of a second.

    Returns
    -------
    RayleighLife
        Its integral [-], and the life in cycles, or in what `per_unit` is of.

    Raises
    ------
    ValueError
        If a number would be too large.

    Examples
    --------
    The book prints 3.62 and 51 000 km; all digits are 3.6191919 and 51 167.55 km.

    >>> made = rayleigh_life(Fatigue(100e6, 3, 4e6), 60e6, per_unit=100)
    >>> round(made.integral, 6), round(made.life or 0.0)
    (3.619192, 51168)
    """
    from scipy.special import gammaincc, gammaln

    half, ratio = fatigue.exponent / 2, fatigue.endurance / deviation
    if math.isinf(ratio):
        raise ValueError("numbers so large give no life")
    least = fatigue.threshold * ratio
    above = float(gammaincc(1 + half, least * least / 2))
    if not above:
        return RayleighLife(0.0, None)
    logarithm = half * math.log(2) + float(gammaln(1 + half)) + math.log(above)
    life = fatigue.exponent * math.log(ratio) - logarithm
    life += math.log(fatigue.sum) + math.log(fatigue.cycles) - math.log(per_unit)
    if max(logarithm, life) > LARGEST_LOGARITHM:
        raise ValueError("numbers so large give no life")
    return RayleighLife(math.exp(logarithm), math.exp(life))


def torque_life(fatigue: Fatigue, deviation: float, crossings: float) -> float:
    """Return the life under a random torque of a narrow band [s].

    Parameters
    ----------
    fatigue : Fatigue
    deviation : float
        Standard deviation of the torque. [N*m]
    crossings : float
        Upward crossings of the mean. [1/s]

    Returns
    -------
    float
        Infinite if there is no damage; NaN if the numbers give no life.
    """
    if not (deviation > 0 and 0 < crossings < math.inf):
        return math.nan
    try:
        life = rayleigh_life(fatigue, deviation / fatigue.modulus, crossings).life
    except ValueError:
        return math.nan
    return math.inf if life is None else life
