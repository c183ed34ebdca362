"""Grammar of formulas: parses a text into a tree, without resolving names.

Operators, from the lowest to the highest precedence::

    or | and | not x | < <= > >= == != | + - | * / | -x +x | ** (^)

An operand is a number, a name (see `operands`), `(x)` or `function(x, ...)`. The parser uses
precedence climbing. It reads an operand, then all following operators of at least the required
precedence. The right operand of each operator includes all operations of higher precedence.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple, TypeAlias

from vstatics.core.errors import quoted
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.operands import (
    Constant,
    DottedName,
    Subscript,
    TableName,
    quantity_end,
    read_dotted,
    read_number,
    read_subscripts,
)
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import NAME

MOST_FORMULA_CHARACTERS = 2000
MOST_FORMULA_BRACKETS = 50
"""Maximum number of brackets that can be open at once."""
MOST_DEPTH = 100
"""Maximum number of nested operations, because trees are evaluated by recursion."""
MOST_TREE_PARTS = 10_000
"""Maximum number of parts of a tree. In a chain `a < b < c` the middle operand counts twice."""

_LOGIC = ("or", "and")
_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_POWERS = ("**", "^")
_LEVELS = (("or",), ("and",), ("not",), _COMPARISONS, ("+", "-"), ("*", "/"), ("-x",), _POWERS)
_BINDS = {sign: level for level, signs in enumerate(_LEVELS) for sign in signs}
_PREFIXES = {"not": "not", "-": "-x", "+": "-x"}
"""Signs before an operand, with the operator that determines their precedence."""
_BINARY = _BINDS.keys() - set(_PREFIXES.values())
_WORD_SIGNS = (*_LOGIC, "not")
_SIGN = re.compile(r"\*\*|<>|[<>=!]=|//|&&|\|\||[-+*/<>(),=!&|^≤≥≠−–×·÷]")
_BLANK = re.compile(r"\s*")
_QUOTED = re.compile(r"\"[^\"]*\"|'[^']*'")
_INSIDE = re.compile(r"[^)]*")


class Applied(NamedTuple):
    """Node of a formula's tree: an operator or function applied to operands."""

    name: str
    """Symbol of an operator (such as `and`, or `-x` for a sign), or name of a function."""
    operands: tuple[Any, ...]
    """Trees of the operands. Leaves are names, or after resolution the meanings of names."""
    at: int
    depth: int
    """Number of nested levels."""
    parts: int = 1
    """Number of parts of the tree."""


Tree: TypeAlias = Constant | TableName | DottedName | Applied


class Language(NamedTuple):
    """Functions and operands that formulas for a purpose can contain, with texts for messages.

    Parameters
    ----------
    functions : collection of str
        Names of functions.
    operands : str
        Description of an operand, such as ``a number, or the time t``.
    example : str
        Example of an operand, such as ``t``.
    instead : str
        Hint for an unknown function without similarity to a known function.
    caret : bool
        True if ``x^2`` means ``x**2``; otherwise a message suggests ``x**2``.
    of_names : collection of str
        Functions whose argument is a quoted name, such as ``speed('out')``.
    """

    functions: Collection[str]
    operands: str
    example: str
    instead: str = ""
    caret: bool = False
    of_names: Collection[str] = ()
    quantity: Callable[[str, int], Constant | None] = lambda _text, _at: None
    """Function from text and offset to a number with a unit, such as ``20 km/h``, if any."""


def parse(source: Excerpt, language: Language) -> Tree:
    """Parse a formula.

    Parameters
    ----------
    source : Excerpt
    language : Language

    Returns
    -------
    Tree
        Tree of the formula. A chain ``a < b < c`` becomes ``a < b and b < c`` (with a single tree
        for both `b`), and ``x^2`` becomes ``x**2``.

    Raises
    ------
    ReadError
        At the first text that cannot be parsed.

    Examples
    --------
    >>> tree = parse(Excerpt("1 - t[2]**2", "--min"), Language(["abs"], "a number", "t"))
    >>> tree.name, tree.operands[0], tree.operands[1].name, tree.operands[1].at
    ('-', Constant(value=1.0), '**', 8)
    """
    length = source.end - source.start
    if length > MOST_FORMULA_CHARACTERS:
        raise source.error(
            f"read {length} characters, expected {MOST_FORMULA_CHARACTERS} at most", source.start
        )
    return _Parser(source, language).expression()


