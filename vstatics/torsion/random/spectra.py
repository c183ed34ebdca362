"""Two-sided spectra of random inputs, with the variance ``2 int_0^inf S d omega``.

The spectrum of the correlation function ``s^2 exp(-a |t|) cos(b t)`` is ``s^2 a/pi (w^2 + a^2 +
b^2)/((w^2 - a^2 - b^2)^2 + 4 a^2 w^2)`` (Tsitovich, Algin, Vehicle dynamics, 1981, (4.19) to
(4.22), corrected). `unit` stands for N*m or rad, the unit of the input.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.tolerances import WHOLE


class White(NamedTuple):
    """White noise, with a constant spectrum at all frequencies.

    Examples
    --------
    >>> White(0.5).at(np.array([1.0, 100.0]))
    array([0.5, 0.5])
    """

    white: float
    """Value of the spectrum. [unit^2 s/rad]"""

    def at(self, omegas: Floats) -> Floats:
        """Return the spectrum at frequencies [rad/s]."""
        return np.full(np.shape(omegas), self.white)

    def problems(self) -> Iterator[Problem]:
        """Yield a problem if the spectrum is negative or not finite."""
        if not 0 <= self.white < math.inf:
            yield Problem(
                "E527", f"read {self.white:g}, expected a spectrum of 0 or more", ("white",)
            )


class Correlation(NamedTuple):
    """Random input with the correlation ``variance * sum(share * exp(-a |t|) * cos(b t))``.

    Examples
    --------
    Road profile at 10 m/s:

    >>> Correlation(2.0, ((1.0, 0.3, 0.8),), speed=10.0).parts
    [(2.0, 3.0, 8.0)]
    """

    variance: float
    """Variance of the input. [unit^2]"""
    correlation: tuple[tuple[float, float, float], ...]
    """Share [-], a and b [1/s, or 1/m with a speed] of each term."""
    speed: float | None = None
    """Vehicle speed over a road, for a correlation over distance. [m/s]"""

    @property
    def parts(self) -> list[tuple[float, float, float]]:
        """Variance [unit^2], a [1/s] and b [1/s] of each term ``exp(-a |t|) cos(b t)``."""
        speed = 1.0 if self.speed is None else self.speed
        return [(self.variance * share, a * speed, b * speed) for share, a, b in self.correlation]

    def at(self, omegas: Floats) -> Floats:
        """Return the spectrum at frequencies [rad/s].

        Examples
        --------
        >>> road = Correlation(1e-4, ((1.0, 0.3, 0.8),), 10.0)
        >>> road.at(np.array([5.0])).round(13)
        array([2.9208211e-06])
        """
        squares, total = np.square(omegas), np.zeros(np.shape(omegas))
        for variance, a, b in self.parts:
            modulus = a**2 + b**2
            denominator = (squares - modulus) ** 2 + 4 * a**2 * squares
            total += variance * a / math.pi * (squares + modulus) / denominator
        return total

    def problems(self) -> Iterator[Problem]:
        """Yield a problem for each number out of range."""
        if not 0 <= self.variance < math.inf:
            yield Problem(
                "E528", f"read {self.variance:g}, expected a variance of 0 or more", ("variance",)
            )
        if self.speed is not None and not 0 < self.speed < math.inf:
            yield Problem("E529", f"read {self.speed:g}, expected a speed above 0", ("speed",))
        for number, (share, a, b) in enumerate(self.correlation, 1):
            for place, is_valid, expected in (
                (1, 0 <= share < math.inf, "a share of 0 or more"),
                (2, 0 < a < math.inf, "an alpha above 0"),
                (3, math.isfinite(b), "a finite beta"),
            ):
                if not is_valid:
                    read = (share, a, b)[place - 1]
                    yield Problem(
                        "E530",
                        f"read {read:g}, expected {expected}",
                        ("correlation", number, place),
                    )
        shares = sum(share for share, _, _ in self.correlation)
        if not abs(shares - 1) <= WHOLE:
            yield Problem("E531", f"the shares add up to {shares:g}, expected 1", ("correlation",))


class SpectrumPoints(NamedTuple):
    """Spectrum interpolated linearly between points, and 0 outside.

    Examples
    --------
    >>> SpectrumPoints(((10.0, 1.0), (20.0, 3.0))).at(np.array([5.0, 15.0, 25.0]))
    array([0., 2., 0.])
    """

    points: tuple[tuple[float, float], ...]
    """Frequency [rad/s] and spectrum [unit^2 s/rad] of each point."""

    def at(self, omegas: Floats) -> Floats:
        """Return the spectrum at frequencies [rad/s]."""
        corners, values = np.transpose(self.points)
        spectrum = np.interp(np.abs(omegas), corners, values, left=0.0, right=0.0)
        return np.asarray(spectrum)

    @property
    def bands(self) -> list[tuple[float, float]]:
        """Frequency intervals in which the spectrum is not 0 [rad/s]."""
        return [(a, b) for (a, at_a), (b, at_b) in pairwise(self.points) if at_a or at_b]

    def problems(self) -> Iterator[Problem]:
        """Yield the problems of invalid points."""
        if len(self.points) < 2:
            yield Problem("E532", "expected at least two points", ("points",))
        previous = -math.inf
        for number, (omega, value) in enumerate(self.points, 1):
            if not (max(previous, 0.0) <= omega < math.inf and omega > previous):
                expected = (
                    "an omega of 0 or more" if previous < 0 else f"an omega above {previous:g}"
                )
                yield Problem("E533", f"read {omega:g}, expected {expected}", ("points", number, 1))
            if not 0 <= value < math.inf:
                yield Problem(
                    "E534",
                    f"read {value:g}, expected a spectrum of 0 or more at a point",
                    ("points", number, 2),
                )
            previous = omega


Spectrum = White | Correlation | SpectrumPoints
