"""Symbolic solution of the speed equations: coefficients of prescribed speeds in the output speed.

Links that rotate together form a body, whose speed is an unknown. All bodies are eliminated except
the output and the bodies with a prescribed speed.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import TYPE_CHECKING

from vstatics.core.explain.bodies import OwnLinks, Structure
from vstatics.core.explain.factored import Quotient, reduced
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import HOUSING
from vstatics.core.numerics.tolerances import ROUNDED_COEFFICIENT
from vstatics.core.statics.matrix import column
from vstatics.core.statics.status import NEUTRAL

if TYPE_CHECKING:
    from flint import fmpz_mpoly, fmpz_mpoly_ctx

MOST_FORMULA_TERMS = 400
"""Largest number of terms of an equation. A longer one gives a useless formula, and slowly."""

Body = int
"""Body of links, identified by the smallest link number."""
Row = dict[Body, "fmpz_mpoly"]
"""Coefficients of an equation by body."""


class NoFormula(Exception):  # noqa: N818 - not an error of the case
    """Exception raised if there is no formula, with the reason as text."""


def shares(
    on_links: OwnLinks,
    structure: Structure,
    given: Mapping[Body, str],
    output: Body,
) -> dict[Body, Quotient]:
    """Return the coefficient of each prescribed speed in the formula of the output speed."""
    from flint import Ordering, fmpz_mpoly_ctx

    names = [f"u{n}" for n in range(1, len(on_links.case.mechanisms) + 1)] or ["u1"]
    ring = fmpz_mpoly_ctx.get(names, Ordering.lex)
    if output in given:
        return {output: Quotient(ring.constant(1), ring.constant(1))}
    rows = [_row(on_links, n, structure.body, ring) for n in structure.needed]
    rows += [_of_spring(on_links.case.springs[n], structure.body, ring) for n in structure.springs]
    rows = [row for row in rows if row]
    while unknown := {body for row in rows for body in row} - {output, *given}:
        counts = Counter(body for row in rows for body in row)
        body = min(unknown, key=lambda candidate: (counts[candidate], candidate))
        pivot = min((row for row in rows if body in row), key=lambda row: (len(row), _size(row)))
        others = (_without(row, body, pivot) for row in rows if row is not pivot)
        rows = [row for row in others if row]
        if any(_size(row) > MOST_FORMULA_TERMS for row in rows):
            raise NoFormula("the formula would be too long")
    last = next((row for row in rows if output in row), None)
    if last is None:
        raise NoFormula(f"{NEUTRAL.english}: the output speed is not determined")
    factor = last.pop(output)
    return {body: reduced(-last[body], factor) for body in given if body in last}


def _row(on_links: OwnLinks, number: int, body: Sequence[Body], ring: fmpz_mpoly_ctx) -> Row:
    """Return the speed equation of a mechanism in terms of bodies."""
    mechanism = on_links.case.mechanisms[number]
    is_fixed = on_links.is_fixed(number)
    ratio = ring.constant(int(mechanism.ratio)) if is_fixed else ring.gen(number)
    row: Row = {}
    for link, factor in zip(mechanism.links, column(ratio), strict=True):
        if body[link] != HOUSING:
            row[body[link]] = row.get(body[link], ring.constant(0)) + factor
    return {joined: factor for joined, factor in row.items() if factor}


def _of_spring(spring: Spring, body: Sequence[Body], ring: fmpz_mpoly_ctx) -> Row:
    """Return the speed equation of a spring with constant twist. Coefficients are integers."""
    sums: dict[Body, Fraction] = {}
    for link, part in spring.form.items():
        sums[body[link]] = sums.get(body[link], Fraction(0)) + as_typed(part)
    least = ROUNDED_COEFFICIENT * max(map(abs, spring.form.values()))
    divisor = math.lcm(*(total.denominator for total in sums.values()))
    return {
        joined: ring.constant(int(total * divisor))
        for joined, total in sums.items()
        if joined != HOUSING and abs(total) > least
    }


def as_typed(number: float) -> Fraction:
    """Return the simple fraction that a user probably meant by a number.

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
    """Return an equation from which a body is eliminated."""
    if body not in row:
        return row
    left = {
        other: pivot[body] * row.get(other, 0) - row[body] * pivot.get(other, 0)
        for other in {**row, **pivot}
    }
    left = {other: factor for other, factor in left.items() if factor}
    common = reduce(lambda one, other: one.gcd(other), left.values(), 0 * pivot[body])
    return {other: factor // common for other, factor in left.items()}


def _size(row: Row) -> int:
    return sum(map(len, row.values()))
