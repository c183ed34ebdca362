"""Numbers in the fields of a deck, read like Fortran's list-directed input."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from math import isfinite
from typing import TypeVar

from vstatics.core.readers.deck.text import Field, Scan, latin
from vstatics.core.readers.signs import dash_hint
from vstatics.core.start import NamedTuple

Number = TypeVar("Number", int, float)
Parse = Callable[[str], Number]
"""Function that reads a number from a text, or raises NotANumberError."""
Spot = tuple[int, int]
"""Line and column in the text, from 1."""
_WRITTEN = r"[-+]?\.?[0-9][-+.0-9EDQЕ*]*(?=[\s,:%]|\Z)"
# Blanks around the sign are permitted only if no word follows, because the sign could begin a
# remark.
_TOKEN = rf"{_WRITTEN}\s*(?::\s*{_WRITTEN}|%)(?=\s*(?:,\s*)?(?:\Z|{_WRITTEN}))|[^\s,]+|,"
"""Pattern of a token: a number, a ratio, a percentage, a comma or a word."""
REPEATED = r"([0-9]{1,18})\*(.+)"
INTEGER = re.compile(r"[+-]?[0-9]+")
REAL = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))(?:[EDQ]([+-]?[0-9]+)|([+-][0-9]+))?")
_RELATED = r"(?P<first>[^:%]*[^:%\s])\s*(?P<sign>[:%])\s*(?P<second>.*)"
_QUOTIENT = re.compile(r"[-+.\d]+/[.\d]+")
"""Pattern of a quotient as written in YAML. In a deck, a quotient has a colon."""
DECIMAL_COMMA = r"(?<![.0-9])[0-9]*,[0-9]+(?![.0-9])"
LONGEST_DECK_NUMBER = 1000
"""Maximum number of characters of a number. More characters add no information."""


class Token(NamedTuple):
    """Number, comma or word on a line of values."""

    text: str
    line: int
    column: int

    @property
    def spot(self) -> Spot:
        """Line and column of the token."""
        return self.line, self.column

    @property
    def after(self) -> int:
        """Column after the last character of the token."""
        return self.column + len(self.text)


class NotANumberError(ValueError):
    """Error about a token that is not a number; the message states the expected number."""


def integer(text: str) -> int:
    """Read a whole number as Fortran does.

    Raises
    ------
    NotANumberError
        If the text is not a whole number.
    """
    if INTEGER.fullmatch(text) is None:
        raise NotANumberError(f"expected a whole number{dash_hint(text)}")
    if len(text) > 18:
        raise NotANumberError("which overflows; expected a whole number")
    return int(text)


def real(text: str) -> float:
    """Read a percentage, a ratio, or a number as Fortran does.

    Raises
    ------
    NotANumberError
        If the text is not a number, or overflows.

    Examples
    --------
    >>> real("-.8"), real(".26Е+01"), real("2.6D0"), real(".1+3")
    (-0.8, 2.6, 2.6, 100.0)
    >>> real("-5 : 2"), real("96%")
    (-2.5, 0.96)
    """
    related = None
    if (":" in text or "%" in text) and len(text) <= LONGEST_DECK_NUMBER:
        related = re.fullmatch(_RELATED, text)
    if related is None or (related["sign"] == "%") == bool(related["second"]):
        return _fortran_number(text)
    first, sign, second = related.groups()
    second = second and repr(_fortran_number(second))
    return worked_out(f"{_fortran_number(first)!r} {sign} {second}")


def worked_out(calculation: str) -> float:
    """Return the value of a calculation in the notation of YAML cases, such as ``96/39``.

    Raises
    ------
    NotANumberError
        If the text is not a calculation, or overflows.
    """
    from vstatics.core.readers.named.arithmetic import dimensionless  # costs start-up time

    try:
        return dimensionless(calculation)
    except ValueError as error:
        raise NotANumberError(str(error)) from None


def _fortran_number(text: str) -> float:
    match = REAL.fullmatch(latin(text)) if len(text) <= LONGEST_DECK_NUMBER else None
    if match is None:
        quotient = text.replace("/", ":") if _QUOTIENT.fullmatch(text) else ""
        hint = f"; write the quotient as `{quotient}`" if quotient else dash_hint(text)
        raise NotANumberError(f"expected a number such as -.8 or .26E+01{hint}")
    number = float(f"{match[1]}E{match[2] or match[3] or 0}")
    if not isfinite(number):
        raise NotANumberError("which overflows; expected a number below 1.8E+308")
    return number


def value_lines(scan: Scan, field: Field) -> Iterator[tuple[int, str, int, int]]:
    """Yield line number, text, start and end of each line of a field, up to the next field."""
    following = bisect_right(scan.stops, field.line)
    last = scan.stops[following] - 1 if following < len(scan.stops) else scan.last
    lines = scan.source.lines
    text = lines[field.line - 1]
    yield field.line, text, field.value, len(text) if field.end is None else field.end
    if field.end is None:
        for number in range(field.line + 1, last + 1):
            text = lines[number - 1]
            yield number, text, 0, len(text)


def token_lines(scan: Scan, field: Field) -> Iterator[list[Token]]:
    """Yield the tokens of each line of a field, without blank lines."""
    pattern = re.compile(_TOKEN, re.IGNORECASE)  # most decks are read without it
    for number, text, start, end in value_lines(scan, field):
        matches = pattern.finditer(text, start, end)
        tokens = [Token(match[0], number, match.start() + 1) for match in matches]
        if tokens:
            yield tokens


def plain_numbers(text: str, parse: Parse[Number]) -> tuple[Number, ...] | None:
    """Return the blank-separated numbers of a text; None if the text contains anything else."""
    try:
        return tuple(map(parse, text.split()))
    except NotANumberError:
        return None


def repeated(token: Token, parse: Parse[Number]) -> tuple[int, Number]:
    """Return the repeat count and the number of a token, such as 3 and 0.5 for ``3*0.5``.

    Raises
    ------
    NotANumberError
        If the token is not a number.
    """
    match = re.fullmatch(REPEATED, token.text) if "*" in token.text else None
    if match is None:
        return 1, parse(token.text)
    if int(match[1]) == 0:
        raise NotANumberError("expected a repeat count above 0")
    return int(match[1]), parse(match[2])


def numbers_alone(tokens: Sequence[Token]) -> bool:
    """Return whether a line contains only numbers and commas."""
    return all(token.text == "," or is_number(token) for token in tokens)


def leading_numbers(tokens: Sequence[Token]) -> int:
    """Return the count of numbers before the first token that is not a number."""
    total = 0
    for token in tokens:
        if token.text != ",":
            try:
                total += repeated(token, real)[0]
            except NotANumberError:
                break
    return total


def is_number(token: Token) -> bool:
    """Return whether a token is a number, possibly with a repeat count."""
    return leading_numbers([token]) > 0


def is_attempt(token: Token) -> bool:
    """Return whether a token is a number or a mistyped number, in contrast to a word."""
    word = token.text.lstrip("+-").upper()
    return word in ("NAN", "INF", "INFINITY") or any(sign in "0123456789" for sign in word)


def starts_values(tokens: Sequence[Token]) -> bool:
    """Return whether a line begins with a number or a mistyped number, in contrast to prose."""
    words = (token for token in tokens if token.text != ",")
    return any(is_attempt(token) for token in islice(words, 1))


def loose_count(scan: Scan, key: str) -> int:
    """Estimate the number of values in a field whose size is unknown."""
    total = 0
    for tokens in token_lines(scan, scan.fields[key]) if key in scan.fields else ():
        count = leading_numbers(tokens)
        total += count
        if count < sum(token.text != "," for token in tokens):
            break
    return total
