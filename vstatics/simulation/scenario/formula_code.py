"""The tree of a formula -> a function of plain floats.

A syntax tree of Python is made part by part, from what the grammar let through: nothing of the
text itself is ever run. Where a float has no result (``1/0``, ``exp(1000)``) the formula is
calculated again with arrays, as in a sweep: these have one, infinite or NaN.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any, TypeAlias

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.readers.expressions.evaluation import evaluate
from vstatics.readers.expressions.grammar import Applied, Tree
from vstatics.readers.expressions.operands import Constant, TableName

VARIABLES = ("t", "speed", "angle")
PI = "pi"
Function: TypeAlias = Callable[[float, float, float], float]


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


def compiled(tree: Tree) -> Function:
    """The function of a tree whose names are those of `VARIABLES`, or `pi`.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> function = compiled(parse(Excerpt("1/(1 + exp(t))", ""), Language(FUNCTIONS, "t", "t")))
    >>> function(0.0, 0.0, 0.0), function(1e6, 0.0, 0.0)
    (0.5, 0.0)
    """
    plain: Function = _evaluated(tree, _PLAIN)

    def function(t: float, speed: float, angle: float) -> float:
        try:
            return plain(t, speed, angle)
        except (ArithmeticError, ValueError):
            known = {"t": t, "speed": speed, "angle": angle, PI: math.pi}
            return evaluate(tree, lambda name: np.array([[known[name.name]]])).item()

    return function


def of_times(tree: Tree) -> Callable[[Floats], Floats]:
    """The function of a tree in which t alone stands, for many times at once.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> function = of_times(parse(Excerpt("min(2*t, 3)", ""), Language(FUNCTIONS, "t", "t")))
    >>> function(np.array([1.0, 2.0]))
    array([2., 3.])
    """
    if _compares(tree):
        one = compiled(tree)
        return lambda times: np.array([one(time, 0.0, 0.0) for time in times.tolist()])
    broad = _evaluated(tree, _BROAD)

    def function(times: Floats) -> Floats:
        with np.errstate(all="ignore"):
            try:
                values = broad(times, 0.0, 0.0)
            except (ArithmeticError, ValueError):  # of numbers alone, as 1/0
                known = {"t": times[:, None, None], PI: np.array([[math.pi]])}
                values = evaluate(tree, lambda name: known[name.name]).reshape(-1)
            return np.broadcast_to(values, times.shape).astype(float)

    return function


def _compares(tree: Any) -> bool:
    """Whether a condition stands in a tree."""
    if not isinstance(tree, Applied):
        return False
    return _is_truth(tree) or any(map(_compares, tree.operands))


def _evaluated(tree: Tree, functions: Mapping[str, Callable[..., Any]]) -> Any:
    """A function of the variables."""
    arguments = ast.arguments([], [ast.arg(name) for name in VARIABLES], None, [], [], None, [])
    whole = ast.fix_missing_locations(ast.Expression(ast.Lambda(arguments, _number(tree))))
    own = {"__builtins__": {}, "pow": math.pow, "truth": _truth, "number": float}
    return eval(compile(whole, "<formula>", "eval"), {**own, **functions})  # noqa: S307 (see the top)


def _call(name: str, *operands: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(name, ast.Load()), list(operands), [])


def _number(tree: Any) -> ast.expr:
    """The value of a part, as a float."""
    if isinstance(tree, Applied):
        if _is_truth(tree):
            return _call("number", _condition(tree))
        return _operation(tree, [_number(operand) for operand in tree.operands])
    if isinstance(tree, Constant):
        return ast.Constant(tree.value)
    return ast.Constant(math.pi) if tree.name == PI else ast.Name(tree.name, ast.Load())


def _operation(tree: Applied, operands: list[ast.expr]) -> ast.expr:
    """An operator or a function of numbers, applied."""
    if tree.name == "-x":
        return ast.UnaryOp(ast.USub(), operands[0])
    if tree.name == "**":
        return _power(tree, operands)
    if tree.name in ("min", "max") and len(operands) == 1:
        return operands[0]
    if tree.name in _ARITHMETIC:
        return ast.BinOp(operands[0], _ARITHMETIC[tree.name](), operands[1])
    return _call(tree.name, *operands)


def _power(tree: Applied, operands: list[ast.expr]) -> ast.expr:
    """A square is a product, since that is fast."""
    base, exponent = tree.operands
    if isinstance(base, TableName) and exponent == Constant(2.0):
        return ast.BinOp(operands[0], ast.Mult(), _number(base))
    return _call("pow", *operands)


def _is_truth(tree: Any) -> bool:
    return isinstance(tree, Applied) and tree.name in (*_COMPARISONS, *_LOGIC, "not")


def _condition(tree: Any) -> ast.expr:
    """Whether a part is true."""
    if not _is_truth(tree):
        return _call("truth", _number(tree))
    if tree.name in _COMPARISONS:
        left, right = map(_number, tree.operands)
        return ast.Compare(left, [_COMPARISONS[tree.name]()], [right])
    conditions = [_condition(operand) for operand in tree.operands]
    if tree.name == "not":
        return ast.UnaryOp(ast.Not(), conditions[0])
    return ast.BoolOp(_LOGIC[tree.name](), conditions)
