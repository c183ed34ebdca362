"""The ratio of a gear as a formula in the ratios of its mechanisms; needs SymPy."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from vstatics.core.elements.drawing import parts_of
from vstatics.core.explain import factored
from vstatics.core.explain.bodies import OwnLinks, Structure
from vstatics.core.explain.names import Names
from vstatics.core.explain.shares import NoFormula, shares
from vstatics.core.extras import missing
from vstatics.core.model.transmission import HOUSING, Gear, SpeedOf, Transmission
from vstatics.core.tables.answer import Flat, told

FOLLOWS = "there is no formula, as the speed of link {link} is given by that of {other}"
"""Why a gear with tied speeds has none."""
SHARED = ("u", "v")
"""Symbols for ratios that several mechanisms have."""


class Symbol(NamedTuple):
    """The ratio of a mechanism in a formula."""

    name: str
    meaning: str
    """The mechanism, or the members of an element."""
    value: float
    """[-]"""


class NumberedSymbol(NamedTuple):
    """A symbol as the expression calls it."""

    symbol: str
    meant: Flat[Symbol]


class NumberedSpeed(NamedTuple):
    """A given speed as the expression calls it."""

    symbol: str
    name: str
    value: float


@told(
    *("left", "text", "expression"),
    symbols="numbered_symbols",
    speeds="numbered_speeds",
    value="value",
    shared="shared",
    shared_text="shared_text",
)
class RatioFormula(NamedTuple):
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

    @property
    def numbered_symbols(self) -> list[NumberedSymbol]:
        """What stands for u1, u2, ..."""
        return [NumberedSymbol(f"u{n}", one) for n, one in enumerate(self.symbols, 1)]

    @property
    def numbered_speeds(self) -> list[NumberedSpeed]:
        """What stands for w1, w2, ..."""
        return [NumberedSpeed(f"w{n}", *one) for n, one in enumerate(self.speeds.items(), 1)]


def symbols_of(case: Transmission, names: Names, own: OwnLinks) -> list[Symbol]:
    """Symbols for the mechanisms between own links: those of the equations, or between wheels.

    Parameters
    ----------
    case : Transmission
        As it is calculated, planets among its links.
    own : OwnLinks
        The same on its own links.
    """
    symbols: list[Symbol] = []
    number, wheels = 0, 0
    for part, reduced in zip(parts_of(case), own.parts, strict=True):
        for place, lowered in enumerate(reduced.lowered):
            if part.planet_links:
                wheels += 1
                first, second, third = lowered.members
                meaning = f"{part.name}: {first} to {second}, {third} held"
                symbols.append(Symbol(f"k{wheels}", meaning, lowered.mechanism.ratio))
            else:
                symbol, name = names.ratios[number + place], case.mechanisms[number + place].name
                symbols.append(Symbol(symbol, name, lowered.mechanism.ratio))
        number += len(part.lowered)
    return symbols


def formula(
    own: OwnLinks, gear: Gear, names: Names, symbols: Sequence[Symbol], structure: Structure
) -> RatioFormula:
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
    reason = missing("formula", "the formula")
    if reason:
        raise NoFormula(reason)
    case = own.case
    given: dict[int, str] = {}
    numbers: dict[str, float] = {}
    for link, speed in {case.gear_input(gear): 1.0, **gear.speeds}.items():
        if isinstance(speed, SpeedOf):
            raise NoFormula(
                FOLLOWS.format(link=case.link_name(link), other=case.link_name(speed.link))
            )
        if structure.body[link] != HOUSING:
            given.setdefault(structure.body[link], names.speeds[link])
            numbers.setdefault(given[structure.body[link]], speed)
    output = case.gear_output(gear)
    if structure.body[output] == HOUSING:
        raise NoFormula("the output is held: there is no ratio")
    parts = shares(own, structure, given, structure.body[output])
    if not parts:
        raise NoFormula("the output stands still: there is no ratio")
    speeds = {given[body]: numbers[given[body]] for body in parts}
    if not gear.speeds or list(speeds) == [names.speeds[case.gear_input(gear)]]:
        return _of_ratio(1 / next(iter(parts.values())), symbols, own.variators)
    return _of_speed(names.speeds[output], list(parts.values()), speeds, symbols)


def _of_ratio(ratio: Any, symbols: Sequence[Symbol], variators: Collection[str]) -> RatioFormula:
    kept, [renamed] = _in_occurring([ratio], symbols)
    text = factored.fraction(renamed, factored.Notation([one.name for one in kept]))
    shared, shorter = _shared(renamed, kept, variators)
    return RatioFormula(
        left="i",
        text=text,
        expression=factored.fraction(renamed, factored.python(len(kept))),
        symbols=kept,
        speeds={},
        value=_value(renamed, kept),
        shared=shared,
        shared_text=shorter if len(shorter) < len(text) else "",
    )


def _of_speed(
    output: str, shares: Sequence[Any], speeds: Mapping[str, float], symbols: Sequence[Symbol]
) -> RatioFormula:
    kept, renamed = _in_occurring(shares, symbols)
    notation = factored.Notation([one.name for one in kept])
    unknowns = [f"w{number}" for number in range(1, len(speeds) + 1)]
    numbers = zip(renamed, speeds.values(), strict=True)
    return RatioFormula(
        left=output,
        text=factored.weighted(renamed, list(speeds), notation),
        expression=factored.weighted(renamed, unknowns, factored.python(len(kept))),
        symbols=kept,
        speeds=speeds,
        value=math.fsum(_value(share, kept) * speed for share, speed in numbers),
        shared={},
        shared_text="",
    )


def _in_occurring(
    values: Sequence[Any], symbols: Sequence[Symbol]
) -> tuple[list[Symbol], list[Any]]:
    """The symbols that occur in fractions of polynomials, and the fractions in these alone."""
    polynomials = [part for value in values for part in (value.numer, value.denom)]
    terms = [powers for part in polynomials for powers in part.monoms()]
    occurring = sorted({place for powers in terms for place, power in enumerate(powers) if power})
    places = {number: place for place, number in enumerate(occurring)}
    return [symbols[number] for number in occurring], [_in_symbols(one, places) for one in values]


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


def _shared(
    value: Any, symbols: Sequence[Symbol], variators: Collection[str]
) -> tuple[dict[str, list[str]], str]:
    """The formula where symbols of the same value are one; that of a variator is so by chance."""
    by_value: dict[float, list[int]] = {}
    for number, symbol in enumerate(symbols):
        if symbol.meaning not in variators:
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
    return stands_for, factored.fraction(one, factored.Notation(new))


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
