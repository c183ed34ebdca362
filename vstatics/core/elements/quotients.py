"""Quotients of numbers of teeth that keep the formula of their value."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

Formula = float | str | Sequence[Any]
"""Number, path of a number of the case, or operation on formulas, such as ``["/", a, b]``.

Operations are ``*`` with any number of factors, ``/`` and ``-`` with two operands, and ``mesh``,
the efficiency of a mesh with friction. The operands of ``mesh`` are the coefficient of friction,
the teeth of both gears, and 1 if the second gear is a ring.
"""


class Quotient:
    """Quotient of two products of numbers, as a value and as a formula.

    Parameters
    ----------
    value : Fraction
        Value of the quotient.
    powers : mapping of Formula to int
        Factors with their exponents. A factor is a whole number or another formula.

    Examples
    --------
    >>> sun, ring, planet = (Quotient.of(*one) for one in (("s", 30), ("r", 75), ("p", 20)))
    >>> -(planet / sun) / (planet / ring)
    Quotient(-5/2, ['/', ['*', -1, 'r'], 's'])
    """

    def __init__(self, value: Fraction, powers: Mapping[Any, int]) -> None:
        self.value = value
        self.powers = {factor: power for factor, power in powers.items() if power}

    @classmethod
    def of(cls, formula: Formula, value: float | Fraction) -> Quotient:
        """Return a quotient with the single factor `formula`, such as a tooth number or a path."""
        return cls(Fraction(value), {tuple(formula) if isinstance(formula, list) else formula: 1})

    def __repr__(self) -> str:
        return f"Quotient({self.value}, {self.formula})"

    def __eq__(self, other: object) -> bool:
        """Return whether the values are equal. The formulas can differ."""
        return self.value == (other.value if isinstance(other, Quotient) else other)

    def __hash__(self) -> int:
        return hash(self.value)

    def _by(self, other: Any, power: int) -> Quotient:
        if not isinstance(other, Quotient):  # a whole number
            other = Quotient.of(other, other)
        powers = Counter(self.powers)
        for factor, exponent in other.powers.items():
            powers[factor] += power * exponent
        return Quotient(self.value * other.value**power, powers)

    def __mul__(self, other: Any) -> Quotient:
        return self._by(other, 1)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Quotient:
        return self._by(other, -1)

    def __rtruediv__(self, other: Any) -> Quotient:
        return Quotient(Fraction(1), {})._by(other, 1)._by(self, -1)

    def __neg__(self) -> Quotient:
        return self._by(-1, 1)

    @property
    def formula(self) -> Formula:
        """Formula with a single division of two products, so that only the division is rounded."""
        above, below = (
            [f for f, power in self.powers.items() for _ in range(max(power * way, 0)) if f != 1]
            for way in (1, -1)
        )
        odd = (above + below).count(-1) % 2
        above, below = ([factor for factor in part if factor != -1] for part in (above, below))
        numerator = product([*[-1] * odd, *above])
        return ["/", numerator, product(below)] if below else numerator


def product(factors: Iterable[Any]) -> Formula:
    """Return the formula of a product of factors.

    >>> product([]), product(["a"]), product(["a", 2])
    (1, 'a', ['*', 'a', 2])
    """
    every = [list(factor) if isinstance(factor, tuple) else factor for factor in factors]
    return every[0] if len(every) == 1 else ["*", *every] if every else 1
