"""Values of a resolved expression, for all variants at once.

Every value has the axes (..., gears, rows), as in `Results`; where an expression has no
gears or no rows this axis has the length 1, so that NumPy spreads it over the other
operand. Selections are views of the results, whatever their strides.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.results import Results

Values = Floats | Booleans


class Constant(NamedTuple):
    """A number."""

    value: float


class Given(NamedTuple):
    """A varied number."""

    column: int


class Selection(NamedTuple):
    """A table of the results, or what is left of it."""

    table: str
    gear: int | None
    """None for all gears."""
    row: int | None
    """None for all rows, or where the table has none."""
    has_rows: bool


class Applied(NamedTuple):
    """An operator or a function of values."""

    name: str
    operands: tuple[Node, ...]


Node = Constant | Given | Selection | Applied


def evaluate(node: Node, results: Results, values: Floats) -> Floats:
    """The values of a node.

    Parameters
    ----------
    node : Node
    results : Results
        With leading axes of variants.
    values : ndarray, shape (..., targets)
        The varied numbers, with the same leading axes. [-]

    Returns
    -------
    ndarray, shape (..., gears or 1, rows or 1)
        1 and 0 for true and false; it may be a view of the results. Variants have the length
        1 if the values are the same for all. [-]
    """
    with np.errstate(all="ignore"):
        return _numbers(_values(node, results, values))


def truth(values: Values) -> Booleans:
    """What a value says as a condition: true unless it is 0, infinite or does not exist.

    >>> truth(np.array([2.0, 0.0, np.nan, np.inf]))
    array([ True, False, False, False])
    """
    made: Any = values if values.dtype == np.bool_ else (values != 0) & np.isfinite(values)
    return made  # type: ignore[no-any-return]


def _values(node: Node, results: Results, given: Floats) -> Values:
    match node:
        case Constant(value):
            return np.full((1,) * (given.ndim + 1), value)
        case Given(column):
            return given[..., column, None, None]
        case Selection():
            return _selected(node, results)
        case Applied(name, operands):
            return _OPERATIONS[name]([_values(one, results, given) for one in operands])


def _selected(part: Selection, results: Results) -> Values:
    """A view of a table; numbers and marks that are no floats become floats in a copy."""
    table: Any = results.existing(part.table)
    if not part.has_rows:
        table = table[..., None]
    gears, rows = (
        slice(None) if index is None else slice(index, index + 1) for index in (part.gear, part.row)
    )
    return _numbers(table[..., gears, rows])


def _numbers(values: Any) -> Floats:
    made: Floats = values.astype(np.float64, copy=False)
    return made


def _with_numbers(function: Callable[..., Any]) -> Callable[[Sequence[Values]], Values]:
    """An operation on numbers, from the left to the right if there are more than two."""

    def applied(operands: Sequence[Values]) -> Values:
        numbers = map(_numbers, operands)
        if len(operands) == 1:
            return function(*numbers)  # type: ignore[no-any-return]
        return reduce(function, numbers)

    return applied


def _with_truth(function: Callable[[Any, Any], Any]) -> Callable[[Sequence[Values]], Values]:
    def applied(operands: Sequence[Values]) -> Values:
        return reduce(function, map(truth, operands))

    return applied


def _unequal(first: Floats, second: Floats) -> Booleans:
    """Unlike NumPy's: false if a number does not exist, as all comparisons are."""
    made: Booleans = (first < second) | (first > second)
    return made


def _extreme(among: np.ufunc, existing: np.ufunc) -> Callable[[Sequence[Values]], Values]:
    """The least or the largest: of all gears and rows, or of several operands.

    `among` gives NaN where one value does not exist, and is fast; `existing` leaves it out.
    """

    def applied(operands: Sequence[Values]) -> Values:
        if len(operands) > 1:
            return reduce(existing, map(_numbers, operands))
        return _over_all(_numbers(operands[0]), among.reduce, existing.reduce)

    return applied


def _sum(operands: Sequence[Values]) -> Values:
    return _over_all(_numbers(operands[0]), np.add.reduce, _sum_of_existing)


def _over_all(values: Floats, among: Any, existing: Any) -> Floats:
    """Reduce gears and rows to one number; again without NaN for the variants that have any."""
    made: Floats = among(values, axis=(-2, -1), keepdims=True)
    lacking = np.isnan(made[..., 0, 0])
    if lacking.any():
        made[lacking] = existing(values[lacking], axis=(-2, -1), keepdims=True)
    return made


def _sum_of_existing(values: Floats, **axes: Any) -> Floats:
    """The sum of what exists; NaN if nothing does."""
    lacking = np.isnan(values)
    made: Floats = np.where(lacking, 0.0, values).sum(**axes)
    made[lacking.all(**axes)] = np.nan
    return made


_OPERATIONS: Mapping[str, Callable[[Sequence[Values]], Values]] = {
    "+": _with_numbers(operator.add),
    "-": _with_numbers(operator.sub),
    "*": _with_numbers(operator.mul),
    "/": _with_numbers(operator.truediv),
    "**": _with_numbers(operator.pow),
    "negative": _with_numbers(operator.neg),
    "abs": _with_numbers(np.abs),
    "<": _with_numbers(operator.lt),
    "<=": _with_numbers(operator.le),
    ">": _with_numbers(operator.gt),
    ">=": _with_numbers(operator.ge),
    "==": _with_numbers(operator.eq),
    "!=": _with_numbers(_unequal),
    "and": _with_truth(operator.and_),
    "or": _with_truth(operator.or_),
    "not": lambda operands: ~truth(operands[0]),
    "min": _extreme(np.minimum, np.fmin),
    "max": _extreme(np.maximum, np.fmax),
    "sum": _sum,
    "true": lambda operands: truth(operands[0]),
}
