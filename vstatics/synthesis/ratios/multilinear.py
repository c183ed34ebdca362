"""Determinants of equations in which every ratio stands in one row: multilinear polynomials.

A polynomial is a mapping: the set of its ratios, as bits of a number, to the coefficient. Each
ratio occurs in it at most to the first power, as each belongs to one mechanism, which is one row.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from vstatics.core.errors import CaseError

Polynomial = Mapping[int, Fraction]
"""Bits of ratios -> coefficient."""
Term = tuple[Fraction, Fraction]
"""A coefficient without the ratio of its row, and one with it."""

MOST_TERMS = 30_000
"""So many products may be added up; the formula of a gearbox has some dozens."""
PRIME = 2**61 - 1
"""Modulus in which it is asked whether anything is 0 whatever the ratios are: it is taken for 0
by chance once in 1e17 times."""


class LinearRow(NamedTuple):
    """The equation ``sum of terms = right`` of a mechanism, or of anything without a ratio."""

    ratio: int
    """Index of its ratio; -1 without."""
    terms: Mapping[int, Term]
    """By unknown."""
    right: Term


class SingularError(Exception):
    """The rows contradict each other."""


def determinant(rows: Sequence[LinearRow], unknowns: Sequence[int]) -> Polynomial:
    """The determinant of as many rows as unknowns; unknown -1 stands for the right sides.

    Row by row, with all sets of unknowns that the rows before may have used.

    Raises
    ------
    CaseError
        If it has too many terms.

    Examples
    --------
    ``x - u y = 0`` and ``y = 2``:

    >>> zero, one = Fraction(0), Fraction(1)
    >>> rows = [LinearRow(0, {0: (one, zero), 1: (zero, -one)}, (zero, zero)),
    ...         LinearRow(-1, {1: (one, zero)}, (2 * one, zero))]
    >>> determinant(rows, [0, 1]), determinant(rows, [-1, 1])
    ({0: Fraction(1, 1)}, {1: Fraction(2, 1)})
    """
    found: dict[int, dict[int, Fraction]] = {0: {0: Fraction(1)}}
    work = 0
    for row in rows:
        after: dict[int, dict[int, Fraction]] = {}
        entries = [
            (place, row.right if unknown < 0 else row.terms[unknown])
            for place, unknown in enumerate(unknowns)
            if (any(row.right) if unknown < 0 else unknown in row.terms)
        ]
        for used, polynomial in found.items():
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
        kept = (
            (used, {ratios: one for ratios, one in sums.items() if one})
            for used, sums in after.items()
        )
        found = {used: sums for used, sums in kept if sums}
        if work > MOST_TERMS:
            message = f"the formula of its ratio has more than {MOST_TERMS} terms"
            raise CaseError("E818", f"{message}; expected more ratios that are given")
    return found.get((1 << len(unknowns)) - 1, {})


class Independent(NamedTuple):
    """Rows that do not imply one another, and unknowns for which they can be solved."""

    rows: list[LinearRow]
    unknowns: list[int]
    needed: Mapping[int, list[LinearRow]]
    """Unknowns that have a value, whatever the others have: the rows that it follows from."""


def independent(rows: Sequence[LinearRow]) -> Independent:
    """Rows that do not imply one another, for ratios of which nothing is known.

    Raises
    ------
    SingularError
        If they contradict each other.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> row = LinearRow(0, {0: (one, zero), 1: (zero, -one)}, (zero, zero))
    >>> found = independent([row, row])
    >>> len(found.rows), found.unknowns, found.needed
    (1, [0], {})
    """
    reduced: dict[int, dict[int, int]] = {}  # by unknown: the row that is solved for it
    kept: list[LinearRow] = []
    for row in rows:
        numbers = _modular(row)
        numbers[_name(len(kept))] = 1
        for unknown, other in reduced.items():
            _take(numbers, other, unknown)
        pivot = next((unknown for unknown in numbers if unknown >= 0), None)
        if pivot is None:
            if _RIGHT in numbers:
                raise SingularError
            continue
        inverse = pow(numbers[pivot], -1, PRIME)
        numbers = {unknown: one * inverse % PRIME for unknown, one in numbers.items()}
        for other in reduced.values():
            _take(other, numbers, pivot)
        reduced[pivot] = numbers
        kept.append(row)
    needed = {
        unknown: [row for number, row in enumerate(kept) if _name(number) in numbers]
        for unknown, numbers in reduced.items()
        if not any(other >= 0 for other in numbers if other != unknown)
    }
    return Independent(kept, list(reduced), needed)


_RIGHT = -1
"""Stands for the right sides among unknowns."""


def _name(number: int) -> int:
    """What stands for a row itself, to see of which rows another is made."""
    return _RIGHT - 1 - number


def _modular(row: LinearRow) -> dict[int, int]:
    """A row with a number for its ratio that nobody has chosen."""
    ratio = ratio_number(row.ratio)
    numbers = {
        unknown: (_residue(plain) + _residue(with_ratio) * ratio) % PRIME
        for unknown, (plain, with_ratio) in (*row.terms.items(), (_RIGHT, row.right))
    }
    return {unknown: number for unknown, number in numbers.items() if number}


def _residue(number: Fraction) -> int:
    return number.numerator * pow(number.denominator, -1, PRIME) % PRIME


def _take(row: dict[int, int], other: Mapping[int, int], unknown: int) -> None:
    """Subtract so much of another row, which has 1 there, that an unknown goes; in place."""
    factor = row.get(unknown, 0)
    if factor:
        for one, number in other.items():
            left = (row.get(one, 0) - factor * number) % PRIME
            if left:
                row[one] = left
            else:
                row.pop(one, None)


@cache
def ratio_number(index: int, trial: int = 0) -> int:
    """A residue for the ratio of an index, the same in every run."""
    return random.Random(f"{index} {trial}").randrange(2, PRIME)  # noqa: S311 - no secret


def without_common(
    above: Polynomial, below: Polynomial, ratios: Sequence[int]
) -> tuple[Polynomial, Polynomial]:
    """A quotient of polynomials without the ratios that it does not depend on.

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
        if not any(one % PRIME for one in crossed):
            above, below = (plain, plain_below) if plain_below else (more, more_below)
    return above, below


def split(polynomial: Polynomial, ratio: int) -> tuple[Polynomial, Polynomial]:
    """What stands without a ratio, and what with it, divided by it."""
    bit = 1 << ratio
    plain = {ratios: one for ratios, one in polynomial.items() if not ratios & bit}
    return plain, {ratios ^ bit: one for ratios, one in polynomial.items() if ratios & bit}


def value(polynomial: Polynomial, trial: int) -> int:
    """The residue of a polynomial where each ratio is its `ratio_number`."""
    total = 0
    for ratios, coefficient in polynomial.items():
        product = _residue(coefficient)
        for ratio in bits(ratios):
            product = product * ratio_number(ratio, trial) % PRIME
        total += product
    return total % PRIME


def bits(ratios: int) -> list[int]:
    """The indices of a set of ratios.

    >>> bits(0b1010)
    [1, 3]
    """
    return [index for index in range(ratios.bit_length()) if ratios >> index & 1]
