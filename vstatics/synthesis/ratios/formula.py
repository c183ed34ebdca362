"""Gear ratios as quotients of two polynomials in the ratios of mechanisms."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Literal, NamedTuple

from vstatics.core.errors import CaseError, spoken
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
"""Kind of a formula: a ratio, a constant, or the reason why no ratio exists."""

ONE, ZERO = Fraction(1), Fraction(0)


class GearFormula(NamedTuple):
    """Formula of the ratio of a gear, ``w_input/w_output = above/below``, in mechanism ratios.

    Both polynomials are sums of products of mechanism ratios, whose indices are bits of the keys.
    Without given speeds, the coefficients are 1 and -1.
    """

    kind: FormulaKind
    above: Polynomial
    below: Polynomial

    @property
    def ratios(self) -> list[int]:
        """Indices of the mechanisms in the formula."""
        occurring = 0
        for ratios in (*self.above, *self.below):
            occurring |= ratios
        return bits(occurring)

    @property
    def constant(self) -> float:
        """Value of a formula of kind `constant` [-]."""
        return float(self.above[0] / self.below[0])


def gear_formula(links: OwnLinks, gear: Gear, fixed: Mapping[int, float]) -> GearFormula:
    """Return the formula of the ratio of a gear.

    Parameters
    ----------
    links : OwnLinks
        Case whose links do not include planets.
    gear : Gear
        Gear whose engaged elements include the holding freewheels.
    fixed : mapping of int to float
        Ratios of mechanisms that are inserted as numbers, by the index of the mechanism. [-]

    Raises
    ------
    CaseError
        If the formula is too long.

    Examples
    --------
    With the ring braked, ``i = w_sun/w_carrier = 1 - u``.

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
    case = links.case
    bodies = case.bodies(gear)
    output = bodies[case.gear_output(gear)]
    try:
        known = _known(case, gear, bodies)
        equations = independent([*_rows(links, gear, bodies, known, fixed)])
    except SingularError:
        return _without(TIED_UP.name)
    if output in known:
        speed = known[output]
        return _constant(speed) if speed else _without(OUTPUT_STANDS.name)
    if output not in equations.needed:
        return _without(NEUTRAL.name)
    left = list(equations.needed[output])
    unknowns = independent(left).unknowns
    # In this order each row introduces few new unknowns, which keeps the expansion short.
    rows: list[LinearRow] = []
    met: set[int] = set()
    while left:
        following = min(left, key=lambda row: len(row.terms.keys() - met))
        left.remove(following)
        rows.append(following)
        met |= following.terms.keys()
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
    return {ratios: factor * coefficient for ratios, coefficient in polynomial.items()}


def _constant(speed: Fraction) -> GearFormula:
    return GearFormula("constant", {0: ONE}, {0: speed})


def _known(case: Transmission, gear: Gear, bodies: Sequence[int]) -> dict[int, Fraction]:
    """Return the given speeds of bodies (groups of connected links), relative to the input speed.

    Raises
    ------
    SingularError
        If given speeds contradict each other.
    """
    known = {HOUSING: ZERO}
    given = {link: speed for link, speed in gear.speeds.items() if not isinstance(speed, SpeedOf)}
    for link, speed in {case.gear_input(gear): 1.0, **given}.items():
        if known.setdefault(bodies[link], as_typed(speed)) != as_typed(speed):
            raise SingularError
    return known


def _rows(
    links: OwnLinks,
    gear: Gear,
    bodies: Sequence[int],
    known: Mapping[int, Fraction],
    fixed: Mapping[int, float],
) -> Iterator[LinearRow]:
    case = links.case
    unloaded, ratios = case.unloaded_converters(gear), case.gear_ratios(gear)
    of_kinds = {index for index, mechanism in enumerate(case.mechanisms) if mechanism.kind}
    if faulty := [n for n in of_kinds - unloaded if not ratios[n] or math.isnan(ratios[n])]:
        names = spoken([case.mechanisms[index].name for index in faulty])
        message = f"gear {gear.name}: without a speed ratio of {names} other than 0, its equations "
        raise CaseError("E279", f"{message}cannot be written: expected another gear")
    fixed = {**fixed, **{index: 1 / ratios[index] for index in of_kinds}}
    for index, mechanism in enumerate(case.mechanisms):
        if index in unloaded:
            continue
        of_links: Sequence[Term] = ((ONE, ZERO), (ZERO, -ONE), (-ONE, ONE))
        ratio = index
        if index in fixed:
            number, ratio = Fraction(fixed[index]), -1
            of_links = [(plain + number * more, ZERO) for plain, more in of_links]
        yield _row(ratio, zip(mechanism.links, of_links, strict=True), bodies, known)
    for spring in case.springs:
        terms = ((link, (as_typed(part), ZERO)) for link, part in spring.form.items())
        yield _row(-1, terms, bodies, known)
    for element, slip in gear.slip.items():
        first, second = case.shift_elements[element - 1].links
        row = _row(-1, [(first, (ONE, ZERO)), (second, (-ONE, ZERO))], bodies, known)
        if element not in gear.joining:
            yield row._replace(right=(row.right[0] + as_typed(float(slip)), ZERO))
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
    """Convert an equation of links to an equation of bodies with known speeds on the right side."""
    unknown: dict[int, Term] = {}
    right = (ZERO, ZERO)
    for link, (plain, more) in terms:
        body = bodies[link]
        if body in known:
            right = (right[0] - plain * known[body], right[1] - more * known[body])
        else:
            before = unknown.get(body, (ZERO, ZERO))
            unknown[body] = (before[0] + plain, before[1] + more)
    return LinearRow(ratio, {body: term for body, term in unknown.items() if any(term)}, right)
