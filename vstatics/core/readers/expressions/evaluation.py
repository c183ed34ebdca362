"""Evaluation of formulas: operators and functions on arrays, for all variants at once.

Every value has the axes (..., gears, rows), as in `Results`. An axis has the length 1 if the value
does not depend on it.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.expressions.operands import Constant

Values: TypeAlias = Floats | Booleans
Function: TypeAlias = Callable[[Sequence[Values]], Values]

ON_ARRAYS: Mapping[str, Callable[..., Values]] = {
    "abs": np.absolute,
    "min": lambda *values: reduce(np.fmin, values),
    "max": lambda *values: reduce(np.fmax, values),
    "sqrt": np.sqrt,
    "exp": np.exp,
    "tanh": np.tanh,
    "sin": np.sin,
    "cos": np.cos,
    "sign": np.sign,
    "log": np.log,
    "atan": np.arctan,
}
"""Functions of numbers in all formulas, by name; only `min` and `max` have several arguments."""
FUNCTIONS = tuple(ON_ARRAYS)
TABLE_FUNCTIONS = (*FUNCTIONS, "sum")
"""Names of functions in formulas over tables of results."""
REDUCTIONS = ("min", "max", "sum")
"""Functions that reduce a single operand to a number over all gears and rows."""
LAST = "last"
"""Function that returns the final value of a quantity over time, only for scenario runs."""


def expect_operands(part: Applied, source: Excerpt, example: str) -> None:
    """Check that only functions with several arguments have several operands.

    Raises
    ------
    ReadError
        If a function of a single number has several operands. The message contains the example.
    """
    count, name = len(part.operands), part.name
    if count > 1 and name in (*TABLE_FUNCTIONS, LAST) and name not in ("min", "max"):
        message = f"{name} of {count} values, expected one, as in {name}({example})"
        raise source.error(message, part.at)


def evaluate(formula: Any, value_of: Callable[[Any], Floats]) -> Floats:
    """Return the values of a formula.

    Parameters
    ----------
    formula : Constant, Applied or resolved name
        Tree of the formula.
    value_of : callable
        Function that returns the values of a resolved name, or of a function that is not in
        `OPERATIONS`. The array has the shape (..., gears or 1, rows or 1).

    Returns
    -------
    ndarray, shape (..., gears or 1, rows or 1)
        Values, with 1 for true and 0 for false. The array can be a view of a result of `value_of`.
        Leading axes are missing if the values are equal for all variants.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("max(t, 2) + 1", "--where"), Language(FUNCTIONS, "t", "t"))
    >>> evaluate(tree, lambda name: np.array([[1.0], [5.0]]))
    array([[3.],
           [6.]])
    """
    with np.errstate(all="ignore"):
        return _numbers(_values(formula, value_of))


def _values(part: Any, value_of: Callable[[Any], Floats]) -> Values:
    # A nested function would keep a reference to the results.
    if isinstance(part, Applied) and part.name in OPERATIONS:
        return OPERATIONS[part.name]([_values(operand, value_of) for operand in part.operands])
    return np.array([[part.value]]) if isinstance(part, Constant) else value_of(part)


def truth(values: Values) -> Booleans:
    """Return values as booleans: false for 0, infinity and NaN.

    >>> truth(np.array([2.0, 0.0, np.nan, np.inf]))
    array([ True, False, False, False])
    """
    true: Any = values if values.dtype == np.bool_ else (values != 0) & np.isfinite(values)
    return true  # type: ignore[no-any-return]


def _numbers(values: Values) -> Floats:
    return values.astype(np.float64, copy=False)


def _unequal(first: Floats, second: Floats) -> Booleans:
    """Return whether numbers differ; unlike NumPy, False if either is NaN."""
    unequal: Booleans = (first < second) | (first > second)
    return unequal


def _of_number(function: Callable[[Any], Any]) -> Function:
    return lambda operands: function(_numbers(operands[0]))


def _of_numbers(
    function: Callable[[Any, Any], Any], kind: Callable[[Values], Any] = _numbers
) -> Function:
    return lambda operands: reduce(function, map(kind, operands))


def _extreme(propagating: np.ufunc, ignoring: np.ufunc) -> Function:
    """Return a function for the smallest or largest of the operands.

    The function reduces a single operand over all gears and rows. The NumPy function `propagating`
    is fast, but returns NaN if any value is NaN; `ignoring` skips NaN.
    """

    def applied(operands: Sequence[Values]) -> Values:
        if len(operands) > 1:
            return reduce(ignoring, map(_numbers, operands))
        return _over_all(_numbers(operands[0]), propagating.reduce, ignoring.reduce)

    return applied


def _over_all(values: Floats, propagating: Any, ignoring: Any) -> Floats:
    """Reduce gears and rows to a number. Only variants with NaN need the slower function."""
    reduced: Floats = propagating(values, axis=(-2, -1), keepdims=True)
    has_nan = np.isnan(reduced[..., 0, 0])
    if has_nan.any():
        reduced[has_nan] = ignoring(values[has_nan], axis=(-2, -1), keepdims=True)
    return reduced


def _sum_ignoring_nan(values: Floats, **axes: Any) -> Floats:
    """Return the sum of all values except NaN; NaN if all values are NaN."""
    is_nan = np.isnan(values)
    total: Floats = np.where(is_nan, 0.0, values).sum(**axes)
    total[is_nan.all(**axes)] = np.nan
    return total


OPERATIONS: Mapping[str, Function] = {
    "+": _of_numbers(operator.add),
    "-": _of_numbers(operator.sub),
    "*": _of_numbers(operator.mul),
    "/": _of_numbers(operator.truediv),
    "**": _of_numbers(operator.pow),
    "<": _of_numbers(operator.lt),
    "<=": _of_numbers(operator.le),
    ">": _of_numbers(operator.gt),
    ">=": _of_numbers(operator.ge),
    "==": _of_numbers(operator.eq),
    "!=": _of_numbers(_unequal),
    "and": _of_numbers(operator.and_, truth),
    "or": _of_numbers(operator.or_, truth),
    "not": lambda operands: ~truth(operands[0]),
    "true": lambda operands: truth(operands[0]),
    "-x": _of_number(operator.neg),
    **{name: _of_number(function) for name, function in ON_ARRAYS.items()},
    "min": _extreme(np.minimum, np.fmin),
    "max": _extreme(np.maximum, np.fmax),
    LAST: _of_number(lambda numbers: numbers[..., -1:, :]),
    "sum": _of_number(lambda numbers: _over_all(numbers, np.add.reduce, _sum_ignoring_nan)),
}
"""Functions on arrays, by name of the operator or function in formulas."""
