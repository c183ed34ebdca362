"""Spectra of what excites, two-sided over omega: the variance is ``2 int_0^inf S d omega``.

Source: Tsitovich, Algin, Vehicle dynamics, 1981, (4.19) to (4.22), repaired: of the correlation
``s^2 exp(-a |t|) cos(b t)`` it is ``s^2 a/pi (w^2 + a^2 + b^2)/((w^2 - a^2 - b^2)^2 + 4 a^2 w^2)``.
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
    """The same at all frequencies.

    Examples
    --------
    >>> White(0.5).at(np.array([1.0, 100.0]))
    array([0.5, 0.5])
    """

    white: float
    """[unit^2 s/rad]"""

    def at(self, omegas: Floats) -> Floats:
        """Its values."""
        return np.full(np.shape(omegas), self.white)

    def problems(self) -> Iterator[Problem]:
        """What is wrong with it."""
        if not 0 <= self.white < math.inf:
            yield Problem(
                "E527", f"read {self.white:g}, expected a spectrum of 0 or more", ("white",)
            )


class Correlation(NamedTuple):
    """A variance that is correlated over time: ``variance sum share exp(-a |t|) cos(b t)``.

    Examples
    --------
    A road that is driven over at 10 m/s:

    >>> Correlation(2.0, ((1.0, 0.3, 0.8),), speed=10.0).parts
    [(2.0, 3.0, 8.0)]
    """

    variance: float
    """[unit^2]"""
    correlation: tuple[tuple[float, float, float], ...]
    """Share [-], a and b [1/s], or, with a speed, [1/m]."""
    speed: float | None = None
    """At which it is driven over. [m/s]"""

    @property
    def parts(self) -> list[tuple[float, float, float]]:
        """Variance, a and b of each part, over time."""
        pace = 1.0 if self.speed is None else self.speed
        return [(self.variance * one, a * pace, b * pace) for one, a, b in self.correlation]

    def at(self, omegas: Floats) -> Floats:
        """Its values.

        Examples
        --------
        >>> road = Correlation(1e-4, ((1.0, 0.3, 0.8),), 10.0)
        >>> road.at(np.array([5.0])).round(13)
        array([2.9208211e-06])
        """
        squares, total = np.square(omegas), np.zeros(np.shape(omegas))
        for variance, a, b in self.parts:
            whole = a**2 + b**2
            bottom = (squares - whole) ** 2 + 4 * a**2 * squares
            total += variance * a / math.pi * (squares + whole) / bottom
        return total

    def problems(self) -> Iterator[Problem]:
        """What is wrong with it."""
        if not 0 <= self.variance < math.inf:
            message = f"read {self.variance:g}, expected a variance of 0 or more"
            yield Problem("E528", message, ("variance",))
        if self.speed is not None and not 0 < self.speed < math.inf:
            yield Problem("E529", f"read {self.speed:g}, expected a speed above 0", ("speed",))
        for number, (share, a, b) in enumerate(self.correlation, 1):
            for place, right, what in (
                (1, 0 <= share < math.inf, "a share of 0 or more"),
                (2, 0 < a < math.inf, "an alpha above 0"),
                (3, math.isfinite(b), "a finite beta"),
            ):
                if not right:
                    read = (share, a, b)[place - 1]
                    path = ("correlation", number, place)
                    yield Problem("E530", f"read {read:g}, expected {what}", path)
        shares = sum(share for share, _, _ in self.correlation)
        if not abs(shares - 1) <= WHOLE:
            message = f"the shares add up to {shares:g}, expected 1"
            yield Problem("E531", message, ("correlation",))


class SpectrumPoints(NamedTuple):
    """Straight between points, 0 outside.

    Examples
    --------
    >>> SpectrumPoints(((10.0, 1.0), (20.0, 3.0))).at(np.array([15.0, 25.0]))
    array([2., 0.])
    """

    points: tuple[tuple[float, float], ...]
    """Omega [rad/s], value [unit^2 s/rad]."""

    def at(self, omegas: Floats) -> Floats:
        """Its values."""
        corners, values = np.transpose(self.points)
        found: Floats = np.interp(np.abs(omegas), corners, values, left=0.0, right=0.0)
        return np.asarray(found)

    @property
    def bands(self) -> list[tuple[float, float]]:
        """Between which frequencies it is not 0 [rad/s]."""
        return [(a, b) for (a, one), (b, other) in pairwise(self.points) if one or other]

    def problems(self) -> Iterator[Problem]:
        """What is wrong with them."""
        if len(self.points) < 2:
            yield Problem("E532", "expected two points at least", ("points",))
        before = -math.inf
        for number, (omega, value) in enumerate(self.points, 1):
            if not (max(before, 0.0) <= omega < math.inf and omega > before):
                expected = "an omega of 0 or more" if before < 0 else f"an omega above {before:g}"
                message = f"read {omega:g}, expected {expected}"
                yield Problem("E533", message, ("points", number, 1))
            if not 0 <= value < math.inf:
                message = f"read {value:g}, expected a spectrum of 0 or more at a point"
                yield Problem("E534", message, ("points", number, 2))
            before = omega


Spectrum = White | Correlation | SpectrumPoints
