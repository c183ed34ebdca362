"""Text of an expression -> tree: what binds how.

`tokens` takes names and numbers out of the text. In their places Python's own parser
(`ast.parse`, which runs nothing) gets placeholders of the same length, made of ASCII
letters, so its columns are those of the user's text and it meets nothing but operators,
brackets, commas and placeholders. Of its trees only the kinds of nodes below are taken.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.errors import ReadError
from vstatics.sweep.expressions.operands import Call, Number, Table, Varied
from vstatics.sweep.expressions.source import Source
from vstatics.sweep.expressions.tokens import Sign, Token, tokens

MOST_DEPTH = 100
"""So many operations may stand one inside another, since trees are walked by recursion."""


class Operation(NamedTuple):
    """An operator or a function, and what it is applied to."""

    name: str
    """The sign, `and`, `or`, `not`, `negative`, or the name of a function."""
    operands: tuple[Tree, ...]
    at: int


Tree = Number | Table | Varied | Operation

ARITHMETIC: Mapping[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.Pow: "**",
}
COMPARISONS: Mapping[type[ast.cmpop], str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
LOGIC: Mapping[type[ast.boolop], str] = {ast.And: "and", ast.Or: "or"}
PREFIXES: Mapping[type[ast.unaryop], str] = {ast.USub: "negative", ast.UAdd: "+", ast.Not: "not"}


def parse(source: Source) -> Tree:
    """Read an expression.

    Parameters
    ----------
    source : Source

    Returns
    -------
    Tree
        Names of tables, rows and gears are not looked at yet. A chain ``a < b < c`` has
        become ``a < b and b < c``.

    Raises
    ------
    ReadError
        At the first place that can't be read.

    Examples
    --------
    >>> tree = parse(Source("1 - ratio[2]**2", "--min"))
    >>> tree.name, tree.operands[0]
    ('-', Number(value=1.0, at=0))
    >>> tree.operands[1].name, tree.operands[1].at
    ('**', 12)
    """
    found = {token.at: token for token in tokens(source)}
    masked = _masked(source, found)
    try:
        tree = ast.parse(masked, mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        message = "this can't be read; brackets around its parts may help"
        raise source.error(message, source.start) from None
    return _Parser(source, found, masked).tree(tree, 1)


def _masked(source: Source, found: Mapping[int, Token]) -> str:
    """Signs at their columns, placeholders for all else, in brackets.

    The bracket stands before column 0 of the text; blanks fill what is not read.
    """
    ends = [*list(found)[1:], source.end]
    letters = [" "] * ends[-1]
    for (at, token), end in zip(found.items(), ends, strict=True):
        written = token.text if isinstance(token, Sign) else "_" * (end - at)
        letters[at : at + len(written)] = written
        if not isinstance(token, Sign):  # a blank, so that it does not grow into a word behind it
            letters[end - 1 : end] = "_" if end - at == 1 else " "
    return "(" + "".join(letters) + ")"


class _Parser:
    """From the nodes of Python's tree to ours."""

    def __init__(self, source: Source, found: Mapping[int, Token], masked: str) -> None:
        self.source = source
        self.found = found
        self.masked = masked

    def tree(self, node: ast.expr, depth: int) -> Tree:
        """The tree of a node; all kinds of nodes that are taken."""
        if depth > MOST_DEPTH:
            message = f"more than {MOST_DEPTH} operations, one inside another; sum() may help"
            raise self.source.error(message, node.col_offset - 1)
        if isinstance(node, ast.Name):
            return self._operand(node)
        name, operands, at = self._parts(node)
        return Operation(name, tuple(self.tree(operand, depth + 1) for operand in operands), at)

    def _parts(self, node: ast.expr) -> tuple[str, list[ast.expr], int]:
        """What a node is called here, its operands and its place; other kinds are refused."""
        at = node.col_offset - 1
        match node:
            case ast.BinOp() if type(node.op) in ARITHMETIC:
                parts = ARITHMETIC[type(node.op)], [node.left, node.right]
            case ast.BoolOp() if type(node.op) in LOGIC:
                parts = LOGIC[type(node.op)], node.values
            case ast.Compare(ops=[op]) if type(op) in COMPARISONS:
                parts = COMPARISONS[type(op)], [node.left, *node.comparators]
            case ast.Compare():
                return "and", _links(node), at
            case ast.UnaryOp() if type(node.op) in PREFIXES:
                return PREFIXES[type(node.op)], [node.operand], at
            case ast.Call(func=ast.Name(), keywords=[]):
                call = self.found.get(at)
                if not isinstance(call, Call):
                    raise self._error(node)
                return call.name, node.args, at
            case _:
                raise self._error(node)
        name, operands = parts
        return name, operands, self._behind(operands[0], name)

    def _operand(self, node: ast.Name) -> Tree:
        token = self.found.get(node.col_offset - 1)
        if not isinstance(token, Number | Table | Varied):
            raise self._error(node)
        return token

    def _behind(self, left: ast.expr, sign: str) -> int:
        """Where the operator behind an operand stands; brackets may be between."""
        return self.masked.index(sign, left.end_col_offset or 0) - 1

    def _error(self, node: ast.expr) -> ReadError:
        return self.source.error("this can't be read here", node.col_offset - 1)


def _links(chain: ast.Compare) -> list[ast.expr]:
    """The comparisons that a chain of them stands for."""
    ends = [chain.left, *chain.comparators]
    return [
        ast.Compare(
            left=left,
            ops=[op],
            comparators=[right],
            lineno=1,
            col_offset=left.col_offset,
            end_lineno=1,
            end_col_offset=right.end_col_offset,
        )
        for left, op, right in zip(ends[:-1], chain.ops, ends[1:], strict=True)
    ]
