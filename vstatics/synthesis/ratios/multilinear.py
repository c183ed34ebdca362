"""Determinants as multilinear polynomials of mechanism ratios, each of which is in one row.

A polynomial maps the ratios in each product, as bits of an integer, to the coefficient. No ratio
has a higher power than 1, because it belongs to one mechanism, which gives one row.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from vstatics.core.errors import CaseError

Polynomial = Mapping[int, Fraction]
"""Coefficient of each product of ratios. Bits of the key are the indices of the ratios."""
Term = tuple[Fraction, Fraction]
"""Coefficient ``a + b u`` of an unknown in an equation, as the pair (a, b); u is a ratio."""

MOST_FORMULA_TERMS = 30_000
"""Largest number of products to add. The formula of a gearbox has a few dozen."""
PRIME = 2**61 - 1
"""Modulus of the test whether a polynomial is 0 for all ratios; the test fails with probability
1e-17.

The polynomial is evaluated for pseudo-random ratios.
"""


class LinearRow(NamedTuple):
    """Equation ``sum of terms = right`` of a mechanism, or of a component without a ratio."""

    ratio: int
    """Index of the mechanism whose ratio is in the equation; -1 without a ratio."""
    terms: Mapping[int, Term]
    """Coefficient of each unknown, by the index of the unknown."""
    right: Term


class SingularError(Exception):
    """Contradiction between equations."""


def determinant(rows: Sequence[LinearRow], unknowns: Sequence[int]) -> Polynomial:
    """Return the determinant of the columns of some unknowns; -1 selects the right sides.

    The determinant is expanded row by row, with a sum for each set of used unknowns.

    Raises
    ------
    CaseError
        If the polynomial has too many terms.

    Examples
    --------
    ``x - u y = 0`` and ``y = 2``:

    >>> zero, one = Fraction(0), Fraction(1)
    >>> rows = [LinearRow(0, {0: (one, zero), 1: (zero, -one)}, (zero, zero)),
    ...         LinearRow(-1, {1: (one, zero)}, (2 * one, zero))]
    >>> determinant(rows, [0, 1]), determinant(rows, [-1, 1])
    ({0: Fraction(1, 1)}, {1: Fraction(2, 1)})
    """
    minors = {0: {0: Fraction(1)}}
    work = 0
    for row in rows:
        after: dict[int, dict[int, Fraction]] = {}
        entries = [
            (place, row.right if unknown < 0 else row.terms[unknown])
            for place, unknown in enumerate(unknowns)
            if (any(row.right) if unknown < 0 else unknown in row.terms)
        ]
        for used, polynomial in minors.items():
            for place, (plain, with_ratio) in entries:
                if used >> place & 1:
                    continue
                sign = -1 if (used >> place).bit_count() % 2 else 1
                sums = after.setdefault(used | 1 << place, {})
                work += len(polynomial)
                for ratios, coefficient in polynomial.items():
                    if plain:
                        sums[ratios] = sums.get(ratios, 0) + sign * plain * coefficient
                    if with_ratio:
                        more = ratios | 1 << row.ratio
                        sums[more] = sums.get(more, 0) + sign * with_ratio * coefficient
        nonzero = (
            (used, {ratios: value for ratios, value in sums.items() if value})
            for used, sums in after.items()
        )
        minors = {used: sums for used, sums in nonzero if sums}
        if work > MOST_FORMULA_TERMS:
            raise CaseError(
                "E818",
                f"the formula of its ratio has more than {MOST_FORMULA_TERMS} terms"
                "; give more ratios as numbers",
            )
    return minors.get((1 << len(unknowns)) - 1, {})


class Independent(NamedTuple):
    """Independent rows, and the unknowns that the rows determine."""

    rows: list[LinearRow]
    unknowns: list[int]
    needed: Mapping[int, list[LinearRow]]
    """Rows that determine each unknown that has a unique value."""


def independent(rows: Sequence[LinearRow]) -> Independent:
    """Select rows that are independent for arbitrary ratios.

    Raises
    ------
    SingularError
        If the rows contradict each other.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> row = LinearRow(0, {0: (one, zero), 1: (zero, -one)}, (zero, zero))
    >>> found = independent([row, row])
    >>> len(found.rows), found.unknowns, found.needed
    (1, [0], {})
    """
    # Each reduced row is stored under the unknown that it determines.
    reduced: dict[int, dict[int, int]] = {}
    selected: list[LinearRow] = []
    for row in rows:
        ratio = ratio_number(row.ratio)
        residues = {
            unknown: (_residue(plain) + _residue(with_ratio) * ratio) % PRIME
            for unknown, (plain, with_ratio) in (*row.terms.items(), (_RIGHT, row.right))
        }
        numbers = {unknown: number for unknown, number in residues.items() if number}
        numbers[_name(len(selected))] = 1
        for unknown, other in reduced.items():
            _take(numbers, other, unknown)
        pivot = next((unknown for unknown in numbers if unknown >= 0), None)
        if pivot is None:
            if _RIGHT in numbers:
                raise SingularError
            continue
        inverse = pow(numbers[pivot], -1, PRIME)
        numbers = {unknown: entry * inverse % PRIME for unknown, entry in numbers.items()}
        for other in reduced.values():
            _take(other, numbers, pivot)
        reduced[pivot] = numbers
        selected.append(row)
    needed = {
        unknown: [row for number, row in enumerate(selected) if _name(number) in numbers]
        for unknown, numbers in reduced.items()
        if not any(other >= 0 for other in numbers if other != unknown)
    }
    return Independent(selected, list(reduced), needed)


_RIGHT = -1
"""Key of the right side among the unknowns of a row."""


def _name(number: int) -> int:
    """Return the key under which a reduced row stores the factor of an original row."""
    return _RIGHT - 1 - number


def _residue(number: Fraction) -> int:
    return number.numerator * pow(number.denominator, -1, PRIME) % PRIME


def _take(row: dict[int, int], other: Mapping[int, int], unknown: int) -> None:
    """Subtract a multiple of a normalised row in place, to eliminate an unknown."""
    factor = row.get(unknown, 0)
    if factor:
        for key, number in other.items():
            left = (row.get(key, 0) - factor * number) % PRIME
            if left:
                row[key] = left
            else:
                row.pop(key, None)


@cache
def ratio_number(index: int, trial: int = 0) -> int:
    """Return a pseudo-random residue that represents a ratio, equal in every run."""
    return random.Random(f"{index} {trial}").randrange(2, PRIME)  # noqa: S311 - not a secret


def without_common(
    above: Polynomial, below: Polynomial, ratios: Sequence[int]
) -> tuple[Polynomial, Polynomial]:
    """Remove the ratios on which a quotient of polynomials does not depend.

    >>> above, below = {0: Fraction(2), 1: Fraction(-2)}, {0: Fraction(1), 1: Fraction(-1)}
    >>> without_common(above, below, [0])
    ({0: Fraction(2, 1)}, {0: Fraction(1, 1)})
    """
    for ratio in ratios:
        (plain, more), (plain_below, more_below) = split(above, ratio), split(below, ratio)
        if not more and not more_below:
            continue
        crossed = [
            value(more, trial) * value(plain_below, trial)
            - value(plain, trial) * value(more_below, trial)
            for trial in (0, 1)
        ]
        if not any(difference % PRIME for difference in crossed):
            above, below = (plain, plain_below) if plain_below else (more, more_below)
    return above, below


def split(polynomial: Polynomial, ratio: int) -> tuple[Polynomial, Polynomial]:
    """Split a polynomial into the part without a ratio, and the factor of the ratio."""
    bit = 1 << ratio
    plain = {ratios: factor for ratios, factor in polynomial.items() if not ratios & bit}
    return plain, {ratios ^ bit: factor for ratios, factor in polynomial.items() if ratios & bit}


def value(polynomial: Polynomial, trial: int) -> int:
    """Evaluate a polynomial modulo `PRIME` with the pseudo-random ratios of a trial."""
    total = 0
    for ratios, coefficient in polynomial.items():
        product = _residue(coefficient)
        for ratio in bits(ratios):
            product = product * ratio_number(ratio, trial) % PRIME
        total += product
    return total % PRIME


def bits(ratios: int) -> list[int]:
    """Return the indices of the set bits of an integer.

    >>> bits(0b1010)
    [1, 3]
    """
    return [index for index in range(ratios.bit_length()) if ratios >> index & 1]
