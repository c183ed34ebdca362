"""Ratios of gears and how they change, from their formulas, on arrays of ratios of mechanisms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.synthesis.ratios.formula import GearFormula
from vstatics.synthesis.ratios.multilinear import Polynomial, bits

MOST_CORNERS = 2**16
"""So many corners of bounds are looked at: those of 16 ratios."""
PRODUCTS_AT_ONCE = 4_000_000
"""So many products are calculated together."""


class RatioArrays(NamedTuple):
    """The formulas of some gears as arrays.

    Examples
    --------
    >>> from fractions import Fraction
    >>> one = Fraction(1)
    >>> low = GearFormula("ratio", {0: one, 1: -one}, {0: one})
    >>> arrays = ratio_arrays([low], 1)
    >>> arrays.ratios(np.array([[-2.5], [-3.0]]))
    array([[3.5],
           [4. ]])
    >>> arrays.sensitivities(np.array([[-2.5]])).round(4)
    array([[[0.7143]]])
    """

    powers: Booleans
    """(products, mechanisms): which ratios a product has."""
    above: Floats
    """(products, gears)."""
    below: Floats

    def ratios(self, of_mechanisms: Floats) -> Floats:
        """The ratios of the gears.

        Parameters
        ----------
        of_mechanisms : ndarray, shape (variants, mechanisms)
            [-]

        Returns
        -------
        ndarray, shape (variants, gears)
            Not finite where the output stands. [-]
        """
        pieces = -(-len(of_mechanisms) * len(self.powers) // PRODUCTS_AT_ONCE)
        with np.errstate(all="ignore"):
            found = [
                (products @ self.above) / (products @ self.below)
                for products in map(self.products, np.array_split(of_mechanisms, max(pieces, 1)))
            ]
        return np.concatenate(found)

    def sensitivities(self, of_mechanisms: Floats) -> Floats:
        """Relative sensitivities ``(u/i) di/du`` of the gears.

        Parameters
        ----------
        of_mechanisms : ndarray, shape (variants, mechanisms)
            [-]

        Returns
        -------
        ndarray, shape (variants, gears, mechanisms)
            [-]
        """
        with np.errstate(all="ignore"):
            products = self.products(of_mechanisms)
            return self._part(products, self.above) - self._part(products, self.below)

    def products(self, of_mechanisms: Floats) -> Floats:
        """The products of ratios, (variants, products)."""
        found = np.ones((len(of_mechanisms), len(self.powers)))
        for has_it, ratios in zip(self.powers.T, of_mechanisms.T, strict=True):
            found *= np.where(has_it, ratios[:, np.newaxis], 1.0)
        return found

    def _part(self, products: Floats, factors: Floats) -> Floats:
        """``(u/p) dp/du`` of each polynomial p: its products with u by all of them."""
        count, mechanisms = self.powers.shape
        with_ratio = factors[:, :, np.newaxis] * self.powers[:, np.newaxis, :]
        parts = products @ with_ratio.reshape(count, -1)
        shaped = parts.reshape(len(products), factors.shape[1], mechanisms)
        return shaped / (products @ factors)[:, :, np.newaxis]


def ratio_arrays(formulas: Sequence[GearFormula], mechanisms: int) -> RatioArrays:
    """The formulas of some gears, which all have a ratio, as arrays."""
    places: dict[int, int] = {}
    for formula in formulas:
        for ratios in (*formula.above, *formula.below):
            places.setdefault(ratios, len(places))
    powers = np.zeros((len(places), mechanisms), np.bool_)
    for ratios, place in places.items():
        powers[place, bits(ratios)] = True
    above = _factors([formula.above for formula in formulas], places)
    return RatioArrays(powers, above, _factors([formula.below for formula in formulas], places))


def _factors(polynomials: Sequence[Polynomial], places: dict[int, int]) -> Floats:
    factors = np.zeros((len(places), len(polynomials)))
    for gear, polynomial in enumerate(polynomials):
        for ratios, coefficient in polynomial.items():
            factors[places[ratios], gear] = float(coefficient)
    return factors


def reach(formula: GearFormula, low: Floats, high: Floats) -> tuple[float, float] | None:
    """The least and the largest ratio of a gear while those of mechanisms are within bounds.

    Each polynomial is linear in each ratio, so it has its least and largest values at corners of
    the bounds. Where the lower one keeps its sign, the quotient grows or falls with each ratio all
    the way, and so has them there, too.

    Parameters
    ----------
    formula : GearFormula
    low, high : ndarray, shape (mechanisms,)
        Bounds of the ratios of mechanisms. [-]

    Returns
    -------
    tuple of float, optional
        None where the output may stand, so that the ratio has no bounds, or has too many corners.

    Examples
    --------
    >>> from fractions import Fraction
    >>> one = Fraction(1)
    >>> low = GearFormula("ratio", {0: one, 1: -one}, {0: one})
    >>> reach(low, np.array([-4.0]), np.array([-1.5]))
    (2.5, 5.0)
    """
    varied = [index for index in formula.ratios if low[index] < high[index]]
    if 2 ** len(varied) > MOST_CORNERS:
        return None
    with np.errstate(all="ignore"):
        above, below = (
            at_corners(factors(one, varied, low), low[varied], high[varied])
            for one in (formula.above, formula.below)
        )
        found = above / below
    if not np.isfinite(found).all() or not ((below > 0).all() or (below < 0).all()):
        return None
    return float(found.min()), float(found.max())


def factors(
    polynomial: Polynomial, varied: Sequence[int], given: Sequence[float] | Floats = ()
) -> Floats:
    """The factors of a polynomial, linear in each ratio, as `at_corners` takes them.

    Parameters
    ----------
    polynomial : mapping
    varied : sequence of int
        Indices of the ratios that stay; for others there is one in `given`.
    given : sequence of float
        By index. [-]

    Examples
    --------
    >>> from fractions import Fraction
    >>> factors({0: Fraction(1), 0b101: Fraction(-1)}, [0], [0.0, 0.0, 3.0])
    array([ 1., -3.])
    """
    places = {ratio: 1 << place for place, ratio in enumerate(varied)}
    found = np.zeros(2 ** len(varied))
    for ratios, coefficient in polynomial.items():
        indices = bits(ratios)
        fixed = [float(given[index]) for index in indices if index not in places]
        place = sum(places.get(index, 0) for index in indices)
        found[place] += float(coefficient) * math.prod(fixed)
    return found


def at_corners(factors: Floats, low: Floats, high: Floats) -> Floats:
    """Polynomials, linear in each ratio, at all corners of bounds.

    A ratio after the other is put in: the half without it, and the half with it at each bound.

    Parameters
    ----------
    factors : ndarray, shape (2**ratios,)
        By product; the bits of its place are the ratios in it.
    low, high : ndarray, shape (..., ratios)
        [-]

    Returns
    -------
    ndarray, shape (..., 2**ratios)

    Examples
    --------
    ``1 - u`` for u of -4 to -1.5:

    >>> at_corners(np.array([1.0, -1.0]), np.array([-4.0]), np.array([-1.5]))
    array([5. , 2.5])
    """
    outer = low.shape[:-1]
    found = np.broadcast_to(factors, (*outer, len(factors)))
    for place in range(low.shape[-1]):
        halves = found.reshape(*outer, len(factors) >> place + 1, 2, 1 << place)
        without, with_it = halves[..., 0, :], halves[..., 1, :]
        ends = (one[..., place, np.newaxis, np.newaxis] for one in (low, high))
        found = np.stack([without + end * with_it for end in ends], axis=-2)
        found = found.reshape(*outer, len(factors))
    return found
