"""The speed equations solved with symbols: what each given speed adds to that of the output.

Links that turn together are one body, and bodies that neither are the output nor have a
given speed are eliminated.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from vstatics.core.explain.bodies import OwnLinks, Structure
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import HOUSING
from vstatics.core.numerics.tolerances import ROUNDED_COEFFICIENT
from vstatics.core.statics.matrix import column
from vstatics.core.statics.status import NEUTRAL

MOST_TERMS = 400
"""A formula of more terms helps nobody, and takes long."""

Body = int
Row = dict[Body, Any]
"""Body -> coefficient, a fraction of polynomials."""


class NoFormula(Exception):  # noqa: N818 - not an error of the case
    """There is no formula; the text says why."""


def shares(
    own: OwnLinks,
    structure: Structure,
    given: Mapping[Body, str],
    output: Body,
) -> Row:
    """What each given speed adds to that of the output."""
    from sympy import ZZ
    from sympy.polys.fields import field

    fractions, *ratios = field(
        [f"u{n}" for n in range(1, len(own.case.mechanisms) + 1)] or ["u1"], ZZ
    )
    if output in given:
        return {output: fractions.one}
    rows = [_row(own, n, structure.body, ratios, fractions) for n in structure.needed]
    rows += [_of_spring(own.case.springs[n], structure.body, fractions) for n in structure.springs]
    rows = [row for row in rows if row]
    while unknown := {body for row in rows for body in row} - {output, *given}:
        counts = Counter(body for row in rows for body in row)
        body = min(unknown, key=lambda one: (counts[one], one))
        pivot = min((row for row in rows if body in row), key=lambda row: (len(row), _size(row)))
        others = (_without(row, body, pivot) for row in rows if row is not pivot)
        rows = [row for row in others if row]
        if any(_size(row) > MOST_TERMS for row in rows):
            raise NoFormula("the formula would be too long")
    last = next((row for row in rows if output in row), None)
    if last is None:
        raise NoFormula(f"{NEUTRAL.english}: the output speed is not determined")
    factor = last.pop(output)
    return {body: -last[body] / factor for body in given if body in last}


def _row(
    own: OwnLinks, number: int, body: Sequence[Body], ratios: Sequence[Any], fractions: Any
) -> Row:
    """The speed equation of a mechanism, in bodies."""
    mechanism = own.case.mechanisms[number]
    ratio = ratios[number]
    if own.is_fixed(number):
        ratio = fractions(int(mechanism.ratio))
    row: Row = {}
    for link, factor in zip(mechanism.links, column(ratio), strict=True):
        if body[link] != HOUSING:
            row[body[link]] = row.get(body[link], fractions.zero) + fractions.one * factor
    return {one: factor for one, factor in row.items() if factor}


def _of_spring(spring: Spring, body: Sequence[Body], fractions: Any) -> Row:
    """That of a spring, whose twist does not grow; its coefficients are numbers as typed."""
    sums: dict[Body, Fraction] = {}
    for link, part in spring.form.items():
        sums[body[link]] = sums.get(body[link], Fraction(0)) + as_typed(part)
    least = ROUNDED_COEFFICIENT * max(map(abs, spring.form.values()))
    return {
        one: fractions(total.numerator) / total.denominator
        for one, total in sums.items()
        if one != HOUSING and abs(total) > least
    }


def as_typed(number: float) -> Fraction:
    """The fraction that a person meant by a number.

    >>> as_typed(1 / 3), as_typed(-4.1), as_typed(0.95 - 1)
    (Fraction(1, 3), Fraction(-41, 10), Fraction(-1, 20))
    """
    short = Fraction(number).limit_denominator(1000)
    return (
        short
        if math.isclose(short, number, rel_tol=ROUNDED_COEFFICIENT)
        else Fraction(repr(number))
    )


def _without(row: Row, body: Body, pivot: Row) -> Row:
    """An equation from which a body is eliminated."""
    if body not in row:
        return row
    share = row[body] / pivot[body]
    reduced = {one: row.get(one, 0) - share * pivot.get(one, 0) for one in {**row, **pivot}}
    return {one: factor for one, factor in reduced.items() if factor and one != body}


def _size(row: Row) -> int:
    return sum(len(factor.numer) + len(factor.denom) for factor in row.values())
