"""What an expression speaks of: numbers, tables, varied numbers, functions.

Names of a case are taken letter by letter as they are written, so they may be Cyrillic, or
words that mean something elsewhere.
"""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

from vstatics.errors import nearest
from vstatics.sweep.expressions.source import Source, quoted
from vstatics.sweep.targets import QUANTITIES
from vstatics.tables.rows import is_bare

FUNCTIONS = ("min", "max", "abs", "sum")
EXPECTED = "a number, a table such as ratio[1], a varied number such as D1.ratio, or a function"

_NUMBER = re.compile(r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_WORD = re.compile(r"\w*")
_HASH = re.compile(r"#[0-9]+(?!\w)")
_TO_NEXT_KEY = re.compile(r"[^,\]\"']*")
PYTHON = ("lambda", "for", "in", "if", "else", "is", "await", "async", "yield", "from", "import")
"""What the parser's own language has and ours has not."""


class Key(NamedTuple):
    """What tells a row or a gear: one of the parts between the brackets of a table."""

    kind: Literal["all", "bare", "quoted", "number"]
    text: str
    """Without quotes and `#`."""
    at: int


class Number(NamedTuple):
    """A number as it is written."""

    value: float
    at: int


class Table(NamedTuple):
    """A table of the results, or a part of one."""

    name: str
    keys: tuple[Key, ...] | None
    at: int


class Varied(NamedTuple):
    """A number of a mechanism: `D1.ratio`."""

    text: str
    at: int


class Call(NamedTuple):
    """The name of a function, before its bracket."""

    name: str
    at: int


Operand = Number | Table | Varied | Call


def read_operand(source: Source, at: int) -> tuple[Operand, int] | None:
    """Read the operand that begins at an offset.

    Returns
    -------
    tuple of Operand and int, or None
        The operand and where it ends; None if no operand begins here.

    Raises
    ------
    ReadError

    Examples
    --------
    >>> read_operand(Source("speeds[C1, #2] < 3", "--where"), 0)
    (Table(name='speeds', keys=(Key(kind='bare', text='C1', at=7), \
Key(kind='number', text='2', at=11)), at=0), 14)
    """
    if source.has(at, '"', "'", "#"):
        return _varied(source, at)
    number = source.matched(_NUMBER, at)
    if number:
        return _number(source, at, number), at + len(number)
    name = source.name(at)
    return _named(source, at, name) if name else None


def _number(source: Source, at: int, text: str) -> Number:
    """A number; a name that begins like one is told to go in quotes."""
    word = text + source.matched(_WORD, at + len(text))
    if re.fullmatch(r"[0-9_]+_[0-9]+", word):
        message = f"read {quoted(word)}, expected a number without `_`: {word.replace('_', '')}"
        raise source.error(message, at)
    if word != text:
        name, dot, quantity = word.partition(".")
        proper = f'"{name}".{quantity}' if dot and quantity in QUANTITIES else f'"{word}"'
        raise source.error(
            f"read {quoted(word)}, expected a number; a name that begins with a digit goes in "
            f"quotes: {proper}",
            at,
        )
    value = float(text)
    if value == float("inf"):
        raise source.error(f"read {quoted(text)}, expected a number below 1.8e308", at)
    return Number(value, at)


def _named(source: Source, at: int, name: str) -> tuple[Operand, int]:
    """What begins with a name: a function, a varied number or a table."""
    end = at + len(name)
    if source.has(end, "."):
        return _varied(source, at)
    behind = source.skip(end)
    if source.has(behind, "("):
        if name in FUNCTIONS:
            return Call(name, at), end
        hint = nearest(name, FUNCTIONS) or "; rows and gears of a table go in [ ]"
        message = f"there is no function {quoted(name)}, expected {', '.join(FUNCTIONS)}{hint}"
        raise source.error(message, at)
    if name in FUNCTIONS:
        message = f"`{name}` is a function, expected `(` behind it, such as {name}(ratio)"
        raise source.error(message, behind)
    if name in PYTHON:
        message = f"read `{name}`, which this language does not have; expected {EXPECTED}"
        raise source.error(message, at)
    if source.has(behind, "["):
        keys, end = _keys(source, behind)
        return Table(name, keys, at), end
    return Table(name, None, at), end


def _varied(source: Source, at: int) -> tuple[Varied, int]:
    """A mechanism, by name or number, then `.` and a word."""
    if source.has(at, "#"):
        end = at + len(source.matched(_HASH, at))
        if end == at:
            message = f"read {quoted(_rough(source, at))}, expected `#` and a number, such as #2"
            raise source.error(message, at)
    else:
        end = _quote_end(source, at) if source.has(at, '"', "'") else at + len(source.name(at))
    if not source.has(end, "."):
        where = "it belongs between the brackets of a table, or before `.ratio`"
        raise source.error(f"read {quoted(source.text[at:end])} alone; {where}", at)
    end += 1 + len(source.matched(_WORD, end + 1))
    return Varied(source.text[at:end], at), end


def _rough(source: Source, at: int) -> str:
    """What stands here up to the next blank."""
    return (source.text[at : source.end].split() or [""])[0]


def _quote_end(source: Source, at: int) -> int:
    """The end of a quoted name."""
    end = source.text.find(source.text[at], at + 1, source.end)
    if end < 0:
        raise source.error(f"the quote {source.text[at]} is not closed", at)
    return end + 1


def _keys(source: Source, bracket: int) -> tuple[tuple[Key, ...], int]:
    """What stands between the brackets of a table, and where it ends."""
    keys, at = [], bracket
    while True:
        key, end = _key(source, source.skip(at + 1))
        keys.append(key)
        at = source.skip(end)
        if source.has(at, "]"):
            return tuple(keys), at + 1
        if at == source.end:
            raise source.error("a bracket `[` is not closed, expected `]`", bracket)
        if not source.has(at, ","):
            message = f"read {quoted(_rough(source, at))}, expected `,` or `]`"
            raise source.error(message, at)


def _key(source: Source, at: int) -> tuple[Key, int]:
    if source.has(at, '"', "'"):
        end = _quote_end(source, at)
        return Key("quoted", source.text[at + 1 : end - 1], at), end
    word = source.matched(_TO_NEXT_KEY, at).rstrip()
    end = at + len(word)
    if word == ":":
        return Key("all", word, at), end
    if _HASH.fullmatch(word):
        return Key("number", word[1:], at), end
    if is_bare(word):
        return Key("bare", word, at), end
    expected = "expected a name, a number such as #2, or `:` for all"
    if not word:
        raise source.error(f"read nothing, {expected}", at)
    if not word.startswith(("#", ":")):
        expected += f'; a name that is no plain word goes in quotes: "{word}"'
    raise source.error(f"read {quoted(word)}, {expected}", at)
