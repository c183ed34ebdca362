"""Gear ratios and their sensitivities, from formulas, for arrays of mechanism ratios."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.synthesis.ratios.formula import GearFormula
from vstatics.synthesis.ratios.multilinear import Polynomial, bits

MOST_CORNERS = 2**16
"""Largest number of evaluated combinations of lower and upper bounds, reached by 16 ratios."""
PRODUCTS_AT_ONCE = 4_000_000
"""Number of products of ratios that are calculated together."""


class RatioArrays(NamedTuple):
    """Formulas of gear ratios as arrays of coefficients of products of mechanism ratios.

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
    """True for each mechanism ratio in a product, shape (products, mechanisms)."""
    above: Floats
    """Coefficients of the numerators, shape (products, gears). [-]"""
    below: Floats
    """Coefficients of the denominators, shape (products, gears). [-]"""

    def ratios(self, of_mechanisms: Floats) -> Floats:
        """Return the ratios of the gears, for arrays of mechanism ratios.

        Parameters
        ----------
        of_mechanisms : ndarray, shape (variants, mechanisms)
            Ratios of the mechanisms. [-]

        Returns
        -------
        ndarray, shape (variants, gears)
            Gear ratios; not finite where the output is at rest. [-]
        """
        pieces = -(-len(of_mechanisms) * len(self.powers) // PRODUCTS_AT_ONCE)
        with np.errstate(all="ignore"):
            quotients = [
                (products @ self.above) / (products @ self.below)
                for products in map(self.products, np.array_split(of_mechanisms, max(pieces, 1)))
            ]
        return np.concatenate(quotients)

    def sensitivities(self, of_mechanisms: Floats) -> Floats:
        """Return the relative sensitivities ``(u/i) di/du`` of gear ratios i to mechanism ratios u.

        Parameters
        ----------
        of_mechanisms : ndarray, shape (variants, mechanisms)
            Ratios of the mechanisms. [-]

        Returns
        -------
        ndarray, shape (variants, gears, mechanisms)
            Sensitivity of each gear ratio to each mechanism ratio. [-]
        """
        with np.errstate(all="ignore"):
            products = self.products(of_mechanisms)
            return self._part(products, self.above) - self._part(products, self.below)

    def products(self, of_mechanisms: Floats) -> Floats:
        """Return the products of mechanism ratios, shape (variants, products)."""
        results = np.ones((len(of_mechanisms), len(self.powers)))
        for has_it, ratios in zip(self.powers.T, of_mechanisms.T, strict=True):
            results *= np.where(has_it, ratios[:, np.newaxis], 1.0)
        return results

    def _part(self, products: Floats, factors: Floats) -> Floats:
        """Return ``(u/p) dp/du``: the fraction of p that comes from products with the ratio u.

        The fraction is calculated for each mechanism ratio u and each polynomial p, whose
        coefficients are a column of `factors`.
        """
        count, mechanisms = self.powers.shape
        with_ratio = factors[:, :, np.newaxis] * self.powers[:, np.newaxis, :]
        parts = products @ with_ratio.reshape(count, -1)
        shaped = parts.reshape(len(products), factors.shape[1], mechanisms)
        return shaped / (products @ factors)[:, :, np.newaxis]


def ratio_arrays(formulas: Sequence[GearFormula], mechanisms: int) -> RatioArrays:
    """Return the formulas of gears as arrays. Every gear must have a ratio."""
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
    """Return the smallest and largest ratio of a gear within bounds of the mechanism ratios.

    Numerator and denominator are linear in each mechanism ratio, so their extremes are at corners
    of the bounds. If the denominator does not change its sign, the quotient is monotonic in each
    ratio, so its extremes are also at corners.

    Parameters
    ----------
    formula : GearFormula
    low, high : ndarray, shape (mechanisms,)
        Bounds of the ratios of mechanisms. [-]

    Returns
    -------
    tuple of float, optional
        Both ends; None if the output can be at rest, so that the ratio is unbounded, or if there
        are too many corners. [-]

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
            at_corners(factors(polynomial, varied, low), low[varied], high[varied])
            for polynomial in (formula.above, formula.below)
        )
        quotients = above / below
    if not np.isfinite(quotients).all() or not ((below > 0).all() or (below < 0).all()):
        return None
    return float(quotients.min()), float(quotients.max())


def factors(
    polynomial: Polynomial, varied: Sequence[int], given: Sequence[float] | Floats = ()
) -> Floats:
    """Return the coefficients of a polynomial in the order that `at_corners` expects.

    Parameters
    ----------
    polynomial : mapping
    varied : sequence of int
        Indices of the mechanism ratios that remain variable.
    given : sequence of float
        Values of all mechanism ratios, from which the other ratios are taken. [-]

    Examples
    --------
    >>> from fractions import Fraction
    >>> factors({0: Fraction(1), 0b101: Fraction(-1)}, [0], [0.0, 0.0, 3.0])
    array([ 1., -3.])
    """
    places = {ratio: 1 << place for place, ratio in enumerate(varied)}
    coefficients = np.zeros(2 ** len(varied))
    for ratios, coefficient in polynomial.items():
        indices = bits(ratios)
        fixed = [float(given[index]) for index in indices if index not in places]
        place = sum(places.get(index, 0) for index in indices)
        coefficients[place] += float(coefficient) * math.prod(fixed)
    return coefficients


def at_corners(factors: Floats, low: Floats, high: Floats) -> Floats:
    """Evaluate polynomials, linear in each ratio, at all corners of bounds.

    The ratios are inserted one after the other. The coefficients of products that contain a ratio
    are multiplied by each of its bounds, and added to the coefficients of the products without it.

    Parameters
    ----------
    factors : ndarray, shape (2**ratios,)
        Coefficients; the bits of an index are the ratios in the product.
    low, high : ndarray, shape (..., ratios)
        Bounds of the ratios. [-]

    Returns
    -------
    ndarray, shape (..., 2**ratios)
        Values at the corners; the bits of an index select the bounds.

    Examples
    --------
    ``1 - u`` for u from -4 to -1.5:

    >>> at_corners(np.array([1.0, -1.0]), np.array([-4.0]), np.array([-1.5]))
    array([5. , 2.5])
    """
    outer = low.shape[:-1]
    values = np.broadcast_to(factors, (*outer, len(factors)))
    for place in range(low.shape[-1]):
        halves = values.reshape(*outer, len(factors) >> place + 1, 2, 1 << place)
        without, with_it = halves[..., 0, :], halves[..., 1, :]
        ends = (bound[..., place, np.newaxis, np.newaxis] for bound in (low, high))
        values = np.stack([without + end * with_it for end in ends], axis=-2)
        values = values.reshape(*outer, len(factors))
    return values
