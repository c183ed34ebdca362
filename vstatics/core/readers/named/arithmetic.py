"""Arithmetic before a unit or name: `-96/39`, `1.3*400 Nm`, `(2+3)*100 rpm`, `1.05*FL`.

The caller interprets the text after the number, such as a unit or the name of a link.
"""

from __future__ import annotations

import math
import operator
import re
from typing import NamedTuple

from vstatics.core.readers.signs import dash_hint, with_plain_blanks

LONGEST_ARITHMETIC = 1000
"""Maximum number of characters of a text with a number."""
MOST_ARITHMETIC_BRACKETS = 20
"""Maximum number of brackets that can be open at once."""

_FIGURE = r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?"
ARITHMETIC = rf"[-+ (]*{_FIGURE}[ )]*([-+*/][-+ (]*{_FIGURE}[ )]*)*"
"""Regular expression of a calculation for JSON Schema, which does not check brackets."""

DIMENSIONLESS = rf"{ARITHMETIC}(%|: *{ARITHMETIC})?"
"""Regular expression of a calculation, a percentage or a ratio, for JSON Schema."""

_GROUPED = re.compile(
    r"(?<![0-9.,])[1-9][0-9]{0,2}"
    r"(?:([ _'\u2019])[0-9]{3}(?:\1[0-9]{3})*(?![0-9])(?:[.,][0-9]+)?"
    r"|([.,])[0-9]{3}(?:\2[0-9]{3})*(?!\2)[.,][0-9]+)"
)
"""Number with grouped digits, such as 1 000, or 1.000,5 with a decimal sign of the other kind."""
_THOUSANDS = re.compile(r"(?<![0-9.,])[1-9][0-9]{0,2}(?:,[0-9]{3})+(?![0-9.,])")
"""Number with commas that can group digits, such as 2,590."""
# A match begins only where digits begin, so the search takes linear time.
_JOINED = re.compile(r"(?<![0-9_])[0-9]+(?:_[0-9]+)+(?:\.[0-9]+)?")
_FURTHER = re.compile(
    r"(?:^|(?<![\w^.])[0-9.]+) ?(?:\*\*|\^)|(?<![^\W\d_])(?:pi|π|sqrt)(?![^\W\d_])"
)
"""Power of a number, pi or a root, which formulas can contain but calculations cannot."""
_FUNCTION = re.compile(r"(?<![\w)])([^\W\d_]\w{1,19}) ?\([-+\d.]")
"""Pattern of the call of a function whose first argument begins with a number."""
_PERCENT = re.compile(r"per ?cent|pct|prozent|процент", re.IGNORECASE)
_PLAIN = re.compile(rf"[-+]?{_FIGURE}\Z")
_NUMBER = re.compile(rf" *{_FIGURE} *")
_SIGN = re.compile(r" *([-+])")
_OPEN, _CLOSED = re.compile(r" *\("), re.compile(r" *\) *")
_BINDING = tuple(
    # An operator must be followed by a number, unlike in 2000/min or 1.05*FL.
    re.compile(rf" *([{signs}])(?= *[-+]? *[.0-9(])")
    for signs in ("-+", "*/")
)


class UnitError(ValueError):
    """Error in the unit of an otherwise readable number."""


class LeadingNumber(NamedTuple):
    """Number, and the text after it without surrounding blanks: `Nm`, `/min`, `*FL`."""

    value: float
    behind: str


def calculated(text: str) -> LeadingNumber:
    """Return the number at the beginning of a text, a calculation with `+ - * /` and brackets.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> calculated("-96/39 "), calculated("(2 + 3)*100 rpm")
    (LeadingNumber(value=-2.4615384615384617, behind=''), LeadingNumber(value=500.0, behind='rpm'))
    >>> calculated("3000 1/min").behind, calculated("1.05*FL").behind
    ('1/min', '*FL')
    """
    if len(text) > LONGEST_ARITHMETIC:
        raise ValueError(f"expected a number of at most {LONGEST_ARITHMETIC} characters")
    if _PLAIN.match(text):
        return LeadingNumber(_finite(float(text)), "")
    reading = _Calculation(with_plain_blanks(text).strip(" "))
    return LeadingNumber(reading.joined(0, 0), reading.text[reading.at :])


def dimensionless(text: str) -> float:
    """Return the value of a calculation, a percentage, or a ratio of two numbers.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> [dimensionless(text) for text in ("98 %", "3.55:1", "5:2", "1 + 78/30")]
    [0.98, 3.55, 2.5, 3.6]
    >>> dimensionless("(100 - 3) %"), dimensionless("-2*5%")
    (0.97, -0.1)
    >>> dimensionless("1 - 0.5%")
    Traceback (most recent call last):
    ValueError: expected brackets around a sum in percent, such as (100 - 3) %
    """
    value, behind = calculated(text)
    if behind == "%":
        product = _Calculation(with_plain_blanks(text).strip(" "))
        product.joined(1, 0)
        if product.text[product.at :] != behind:  # 1 - 3 % can mean 0.97 or -0.02
            raise ValueError("expected brackets around a sum in percent, such as (100 - 3) %")
        return value / 100
    if behind.startswith(":"):
        divisor, behind = calculated(behind[1:])
        if not behind:
            return _applied("/", value, divisor)
    if behind:
        needless = behind[0].isalpha() and not slip_or_percent(text)
        raise ValueError(expected(text) + " (without a unit)" * needless)
    return value


