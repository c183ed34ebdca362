"""Text of a formula -> tree: what binds how, not what names mean.

From the operator that binds least to the one that binds most::

    or | and | not x | < <= > >= == != | + - | * / | -x +x | **

An operand is a number, a name (see `operands`), `(x)` or `function(x, ...)`. The parser climbs
by precedence: an operand, then all operators behind it that bind at least as much as asked,
each with what binds more to its right.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any, NamedTuple, TypeAlias

from vstatics.errors import ReadError, nearest
from vstatics.sweep.expressions.excerpt import Excerpt, quoted
from vstatics.sweep.expressions.operands import (
    Constant,
    DottedName,
    TableName,
    read_dotted,
    read_number,
    read_subscripts,
)
from vstatics.tables.rows import NAME

MOST_CHARACTERS = 2000
MOST_BRACKETS = 50
"""So many may be open at once."""
MOST_DEPTH = 100
"""So many operations may stand one inside another, since trees are walked by recursion."""

_LOGIC = ("or", "and")
_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_LEVELS = (("or",), ("and",), ("not",), _COMPARISONS, ("+", "-"), ("*", "/"), ("-x",), ("**",))
_BINDS = {sign: level for level, signs in enumerate(_LEVELS) for sign in signs}
_PREFIXES = {"not": "not", "-": "-x", "+": "-x"}
"""Signs before an operand, and what they bind like."""
_BINARY = _BINDS.keys() - set(_PREFIXES.values())
_WORDS = (*_LOGIC, "not")
_ELSEWHERE = {
    "&&": "and",
    "&": "and",
    "||": "or",
    "|": "or",
    "!": "not",
    "^": "**",
    "//": "/",
    "=": "==",
    "<>": "!=",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "−": "-",
    "–": "-",
    "×": "*",
    "·": "*",
    "÷": "/",
}
"""Signs of other languages, and how they are written here."""
_PYTHON = ("lambda", "for", "in", "if", "else", "is", "await", "async", "yield", "from", "import")
"""Words that ask for more than this language has."""
_SIGN = re.compile(r"\*\*|<>|[<>=!]=|//|&&|\|\||[-+*/<>(),=!&|^≤≥≠−–×·÷]")
_BLANK = re.compile(r"\s*")


class Operation(NamedTuple):
    """An operator or a function, and what it is applied to."""

    name: str
    """The sign, `and`, `or`, `not`, `-x`, or the name of a function."""
    operands: tuple[Any, ...]
    """Trees; when names are resolved, what they mean in place of names."""
    at: int
    depth: int
    """How many parts stand one inside another."""


Tree: TypeAlias = Constant | TableName | DottedName | Operation


def parse(source: Excerpt, functions: Collection[str], operands: str) -> Tree:
    """Read a formula.

    Parameters
    ----------
    source : Excerpt
    functions : collection of str
        Their names.
    operands : str
        What an operand can be, for messages: ``a number, or the time t``.

    Returns
    -------
    Tree
        A chain ``a < b < c`` has become ``a < b and b < c``.

    Raises
    ------
    ReadError
        At the first place that can't be read.

    Examples
    --------
    >>> tree = parse(Excerpt("1 - ratio[2]**2", "--min"), ["abs"], "a number")
    >>> tree.name, tree.operands[0], tree.operands[1].name, tree.operands[1].at
    ('-', Constant(value=1.0), '**', 12)
    """
    read = source.end - source.start
    if read > MOST_CHARACTERS:
        message = f"read {read} characters, expected {MOST_CHARACTERS} at most"
        raise source.error(message, source.start)
    return _Parser(source, functions, operands).expression()


class _Parser:
    """Goes through a text from the left to the right."""

    def __init__(self, source: Excerpt, functions: Collection[str], operands: str) -> None:
        self.source = source
        self.functions = functions
        self.operands = operands
        self.calls: list[bool] = []
        """Whether each open bracket is that of a function."""
        self.take("", source.start)

    def take(self, read: str, end: int) -> None:
        """Go on behind what was read."""
        self.before, self.end_of_before = read, end
        self.at = self.skip(end)

    def skip(self, at: int) -> int:
        """The next place that is not blank."""
        match = _BLANK.match(self.source.text, at, self.source.end)
        return match.end() if match else at

    def matched(self, pattern: re.Pattern[str]) -> str:
        """What matches a pattern here; nothing if nothing does."""
        match = pattern.match(self.source.text, self.at, self.source.end)
        return match[0] if match else ""

    def has(self, sign: str, at: int) -> bool:
        return self.source.text.startswith(sign, at, self.source.end)

    def expression(self, least: int = 0, depth: int = 1) -> Tree:
        """Operands with operators between them that bind at least so much."""
        left = self.operand(least, depth)
        while (level := _BINDS.get(self.operator(), -1)) >= least:
            operands: list[Tree] = [left]
            signs: list[tuple[str, int]] = []
            while (sign := self.operator()) in _LEVELS[level]:
                signs.append((sign, self.at))
                self.take(sign, self.at + len(sign))
                behind = level if sign == "**" else level + 1  # a power goes from the right
                operands.append(self.expression(behind, depth + 1))
            left = self.joined(operands, signs)
        return left

    def joined(self, operands: Sequence[Tree], signs: Sequence[tuple[str, int]]) -> Tree:
        """Operands with operators of one level between them."""
        first, at = signs[0]
        if first in _LOGIC:
            return self.operation(first, operands, at)
        if first in _COMPARISONS:
            links = [
                self.operation(sign, operands[number : number + 2], place)
                for number, (sign, place) in enumerate(signs)
            ]
            return self.operation("and", links, at) if len(links) > 1 else links[0]
        left = operands[0]
        for (sign, place), right in zip(signs, operands[1:], strict=True):
            left = self.operation(sign, (left, right), place)
        return left

    def operation(self, name: str, operands: Sequence[Tree], at: int) -> Tree:
        depth = 1 + max(one.depth if isinstance(one, Operation) else 1 for one in operands)
        self.check_depth(depth, at)
        return Operation(name, tuple(operands), at, depth)

    def check_depth(self, depth: int, at: int) -> None:
        if depth > MOST_DEPTH:
            message = f"more than {MOST_DEPTH} operations, one inside another; sum() may help"
            raise self.source.error(message, at)

    def operator(self) -> str:
        """What stands behind an operand: an operator, `)`, `,`, or nothing at the end."""
        name = self.matched(NAME)
        sign = name or self.matched(_SIGN)
        if sign == ",":
            known = bool(self.calls) and self.calls[-1]
        else:
            known = sign in _BINARY or (sign == ")" and bool(self.calls))
        if known or self.at == self.source.end:
            return sign
        raise self.source.error(self.no_operator(name, sign), self.at)

    def no_operator(self, name: str, sign: str) -> str:
        """What to say of something behind an operand."""
        if sign == ",":
            return "read `,`, expected an operator, or an end"
        if sign == ")":
            return "read `)`, but no bracket is open"
        if self.has("[", self.at):
            return "read `[`, but rows and gears belong to a table, such as speeds[:,1]"
        if sign in _ELSEWHERE and sign != "!":
            return f"read `{sign}`, expected `{_ELSEWHERE[sign]}`"
        if name in _PYTHON:
            return f"read `{name}`, which this language does not have"
        read = quoted(name or self.source.text[self.at])
        expected = "expected an operator such as `+`, `<` or `and`, or an end"
        return f"read {read} behind {quoted(self.before)}, {expected}"

    def operand(self, least: int, depth: int) -> Tree:
        """An operand, with the signs before it."""
        self.check_depth(depth, self.at)
        name = self.matched(NAME)
        sign = name if name in _WORDS else self.matched(_SIGN)
        if sign in _PREFIXES:
            return self.prefixed(sign, least, depth)
        if sign == "(":
            return self.bracketed(depth, call=False)[0]
        found = None if sign else read_dotted(self.source, self.at)
        if not found and name and not sign:
            return self.named(name, depth)
        read = found or read_number(self.source, self.at)
        if not read:
            raise self.no_operand(sign)
        if self.before in _WORDS and self.end_of_before == self.at:
            raise self.source.error(f"expected a blank behind {quoted(self.before)}", self.at)
        tree, end = read
        self.take(self.source.text[self.at : end], end)
        return tree

    def prefixed(self, sign: str, least: int, depth: int) -> Tree:
        """An operand behind a sign."""
        at, name = self.at, _PREFIXES[sign]
        if sign == "not" and _BINDS[sign] < least:
            message = f"put `not ...` behind {quoted(self.before)} in brackets: (not ...)"
            raise self.source.error(message, at)
        self.take(sign, at + len(sign))
        operand = self.expression(_BINDS[name], depth + 1)
        return operand if sign == "+" else self.operation(name, [operand], at)

    def bracketed(self, depth: int, *, call: bool) -> list[Tree]:
        """What stands between brackets: several parts in a call."""
        self.calls.append(call)
        if len(self.calls) > MOST_BRACKETS:
            raise self.source.error(f"more than {MOST_BRACKETS} brackets are open", self.at)
        inside: list[Tree] = []
        while not inside or self.operator() == ",":
            self.take(self.source.text[self.at], self.at + 1)
            inside.append(self.expression(0, depth))
        if self.at == self.source.end:
            raise self.source.error("a bracket `(` is not closed, expected `)`", self.at)
        self.calls.pop()
        self.take(")", self.at + 1)
        return inside

    def named(self, name: str, depth: int) -> Tree:
        """What begins with a name that has no point: a call, or a table."""
        at, end = self.at, self.at + len(name)
        behind = self.skip(end)
        call = self.has("(", behind)
        if name in self.functions and call:
            self.take(name, end)
            return self.operation(name, self.bracketed(depth + 1, call=True), at)
        if name in self.functions:
            message = f"`{name}` is a function, expected `(` behind it, such as {name}(ratio)"
            raise self.source.error(message, behind)
        if call:
            hint = nearest(name, self.functions) or "; rows and gears of a table go in [ ]"
            known = ", ".join(self.functions)
            message = f"there is no function {quoted(name)}, expected {known}{hint}"
            raise self.source.error(message, at)
        if name in _PYTHON:
            message = f"read `{name}`, which this language does not have; expected {self.operands}"
            raise self.source.error(message, at)
        subscripts, end = (
            read_subscripts(self.source, behind) if self.has("[", behind) else ((), end)
        )
        self.take(name, end)
        return TableName(name, subscripts, at)

    def no_operand(self, sign: str) -> ReadError:
        """An error about what stands where an operand is wanted."""
        behind = f" behind {quoted(self.before)}" if self.before else ""
        if self.at == self.source.end:
            message = f"the text ends{behind}" if behind else "read nothing"
        elif _ELSEWHERE.get(sign) in _PREFIXES:
            return self.source.error(f"read `{sign}`, expected `{_ELSEWHERE[sign]}`", self.at)
        elif self.has("[", self.at):
            message = "read `[`, expected a table before it, such as speeds[:,1]"
            return self.source.error(message, self.at)
        else:
            message = f"read {quoted(sign or self.source.text[self.at])}{behind}"
        return self.source.error(f"{message}, expected {self.operands}", self.at)
