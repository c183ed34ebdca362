"""Selection of variants: those that satisfy a condition, or the best by objectives.

With several objectives, the best variants are those that no other variant dominates: see `fronts`.
A variant with an undefined objective (NaN) is never among the best.
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
    """Quantity to minimise or maximise."""

    expression: Expression
    sign: Literal[1, -1]
    """Factor of the quantity: 1 to minimise, -1 to maximise."""


class WhereCondition(NamedTuple):
    """Condition on variants: expressions that must all be true."""

    text: str
    parts: tuple[Expression, ...]
    """Expressions that the text joins by `and`, with values 1 for true and 0 for false."""

    def passed(
        self, tables: Tables, values: Floats, unknown: Booleans
    ) -> tuple[Booleans, tuple[int, ...]]:
        """Return a mask of variants that pass, and the number that each part removes in turn.

        Parameters
        ----------
        tables, values
            Arguments of an `Expression`.
        unknown : ndarray, shape (variants,)
            Mask of variants without results, which never pass.
        """
        passing, removed = np.ones(len(values), np.bool_), []
        for part in self.parts:
            still_passing = passing & part(tables, values).astype(np.bool_) & ~unknown
            removed.append(int(passing.sum() - still_passing.sum()))
            passing = still_passing
        return passing, tuple(removed)


def read_where(text: str, subject: Subject, targets: Sequence[Varied] | Terms) -> WhereCondition:
    """Read a condition on variants.

    Raises
    ------
    ReadError
        If the text is invalid, with the place of the error.

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
    whole = _single_value(Excerpt(text, "--where"), subject, targets)
    spans = _between_ands(text)
    parts = [whole]
    if len(spans) > 1:
        parts = [_single_value(Excerpt(text, "--where", *span), subject, targets) for span in spans]
    true = [Expression(part.text, Applied("true", (part.node,), 0, 0)) for part in parts]
    return WhereCondition(whole.text, tuple(true))


_JOINING_WORDS = re.compile(r"""\"[^\"]*\"|'[^']*'|[(\[]|[)\]]|\b(?:and|or)\b""")


def _between_ands(text: str) -> list[tuple[int, int]]:
    """Return start and end of the parts joined by `and` outside brackets; a single part with `or`.

    >>> _between_ands("a > 1 and max(b and c) < 2"), _between_ands("a and b or c")
    ([(0, 6), (9, 26)], [(0, 12)])
    """
    spans, start, depth = [], 0, 0
    for word in _JOINING_WORDS.finditer(text):
        depth += (word[0] in "([") - (word[0] in ")]")
        if depth == 0 and word[0] == "or":
            return [(0, len(text))]
        if depth == 0 and word[0] == "and":
            spans.append((start, word.start()))
            start = word.end()
    return [*spans, (start, len(text))]


def read_objective(
    text: str, subject: Subject, targets: Sequence[Varied] | Terms, option: str
) -> Objective:
    """Read an objective: a quantity to minimise (`option` ``--min``) or maximise (``--max``).

    Raises
    ------
    ReadError
        If the text is invalid, with the place of the error.
    """
    expression = _single_value(Excerpt(text, option), subject, targets)
    return Objective(expression, -1 if option == "--max" else 1)


def _single_value(
    source: Excerpt, subject: Subject, targets: Sequence[Varied] | Terms
) -> Expression:
    """Read an expression with a single value for each variant."""
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
    """Return the indices of the rows with the smallest values, the smallest first.

    Rows with equal values keep their order. For many chunks, append each chunk in turn to the best
    rows found before, and call this function again.

    Parameters
    ----------
    values : ndarray, shape (rows,)
    count : int
        Largest number of rows.

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
    """Return at most `count` rows of a Pareto front, spread over the front.

    The best row by each objective is chosen first, as far as `count` permits. Then the row farthest
    from the chosen rows is added repeatedly, where each objective is scaled by its range. Of equal
    rows, the first is taken.

    Parameters
    ----------
    objectives : ndarray, shape (rows, objectives)
        Objectives of a front, without NaN.
    count : int

    Returns
    -------
    ndarray of int, shape (at most count,)
        Indices in ascending order.

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
        if number < points.shape[1]:  # first the best row by each objective, unless already chosen
            least = np.flatnonzero(points[:, number] == points[:, number].min())
            row = int(least[np.argmax(away[least])]) if away[least].max() >= 0 else row
        chosen.append(row)
        away = np.minimum(away, ((points - points[row]) ** 2).sum(axis=1))
        away[row] = -1
    return np.sort(np.array(chosen, dtype=np.int64))
