"""Compilation of the tree of a formula to a fast Python function.

A Python syntax tree is built from the checked tree of the formula, so the text itself is never
executed. Where Python raises an error (``1/0``, ``exp(1000)``), the function for arrays evaluates
the formula by the rules of NumPy. The result is then infinite or NaN, as in a sweep.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial, reduce
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.evaluation import ON_ARRAYS
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.table_call import TableCall

VARIABLES = ("t", "speed", "angle")
PI = "pi"
Function: TypeAlias = Callable[..., float]
"""Function of t, speed and angle, and then of the other quantities that a formula reads."""


class Seen(NamedTuple):
    """Quantity that a formula reads, other than time and the speed and angle of its link."""

    word: str
    """Function of the motion, such as `speed` or `slip`; `value` for a state or setting."""
    of: str
    """Name of a link, component, state or setting."""


def seen_in(part: TableName) -> Seen | None:
    """Return the quantity that a name in a formula means; None for `VARIABLES` and pi."""
    if part.subscripts:
        return Seen(part.name, part.subscripts[0].written[1:-1])
    return None if part.name in (*VARIABLES, PI) else Seen("value", part.name)


def _sign(value: float) -> float:
    return float(value > 0) - float(value < 0)


def _truth(value: float) -> bool:
    """Return whether a number is true, which means finite and not 0."""
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
    "log": math.log,
    "atan": math.atan,
}
_BROAD: Mapping[str, Callable[..., Any]] = {
    **ON_ARRAYS,
    "pow": np.power,
    "divide": np.divide,
    "number": lambda condition: np.asarray(condition, float),
    "truth": lambda values: np.isfinite(values) & (np.asarray(values) != 0),
    "and_": np.logical_and,
    "or_": np.logical_or,
    "not_": np.logical_not,
}
_ARITHMETIC = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
}
_CALLED = {"/": "divide", "**": "pow"}
_COMPARISONS = {
    "<": ast.Lt,
    "<=": ast.LtE,
    ">": ast.Gt,
    ">=": ast.GtE,
    "==": ast.Eq,
    "!=": ast.NotEq,
}
_LOGIC = {"and": ast.And, "or": ast.Or}


def compiled(tree: Tree, seen: Sequence[Seen] = ()) -> Function:
    """Compile a tree to a function of `VARIABLES` and then of the quantities `seen`.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.evaluation import FUNCTIONS
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> function = compiled(parse(Excerpt("1/(1 + exp(t))", ""), Language(FUNCTIONS, "t", "t")))
    >>> function(0.0, 0.0, 0.0), function(1e6, 0.0, 0.0)
    (0.5, 0.0)
    """
    functions = {**_PLAIN, **{name: table.at for name, table in _called_tables(tree).items()}}
    plain: Function = _evaluated(tree, functions, seen, is_broad=False)
    along = cache(partial(compiled_along, tree, seen))

    def function(time: float, *known: float) -> float:
        try:
            return plain(time, *known)
        except (ArithmeticError, ValueError):
            with np.errstate(all="ignore"):
                return along()(np.array([time]), *known).item()

    return function


def compiled_along(tree: Tree, seen: Sequence[Seen] = ()) -> Callable[..., Floats]:
    """Compile a tree to a function for many times.

    Its first argument is an array of times; each other argument is an array of the same shape or a
    number. Callers suppress NumPy's floating-point warnings, once for many evaluations.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.evaluation import FUNCTIONS
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("min(2*t, 3)*(speed > 1)", ""), Language(FUNCTIONS, "t", "t"))
    >>> compiled_along(tree)(np.array([1.0, 2.0, 3.0]), np.array([2.0, 2.0, 0.0]), 0.0)
    array([2., 3., 0.])
    """
    functions = {**_BROAD, **{name: table.along for name, table in _called_tables(tree).items()}}
    broad = _evaluated(tree, functions, seen, is_broad=True)

    def function(times: Floats, *known: Floats | float) -> Floats:
        result: Floats = np.empty(times.shape)
        result[...] = broad(times, *known)
        return result

    return function


def _called_tables(tree: Any) -> dict[str, LookupTable]:
    if not isinstance(tree, Applied):
        return {}
    called = {str(tree.name): tree.name.table} if isinstance(tree.name, TableCall) else {}
    return reduce(operator.or_, map(_called_tables, tree.operands), called)


class _CodeWriter:
    """Writer of the Python syntax tree of a formula, for arrays if `is_broad`, otherwise floats."""

    def __init__(self, seen: Sequence[Seen], *, is_broad: bool) -> None:
        self.is_broad = is_broad
        self.names: dict[object, str] = {argument: argument for argument in VARIABLES}
        self.names |= {argument: f"seen_{number}" for number, argument in enumerate(seen)}

    def number(self, tree: Any) -> ast.expr:
        """Return the Python expression for the numerical value of a subtree."""
        if isinstance(tree, Applied):
            if _is_truth(tree):
                return _call("number", self.condition(tree))
            return self.operation(tree, [self.number(operand) for operand in tree.operands])
        if isinstance(tree, Constant):
            return ast.Constant(float(tree.value))  # `compile` accepts no subclass of float
        if tree.name == PI:
            return ast.Constant(math.pi)
        return ast.Name(self.names[seen_in(tree) or tree.name], ast.Load())

    def operation(self, tree: Applied, operands: list[ast.expr]) -> ast.expr:
        """Return the Python expression for an operator or function and its operands."""
        if tree.name == "-x":
            return ast.UnaryOp(ast.USub(), operands[0])
        base, exponent = tree.operands[0], tree.operands[-1]
        if tree.name == "**" and isinstance(base, TableName) and exponent == Constant(2.0):
            return ast.BinOp(operands[0], ast.Mult(), self.number(base))  # faster than a power
        if tree.name in ("min", "max") and len(operands) == 1:
            return operands[0]
        is_quotient = self.is_broad and tree.name == "/"  # `/` of two numbers can raise an error
        if tree.name in _ARITHMETIC and not is_quotient:
            return ast.BinOp(operands[0], _ARITHMETIC[tree.name](), operands[1])
        return _call(_CALLED.get(tree.name, str(tree.name)), *operands)

    def condition(self, tree: Any) -> ast.expr:
        """Return the Python expression for the truth value of a subtree."""
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
    seen: Sequence[Seen],
    *,
    is_broad: bool,
) -> Any:
    """Compile a tree to a function of `VARIABLES` and of the quantities `seen`."""
    writer = _CodeWriter(seen, is_broad=is_broad)
    arguments = [ast.arg(name) for name in writer.names.values()]
    signature = ast.arguments([], arguments, None, [], [], None, [])
    body = ast.fix_missing_locations(ast.Expression(ast.Lambda(signature, writer.number(tree))))
    code = compile(body, "<formula>", "eval")
    builtins = {"__builtins__": {}, "pow": math.pow, "truth": _truth, "number": float}
    return eval(code, {**builtins, **functions})  # noqa: S307 (see the top)


def _call(name: str, *operands: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(name, ast.Load()), list(operands), [])


def _is_truth(tree: Any) -> bool:
    return isinstance(tree, Applied) and tree.name in (*_COMPARISONS, *_LOGIC, "not")
