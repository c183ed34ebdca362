"""The numbers of a deck's fields, as Fortran's list-directed input takes them."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from math import isfinite
from typing import NamedTuple, TypeVar

from vstatics.core.readers.deck.text import Field, Scan, latin
from vstatics.core.readers.signs import dash_hint

Number = TypeVar("Number", int, float)
_WRITTEN = r"[-+]?\.?[0-9][-+.0-9EDQЕ*]*(?=[\s,:%]|\Z)"
TOKEN = re.compile(
    # blanks around the sign only where words cannot follow, in which it may be a comment
    rf"{_WRITTEN}\s*(?::\s*{_WRITTEN}|%)(?=\s*(?:,\s*)?(?:\Z|{_WRITTEN}))|[^\s,]+|,",
    re.IGNORECASE,
)
"""A number, a ratio or a percentage, or what stands in its place."""
REPEATED = r"([0-9]{1,18})\*(.+)"
INTEGER = re.compile(r"[+-]?[0-9]+")
REAL = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))(?:[EDQ]([+-]?[0-9]+)|([+-][0-9]+))?")
_RELATED = re.compile(r"(?P<first>[^:%]*[^:%\s])\s*(?P<sign>[:%])\s*(?P<second>.*)")
DECIMAL_COMMA = r"(?<![.0-9])[0-9]*,[0-9]+(?![.0-9])"
LONGEST_DECK_NUMBER = 1000
"""Characters of a number; none that means anything is longer."""


class Token(NamedTuple):
    """A number, or what stands in its place, or a comma."""

    text: str
    line: int
    column: int

    @property
    def spot(self) -> tuple[int, int]:
        """Where it stands."""
        return self.line, self.column

    @property
    def after(self) -> int:
        """The column after it."""
        return self.column + len(self.text)


class NotANumberError(ValueError):
    """A token is no number; says what was expected."""


def integer(text: str) -> int:
    """A whole number, as Fortran reads it.

    Raises
    ------
    NotANumberError
        If it is none.
    """
    if INTEGER.fullmatch(text) is None:
        raise NotANumberError(f"expected a whole number{dash_hint(text)}")
    if len(text) > 18:
        raise NotANumberError("which overflows; expected a whole number")
    return int(text)


def real(text: str) -> float:
    """A number, as Fortran reads it, a percentage or a ratio of two such numbers.

    Raises
    ------
    NotANumberError
        If it is none, or overflows.

    Examples
    --------
    >>> real("-.8"), real(".26Е+01"), real("2.6D0"), real(".1+3")
    (-0.8, 2.6, 2.6, 100.0)
    >>> real("-5 : 2"), real("96%")
    (-2.5, 0.96)
    """
    related = _RELATED.fullmatch(text) if len(text) <= LONGEST_DECK_NUMBER else None
    if related is None or (related["sign"] == "%") == bool(related["second"]):
        return _of_fortran(text)
    first, sign, second = related.groups()
    second = second and repr(_of_fortran(second))
    return worked_out(f"{_of_fortran(first)!r} {sign} {second}")


def worked_out(calculation: str) -> float:
    """A calculation, as other formats of cases take it.

    Raises
    ------
    NotANumberError
        If it is none, or overflows.
    """
    from vstatics.core.readers.named.arithmetic import dimensionless  # costs start-up time

    try:
        return dimensionless(calculation)
    except ValueError as error:
        raise NotANumberError(str(error)) from None


def _of_fortran(text: str) -> float:
    match = REAL.fullmatch(latin(text)) if len(text) <= LONGEST_DECK_NUMBER else None
    if match is None:
        raise NotANumberError(f"expected a number such as -.8 or .26E+01{dash_hint(text)}")
    number = float(f"{match[1]}E{match[2] or match[3] or 0}")
    if not isfinite(number):
        raise NotANumberError("which overflows; expected a number below 1.8E+308")
    return number


def value_lines(found: Scan, field: Field) -> Iterator[tuple[int, str, int, int]]:
    """The lines to the next field: number, text, and where values start and end in it."""
    following = bisect_right(found.stops, field.line)
    last = found.stops[following] - 1 if following < len(found.stops) else found.last
    lines = found.source.lines
    text = lines[field.line - 1]
    yield field.line, text, field.value, len(text) if field.end is None else field.end
    if field.end is None:
        for number in range(field.line + 1, last + 1):
            text = lines[number - 1]
            yield number, text, 0, len(text)


def token_lines(found: Scan, field: Field) -> Iterator[list[Token]]:
    """The tokens of a field line by line, blank lines aside, to the next field."""
    for number, text, start, end in value_lines(found, field):
        matches = TOKEN.finditer(text, start, end)
        tokens = [Token(match[0], number, match.start() + 1) for match in matches]
        if tokens:
            yield tokens


def plain_numbers(text: str, parse: Callable[[str], Number]) -> tuple[Number, ...] | None:
    """The numbers of a text with blanks between them; None if there is anything else."""
    try:
        return tuple(map(parse, text.split()))
    except NotANumberError:
        return None


def repeated(token: Token, parse: Callable[[str], Number]) -> tuple[int, Number]:
    """How often a token stands for its number, and the number; nothing is expanded.

    Raises
    ------
    NotANumberError
        If it is no number.
    """
    match = re.fullmatch(REPEATED, token.text) if "*" in token.text else None
    if match is None:
        return 1, parse(token.text)
    if int(match[1]) == 0:
        raise NotANumberError("expected a repeat count above 0")
    return int(match[1]), parse(match[2])


def numbers_alone(tokens: Sequence[Token]) -> bool:
    """Whether a line holds numbers and nothing else."""
    return all(token.text == "," or is_number(token) for token in tokens)


def leading_numbers(tokens: Sequence[Token]) -> int:
    """How many numbers there are before the first thing that is none."""
    total = 0
    for token in tokens:
        if token.text != ",":
            try:
                total += repeated(token, real)[0]
            except NotANumberError:
                break
    return total


def is_number(token: Token) -> bool:
    """Whether a token is a number, repeated or not."""
    return leading_numbers([token]) > 0


def is_attempt(token: Token) -> bool:
    """Whether a token is a number or a mistyped one, not a word of prose."""
    word = token.text.lstrip("+-").upper()
    return word in ("NAN", "INF", "INFINITY") or any(sign in "0123456789" for sign in word)


def starts_values(tokens: Sequence[Token]) -> bool:
    """Whether a line starts with a number or a mistyped one, and so is not prose."""
    words = (token for token in tokens if token.text != ",")
    return any(is_attempt(token) for token in islice(words, 1))


def loose_count(found: Scan, key: str) -> int:
    """How many numbers a field seems to hold, when the size that says so is unknown."""
    total = 0
    for tokens in token_lines(found, found.fields[key]) if key in found.fields else ():
        count = leading_numbers(tokens)
        total += count
        if count < sum(token.text != "," for token in tokens):
            break
    return total
