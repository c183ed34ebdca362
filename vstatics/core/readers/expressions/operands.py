"""Operands of a formula as written: numbers, and names with subscripts or a point.

Names can contain any letters, such as Cyrillic, and coincide with keywords of Python. Their meaning
is resolved elsewhere.
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
"""Pattern of the parts of a name from the first point on: `.ratio`, `.*.torques.x`."""
_UNTIL_NEXT = re.compile(r"\"[^\"]*\"|'[^']*'|[^,\]\"']*")
_BLANK = re.compile(r"\s*")
_SUBSCRIPT = re.compile(rf"\"[^\"]*\"|'[^']*'|:|#?[0-9]+|{DOTTED}")
_COMPARED, _COMPARES = re.compile(r"[!=]=\s*$"), re.compile(r"\s*[!=]=")
_QUOTES = ('"', "'")


class Constant(NamedTuple):
    """Number in a formula."""

    value: float


class Velocity(Constant):
    """Speed of a vehicle [m/s]. Its link, and so its angular speed, is not known yet."""

    at: int = 0
    written: str = ""

    @classmethod
    def of(cls, value: float, written: str, at: int) -> Velocity:
        """Return a vehicle speed [m/s], with the text and the offset in the formula.

        >>> Velocity.of(5.0, "18 km/h", 3).written
        '18 km/h'
        """
        velocity = cls(value)
        velocity.at, velocity.written = at, written
        return velocity


class Subscript(NamedTuple):
    """Selection of rows or gears: a name, a number, `#` followed by a number, or `:` for all."""

    written: str
    """Text of the subscript, including quotes."""
    at: int


class TableName(NamedTuple):
    """Name of a table or quantity, with optional subscripts."""

    name: str
    subscripts: tuple[Subscript, ...]
    at: int


class DottedName(NamedTuple):
    """Name, point and word, such as `D1.ratio`, `"set 1".ratio` or `#1.ratio`."""

    written: str
    at: int


def read_number(source: Excerpt, at: int) -> tuple[Constant, int] | None:
    """Return an unsigned number and its end offset; None without a number.

    Raises
    ------
    ReadError
        If a name begins with a digit and is not quoted, or the number is too large.

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
        raise source.error(
            f"read {quoted(word)}, expected a number without `_`: {word.replace('_', '')}", at
        )
    if word != text:
        name, dot, attribute = word.partition(".")
        correct = f'"{name}".{attribute}' if dot and NAME.fullmatch(attribute) else f'"{word}"'
        product = quoted(f"{text}*{word.removeprefix(text)}")
        expected = f"expected a number; write {product}, or a name in quotes"
        raise source.error(f"read {quoted(word)}, {expected}: {correct}", at)
    if float(text) == float("inf"):
        raise source.error(f"read {quoted(text)}, expected a number below 1.8e308", at)
    return Constant(float(text)), end


def quantity_end(source: Excerpt, at: int) -> int:
    """Return the offset after a number with a unit; `at` without a number.

    >>> quantity_end(Excerpt("36 km/h and t > 2", "when"), 0)
    7
    """
    return source.end_of(_QUANTITY, at)


def read_dotted(source: Excerpt, at: int) -> tuple[DottedName, int] | None:
    """Return a name with a point, and its end offset; None without such a name.

    Raises
    ------
    ReadError
        If a quoted name or `#` is not followed by a point.

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
        advice = "it belongs between the brackets of a table, or before `.ratio`"
        if _COMPARED.search(source.text[:at]) or _COMPARES.match(source.text, end):
            advice = "numbers are compared, not texts; in a sweep `ok` is true where `status` is ok"
        message = f"read {quoted(source.text[at:end])} alone; {advice}"
    elif first == "#":
        message = "read `#`, expected `#` and a number, such as #2"
    else:
        message = f"the quote {first} is not closed"
    raise source.error(message, at)


def read_subscripts(source: Excerpt, bracket: int) -> tuple[tuple[Subscript, ...], int]:
    """Return the subscripts in brackets after a name, and the offset after the brackets.

    Raises
    ------
    ReadError
        At the first text that is not a subscript, or if the bracket is not closed.

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


def _no_subscript(written: str, text: str) -> str:
    """Return the message about a text in brackets that is not a subscript."""
    if not written and text.startswith(_QUOTES):
        return f"the quote {text[0]} is not closed"
    expected = "expected a name, a number such as #2, or `:` for all"
    if written and not written.startswith(("#", ":")):
        expected += f'; write a name with other characters in quotes: "{written}"'
    return f"read {quoted(written) if written else 'nothing'}, {expected}"
