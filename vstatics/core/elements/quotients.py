"""Numbers of teeth that keep where they come from, and quotients of products of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

Formula = float | str | Sequence[Any]
"""A number, the path of one that the case gives, or an operation with formulas: ``["/", a, b]``.

Operations are ``*`` of any number of factors, ``/`` and ``-`` of two, and ``mesh``: the efficiency
that friction leaves, of its coefficient, teeth, other teeth, and 1 if those are a ring's."""


class Quotient:
    """A product of numbers by a product of others, with its value.

    Parameters
    ----------
    value : Fraction
    powers : mapping of Formula to int
        Factors with their exponents; a whole number among them is itself.

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
        """A number of teeth, or another formula."""
        return cls(Fraction(value), {tuple(formula) if isinstance(formula, list) else formula: 1})

    def __repr__(self) -> str:
        return f"Quotient({self.value}, {self.formula})"

    def __eq__(self, other: object) -> bool:
        """Whether the values are the same."""
        return self.value == (other.value if isinstance(other, Quotient) else other)

    def __hash__(self) -> int:
        return hash(self.value)

    def _by(self, other: Any, power: int) -> Quotient:
        if not isinstance(other, Quotient):  # a whole number
            other = Quotient.of(other, other)
        powers = Counter(self.powers)
        for factor, own in other.powers.items():
            powers[factor] += power * own
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
        """A whole number by another one, which rounds once."""
        above, below = (
            [f for f, power in self.powers.items() for _ in range(max(power * way, 0)) if f != 1]
            for way in (1, -1)
        )
        odd = (above + below).count(-1) % 2
        above, below = ([one for one in part if one != -1] for part in (above, below))
        numerator = product([*[-1] * odd, *above])
        return ["/", numerator, product(below)] if below else numerator


def product(factors: Iterable[Any]) -> Formula:
    """The product of formulas.

    >>> product([]), product(["a"]), product(["a", 2])
    (1, 'a', ['*', 'a', 2])
    """
    every = [list(one) if isinstance(one, tuple) else one for one in factors]
    return every[0] if len(every) == 1 else ["*", *every] if every else 1
