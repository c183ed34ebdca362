"""Values of a formula: operators and functions on arrays, all variants at once.

Every value has the axes (..., gears, rows), as in `Results`; where a formula has no gears
or no rows this axis has the length 1, so that NumPy spreads it over the other operand.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.expressions.operands import Constant

Values: TypeAlias = Floats | Booleans
Function: TypeAlias = Callable[[Sequence[Values]], Values]

FUNCTIONS = ("min", "max", "abs", "sum", "sqrt")
REDUCTIONS = ("min", "max", "sum")
"""Functions that make one number of all gears and rows of one operand."""
LAST = "last"
"""Of what runs along time, its value at the end; only of runs of a scenario."""


def evaluate(formula: Any, value_of: Callable[[Any], Floats]) -> Floats:
    """The values of a formula.

    Parameters
    ----------
    formula : Constant, Applied or what names stand for
    value_of : callable
        Gives the values of what a name stands for, or a function that is none of `OPERATIONS`,
        shape (..., gears or 1, rows or 1).

    Returns
    -------
    ndarray, shape (..., gears or 1, rows or 1)
        1 and 0 for true and false; it may be a view of what `value_of` gave. Leading axes
        may lack if the values are the same for all.

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
    # no function in a function: it would hold itself, and with it the memory of the results
    if isinstance(part, Applied) and part.name in OPERATIONS:
        return OPERATIONS[part.name]([_values(operand, value_of) for operand in part.operands])
    return np.array([[part.value]]) if isinstance(part, Constant) else value_of(part)


def truth(values: Values) -> Booleans:
    """What a value says as a condition: true unless it is 0, infinite or does not exist.

    >>> truth(np.array([2.0, 0.0, np.nan, np.inf]))
    array([ True, False, False, False])
    """
    true: Any = values if values.dtype == np.bool_ else (values != 0) & np.isfinite(values)
    return true  # type: ignore[no-any-return]


def _numbers(values: Values) -> Floats:
    return values.astype(np.float64, copy=False)


def _unequal(first: Floats, second: Floats) -> Booleans:
    """Unlike NumPy's: false if a number does not exist, as all comparisons are."""
    unequal: Booleans = (first < second) | (first > second)
    return unequal


def _of_number(function: Callable[[Any], Any]) -> Function:
    return lambda operands: function(_numbers(operands[0]))


def _of_numbers(
    function: Callable[[Any, Any], Any], kind: Callable[[Values], Any] = _numbers
) -> Function:
    return lambda operands: reduce(function, map(kind, operands))


def _extreme(among: np.ufunc, existing: np.ufunc) -> Function:
    """The least or the largest: of all gears and rows, or of several operands.

    `among` gives NaN where one value does not exist, and is fast; `existing` leaves it out.
    """

    def applied(operands: Sequence[Values]) -> Values:
        if len(operands) > 1:
            return reduce(existing, map(_numbers, operands))
        return _over_all(_numbers(operands[0]), among.reduce, existing.reduce)

    return applied


def _over_all(values: Floats, among: Any, existing: Any) -> Floats:
    """Reduce gears and rows to one number; again without NaN for the variants that have any."""
    reduced: Floats = among(values, axis=(-2, -1), keepdims=True)
    lacking = np.isnan(reduced[..., 0, 0])
    if lacking.any():
        reduced[lacking] = existing(values[lacking], axis=(-2, -1), keepdims=True)
    return reduced


def _sum_of_existing(values: Floats, **axes: Any) -> Floats:
    """The sum of what exists; NaN if nothing does."""
    lacking = np.isnan(values)
    total: Floats = np.where(lacking, 0.0, values).sum(**axes)
    total[lacking.all(**axes)] = np.nan
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
    "abs": _of_number(np.abs),
    "sqrt": _of_number(np.sqrt),
    "exp": _of_number(np.exp),
    "tanh": _of_number(np.tanh),
    "sin": _of_number(np.sin),
    "cos": _of_number(np.cos),
    "sign": _of_number(np.sign),
    "min": _extreme(np.minimum, np.fmin),
    "max": _extreme(np.maximum, np.fmax),
    LAST: _of_number(lambda numbers: numbers[..., -1:, :]),
    "sum": _of_number(lambda numbers: _over_all(numbers, np.add.reduce, _sum_of_existing)),
}
"""By the names of the grammar."""
