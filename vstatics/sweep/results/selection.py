"""Which variants are kept: those that fulfil a condition, the best by one or by several.

The best by several are those that no other dominates: see `fronts`. A variant for which an
objective does not exist (NaN) is never among the best.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.fronts import scaled
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import Expression, Terms, read_expression
from vstatics.sweep.results.meanings import Tables
from vstatics.sweep.variants.targets import Varied


class Objective(NamedTuple):
    """What is to be small, or large."""

    expression: Expression
    sign: Literal[1, -1]
    """By which values are multiplied, so that smaller is better."""


class WhereCondition(NamedTuple):
    """Which variants are written: those for which all of its parts hold."""

    text: str
    parts: tuple[Expression, ...]
    """What stands between `and`; values are 1 where it is true, else 0."""

    def passed(
        self, tables: Tables, values: Floats, unknown: Booleans
    ) -> tuple[Booleans, tuple[int, ...]]:
        """Which variants pass, and how many of those that are left each part removes.

        Parameters
        ----------
        tables, values
            As an `Expression` takes them.
        unknown : ndarray, shape (variants,)
            Variants that pass nothing.
        """
        left, removed = np.ones(len(values), np.bool_), []
        for part in self.parts:
            now = left & part(tables, values).astype(np.bool_) & ~unknown
            removed.append(int(left.sum() - now.sum()))
            left = now
        return left, tuple(removed)


def read_where(text: str, subject: Subject, targets: Sequence[Varied] | Terms) -> WhereCondition:
    """Read a condition.

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
    vstatics.core.errors.ReadError: --where:1:1: error: `ratio < 3` has one value per gear: \
pick a gear, or use min, max or sum [E105]
    """
    whole = _of_one(Excerpt(text, "--where"), subject, targets)
    spans = _between_ands(text)
    parts = [whole]
    if len(spans) > 1:
        parts = [_of_one(Excerpt(text, "--where", *span), subject, targets) for span in spans]
    true = [Expression(part.text, Applied("true", (part.node,), 0, 0)) for part in parts]
    return WhereCondition(whole.text, tuple(true))


_JOINING_WORDS = re.compile(r"""\"[^\"]*\"|'[^']*'|[(\[]|[)\]]|\b(?:and|or)\b""")


def _between_ands(text: str) -> list[tuple[int, int]]:
    """The ends of the parts between `and`, as far as brackets and `or` do not join them.

    >>> _between_ands("a > 1 and max(b and c) < 2"), _between_ands("a and b or c")
    ([(0, 6), (9, 26)], [(0, 12)])
    """
    spans, start, depth = [], 0, 0
    for found in _JOINING_WORDS.finditer(text):
        depth += (found[0] in "([") - (found[0] in ")]")
        if depth == 0 and found[0] == "or":
            return [(0, len(text))]
        if depth == 0 and found[0] == "and":
            spans.append((start, found.start()))
            start = found.end()
    return [*spans, (start, len(text))]


def read_objective(
    text: str, subject: Subject, targets: Sequence[Varied] | Terms, option: str
) -> Objective:
    """Read what is to be small (`option` ``--min``) or large (``--max``).

    Raises
    ------
    ReadError
        With the place of what is wrong.
    """
    expression = _of_one(Excerpt(text, option), subject, targets)
    return Objective(expression, -1 if option == "--max" else 1)


def _of_one(source: Excerpt, subject: Subject, targets: Sequence[Varied] | Terms) -> Expression:
    """An expression, if it has one value for each variant."""
    expression = read_expression(source, subject, targets)
    if not expression.per:
        return expression
    parts = [f"a {name}" for name in expression.per.split(" and ")]
    raise source.error(
        f"`{expression.text}` has one value per {expression.per}: pick {' and '.join(parts)}, "
        "or use min, max or sum",
        source.start + len(source.part) - len(source.part.lstrip()),
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
