"""Fractions of polynomials as written by hand: `(1 - u1)(1 - u3)`, `2 - 1/u`.

A fraction can be written as factors, as single terms, or as 1 plus a remainder, whichever is
shortest. The sign of each factor is chosen for readability. Polynomials are objects of
`sympy.polys` with integer coefficients.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

Fraction = Any
"""Fraction of polynomials, `sympy.polys.fields.FracElement`."""


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


def fraction(value: Fraction, notation: Notation) -> str:
    """Return the shortest form of a fraction of polynomials.

    Examples
    --------
    >>> from sympy import ZZ
    >>> from sympy.polys.fields import field
    >>> _, u, v = field("u, v", ZZ)
    >>> [fraction(one, Notation("uv")) for one in (1 - u, (1 - u) * (1 - v), u / (u - 1), u * v)]
    ['1 - u', '(1 - u)(1 - v)', 'u/(u - 1)', 'u v']
    >>> [fraction(one, Notation("uv")) for one in (2 - 1 / u, (u + v - 1) / u, 1 - u * v)]
    ['2 - 1/u', '(u + v - 1)/u', '1 - u v']
    >>> fraction((u - 1) / u * (1 - v), Notation("uv"))
    '(1 - 1/u)(1 - v)'
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


def weighted(values: Sequence[Fraction], unknowns: Sequence[str], notation: Notation) -> str:
    """Return a sum of unknowns times fractions of polynomials, over a common denominator.

    Examples
    --------
    >>> from sympy import ZZ
    >>> from sympy.polys.fields import field
    >>> _, u = field("u", ZZ)
    >>> weighted([1 / (1 - u), -u / (1 - u)], ["w_sun", "w_ring"], Notation("u"))
    '(w_sun - u w_ring)/(1 - u)'
    """
    divisor = values[0].denom
    for value in values[1:]:
        divisor = divisor.lcm(value.denom)
    below = factored(divisor)
    terms = []
    for value, unknown in zip(values, unknowns, strict=True):
        whole = (value * divisor).numer * (1 if below.number > 0 else -1)
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


def _signed(polynomial: Polynomial, notation: Notation) -> tuple[str, _Written]:
    """Return the sign and the factors of a polynomial as text. A factor can absorb a minus sign."""
    product = factored(polynomial)
    if product.number < 0:
        product, _ = _turned(product, Factored(1, []))
    text = _product(product._replace(number=abs(product.number)), notation)
    return ("-" if product.number < 0 else "+"), text


def _in_factors(value: Fraction, notation: Notation) -> _Written:
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
    inverse: Sequence[tuple[Polynomial, int]] = (),
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


def _by_terms(value: Fraction, notation: Notation) -> _Written | None:
    """Return a fraction as a sum of terms, if the denominator is a single term."""
    if len(value.denom) > 1 or len(value.numer) < 2:
        return None
    field = value.parent()
    text = ""
    for term in _ordered(value.numer):
        quotient = _in_factors(field(term) / field(value.denom), notation).text
        minus = quotient.startswith("-")
        text += f" {'-' if minus else '+'} {quotient.lstrip('-')}" if text else quotient
    return _Written(text, is_sum=True)


def _one_and_rest(value: Fraction, notation: Notation) -> _Written | None:
    """Return a fraction as 1 plus or minus a factored remainder; None for simple fractions."""
    remainder = value - 1
    if not remainder or len(remainder.numer) == len(value.numer) == 1:
        return None
    above, below = factored(remainder.numer), factored(remainder.denom)
    sign = "-" if above.number * below.number < 0 else "+"
    return _Written(f"1 {sign} {_quotient(above, below, notation).factor}", is_sum=True)


_FORMS = (_in_factors, _by_terms, _one_and_rest)


def _ordered(polynomial: Polynomial) -> list[Polynomial]:
    """Return the terms of a polynomial: positive before negative, then short before long."""
    terms = sorted(polynomial.terms(), key=lambda term: (term[1] < 0, sum(term[0])))
    ring = polynomial.ring
    return [ring({powers: factor}) for powers, factor in terms]


def _product(
    product: Factored, notation: Notation, inverse: Sequence[tuple[Polynomial, int]] = ()
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


def _position(polynomial: Polynomial) -> tuple[int, ...]:
    """Return the sort key of a factor: the indices of its symbols."""
    occurring = {place for powers, _ in polynomial.terms() for place, p in enumerate(powers) if p}
    return tuple(sorted(occurring))


def _sum(polynomial: Polynomial, notation: Notation) -> str:
    text = ""
    for term in _ordered(polynomial):
        [(powers, factor)] = term.terms()
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


Polynomial = Any
"""Polynomial with integer coefficients, `sympy.polys.rings.PolyElement`."""

Powers = list[tuple[Polynomial, int]]
"""Factors of a polynomial, with exponents."""


class Factored(NamedTuple):
    """Polynomial as an integer times powers of factors."""

    number: int
    factors: Powers


def factored(polynomial: Polynomial) -> Factored:
    """Return the factors of a polynomial, each with its most readable sign."""
    number, primitive = polynomial.primitive()
    factors = []
    for factor, power in _factors(primitive):
        if factor.is_ground:
            number *= factor.LC**power
            continue
        turned = _looks(-factor) > _looks(factor)
        factors.append((-factor if turned else factor, power))
        number = -number if turned and power % 2 else number
    return Factored(int(number), factors)


def _factors(polynomial: Polynomial) -> Powers:
    """Return the factors of a polynomial, whose coefficients must have no common factor.

    If a symbol u occurs only in the first power, the polynomial is ``a + b u``. The greatest common
    divisor of a and b is then a factor, and the quotient is irreducible. SymPy's factorisation is
    not used, because it is slow for many symbols.
    """
    if polynomial.is_ground:
        return [(polynomial, 1)]
    powers = [max(exponents) for exponents in zip(*polynomial.monoms(), strict=True)]
    if 1 not in powers:
        constant, factors = polynomial.factor_list()
        return [(polynomial.ring(constant), 1), *factors]
    place = powers.index(1)
    ring = polynomial.ring
    symbol = ring.gens[place]
    with_it = ring(
        {exponents: factor for exponents, factor in polynomial.terms() if exponents[place]}
    )
    common = with_it.quo(symbol).gcd(polynomial - with_it)
    return [(polynomial.quo(common), 1), *_factors(common)]


def balance(polynomial: Polynomial) -> int:
    """Return the number of positive terms minus the number of negative terms."""
    return sum(1 if factor > 0 else -1 for _, factor in polynomial.terms())


def _looks(polynomial: Polynomial) -> tuple[int, bool, bool]:
    """Return a sort key that is larger for the more readable of ``p`` and ``-p``.

    The key contains `balance`, then flags for a positive constant term and a positive leading term.
    """
    return balance(polynomial), polynomial.coeff(1) > 0, polynomial.LC > 0
