"""Torques over a stretch of time as polynomials, by what they are at its instants."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from vstatics.numerics.arrays import Floats

DEGREE = 10
"""Of the polynomials."""
_GAUSS = 8
_POINTS, WEIGHTS = np.polynomial.legendre.leggauss(_GAUSS)
NODES: Floats = np.append(0.5 + 0.5 * np.asarray(_POINTS, float), 1.0)
"""Gauss points of a part of a stretch and its end, by its length."""


@lru_cache(maxsize=16)
def fitting(count: int) -> tuple[Floats, Floats, Floats]:
    """For so many parts: values at all instants -> series -> powers; and series -> values.

    Returns
    -------
    to_series : ndarray, shape (instants, DEGREE + 1)
    to_powers : ndarray, shape (DEGREE + 1, DEGREE + 1)
        Of the time by the length of a part; each divided by its factorial.
    to_values : ndarray, shape (DEGREE + 1, instants)
    """
    places = ((np.arange(count)[:, None] + NODES) / count).reshape(-1)
    degree = min(DEGREE, len(places) - 3)
    values = np.asarray(np.polynomial.chebyshev.chebvander(2 * places - 1, degree), float)
    to_series = np.zeros((len(places), DEGREE + 1))
    to_series[:, : degree + 1] = np.linalg.pinv(values).T
    to_values = np.zeros((DEGREE + 1, len(places)))
    to_values[: degree + 1] = values.T
    return to_series, _powers() / _scales(count), to_values


@lru_cache(maxsize=1)
def _powers() -> Floats:
    """Series over 0 to 1 -> powers."""
    powers = np.zeros((DEGREE + 1, DEGREE + 1))
    for number in range(DEGREE + 1):
        series = np.polynomial.Chebyshev.basis(number, domain=[0.0, 1.0])
        powers[number, : number + 1] = series.convert(kind=np.polynomial.Polynomial).coef
    return powers


def _scales(count: int) -> Floats:
    """By which powers are divided: those of derivatives at the start are wanted."""
    orders = np.arange(1, DEGREE + 1)
    return np.append(1.0, np.cumprod(count / orders))
