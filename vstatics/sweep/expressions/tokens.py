"""Text of an expression -> tokens, each checked to follow the one before it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.errors import ReadError
from vstatics.sweep.expressions.operands import (
    EXPECTED,
    PYTHON,
    Call,
    Number,
    Operand,
    Table,
    Varied,
    read_operand,
)
from vstatics.sweep.expressions.source import Source, quoted

MOST_CHARACTERS = 2000
MOST_BRACKETS = 50
"""So many may be open at once."""


class Sign(NamedTuple):
    """An operator, a bracket, a comma; or a word that is an operator."""

    text: str
    at: int


Token = Operand | Sign

_SIGN = re.compile(r"\*\*|[<>=!]=|[-+*/<>(),]")
_WORDS = ("and", "or", "not")
_PREFIXES = ("-", "+", "not", "(")
_ELSEWHERE = {
    "&&": "and",
    "&": "and",
    "||": "or",
    "|": "or",
    "^": "**",
    "<>": "!=",
    "//": "/",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "−": "-",
    "–": "-",
    "×": "*",
    "·": "*",
    "÷": "/",
    "==": "==",
    "!=": "!=",
    "=": "==",
    "!": "not",
}
"""What is written so elsewhere; longer signs before those that they begin with."""


def tokens(source: Source) -> Iterator[Token]:
    """Cut a text into tokens.

    Raises
    ------
    ReadError
        At the first place where something else was expected.

    Examples
    --------
    >>> for token in tokens(Source("2*(D1.ratio)", "--min")):
    ...     print(token)
    Number(value=2.0, at=0)
    Sign(text='*', at=1)
    Sign(text='(', at=2)
    Varied(text='D1.ratio', at=3)
    Sign(text=')', at=11)
    """
    if source.end - source.start > MOST_CHARACTERS:
        read = source.end - source.start
        message = f"read {read} characters, expected {MOST_CHARACTERS} at most"
        raise source.error(message, source.start)
    order, at = _Order(source), source.skip(source.start)
    while at < source.end:
        token, end = order.operand(at) if order.wanted else order.operator(at)
        order.take(token)
        yield token
        at = source.skip(end)
    order.finish()


class _Order:
    """What came before, what is open, and whether an operand has to follow."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.wanted = True
        self.before: Token | None = None
        self.open: list[Token | None] = []
        """What stands before each open bracket."""

    def operand(self, at: int) -> tuple[Token, int]:
        """What may stand where an operand is wanted: one, or a sign before one."""
        name = self.source.name(at)
        if name not in _WORDS:
            found = read_operand(self.source, at)
            if found:
                if self._touches(at):
                    message = f"expected a blank behind {_shown(self.before)}"
                    raise self.source.error(message, at)
                return found
        sign = name or self.source.matched(_SIGN, at)
        if sign not in _PREFIXES or self._foreign(at):
            raise self._no_operand(sign, at)
        if sign == "not" and not self._begins():
            message = f"put `not ...` behind {_shown(self.before)} in brackets: (not ...)"
            raise self.source.error(message, at)
        return Sign(sign, at), at + len(sign)

    def operator(self, at: int) -> tuple[Token, int]:
        """What may stand behind an operand."""
        sign = self.source.name(at) or self.source.matched(_SIGN, at)
        known = sign in ("and", "or") or bool(_SIGN.fullmatch(sign))
        if not known or sign == "(" or self._foreign(at):
            raise self._no_operator(at)
        if sign == "," and not (self.open and isinstance(self.open[-1], Call)):
            raise self.source.error("read `,`, expected an operator, or an end", at)
        if sign == ")" and not self.open:
            raise self.source.error("read `)`, but no bracket is open", at)
        return Sign(sign, at), at + len(sign)

    def take(self, token: Token) -> None:
        """Go on behind a token."""
        match token:
            case Sign("(", at):
                self.open.append(self.before)
                if len(self.open) > MOST_BRACKETS:
                    raise self.source.error(f"more than {MOST_BRACKETS} brackets are open", at)
            case Sign(")"):
                self.open.pop()
        self.wanted = isinstance(token, Call) or (isinstance(token, Sign) and token.text != ")")
        self.before = token

    def finish(self) -> None:
        """Check that the text may end here."""
        end = self.source.end
        if self.before is None:
            raise self.source.error(f"read nothing, expected {EXPECTED}", end)
        if self.wanted:
            message = f"the text ends behind {_shown(self.before)}, expected {EXPECTED}"
            raise self.source.error(message, end)
        if self.open:
            raise self.source.error("a bracket `(` is not closed, expected `)`", end)

    def _begins(self) -> bool:
        """Whether a condition begins here, so that `not` may stand before it."""
        before = self.before
        return before is None or (
            isinstance(before, Sign) and (before.text in ("(", ",") or before.text in _WORDS)
        )

    def _touches(self, at: int) -> bool:
        """Whether a word stands directly before this place."""
        before = self.before
        return (
            isinstance(before, Sign)
            and before.text in _WORDS
            and before.at + len(before.text) == at
        )

    def _foreign(self, at: int) -> str:
        """A sign that is written in another way here, or nothing."""
        sign = next((sign for sign in _ELSEWHERE if self.source.has(at, sign)), "")
        return sign if sign and _ELSEWHERE[sign] != sign else ""

    def _no_operand(self, sign: str, at: int) -> ReadError:
        """An error about something where an operand is wanted."""
        foreign = self._foreign(at)
        if foreign and _ELSEWHERE[foreign] in _PREFIXES:
            return self.source.error(f"read `{foreign}`, expected `{_ELSEWHERE[foreign]}`", at)
        if self.source.has(at, "["):
            message = "read `[`, expected a table before it, such as speeds[:,1]"
            return self.source.error(message, at)
        read = quoted(foreign or sign or self.source.text[at])
        behind = "" if self.before is None else f" behind {_shown(self.before)}"
        return self.source.error(f"read {read}{behind}, expected {EXPECTED}", at)

    def _no_operator(self, at: int) -> ReadError:
        """An error about something behind an operand."""
        foreign, before = self._foreign(at), self.before
        name = self.source.name(at)
        if foreign and foreign != "!":
            message = f"read `{foreign}`, expected `{_ELSEWHERE[foreign]}`"
        elif self.source.has(at, "["):
            message = "read `[`, but rows and gears belong to a table, such as speeds[:,1]"
        elif name in PYTHON:
            message = f"read `{name}`, which this language does not have"
        else:
            read = quoted(name or self.source.text[at])
            expected = "expected an operator such as `+`, `<` or `and`, or an end"
            message = f"read {read} behind {_shown(before)}, {expected}"
        return self.source.error(message, at)


def _shown(token: Token | None) -> str:
    """A token as it is called in a message."""
    match token:
        case Sign(text) | Varied(text):
            return quoted(text)
        case Call(name) | Table(name):
            return quoted(name)
        case Number(value):
            return quoted(f"{value:g}")
    return "nothing"
