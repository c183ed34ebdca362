"""The ratio of a gear as a quotient of two polynomials in the ratios of its mechanisms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Literal, NamedTuple

from vstatics.core.explain.bodies import OwnLinks
from vstatics.core.explain.shares import as_typed
from vstatics.core.model.transmission import HOUSING, Gear, SpeedOf, Transmission
from vstatics.core.statics.status import NEUTRAL, OUTPUT_STANDS, TIED_UP
from vstatics.synthesis.ratios.multilinear import (
    LinearRow,
    Polynomial,
    SingularError,
    Term,
    bits,
    determinant,
    independent,
    without_common,
)

FormulaKind = Literal["ratio", "constant", "tied up", "open", "output stands", "too long"]
"""Whether there is a ratio, or one whatever the ratios of the mechanisms are; else why not."""

ONE, ZERO = Fraction(1), Fraction(0)


class GearFormula(NamedTuple):
    """``w_input/w_output = above/below``, both in ratios of mechanisms, whose indices are bits.

    Both are sums of products of some of the ratios, with factors of 1 and -1 but for given speeds.
    """

    kind: FormulaKind
    above: Polynomial
    below: Polynomial

    @property
    def ratios(self) -> list[int]:
        """The indices of the mechanisms whose ratios matter."""
        occurring = 0
        for ratios in (*self.above, *self.below):
            occurring |= ratios
        return bits(occurring)

    @property
    def constant(self) -> float:
        """The ratio, where it is one whatever the ratios of the mechanisms are [-]."""
        return float(self.above[0] / self.below[0])


def gear_formula(own: OwnLinks, gear: Gear, fixed: Mapping[int, float]) -> GearFormula:
    """The formula of a gear's ratio.

    Parameters
    ----------
    own : OwnLinks
        The case, without planets among its links.
    gear : Gear
        With the freewheels that hold among the engaged elements.
    fixed : mapping of int to float
        Ratios of mechanisms, by their indices, that are numbers in the formula. [-]

    Raises
    ------
    CaseError
        If the formula is too long.

    Examples
    --------
    The ring is braked: ``i = (w_sun/w_carrier) = 1 - u``.

    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> own = on_own_links(case)
    >>> low, direct = [gear_formula(own, gear, {}) for gear in case.gears]
    >>> {ratios: int(factor) for ratios, factor in low.above.items()}
    {0: 1, 1: -1}
    >>> direct.kind, direct.constant
    ('constant', 1.0)
    """
    case = own.case
    bodies = case.bodies(gear)
    output = bodies[case.gear_output(gear)]
    try:
        known = _known(case, gear, bodies)
        found = independent([*_rows(own, gear, bodies, known, fixed)])
    except SingularError:
        return _without(TIED_UP.name)
    if output in known:
        speed = known[output]
        return _constant(speed) if speed else _without(OUTPUT_STANDS.name)
    if output not in found.needed:
        return _without(NEUTRAL.name)
    rows = found.needed[output]
    unknowns = independent(rows).unknowns
    rows = _ordered(rows)
    replaced = [-1 if unknown == output else unknown for unknown in unknowns]
    above, below = determinant(rows, unknowns), determinant(rows, replaced)
    if not below:
        return _without(OUTPUT_STANDS.name)
    above, below = without_common(above, below, range(len(case.mechanisms)))
    if not any(above) and not any(below):
        return _constant(below[0] / above[0])
    sign = 1 if below[min(below)] > 0 else -1
    return GearFormula("ratio", _times(sign, above), _times(sign, below))


def _without(name: str) -> GearFormula:
    return GearFormula(name, {}, {})  # type: ignore[arg-type] # one of the words


def _times(factor: int, polynomial: Polynomial) -> Polynomial:
    return {ratios: factor * one for ratios, one in polynomial.items()}


def _constant(speed: Fraction) -> GearFormula:
    return GearFormula("constant", {0: ONE}, {0: speed})


def _known(case: Transmission, gear: Gear, bodies: Sequence[int]) -> dict[int, Fraction]:
    """The speeds of bodies that are given, by the input's.

    Raises
    ------
    SingularError
    """
    known = {HOUSING: ZERO}
    given = {link: one for link, one in gear.speeds.items() if not isinstance(one, SpeedOf)}
    for link, speed in {case.gear_input(gear): 1.0, **given}.items():
        if known.setdefault(bodies[link], as_typed(speed)) != as_typed(speed):
            raise SingularError
    return known


def _rows(
    own: OwnLinks,
    gear: Gear,
    bodies: Sequence[int],
    known: Mapping[int, Fraction],
    fixed: Mapping[int, float],
) -> Iterator[LinearRow]:
    """The speed equations of a gear in its bodies."""
    case = own.case
    for index, mechanism in enumerate(case.mechanisms):
        of_links: Sequence[Term] = ((ONE, ZERO), (ZERO, -ONE), (-ONE, ONE))
        ratio = index
        if index in fixed:
            number, ratio = Fraction(fixed[index]), -1
            of_links = [(plain + number * more, ZERO) for plain, more in of_links]
        yield _row(ratio, zip(mechanism.links, of_links, strict=True), bodies, known)
    for spring in case.springs:
        terms = ((link, (as_typed(part), ZERO)) for link, part in spring.form.items())
        yield _row(-1, terms, bodies, known)
    for link, speed in gear.speeds.items():
        if isinstance(speed, SpeedOf):
            pair = ((link, (ONE, ZERO)), (speed.link, (-as_typed(speed.factor), ZERO)))
            yield _row(-1, pair, bodies, known)


def _row(
    ratio: int,
    terms: Iterator[tuple[int, Term]] | Sequence[tuple[int, Term]],
    bodies: Sequence[int],
    known: Mapping[int, Fraction],
) -> LinearRow:
    """An equation in links as one in bodies; what is known goes to the right."""
    unknown: dict[int, Term] = {}
    right: Term = (ZERO, ZERO)
    for link, (plain, more) in terms:
        body = bodies[link]
        if body in known:
            right = (right[0] - plain * known[body], right[1] - more * known[body])
        else:
            before = unknown.get(body, (ZERO, ZERO))
            unknown[body] = (before[0] + plain, before[1] + more)
    return LinearRow(ratio, {body: term for body, term in unknown.items() if any(term)}, right)


def _ordered(rows: Sequence[LinearRow]) -> list[LinearRow]:
    """Each row behind those that have most of its unknowns: so few are to be kept in mind."""
    left = list(rows)
    ordered: list[LinearRow] = []
    met: set[int] = set()
    while left:
        following = min(left, key=lambda row: len(row.terms.keys() - met))
        left.remove(following)
        ordered.append(following)
        met |= following.terms.keys()
    return ordered
