"""Which variants are kept: those that fulfil a condition, the best by one or by several.

The best by several are those that no other dominates: see `fronts`. A variant for which an
objective does not exist (NaN) is never among the best.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.fronts import scaled
from vstatics.readers.expressions.excerpt import Excerpt
from vstatics.readers.expressions.grammar import Applied
from vstatics.sweep.kept.expressions import Expression, read_expression
from vstatics.sweep.variants.subject import Subject
from vstatics.sweep.variants.targets import Varied


class Objective(NamedTuple):
    """What is to be small, or large."""

    expression: Expression
    sign: Literal[1, -1]
    """By which values are multiplied, so that smaller is better."""


def read_where(text: str, subject: Subject, targets: Sequence[Varied]) -> Expression:
    """Read a condition; its values are 1 where it is true, else 0.

    Raises
    ------
    ReadError
        With the place of what is wrong.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(), Gear()])
    >>> read_where("ratio < 3", case, [])
    Traceback (most recent call last):
        ...
    vstatics.errors.ReadError: --where:1:1: error: `ratio < 3` has one value per gear: \
pick a gear, or use min, max or sum
    """
    condition = _of_one(text, subject, targets, "--where")
    return Expression(condition.text, Applied("true", (condition.node,), 0, 0))


def read_objective(
    text: str, subject: Subject, targets: Sequence[Varied], option: str
) -> Objective:
    """Read what is to be small (`option` ``--min``) or large (``--max``).

    Raises
    ------
    ReadError
        With the place of what is wrong.
    """
    expression = _of_one(text, subject, targets, option)
    return Objective(expression, -1 if option == "--max" else 1)


def _of_one(text: str, subject: Subject, targets: Sequence[Varied], option: str) -> Expression:
    """An expression, if it has one value for each variant."""
    expression = read_expression(text, subject, targets, option)
    if not expression.per:
        return expression
    parts = [f"a {name}" for name in expression.per.split(" and ")]
    raise Excerpt(text, option).error(
        f"`{expression.text}` has one value per {expression.per}: pick {' and '.join(parts)}, "
        "or use min, max or sum",
        len(text) - len(text.lstrip()),
    )


def best(values: Floats, count: int) -> Integers:
    """The rows of the smallest values, the smallest first.

    Of equal ones the first row comes first. To go through many chunks in order of their
    variants, ask for the best among those kept so far and the next chunk behind them.

    Parameters
    ----------
    values : ndarray, shape (rows,)
    count : int
        So many at most.

    Returns
    -------
    ndarray of int, shape (at most count,)

    Examples
    --------
    >>> best(np.array([3.0, np.nan, 1.0, 3.0]), 2)
    array([2, 0])
    """
    rows = np.flatnonzero(~np.isnan(values))
    if count < len(rows):
        limit = np.partition(values[rows], count - 1)[count - 1]
        rows = rows[values[rows] <= limit]
    return rows[np.argsort(values[rows], kind="stable")][:count]


def limited(objectives: Floats, count: int) -> Integers:
    """At most so many rows of a front, spread over it.

    The best by each objective come first, as many as there is room for; then always the one
    that is farthest from those chosen, with each objective measured from its least to its
    largest value on the front. Of equal ones the first row is taken.

    Parameters
    ----------
    objectives : ndarray, shape (rows, objectives)
        Of a front, without NaN.
    count : int

    Returns
    -------
    ndarray of int, shape (at most count,)
        In the order of the rows.

    Examples
    --------
    >>> limited(np.array([[0.0, 9.0], [1.0, 8.0], [5.0, 5.0], [6.0, 4.0], [9.0, 0.0]]), 3)
    array([0, 2, 4])
    """
    if count >= len(objectives):
        return np.arange(len(objectives))
    points = scaled(objectives)
    away = np.full(len(points), np.inf)
    chosen: list[int] = []
    for number in range(count):
        row = int(np.argmax(away))
        if number < points.shape[1]:  # the best by this objective, if it isn't chosen already
            least = np.flatnonzero(points[:, number] == points[:, number].min())
            row = int(least[np.argmax(away[least])]) if away[least].max() >= 0 else row
        chosen.append(row)
        away = np.minimum(away, ((points - points[row]) ** 2).sum(axis=1))
        away[row] = -1
    return np.sort(np.array(chosen, dtype=np.int64))
