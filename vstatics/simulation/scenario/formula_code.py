"""The tree of a formula -> a function of plain floats.

A syntax tree of Python is made part by part, from what the grammar let through: nothing of the
text itself is ever run. Where a float has no result (``1/0``, ``exp(1000)``) the formula is
calculated again with arrays, as in a sweep: these have one, infinite or NaN.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.evaluation import evaluate
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.table_call import TableCall

VARIABLES = ("t", "speed", "angle")
PI = "pi"
Function: TypeAlias = Callable[..., float]
"""By t, speed and angle, then by what else is seen."""


class Seen(NamedTuple):
    """What a formula sees besides the time and its own link."""

    word: str
    """`speed`, `slip`, ...; of a number that changes `value`."""
    of: str
    """The name of a link, an element, a device, a number."""


def seen_in(part: TableName) -> Seen | None:
    """What a name stands for, if it is seen elsewhere than on the own link."""
    if part.subscripts:
        return Seen(part.name, part.subscripts[0].written[1:-1])
    return None if part.name in (*VARIABLES, PI) else Seen("value", part.name)


def _sign(value: float) -> float:
    return float(value > 0) - float(value < 0)


def _truth(value: float) -> bool:
    """As in a sweep: true unless it is 0, infinite or does not exist."""
    return value != 0 and math.isfinite(value)


_PLAIN: Mapping[str, Callable[..., Any]] = {
    "abs": abs,
    "min": min,
    "max": max,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "tanh": math.tanh,
    "sin": math.sin,
    "cos": math.cos,
    "sign": _sign,
}
_BROAD: Mapping[str, Callable[..., Any]] = {
    "abs": np.abs,
    "min": lambda *values: reduce(np.fmin, values),
    "max": lambda *values: reduce(np.fmax, values),
    "sqrt": np.sqrt,
    "exp": np.exp,
    "tanh": np.tanh,
    "sin": np.sin,
    "cos": np.cos,
    "sign": np.sign,
    "pow": np.power,
    "number": lambda condition: np.asarray(condition, float),
    "truth": lambda values: np.isfinite(values) & (np.asarray(values) != 0),
    "and_": np.logical_and,
    "or_": np.logical_or,
    "not_": np.logical_not,
}
FUNCTIONS = tuple(_PLAIN)
"""Of numbers; `min` and `max` of several."""

_ARITHMETIC: Mapping[str, type[ast.operator]] = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
}
_COMPARISONS: Mapping[str, type[ast.cmpop]] = {
    "<": ast.Lt,
    "<=": ast.LtE,
    ">": ast.Gt,
    ">=": ast.GtE,
    "==": ast.Eq,
    "!=": ast.NotEq,
}
_LOGIC: Mapping[str, type[ast.boolop]] = {"and": ast.And, "or": ast.Or}


def compiled(tree: Tree, seen: Sequence[Seen] = ()) -> Function:
    """The function of a tree: of `VARIABLES`, then of what else is seen.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> function = compiled(parse(Excerpt("1/(1 + exp(t))", ""), Language(FUNCTIONS, "t", "t")))
    >>> function(0.0, 0.0, 0.0), function(1e6, 0.0, 0.0)
    (0.5, 0.0)
    """
    functions = {**_PLAIN, **{name: table.at for name, table in _tables(tree).items()}}
    plain: Function = _evaluated(tree, functions, seen)

    def function(*known: float) -> float:
        try:
            return plain(*known)
        except (ArithmeticError, ValueError):
            arrays = [np.array([[one]]) for one in known]
            return _as_arrays(tree, arrays, seen).item()

    return function


def compiled_along(tree: Tree, seen: Sequence[Seen] = ()) -> Callable[..., Floats]:
    """The same function for many times at once: of arrays, or of numbers beside the times.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("min(2*t, 3)*(speed > 1)", ""), Language(FUNCTIONS, "t", "t"))
    >>> compiled_along(tree)(np.array([1.0, 2.0, 3.0]), np.array([2.0, 2.0, 0.0]), 0.0)
    array([2., 3., 0.])
    """
    functions = {**_BROAD, **{name: table.along for name, table in _tables(tree).items()}}
    broad = _evaluated(tree, functions, seen, is_broad=True)

    def function(times: Floats, *known: Floats | float) -> Floats:
        with np.errstate(all="ignore"):
            try:
                values = broad(times, *known)
            except (ArithmeticError, ValueError):  # of numbers alone, as 1/0
                shaped = [np.reshape(one, (-1, 1, 1)) for one in (times, *known)]
                values = _as_arrays(tree, shaped, seen).reshape(-1)
            return np.broadcast_to(values, times.shape).astype(float)

    return function


def _tables(tree: Any) -> dict[str, LookupTable]:
    """The tables that a tree calls, by their names."""
    if not isinstance(tree, Applied):
        return {}
    own = {str(tree.name): tree.name.table} if isinstance(tree.name, TableCall) else {}
    return reduce(operator.or_, map(_tables, tree.operands), own)


def _as_arrays(tree: Tree, known: Sequence[Floats], seen: Sequence[Seen]) -> Floats:
    """The values of a tree by the rules of arrays: 1/0 is infinite, 0/0 is no number."""
    by_name = dict(zip([*VARIABLES, *seen], known, strict=True))

    def value_of(part: Any) -> Floats:
        if isinstance(part, Applied):
            assert isinstance(part.name, TableCall)  # noqa: S101 - nothing else is left
            return part.name.table.along(*(evaluate(one, value_of) for one in part.operands))
        if part.name == PI:
            return np.array([[math.pi]])
        return by_name[seen_in(part) or part.name]

    return evaluate(tree, value_of)


class _CodeWriter:
    """Writes the syntax tree of a function."""

    def __init__(self, seen: Sequence[Seen], *, is_broad: bool) -> None:
        self.is_broad = is_broad
        self.names: dict[object, str] = {one: one for one in VARIABLES}
        self.names |= {one: f"seen_{number}" for number, one in enumerate(seen)}

    def function(self, tree: Tree) -> ast.Expression:
        """Of the variables, then of what is seen."""
        arguments = [ast.arg(name) for name in self.names.values()]
        made = ast.arguments([], arguments, None, [], [], None, [])
        return ast.fix_missing_locations(ast.Expression(ast.Lambda(made, self.number(tree))))

    def number(self, tree: Any) -> ast.expr:
        """The value of a part, as a float."""
        if isinstance(tree, Applied):
            if _is_truth(tree):
                return _call("number", self.condition(tree))
            return self.operation(tree, [self.number(operand) for operand in tree.operands])
        if isinstance(tree, Constant):
            return ast.Constant(tree.value)
        if tree.name == PI:
            return ast.Constant(math.pi)
        return ast.Name(self.names[seen_in(tree) or tree.name], ast.Load())

    def operation(self, tree: Applied, operands: list[ast.expr]) -> ast.expr:
        """An operator or a function of numbers, applied."""
        if tree.name == "-x":
            return ast.UnaryOp(ast.USub(), operands[0])
        if tree.name == "**":
            return self.power(tree, operands)
        if tree.name in ("min", "max") and len(operands) == 1:
            return operands[0]
        if tree.name in _ARITHMETIC:
            return ast.BinOp(operands[0], _ARITHMETIC[tree.name](), operands[1])
        return _call(str(tree.name), *operands)

    def power(self, tree: Applied, operands: list[ast.expr]) -> ast.expr:
        """A square is a product, since that is fast."""
        base, exponent = tree.operands
        if isinstance(base, TableName) and exponent == Constant(2.0):
            return ast.BinOp(operands[0], ast.Mult(), self.number(base))
        return _call("pow", *operands)

    def condition(self, tree: Any) -> ast.expr:
        """Whether a part is true."""
        if not _is_truth(tree):
            return _call("truth", self.number(tree))
        if tree.name in _COMPARISONS:
            left, right = map(self.number, tree.operands)
            return ast.Compare(left, [_COMPARISONS[tree.name]()], [right])
        conditions = [self.condition(operand) for operand in tree.operands]
        if self.is_broad:
            return _call(f"{tree.name}_", *conditions)
        if tree.name == "not":
            return ast.UnaryOp(ast.Not(), conditions[0])
        return ast.BoolOp(_LOGIC[tree.name](), conditions)


def _evaluated(
    tree: Tree,
    functions: Mapping[str, Callable[..., Any]],
    seen: Sequence[Seen] = (),
    *,
    is_broad: bool = False,
) -> Any:
    """A function of the variables."""
    whole = _CodeWriter(seen, is_broad=is_broad).function(tree)
    own = {"__builtins__": {}, "pow": math.pow, "truth": _truth, "number": float}
    return eval(compile(whole, "<formula>", "eval"), {**own, **functions})  # noqa: S307 (see the top)


def _call(name: str, *operands: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(name, ast.Load()), list(operands), [])


def _is_truth(tree: Any) -> bool:
    return isinstance(tree, Applied) and tree.name in (*_COMPARISONS, *_LOGIC, "not")