class _Parser:
    """Recursive parser, reading a text from left to right."""

    def __init__(self, source: Excerpt, language: Language) -> None:
        self.source = source
        self.language = language
        self.binary = _BINARY if language.caret else _BINARY - {"^"}
        self.calls: list[bool] = []
        """Whether each open bracket belongs to a call."""
        self.take("", source.start)

    def take(self, read: str, end: int) -> None:
        """Advance beyond a text and the following blanks."""
        self.before, self.end_of_before = read, end
        self.at = self.source.end_of(_BLANK, end)

    def matched(self, pattern: re.Pattern[str]) -> str:
        """Return the match of a pattern at the current offset; empty without a match."""
        return self.source.text[self.at : self.source.end_of(pattern, self.at)]

    def expression(self, least: int = 0, depth: int = 1) -> Tree:
        """Read operands and operators of at least the precedence `least`."""
        left = self.operand(least, depth)
        while (level := _BINDS.get(self.operator(), -1)) >= least:
            operands: list[Tree] = [left]
            signs = []
            while (sign := self.operator()) in _LEVELS[level]:
                signs.append((sign, self.at))
                self.take(sign, self.at + len(sign))
                behind = level if sign in _POWERS else level + 1  # powers associate to the right
                operands.append(self.expression(behind, depth + 1))
            left = self.joined(operands, signs)
        return left

    def joined(self, operands: Sequence[Tree], signs: Sequence[tuple[str, int]]) -> Tree:
        """Return the tree of a chain of operations with equal precedence."""
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
            left = self.operation("**" if sign in _POWERS else sign, (left, right), place)
        return left

    def operation(self, name: str, operands: Sequence[Tree], at: int) -> Tree:
        nodes = [node for node in operands if isinstance(node, Applied)]
        depth = 1 + max([1, *(node.depth for node in nodes)])
        self.check_depth(depth, at)
        parts = 1 + len(operands) - len(nodes) + sum(node.parts for node in nodes)
        if parts > MOST_TREE_PARTS:
            raise self.source.error("read too many nested comparisons, expected fewer", at)
        return Applied(name, tuple(operands), at, depth, parts)

    def check_depth(self, depth: int, at: int) -> None:
        if depth > MOST_DEPTH:
            raise self.source.error(
                f"more than {MOST_DEPTH} nested operations, expected fewer; sum() can help", at
            )

    def operator(self) -> str:
        """Return the operator, `)` or `,` after an operand; empty at the end of the text."""
        sign = self.matched(NAME) or self.matched(_SIGN)
        if sign == ",":
            known = bool(self.calls) and self.calls[-1]
        else:
            known = sign in self.binary or (sign == ")" and bool(self.calls))
        if known or self.at == self.source.end:
            return sign
        raise self.source.error(no_operator(self.source, self.at, sign, self.before), self.at)

    def operand(self, least: int, depth: int) -> Tree:
        """Read an operand with preceding signs."""
        self.check_depth(depth, self.at)
        name = self.matched(NAME)
        sign = name if name in _WORD_SIGNS else self.matched(_SIGN)
        if sign in _PREFIXES:
            return self.prefixed(sign, least, depth)
        if sign == "(":
            return self.bracketed(depth, call=False)[0]
        dotted = None if sign else read_dotted(self.source, self.at)
        if not dotted and name and not sign:
            return self.named(name, depth)
        read = dotted or self.quantity() or read_number(self.source, self.at)
        if not read:
            message = no_operand(self.source, self.at, sign, self.before, self.language.operands)
            raise self.source.error(message, self.at)
        if self.before in _WORD_SIGNS and self.end_of_before == self.at:
            raise self.source.error(f"expected a blank after {quoted(self.before)}", self.at)
        tree, end = read
        self.take(self.source.text[self.at : end], end)
        return tree

    def quantity(self) -> tuple[Constant, int] | None:
        """Return a number with a known unit, and its end offset; None for other texts."""
        end = quantity_end(self.source, self.at)
        known = self.language.quantity(self.source.text[self.at : end], self.at)
        return None if known is None else (known, end)

    def prefixed(self, sign: str, least: int, depth: int) -> Tree:
        """Read an operand after a sign."""
        at, name = self.at, _PREFIXES[sign]
        if sign == "not" and _BINDS[sign] < least:
            raise self.source.error(
                f"put `not ...` after {quoted(self.before)} in brackets: (not ...)", at
            )
        self.take(sign, at + len(sign))
        operand = self.expression(_BINDS[name], depth + 1)
        return operand if sign == "+" else self.operation(name, [operand], at)

    def bracketed(self, depth: int, *, call: bool) -> list[Tree]:
        """Read the content of brackets: in a call, several operands."""
        self.calls.append(call)
        if len(self.calls) > MOST_FORMULA_BRACKETS:
            raise self.source.error(f"more than {MOST_FORMULA_BRACKETS} brackets are open", self.at)
        operands: list[Tree] = []
        while not operands or self.operator() == ",":
            self.take(self.source.text[self.at], self.at + 1)
            operands.append(self.expression(0, depth))
        if self.at == self.source.end:
            raise self.source.error("a bracket `(` is not closed, expected `)`", self.at)
        self.calls.pop()
        self.take(")", self.at + 1)
        return operands

    def named(self, name: str, depth: int) -> Tree:
        """Read a call, or a name without a point, with subscripts."""
        at, end, language = self.at, self.at + len(name), self.language
        behind = self.source.end_of(_BLANK, end)
        call = self.source.has("(", behind)
        if name in language.of_names and call:
            return self.of_name(name, at, behind)
        if name in language.functions and call:
            self.take(name, end)
            return self.operation(name, self.bracketed(depth + 1, call=True), at)
        if name in language.functions:
            raise self.source.error(
                f"`{name}` is a function, expected `(` after it, such as "
                f"{name}({language.example})",
                at,
            )
        if call:
            known = ", ".join(language.functions)
            hint = _advice(name, language)
            raise self.source.error(
                f"there is no function {quoted(name)}, expected {known}{hint}", at
            )
        if name in PYTHON:
            raise self.source.error(
                f"read `{name}`, which this language does not have; expected {language.operands}",
                at,
            )
        subscripts, end = (
            read_subscripts(self.source, behind) if self.source.has("[", behind) else ((), end)
        )
        self.take(name, end)
        return TableName(name, subscripts, at)

    def of_name(self, word: str, at: int, bracket: int) -> TableName:
        """Read a call of a function whose argument is a quoted name."""
        begin = self.source.end_of(_BLANK, bracket + 1)
        end = self.source.end_of(_QUOTED, begin)
        close = self.source.end_of(_BLANK, end)
        if end == begin or not self.source.has(")", close):
            read = self.source.text[begin : self.source.end_of(_INSIDE, begin)].strip()
            raise self.source.error(
                f"read {quoted(read)}, expected a name in quotes, such as {word}('out')", begin
            )
        self.take(")", close + 1)
        return TableName(word, (Subscript(self.source.text[begin:end], begin),), at)


