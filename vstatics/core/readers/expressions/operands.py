"""What a formula speaks of, as it is written: numbers, and names with subscripts or a point.

Names are taken letter by letter, so they may be Cyrillic, or words that mean something
elsewhere. What they mean is not asked here.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from vstatics.core.errors import quoted
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.tables.names import DOTTED, NAME

_NUMBER = re.compile(r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_QUANTITY = re.compile(rf"{_NUMBER.pattern} *[^\W\d_]+(?: */ *[^\W\d_]+)?(?!\w)")
_ANY_NAME = re.compile(rf"\"[^\"]*\"|'[^']*'|#[0-9]+(?!\w)|{NAME.pattern}")
_WORD = re.compile(r"\w*")
_MORE = re.compile(r"(?:\.(?:\w+|\*(?=\.)|\"[^\"]*\"|'[^']*'))+|\.")
"""What stands behind a name, from its point on: `.ratio`, `.*.torques.x`."""
_UNTIL_NEXT = re.compile(r"\"[^\"]*\"|'[^']*'|[^,\]\"']*")
_BLANK = re.compile(r"\s*")
_SUBSCRIPT = re.compile(rf"\"[^\"]*\"|'[^']*'|:|#?[0-9]+|{DOTTED.pattern}")
_COMPARED, _COMPARES = re.compile(r"[!=]=\s*$"), re.compile(r"\s*[!=]=")
_QUOTES = ('"', "'")


class Constant(NamedTuple):
    """A number."""

    value: float


class Velocity(Constant):
    """The speed of a vehicle in m/s, whose link is not known yet."""

    at: int = 0
    written: str = ""

    @classmethod
    def of(cls, value: float, written: str, at: int) -> Velocity:
        """A speed in m/s, as it is written at a place.

        >>> Velocity.of(5.0, "18 km/h", 3).written
        '18 km/h'
        """
        velocity = cls(value)
        velocity.at, velocity.written = at, written
        return velocity


class Subscript(NamedTuple):
    """What tells a row or a gear: a name, a number, `#` and a number, or `:` for all."""

    written: str
    """With its quotes, if it has any."""
    at: int


class TableName(NamedTuple):
    """A name, and its subscripts if it has any."""

    name: str
    subscripts: tuple[Subscript, ...]
    at: int


class DottedName(NamedTuple):
    """A name, a point, and a word: `D1.ratio`; also `"set 1".ratio` and `#1.ratio`."""

    written: str
    at: int


def read_number(source: Excerpt, at: int) -> tuple[Constant, int] | None:
    """A number and where it ends; a name that begins like one is told to go in quotes.

    Raises
    ------
    ReadError

    Examples
    --------
    >>> read_number(Excerpt("2.5e3*x", "--where"), 0)
    (Constant(value=2500.0), 5)
    """
    behind = source.end_of(_NUMBER, at)
    if behind == at:
        return None
    end = source.end_of(_WORD, behind)
    text, word = source.text[at:behind], source.text[at:end]
    if re.fullmatch(r"[0-9_]+_[0-9]+", word):
        message = f"read {quoted(word)}, expected a number without `_`: {word.replace('_', '')}"
        raise source.error(message, at)
    if word != text:
        name, dot, rest = word.partition(".")
        proper = f'"{name}".{rest}' if dot and NAME.fullmatch(rest) else f'"{word}"'
        expected = "expected a number; a name that begins with a digit goes in quotes"
        raise source.error(f"read {quoted(word)}, {expected}: {proper}", at)
    if float(text) == float("inf"):
        raise source.error(f"read {quoted(text)}, expected a number below 1.8e308", at)
    return Constant(float(text)), end


def quantity_end(source: Excerpt, at: int) -> int:
    """Where a number with a unit ends; where it begins if there is none.

    >>> quantity_end(Excerpt("36 km/h and t > 2", "when"), 0)
    7
    """
    return source.end_of(_QUANTITY, at)


def read_dotted(source: Excerpt, at: int) -> tuple[DottedName, int] | None:
    """A name with a point, and where it ends.

    Raises
    ------
    ReadError

    Examples
    --------
    >>> read_dotted(Excerpt('"set 1".ratio > -3', "--where"), 0)
    (DottedName(written='"set 1".ratio', at=0), 13)
    """
    end = source.end_of(_ANY_NAME, at)
    if end > at and source.has(".", end):
        end = source.end_of(_MORE, end)
        return DottedName(source.text[at:end], at), end
    first = source.text[at:end][:1] or source.text[at : source.end][:1]
    if first not in (*_QUOTES, "#"):
        return None
    if end > at:
        where = "it belongs between the brackets of a table, or before `.ratio`"
        if _COMPARED.search(source.text[:at]) or _COMPARES.match(source.text, end):
            where = "numbers are compared, not texts; in a sweep `ok` is true where `status` is ok"
        message = f"read {quoted(source.text[at:end])} alone; {where}"
    elif first == "#":
        message = "read `#`, expected `#` and a number, such as #2"
    else:
        message = f"the quote {first} is not closed"
    raise source.error(message, at)


def read_subscripts(source: Excerpt, bracket: int) -> tuple[tuple[Subscript, ...], int]:
    """What stands between the brackets behind a name, and where they end.

    Raises
    ------
    ReadError

    Examples
    --------
    >>> read_subscripts(Excerpt("[C1, #2] < 3", "--where"), 0)
    ((Subscript(written='C1', at=1), Subscript(written='#2', at=5)), 8)
    """
    subscripts, at = [], bracket
    while source.text[at] != "]":
        begin = source.end_of(_BLANK, at + 1)
        written = source.text[begin : source.end_of(_UNTIL_NEXT, begin)].rstrip()
        at = source.end_of(_BLANK, begin + len(written))
        if not _SUBSCRIPT.fullmatch(written):
            raise source.error(_no_subscript(written, source.text[begin : source.end]), begin)
        subscripts.append(Subscript(written, begin))
        if at == source.end:
            raise source.error("a bracket `[` is not closed, expected `]`", bracket)
        if source.text[at] not in ",]":
            raise source.error(f"read {quoted(source.text[at])}, expected `,` or `]`", at)
    return tuple(subscripts), at + 1


def _no_subscript(written: str, rest: str) -> str:
    """What to say of something between brackets that is no subscript."""
    if not written and rest.startswith(_QUOTES):
        return f"the quote {rest[0]} is not closed"
    expected = "expected a name, a number such as #2, or `:` for all"
    if written and not written.startswith(("#", ":")):
        expected += f'; a name that is no plain word goes in quotes: "{written}"'
    return f"read {quoted(written) if written else 'nothing'}, {expected}"
