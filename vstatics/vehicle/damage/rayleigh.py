"""Life under narrow-band random stresses, whose amplitudes have a Rayleigh distribution.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), chapter 4.6; equation numbers are
from the book.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.answer import Sometimes, document
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.scatter import LifeSamples, drawn

LARGEST_LOG_OF_LIFE = 700.0
"""Largest natural logarithm of a result without floating-point overflow."""


@document("vstatics-rayleigh")
class RayleighLife(NamedTuple):
    """Life under stress amplitudes with a Rayleigh distribution."""

    integral: float
    """Integral int_x0^inf x^(m+1) exp(-x^2/2) dx. [-]

    m is the exponent of the S-N curve, and x0 = threshold*endurance/deviation.
    """
    life: float | None
    """Life in cycles, or in km if cycles per km are known; None if unlimited."""
    samples: Sometimes[LifeSamples] = None
    """Distribution of lives if strength or stress scatter. The other fields ignore the scatter."""


@refusing()
def rayleigh_life(fatigue: Fatigue, deviation: float, per_unit: float = 1.0) -> RayleighLife:
    """Return the life under a narrow-band random stress, by (4.40).

    Parameters
    ----------
    fatigue : Fatigue
    deviation : float
        Standard deviation of the stress. [Pa]
    per_unit : float
        Stress cycles per unit of life, such as a km or a second.

    Returns
    -------
    RayleighLife
        Integral [-], and life in cycles, or in the unit of `per_unit`.

    Raises
    ------
    ValueError
        If a result overflows.

    Examples
    --------
    The book prints 3.62 and 51 000 km; more digits are 3.6191919 and 51 167.55 km.

    >>> result = rayleigh_life(Fatigue(100e6, 3, 4e6), 60e6, per_unit=100)
    >>> round(result.integral, 6), round(result.life or 0.0)
    (3.619192, 51168)
    """
    ratio = fatigue.endurance / deviation
    if ratio in (0, math.inf):
        raise ValueError("the numbers are too large to give a life")
    integral, life = map(float, _logarithms(fatigue, np.asarray(ratio), per_unit))
    if math.isinf(integral):
        return RayleighLife(0.0, None)
    if max(integral, life) > LARGEST_LOG_OF_LIFE:
        raise ValueError("the numbers are too large to give a life")
    return RayleighLife(math.exp(integral), math.exp(life))


def _logarithms(fatigue: Fatigue, ratio: Floats, per_unit: float) -> tuple[Floats, Floats]:
    """Return the logarithms of integral and life at ratios of endurance to deviation."""
    from scipy.special import gammaincc, gammaln

    half = fatigue.exponent / 2
    with np.errstate(divide="ignore", over="ignore"):
        above = gammaincc(1 + half, (fatigue.threshold * ratio) ** 2 / 2)
        integral = half * math.log(2) + gammaln(1 + half) + np.log(above)
        life = fatigue.exponent * np.log(ratio) - integral
    life += math.log(fatigue.sum) + math.log(fatigue.cycles) - math.log(per_unit)
    return integral, life


def scattered_life(
    fatigue: Fatigue, deviation: float, per_unit: float, count: int, seed: int = 0
) -> RayleighLife:
    """Return the life, with the distribution of random samples of endurance and deviation.

    Parameters
    ----------
    fatigue : Fatigue
        Strength, whose endurance can be `Scattered`.
    deviation : float
        Standard deviation of the stress, which can be `Scattered`. [Pa]
    per_unit : float
        Stress cycles per unit of life.
    count, seed : int
        Number of samples, and seed of the random numbers.

    Examples
    --------
    Without a threshold, life is proportional to endurance to the power m, so it is lognormal, too:

    >>> from vstatics.vehicle.damage.scatter import Scattered
    >>> strength = Fatigue(Scattered(100e6, "lognormal", 0.08), 3, 4e6, threshold=0.0)
    >>> found = scattered_life(strength, 60e6, 100, 20000)
    >>> round(found.samples.B10 / found.life / math.exp(-1.2815516 * 3 * 0.08), 1)
    1.0
    """
    random = np.random.default_rng(seed)
    ratios = drawn(fatigue.endurance, count, random) / drawn(deviation, count, random)
    _, life = _logarithms(fatigue, ratios, per_unit)
    lives = np.exp(np.where(life > LARGEST_LOG_OF_LIFE, np.inf, life))
    return rayleigh_life(fatigue, deviation, per_unit)._replace(samples=LifeSamples.of(lives))


def torque_life(fatigue: Fatigue, deviation: float, crossings: float) -> float:
    """Return the life under a narrow-band random torque [s].

    Parameters
    ----------
    fatigue : Fatigue
    deviation : float
        Standard deviation of the torque. [N*m]
    crossings : float
        Rate of upward crossings of the mean. [1/s]

    Returns
    -------
    float
        Life [s]: infinite without damage, NaN if an argument is invalid or a result overflows.
    """
    if not (deviation > 0 and 0 < crossings < math.inf):
        return math.nan
    try:
        life = rayleigh_life(fatigue, deviation / fatigue.modulus, crossings).life
    except ValueError:
        return math.nan
    return math.inf if life is None else life