ELSEWHERE = {
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
"""Operators of other languages, with the operators of formulas."""
_SAME_FUNCTION = {"ln": "log", "sgn": "sign"}
"""Functions of other languages, with the functions of formulas."""
_EQUIVALENT = {
    "pow": "x**2",
    "square": "x**2",
    "fabs": "abs(x)",
    "tan": "sin(x)/cos(x)",
    "asin": "atan(x/sqrt(1 - x**2))",
    "acos": "pi/2 - atan(x/sqrt(1 - x**2))",
    "atan2": "2*atan(y/(sqrt(x**2 + y**2) + x))",
    "sinh": "(exp(x) - exp(-x))/2",
    "cosh": "(exp(x) + exp(-x))/2",
    "hypot": "sqrt(x**2 + y**2)",
    "clip": "max(a, min(x, b))",
    "log10": "log(x)/log(10)",
}
"""Functions of other languages, with equivalent formulas."""
_ROUNDING = ("floor", "ceil", "round", "trunc", "int", "mod", "fmod", "rem")
_NO_ROUNDING = "; no function rounds, so write steps as comparisons, such as `(x > 1) + (x > 2)`"
_OF_CASES = ("if", "where", "step", "heaviside")
_CASES = "; a comparison is 1 or 0, so write a factor such as `2*(x > 1)`"
PYTHON = ("lambda", "for", "in", "if", "else", "is", "await", "async", "yield", "from", "import")
"""Keywords of Python that formulas do not support."""


def _advice(name: str, language: Language) -> str:
    """Return advice on an unknown function.

    A function of Python's `math` is not a misspelling, so no similar name is suggested.

    >>> numbers = {"atan": math.atan, "sqrt": math.sqrt, "pi": math.pi, "x": -0.6, "y": 0.8}
    >>> round(eval(_EQUIVALENT["atan2"], numbers) - math.atan2(0.8, -0.6), 12)
    0.0
    >>> round(eval(_EQUIVALENT["acos"], numbers) - math.acos(-0.6), 12)
    0.0
    """
    if name in _OF_CASES:
        return _CASES
    if name in _ROUNDING:
        return _NO_ROUNDING
    formula = _EQUIVALENT.get(name, "")
    if formula and {*re.findall(r"\w+(?=\()", formula)} <= {*language.functions}:
        return f"; write {name} as {quoted(formula)}"
    words = () if hasattr(math, name) else (*language.functions, *language.of_names)
    return nearest(_SAME_FUNCTION.get(name, name), words) or language.instead


def no_operator(source: Excerpt, at: int, read: str, before: str) -> str:
    """Return the message about a text in the position of an operator.

    >>> no_operator(Excerpt("1 & 2", "--where"), 2, "&", "1")
    'read `&`, expected `and`'
    """
    if read == ",":
        return "read `,`, expected an operator, or an end"
    if read == ")":
        return "read `)` without an opening bracket"
    if source.has("[", at):
        return "read `[`, but rows and gears belong to a table, such as speeds[:,1]"
    if read in ELSEWHERE and read != "!":
        return f"read `{read}`, expected `{ELSEWHERE[read]}`"
    if read in PYTHON:
        hint = _CASES if read in _OF_CASES else ""
        return f"read `{read}`, which this language does not have{hint}"
    shown = quoted(read or source.text[at])
    expected = "expected an operator such as `+`, `<` or `and`, or an end"
    expected += (
        _CASES if source.has("?", at) else _NO_ROUNDING * (source.has("%", at) or read in _ROUNDING)
    )
    return f"read {shown} after {quoted(before)}, {expected}"


def no_operand(source: Excerpt, at: int, read: str, before: str, operands: str) -> str:
    """Return the message about a text in the position of an operand.

    >>> no_operand(Excerpt("1 + * 2", "--where"), 4, "*", "+", "a number")
    'read `*` after `+`, expected a number'
    """
    if ELSEWHERE.get(read) in ("-", "not"):
        return f"read `{read}`, expected `{ELSEWHERE[read]}`"
    if source.has("[", at):
        return "read `[`, expected a table before it, such as speeds[:,1]"
    behind = f" after {quoted(before)}" if before else ""
    shown = f"read {quoted(read or source.text[at])}" if at < source.end else "the text ends"
    return f"{shown if source.part.strip() else 'read nothing'}{behind}, expected {operands}"
