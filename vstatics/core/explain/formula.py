"""Ratio of a gear as a formula in the ratios of its mechanisms; needs FLINT."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.elements.drawing import parts_of
from vstatics.core.explain import factored
from vstatics.core.explain.bodies import OwnLinks, Structure
from vstatics.core.explain.factored import Quotient
from vstatics.core.explain.names import Names
from vstatics.core.explain.shares import NoFormula, shares
from vstatics.core.extras import missing
from vstatics.core.groups import grouped
from vstatics.core.model.transmission import HOUSING, Gear, SpeedOf, Transmission
from vstatics.core.tables.answer import Flat, json_keys

if TYPE_CHECKING:
    from flint import fmpz_mpoly

FOLLOWS = (
    "there is no formula, because the speed of link {link} is given as a multiple "
    "of the speed of {other}"
)
"""Reason for the missing formula of a gear with a speed that depends on another link."""
SLIPS = "there is no formula, because a shift element slips"
"""Reason for the missing formula of a gear with a prescribed slip."""
SHARED = ("u", "v")
"""Symbols for ratios that are equal in several mechanisms."""


class Symbol(NamedTuple):
    """Ratio of a mechanism in a formula."""

    name: str
    meaning: str
    """Name of the mechanism, or the members of a gear set that the mechanism connects."""
    value: float
    """Value of the ratio. [-]"""


class NumberedSymbol(NamedTuple):
    """Symbol of a ratio, with its name in `expression`, such as u1."""

    symbol: str
    meant: Flat[Symbol]


class NumberedSpeed(NamedTuple):
    """Prescribed speed, with its name in `expression`, such as w1."""

    symbol: str
    name: str
    value: float


@json_keys(
    *("left", "text", "expression"),
    symbols="numbered_symbols",
    speeds="numbered_speeds",
    value="value",
    shared="shared",
    shared_text="shared_text",
)
class RatioFormula(NamedTuple):
    """Formula of a ratio or output speed in symbols, with the value."""

    left: str
    """Left side of the formula: ``i``, or the symbol of the output speed."""
    text: str
    expression: str
    """Formula as an expression that Python and SymPy can read.

    Ratios have the names u1, u2 and so on, in the order of the symbols. Prescribed speeds have the
    names w1, w2 and so on.
    """
    symbols: Sequence[Symbol]
    speeds: Mapping[str, float]
    """Prescribed speeds in the formula, by symbol; empty for a ratio. [-]"""
    value: float
    """Value of the formula. [-]"""
    shared: Mapping[str, Sequence[str]]
    """Common symbols in `shared_text`, each with the symbols of equal value that it replaces."""
    shared_text: str
    """Shorter formula with common symbols for equal ratios; empty if all ratios differ."""

    @property
    def numbered_symbols(self) -> list[NumberedSymbol]:
        """Symbols with the names u1, u2 and so on."""
        return [NumberedSymbol(f"u{n}", symbol) for n, symbol in enumerate(self.symbols, 1)]

    @property
    def numbered_speeds(self) -> list[NumberedSpeed]:
        """Prescribed speeds with the names w1, w2 and so on."""
        return [NumberedSpeed(f"w{n}", *item) for n, item in enumerate(self.speeds.items(), 1)]


def symbols_of(case: Transmission, names: Names, on_links: OwnLinks) -> list[Symbol]:
    """Return the symbols of the mechanisms in a case without planets as links.

    Mechanisms that also occur in the calculated case keep their symbols. Mechanisms between central
    gears get new symbols.

    Parameters
    ----------
    case : Transmission
        Calculated case, in which planets can be links.
    on_links : OwnLinks
        Case without planets as links.
    """
    symbols = []
    number, wheels = 0, 0
    for part, reduced in zip(parts_of(case), on_links.parts, strict=True):
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
    on_links: OwnLinks, gear: Gear, names: Names, symbols: Sequence[Symbol], structure: Structure
) -> RatioFormula:
    """Return the formula of a gear's ratio, or of the output speed if speeds are prescribed.

    Parameters
    ----------
    on_links : OwnLinks
        Case without planets as links.
    gear : Gear
        Gear in which holding freewheels are listed as engaged.
    symbols : sequence of Symbol
        Symbol of each mechanism.

    Raises
    ------
    NoFormula
        If FLINT is not installed, the output speed is indeterminate or 0, or the formula would be
        too long.
    """
    reason = missing("formula", "the formula")
    if reason:
        raise NoFormula(reason)
    case = on_links.case
    if gear.slipping:
        raise NoFormula(SLIPS)
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
        raise NoFormula("the output is held, so it has no ratio")
    parts = shares(on_links, structure, given, structure.body[output])
    if not parts:
        raise NoFormula("the output is at rest, so it has no ratio")
    speeds = {given[body]: numbers[given[body]] for body in parts}
    if not gear.speeds or list(speeds) == [names.speeds[case.gear_input(gear)]]:
        share = next(iter(parts.values()))
        return _of_ratio(factored.reduced(share.denom, share.numer), symbols, on_links.variators)
    return _of_speed(names.speeds[output], list(parts.values()), speeds, symbols)


def _of_ratio(
    ratio: Quotient, symbols: Sequence[Symbol], variators: Collection[str]
) -> RatioFormula:
    occurring = _occurring([ratio])
    text = factored.fraction(ratio, factored.Notation([symbol.name for symbol in symbols]))
    fixed = [place for place in occurring if symbols[place].meaning not in variators]
    shared, shorter = _shared(ratio, symbols, fixed)
    return RatioFormula(
        left="i",
        text=text,
        expression=factored.fraction(ratio, factored.python(occurring, len(symbols))),
        symbols=[symbols[place] for place in occurring],
        speeds={},
        value=_value(ratio, symbols),
        shared=shared,
        shared_text=shorter if len(shorter) < len(text) else "",
    )


def _of_speed(
    output: str, shares: Sequence[Quotient], speeds: Mapping[str, float], symbols: Sequence[Symbol]
) -> RatioFormula:
    occurring = _occurring(shares)
    notation = factored.Notation([symbol.name for symbol in symbols])
    unknowns = [f"w{number}" for number in range(1, len(speeds) + 1)]
    numbers = zip(shares, speeds.values(), strict=True)
    return RatioFormula(
        left=output,
        text=factored.weighted(shares, list(speeds), notation),
        expression=factored.weighted(shares, unknowns, factored.python(occurring, len(symbols))),
        symbols=[symbols[place] for place in occurring],
        speeds=speeds,
        value=math.fsum(_value(share, symbols) * speed for share, speed in numbers),
        shared={},
        shared_text="",
    )


def _occurring(values: Sequence[Quotient]) -> list[int]:
    """Return the indices of the symbols that occur in fractions."""
    degrees = [part.degrees() for value in values for part in value]
    return [place for place, powers in enumerate(zip(*degrees, strict=True)) if any(powers)]


def _shared(
    value: Quotient, symbols: Sequence[Symbol], fixed: Sequence[int]
) -> tuple[dict[str, list[str]], str]:
    """Return common symbols for equal ratios among `fixed`, and the formula with these symbols."""
    by_value = grouped((symbols[place].value, place) for place in fixed)
    groups = [places for places in by_value.values() if len(places) > 1]
    if not 0 < len(groups) <= len(SHARED):
        return {}, ""
    names, merged = [symbol.name for symbol in symbols], [*value.numer.context().gens()]
    stands_for = {}
    for letter, (first, *others) in zip(SHARED, groups, strict=False):
        stands_for[letter] = [names[place] for place in (first, *others)]
        names[first] = letter
        for place in others:
            merged[place] = merged[first]
    above, below = (part.compose(*merged) for part in value)
    if not below:  # the ratio does not exist for equal symbols
        return {}, ""
    return stands_for, factored.fraction(factored.reduced(above, below), factored.Notation(names))


def _value(value: Quotient, symbols: Sequence[Symbol]) -> float:
    """Return the value of a fraction; NaN if it is undefined, or beyond the range of floats.

    >>> from flint import Ordering, fmpz_mpoly_ctx
    >>> [u] = fmpz_mpoly_ctx.get(["u"], Ordering.lex).gens()
    >>> [_value(Quotient(u**3, u - 2), [Symbol("u", "P", at)]) for at in (-2.0, 2.0, 1e200)]
    [2.0, nan, nan]
    """

    def at(polynomial: fmpz_mpoly) -> Fraction:
        total = Fraction(0)
        for powers, factor in polynomial.terms():
            ratios = (
                Fraction(symbols[place].value) ** int(power)
                for place, power in enumerate(powers)
                if power
            )
            total += math.prod(ratios, start=Fraction(int(factor)))
        return total

    with suppress(ZeroDivisionError, OverflowError):  # a fraction can exceed the range of floats
        return float(at(value.numer) / at(value.denom))
    return math.nan
