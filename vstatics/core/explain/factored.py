"""Fractions of polynomials as written by hand: `(1 - u1)(1 - u3)`, `2 - 1/u`.

A fraction can be written as factors, as single terms, or as 1 plus a remainder, whichever is
shortest. The sign of each factor is chosen for readability. Polynomials have integer coefficients
and are calculated by the library FLINT.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from flint import fmpz, fmpz_mpoly


class Quotient(NamedTuple):
    """Fraction of polynomials without a common factor."""

    numer: fmpz_mpoly
    denom: fmpz_mpoly
    """Denominator, whose leading coefficient is positive."""


def reduced(numer: fmpz_mpoly, denom: fmpz_mpoly) -> Quotient:
    """Return the fraction of two polynomials, without their common factors."""
    common = numer.gcd(denom) * (1 if denom.leading_coefficient() > 0 else -1)
    return Quotient(numer // common, denom // common)


class Notation(NamedTuple):
    """Notation of symbols, products and powers."""

    symbols: Sequence[str]
    """Symbol of each generator of the polynomials."""
    times: str = " "
    power: str = "^"
    joined: str = ""
    """Multiplication sign between two factors in brackets; empty to omit the sign."""


def python(occurring: Sequence[int], count: int) -> Notation:
    """Return the notation of Python and SymPy, with u1, u2 and so on for occurring generators."""
    symbols = [f"u{occurring.index(n) + 1}" if n in occurring else "" for n in range(count)]
    return Notation(symbols, "*", "**", "*")


class _Written(NamedTuple):
    """Expression as text, and whether brackets are needed in a product or quotient."""

    text: str
    is_sum: bool = False
    is_product: bool = False

    @property
    def factor(self) -> str:
        return f"({self.text})" if self.is_sum else self.text

    @property
    def divisor(self) -> str:
        return f"({self.text})" if self.is_sum or self.is_product else self.text


def fraction(value: Quotient, notation: Notation) -> str:
    """Return the shortest form of a fraction of polynomials.

    Examples
    --------
    >>> from flint import Ordering, fmpz_mpoly_ctx
    >>> u, v = fmpz_mpoly_ctx.get(["u", "v"], Ordering.lex).gens()
    >>> [fraction(reduced(one, u), Notation("uv")) for one in (u - u**2, u**2 * v, 2 * u - 1)]
    ['1 - u', 'u v', '2 - 1/u']
    >>> [fraction(reduced(one, u), Notation("uv")) for one in (u + v - 1, (u - 1) * (1 - v))]
    ['(u + v - 1)/u', '(1 - 1/u)(1 - v)']
    >>> fraction(reduced(u, u - 1), Notation("uv"))
    'u/(u - 1)'
    """
    if len(factored(value.numer).factors) > 1:
        return _in_factors(value, notation).text  # products stay in factored form
    # The length of symbol names must not affect the choice of form.
    measure = Notation(["u"] * len(notation.symbols))
    measured, texts = (
        [form.text for form in (write(value, how) for write in _FORMS) if form is not None]
        for how in (measure, notation)
    )
    return min(zip(measured, texts, strict=True), key=lambda pair: len(pair[0]))[1]


def weighted(values: Sequence[Quotient], unknowns: Sequence[str], notation: Notation) -> str:
    """Return a sum of unknowns times fractions of polynomials, over a common denominator.

    Examples
    --------
    >>> from flint import Ordering, fmpz_mpoly_ctx
    >>> [u] = fmpz_mpoly_ctx.get(["u"], Ordering.lex).gens()
    >>> shares = [reduced(u**0, 1 - u), reduced(-u, 1 - u)]
    >>> weighted(shares, ["w_sun", "w_ring"], Notation("u"))
    '(w_sun - u w_ring)/(1 - u)'
    """
    divisor = values[0].denom
    for value in values[1:]:
        divisor *= value.denom // divisor.gcd(value.denom)
    below = factored(divisor)
    terms = []
    for value, unknown in zip(values, unknowns, strict=True):
        whole = value.numer * (divisor // value.denom) * (1 if below.number > 0 else -1)
        sign, text = _signed(whole, notation)
        term = unknown if text.text == "1" else f"{text.factor}{notation.times}{unknown}"
        terms.append((sign, term))
    terms.sort(key=lambda signed_term: signed_term[0] == "-")
    written = "".join(f" {sign} {term}" for sign, term in terms)
    written = written.removeprefix(" + ") if terms[0][0] == "+" else f"-{written[3:]}"
    positive = below._replace(number=abs(below.number))
    over = _product(positive, notation)
    if over.text == "1":
        return written
    return f"({written})/{over.divisor}" if len(values) > 1 else f"{written}/{over.divisor}"


def _signed(polynomial: fmpz_mpoly, notation: Notation) -> tuple[str, _Written]:
    """Return the sign and the factors of a polynomial as text. A factor can absorb a minus sign."""
    product = factored(polynomial)
    if product.number < 0:
        product, _ = _turned(product, Factored(1, []))
    text = _product(product._replace(number=abs(product.number)), notation)
    return ("-" if product.number < 0 else "+"), text


def _in_factors(value: Quotient, notation: Notation) -> _Written:
    """Return a fraction with factored numerator and denominator.

    A factor ``u - 1`` with the divisor u is written as ``1 - 1/u``.
    """
    above, below = factored(value.numer), factored(value.denom)
    above, below, inverse = _inverse(above, below)
    if above.number * below.number < 0:
        above, below = _turned(above, below)
    is_negative = above.number * below.number < 0
    quotient = _quotient(above, below, notation, inverse)
    return quotient._replace(text=f"-{quotient.factor}") if is_negative else quotient


def _quotient(
    above: Factored,
    below: Factored,
    notation: Notation,
    inverse: Sequence[tuple[fmpz_mpoly, int]] = (),
) -> _Written:
    top = _product(above._replace(number=abs(above.number)), notation, inverse)
    over = _product(below._replace(number=abs(below.number)), notation)
    return top if over.text == "1" else _Written(f"{top.factor}/{over.divisor}", is_product=True)


def _inverse(above: Factored, below: Factored) -> tuple[Factored, Factored, Powers]:
    """Separate the factors ``1 - 1/u`` from a fraction.

    The result is the remaining numerator and denominator, and the symbols u with the powers of
    their factors.
    """
    inverse = []
    top, bottom, number = [], below.factors, above.number
    for factor, power in above.factors:
        symbol = 1 - factor  # factors are stored as 1 - u, not as u - 1
        given = next(
            (have for candidate, have in bottom if candidate == symbol and len(candidate) == 1), 0
        )
        common = min(power, given)
        if common:
            inverse.append((symbol, common))
            number *= (-1) ** common
            bottom = [
                (candidate, have - common * (candidate == symbol)) for candidate, have in bottom
            ]
        if power > common:
            top.append((factor, power - common))
    remaining = [(factor, power) for factor, power in bottom if power]
    return Factored(number, top), below._replace(factors=remaining), inverse


def _turned(above: Factored, below: Factored) -> tuple[Factored, Factored]:
    """Return a fraction whose minus sign is absorbed by a factor that is as readable when negated.

    Without such a factor, the fraction is unchanged.
    """
    for part in (below, above):
        for place, (factor, power) in enumerate(part.factors):
            if power % 2 and balance(factor) == 0 and len(factor) > 1:
                factors = [*part.factors]
                factors[place] = (-factor, power)
                turned = part._replace(number=-part.number, factors=factors)
                return (above, turned) if part is below else (turned, below)
    return above, below


def _by_terms(value: Quotient, notation: Notation) -> _Written | None:
    """Return a fraction as a sum of terms, if the denominator is a single term."""
    if len(value.denom) > 1 or len(value.numer) < 2:
        return None
    ring = value.numer.context()
    text = ""
    for powers, factor in _ordered(value.numer):
        term = ring.from_dict({powers: factor})
        quotient = _in_factors(reduced(term, value.denom), notation).text
        minus = quotient.startswith("-")
        text += f" {'-' if minus else '+'} {quotient.lstrip('-')}" if text else quotient
    return _Written(text, is_sum=True)


def _one_and_rest(value: Quotient, notation: Notation) -> _Written | None:
    """Return a fraction as 1 plus or minus a factored remainder; None for simple fractions."""
    remainder = value.numer - value.denom
    if not remainder or len(remainder) == len(value.numer) == 1:
        return None
    above, below = factored(remainder), factored(value.denom)
    sign = "-" if above.number * below.number < 0 else "+"
    return _Written(f"1 {sign} {_quotient(above, below, notation).factor}", is_sum=True)


_FORMS = (_in_factors, _by_terms, _one_and_rest)


def _ordered(polynomial: fmpz_mpoly) -> list[tuple[tuple[int, ...], fmpz]]:
    """Return the terms of a polynomial: positive before negative, then short before long."""
    return sorted(polynomial.terms(), key=lambda term: (term[1] < 0, sum(term[0])))


def _product(
    product: Factored, notation: Notation, inverse: Sequence[tuple[fmpz_mpoly, int]] = ()
) -> _Written:
    """Return a product as text: single symbols before sums, in the order of the symbols.

    `inverse` contains the symbols u of further factors ``1 - 1/u`` with their powers.
    """
    factors = [
        (len(factor) > 1, _position(factor), _sum(factor, notation), power)
        for factor, power in product.factors
    ]
    factors += [
        (True, _position(symbol), f"1 - 1/{_sum(symbol, notation)}", power)
        for symbol, power in inverse
    ]
    factors.sort()
    if product.number == 1 and len(factors) == 1 and factors[0][-1] == 1:
        is_sum, _, text, _ = factors[0]
        return _Written(text, is_sum=is_sum)
    text = str(product.number) if product.number != 1 or not factors else ""
    for is_sum, _, written, power in factors:
        base = f"({written})" if is_sum else written
        raised = base if power == 1 else f"{base}{notation.power}{power}"
        bracketed = is_sum and text.endswith(")")
        text += f"{notation.joined if bracketed else notation.times}{raised}" if text else raised
    return _Written(text, is_product=len(factors) + (product.number != 1) > 1)


def _position(polynomial: fmpz_mpoly) -> tuple[int, ...]:
    """Return the sort key of a factor: the indices of its symbols."""
    return tuple(place for place, power in enumerate(polynomial.degrees()) if power)


def _sum(polynomial: fmpz_mpoly, notation: Notation) -> str:
    text = ""
    for powers, factor in _ordered(polynomial):
        symbols = [
            symbol if power == 1 else f"{symbol}{notation.power}{power}"
            for symbol, power in zip(notation.symbols, powers, strict=True)
            if power
        ]
        size = abs(int(factor))
        parts = [str(size)] * (size != 1 or not symbols) + symbols
        minus = factor < 0
        front = (" - " if minus else " + ") if text else "-" * minus
        text += front + notation.times.join(parts)
    return text


Powers = list[tuple["fmpz_mpoly", int]]
"""Factors of a polynomial, with exponents."""


class Factored(NamedTuple):
    """Polynomial as an integer times powers of factors."""

    number: int
    factors: Powers


def factored(polynomial: fmpz_mpoly) -> Factored:
    """Return the factors of a polynomial, each with its most readable sign."""
    number, irreducible = polynomial.factor()
    factors = []
    alone = [place for place, power in enumerate(polynomial.degrees()) if power == 1]
    # Factors that alone contain a symbol come first, because the first factor absorbs a minus sign.
    for factor, power in sorted(
        irreducible,
        key=lambda item: ([-item[0].degrees()[n] for n in alone], item[0].monoms()),
    ):
        turned = _looks(-factor) > _looks(factor)
        factors.append((-factor if turned else factor, power))
        number = -number if turned and power % 2 else number
    return Factored(int(number), factors)


def balance(polynomial: fmpz_mpoly) -> int:
    """Return the number of positive terms minus the number of negative terms."""
    return sum(1 if factor > 0 else -1 for factor in polynomial.coeffs())


def _looks(polynomial: fmpz_mpoly) -> tuple[int, bool, bool]:
    """Return a sort key that is larger for the more readable of ``p`` and ``-p``.

    The key contains `balance`, then flags for a positive constant term and a positive leading term.
    """
    constant = polynomial[(0,) * len(polynomial.degrees())]
    return balance(polynomial), constant > 0, polynomial.leading_coefficient() > 0