def expected(text: str) -> str:
    """Return the message for a text that is not a number.

    >>> expected("1,5")
    'expected a number or a calculation such as -96/39 (with a decimal point)'
    >>> expected("97 percent")
    'expected a number or a calculation such as -96/39 (write `%`, or 0.97 for 97 %)'
    """
    return f"expected a number or a calculation such as -96/39{slip_or_percent(text)}"


def slip_or_percent(text: str) -> str:
    """Return the hint of `slip` or `further`, or a hint for a percentage in words."""
    hint = slip(text) or further(text)
    return hint or " (write `%`, or 0.97 for 97 %)" * bool(_PERCENT.search(text))


def further(text: str) -> str:
    """Return a hint for powers, pi and functions, which calculations must not contain.

    >>> further("80e9*pi"), further("^4/32 N*m/rad") == further("2**3"), further("9 kg*m**3")
    (' (a calculation can only contain numbers, `+ - * /` and brackets)', True, '')
    >>> further("sqr(12)*0.31")
    ' (a calculation can only contain numbers, `+ - * /` and brackets, not `sqr`)'
    """
    function = _FUNCTION.search(text)
    named = f", not `{function[1]}`" if function else ""
    hint = f" (a calculation can only contain numbers, `+ - * /` and brackets{named})"
    return hint * bool(function or _FURTHER.search(text))


def slip(text: str) -> str:
    """Return a hint for a number in typographic notation, or an empty text.

    >>> slip("1,5"), slip("\u22122.6"), slip("x")
    (' (with a decimal point)', ' (with `-` instead of `\u2212`)', '')
    >>> slip("1 500 rpm"), slip("1.234,56")
    (' (digits without blanks: 1500)', ' (digits without `.`: 1234.56)')
    >>> slip("1_00.5 N*m"), slip("1 000,5 kg")
    (' (digits without `_`: 100.5)', ' (digits without blanks: 1000.5)')
    >>> slip("-2,590 rpm"), slip("1,234,567")
    (' (2590, or 2.590 with a decimal point)', ' (digits without `,`: 1234567)')
    """
    if thousands := _THOUSANDS.search(text):
        whole, point = thousands[0].replace(",", ""), thousands[0].replace(",", ".")
        if point.count(".") > 1:
            return f" (digits without `,`: {whole})"
        return f" ({whole}, or {point} with a decimal point)"
    if grouped := _GROUPED.search(with_plain_blanks(text)):
        sign = grouped[1] or grouped[2]
        signs = "blanks" if sign == " " else f"`{sign}`"
        return f" (digits without {signs}: {grouped[0].replace(sign, '').replace(',', '.')})"
    if joined := _JOINED.search(text):
        return f" (digits without `_`: {joined[0].replace('_', '')})"
    return " (with a decimal point)" if "," in text else dash_hint(text)


class _Calculation:
    """Recursive parser of a calculation, reading from left to right."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """Match a pattern at the current position, and advance beyond the match."""
        match = pattern.match(self.text, self.at)
        self.at = match.end() if match else self.at
        return match

    def joined(self, level: int, brackets: int) -> float:
        """Return the value of a sum (level 0), a product (level 1) or an operand (level 2)."""
        if level == len(_BINDING):
            return self.operand(brackets)
        value = self.joined(level + 1, brackets)
        while sign := self.match(_BINDING[level]):
            value = _applied(sign[1], value, self.joined(level + 1, brackets))
        return value

    def operand(self, brackets: int) -> float:
        sign = self.match(_SIGN)
        if self.match(_OPEN):
            value = self.bracketed(brackets + 1)
        else:
            number = self.match(_NUMBER)
            if not number:
                raise ValueError(expected(self.text))
            value = _finite(float(number[0]))
        return -value if sign and sign[1] == "-" else value

    def bracketed(self, brackets: int) -> float:
        if brackets > MOST_ARITHMETIC_BRACKETS:
            raise ValueError(f"expected at most {MOST_ARITHMETIC_BRACKETS} open brackets")
        value = self.joined(0, brackets)
        if not self.match(_CLOSED):
            raise ValueError(f"{expected(self.text)}, and `)` after it")
        return value


_OPERATORS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def _applied(sign: str, left: float, right: float) -> float:
    if sign == "/" and right == 0:
        raise ValueError("expected a denominator other than 0")
    return _finite(_OPERATORS[sign](left, right))


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise ValueError("expected a smaller number")
    return value
