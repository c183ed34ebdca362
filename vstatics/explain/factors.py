"""Factors of polynomials, each with the sign in which it looks best."""

from __future__ import annotations

from typing import Any, NamedTuple

Polynomial = Any
"""`sympy.polys.rings.PolyElement`, with whole coefficients."""

Powers = list[tuple[Polynomial, int]]
"""Factors, each with its power."""


class Factored(NamedTuple):
    """A polynomial: a whole number times powers of factors."""

    number: int
    factors: Powers


def factored(polynomial: Polynomial) -> Factored:
    """Factors with the sign in which they look best."""
    number, rest = polynomial.primitive()
    factors = []
    for factor, power in _factors(rest):
        if factor.is_ground:
            number *= factor.LC**power
            continue
        turned = _looks(-factor) > _looks(factor)
        factors.append((-factor if turned else factor, power))
        number = -number if turned and power % 2 else number
    return Factored(int(number), factors)


def _factors(polynomial: Polynomial) -> Powers:
    """Factors of a polynomial whose coefficients have none in common.

    Where a symbol occurs in the first power only, as ``a + b u``, the greatest common factor
    of a and b is one, and what is left can't be divided. SymPy's own way takes long where
    there are many symbols.
    """
    if polynomial.is_ground:
        return [(polynomial, 1)]
    powers = [max(one) for one in zip(*polynomial.monoms(), strict=True)]
    if 1 not in powers:
        constant, found = polynomial.factor_list()
        return [(polynomial.ring(constant), 1), *found]
    place = powers.index(1)
    ring = polynomial.ring
    symbol = ring.gens[place]
    with_it = ring({one: factor for one, factor in polynomial.terms() if one[place]})
    common = with_it.quo(symbol).gcd(polynomial - with_it)
    return [(polynomial.quo(common), 1), *_factors(common)]


def balance(polynomial: Polynomial) -> int:
    """Terms above 0 less those below 0."""
    return sum(1 if factor > 0 else -1 for _, factor in polynomial.terms())


def _looks(polynomial: Polynomial) -> tuple[int, bool, bool]:
    """How well it looks: more terms above 0; else the constant is above 0, else the first term."""
    return balance(polynomial), polynomial.coeff(1) > 0, polynomial.LC > 0
