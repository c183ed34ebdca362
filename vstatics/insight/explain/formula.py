"""The ratio of a gear as a formula in the ratios of its mechanisms; needs SymPy.

The speed equations are solved with symbols for the ratios: links that turn together are
one body, and bodies that neither are the output nor have a given speed are eliminated.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from importlib.util import find_spec
from typing import Any, NamedTuple

from vstatics.elements.lower import parts
from vstatics.insight.explain import forms
from vstatics.insight.explain.bodies import OwnLinks, Structure
from vstatics.insight.explain.names import Names
from vstatics.model import HOUSING, Gear, Transmission

INSTALL = 'pip install "vstatics[formula]"'
LARGEST = 400
"""A formula of more terms helps nobody, and takes long."""
SHARED = ("u", "v")
"""Symbols for ratios that several mechanisms have."""

Body = int
Row = dict[Body, Any]
"""Body -> coefficient, a fraction of polynomials."""


class Symbol(NamedTuple):
    """The ratio of a mechanism in a formula."""

    name: str
    meaning: str
    """The mechanism, or the members of an element."""
    value: float
    """[-]"""


class Formula(NamedTuple):
    """A formula in symbols, and what it gives."""

    left: str
    """What it is a formula of: ``i``, or the speed of the output."""
    text: str
    expression: str
    """The same as Python and SymPy read it; symbols are u1, u2, ... in their order, then the
    given speeds w1, w2, ..."""
    symbols: Sequence[Symbol]
    speeds: Mapping[str, float]
    """The given speeds that it speaks of; none in a formula of the ratio. [-]"""
    value: float
    """[-]"""
    shared: Mapping[str, Sequence[str]]
    """New symbol -> those of the same value that it stands for in `shared_text`."""
    shared_text: str
    """Shorter, as some ratios are the same; may be nothing."""


class NoFormula(Exception):  # noqa: N818 - not an error of the case
    """There is no formula; the text says why."""


def symbols_of(case: Transmission, names: Names, own: OwnLinks) -> list[Symbol]:
    """Symbols for the mechanisms between own links: those of the equations, or between wheels.

    Parameters
    ----------
    case : Transmission
        As it is calculated, planets among its links.
    own : OwnLinks
        The same on its own links.
    """
    values = [mechanism.ratio for mechanism in own.case.mechanisms]
    given = [one.name for one in case.mechanisms]
    if case.drawing is None:
        return list(map(Symbol, names.ratios, given, values))
    found: list[Symbol] = []
    number, wheels = 0, 0
    for part, reduced in zip(parts(case.drawing), own.parts, strict=True):
        for place, lowered in enumerate(reduced.lowered):
            if part.planet_links:
                wheels += 1
                first, second, third = lowered.members
                meaning = f"{part.name}: {first} to {second}, {third} held"
                found.append(Symbol(f"k{wheels}", meaning, lowered.mechanism.ratio))
            else:
                name = names.ratios[number + place]
                found.append(Symbol(name, given[number + place], lowered.mechanism.ratio))
        number += len(part.lowered)
    return found


def formula(
    own: OwnLinks, gear: Gear, names: Names, symbols: Sequence[Symbol], found: Structure
) -> Formula:
    """The formula of a gear's ratio; where several speeds are given, of its output speed.

    Parameters
    ----------
    own : OwnLinks
        The case, without planets among its links.
    gear : Gear
        With the freewheels that hold among the engaged elements.
    symbols : sequence of Symbol
        By mechanism.

    Raises
    ------
    NoFormula
        If SymPy is not installed, the output speed is not determined or 0, or the formula
        would be too long.
    """
    if find_spec("sympy") is None:
        raise NoFormula(f"the formula needs the package sympy: {INSTALL}")
    case = own.case
    given: dict[Body, str] = {}
    numbers: dict[str, float] = {}
    for link, speed in {case.gear_input(gear): 1.0, **gear.speeds}.items():
        if found.body[link] != HOUSING:
            given.setdefault(found.body[link], names.speeds[link])
            numbers.setdefault(given[found.body[link]], speed)
    output = case.gear_output(gear)
    if found.body[output] == HOUSING:
        raise NoFormula("the output is held: there is no ratio")
    shares = _shares(own, symbols, found, given, found.body[output])
    if not shares:
        raise NoFormula("the output stands still: there is no ratio")
    speeds = {given[body]: numbers[given[body]] for body in shares}
    if not gear.speeds or list(speeds) == [names.speeds[case.gear_input(gear)]]:
        return _of_ratio(1 / next(iter(shares.values())), symbols)
    return _of_speed(names.speeds[output], list(shares.values()), speeds, symbols)


def _shares(
    own: OwnLinks,
    symbols: Sequence[Symbol],
    found: Structure,
    given: Mapping[Body, str],
    output: Body,
) -> Row:
    """What each given speed adds to that of the output."""
    from sympy import ZZ
    from sympy.polys.fields import field

    fractions, *ratios = field([f"u{n}" for n in range(1, len(symbols) + 1)] or ["u1"], ZZ)
    if output in given:
        return {output: fractions.one}
    rows = [row for n in found.needed if (row := _row(own, n, found.body, ratios, fractions))]
    while unknown := {body for row in rows for body in row} - {output, *given}:
        counts = Counter(body for row in rows for body in row)
        body = min(unknown, key=lambda one: (counts[one], one))
        pivot = min((row for row in rows if body in row), key=lambda row: (len(row), _size(row)))
        rows = [_without(row, body, pivot) for row in rows if row is not pivot]
        rows = [row for row in rows if row]
        if any(_size(row) > LARGEST for row in rows):
            raise NoFormula("the formula would be too long")
    last = next((row for row in rows if output in row), None)
    if last is None:
        raise NoFormula("neutral: the output speed is not determined")
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
    for link, factor in zip(mechanism.links, (fractions.one, -ratio, ratio - 1), strict=True):
        if body[link] != HOUSING:
            row[body[link]] = row.get(body[link], fractions.zero) + factor
    return {one: factor for one, factor in row.items() if factor}


def _without(row: Row, body: Body, pivot: Row) -> Row:
    """An equation from which a body is eliminated."""
    if body not in row:
        return row
    share = row[body] / pivot[body]
    made = {one: row.get(one, 0) - share * pivot.get(one, 0) for one in {**row, **pivot}}
    return {one: factor for one, factor in made.items() if factor and one != body}


def _size(row: Row) -> int:
    return sum(len(factor.numer) + len(factor.denom) for factor in row.values())


def _of_ratio(ratio: Any, symbols: Sequence[Symbol]) -> Formula:
    occurring = [n for n in range(len(symbols)) if n in _occurring(ratio)]
    kept = [symbols[number] for number in occurring]
    renamed = _in_symbols(ratio, {number: place for place, number in enumerate(occurring)})
    text = forms.fraction(renamed, forms.Style([one.name for one in kept]))
    shared, shorter = _shared(renamed, kept)
    return Formula(
        left="i",
        text=text,
        expression=forms.fraction(renamed, forms.python(len(kept))),
        symbols=kept,
        speeds={},
        value=_value(renamed, kept),
        shared=shared,
        shared_text=shorter if len(shorter) < len(text) else "",
    )


def _of_speed(
    output: str, shares: Sequence[Any], speeds: Mapping[str, float], symbols: Sequence[Symbol]
) -> Formula:
    occurring = sorted(set().union(*map(_occurring, shares)))
    kept = [symbols[number] for number in occurring]
    places = {number: place for place, number in enumerate(occurring)}
    renamed = [_in_symbols(share, places) for share in shares]
    style = forms.Style([one.name for one in kept])
    unknowns = [f"w{number}" for number in range(1, len(speeds) + 1)]
    numbers = zip(renamed, speeds.values(), strict=True)
    return Formula(
        left=output,
        text=forms.weighted(renamed, list(speeds), style),
        expression=forms.weighted(renamed, unknowns, forms.python(len(kept))),
        symbols=kept,
        speeds=speeds,
        value=math.fsum(_value(share, kept) * speed for share, speed in numbers),
        shared={},
        shared_text="",
    )


def _occurring(value: Any) -> set[int]:
    """Numbers of the symbols in a fraction of polynomials."""
    terms = [*value.numer.terms(), *value.denom.terms()]
    return {place for powers, _ in terms for place, power in enumerate(powers) if power}


def _in_symbols(value: Any, places: Mapping[int, int]) -> Any:
    """The fraction in other symbols: number of the old -> number of the new one.

    None if its denominator becomes 0 where two symbols become one.
    """
    from sympy import ZZ
    from sympy.polys.fields import field

    count = len(set(places.values()))
    fractions, *_ = field([f"u{number}" for number in range(1, count + 1)] or ["u1"], ZZ)

    def image(polynomial: Any) -> Any:
        terms: Counter[tuple[int, ...]] = Counter()
        for powers, factor in polynomial.terms():
            new = [0] * max(count, 1)
            for old, power in enumerate(powers):
                if power:
                    new[places[old]] += power
            terms[tuple(new)] += factor
        return fractions.ring({one: factor for one, factor in terms.items() if factor})

    below = image(value.denom)
    return fractions(image(value.numer)) / fractions(below) if below else None


def _shared(value: Any, symbols: Sequence[Symbol]) -> tuple[dict[str, list[str]], str]:
    """The formula where symbols of the same value are one."""
    by_value: dict[float, list[int]] = {}
    for number, symbol in enumerate(symbols):
        by_value.setdefault(symbol.value, []).append(number)
    groups = [numbers for numbers in by_value.values() if len(numbers) > 1]
    if not 0 < len(groups) <= len(SHARED):
        return {}, ""
    letters = dict(zip(SHARED, groups, strict=False))
    letter_of = {number: letter for letter, numbers in letters.items() for number in numbers}
    written = [letter_of.get(number, symbols[number].name) for number in range(len(symbols))]
    new = list(dict.fromkeys(written))
    one = _in_symbols(value, {number: new.index(name) for number, name in enumerate(written)})
    if one is None:
        return {}, ""
    stands_for = {letter: [symbols[n].name for n in numbers] for letter, numbers in letters.items()}
    return stands_for, forms.fraction(one, forms.Style(new))


def _value(value: Any, symbols: Sequence[Symbol]) -> float:
    """The number that a fraction of polynomials is at the values of its symbols."""
    values = [Fraction(symbol.value) for symbol in symbols]

    def at(polynomial: Any) -> Fraction:
        total = Fraction(0)
        for powers, factor in polynomial.terms():
            pairs = zip(values, powers, strict=False)
            total += math.prod((one**power for one, power in pairs), start=Fraction(int(factor)))
        return total

    divisor = at(value.denom)
    return float(at(value.numer) / divisor) if divisor else math.nan
