"""Drag as a formula of speed: `1.2 + 0.004*w`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, Self

import numpy as np

from vstatics.core.errors import ReadError, quoted
from vstatics.core.model.parts import Law
from vstatics.core.readers.expressions.evaluation import evaluate
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Language, Tree, parse
from vstatics.core.readers.expressions.operands import DottedName, TableName
from vstatics.core.suggestions import nearest

SPEED = "w"
"""Name of the speed of a link or the slip speed of a shift element, without sign. [rad/s]"""
NAMES = (SPEED, "speed")
"""Names of the speed in a formula; in formulas of a scenario the speed has a sign."""
FUNCTIONS = ("abs", "min", "max", "sqrt", "exp", "tanh")
_OPERANDS = f"a number, the speed {SPEED} in rad/s, pi, or one of {', '.join(FUNCTIONS)}"


class DragFormula(Law):
    """Drag torque [N*m] as a formula of the speed w [rad/s].

    Examples
    --------
    >>> law = DragFormula("1.2 + 0.004*w")
    >>> law.at(100.0), law.at(np.array([0.0, 50.0])).tolist(), float(law)
    (1.6, [1.2, 1.4], 1.2)
    """

    def __new__(cls, text: str) -> Self:
        """Parse and store the text."""
        law = super().__new__(cls, _value(text, np.zeros(1))[0])
        law.text = text
        return law

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments for pickling."""
        return (self.text,)

    def at(self, size: Any) -> Any:
        """Return the torque at a speed or an array of speeds; NaN for an undefined torque."""
        values = _value(self.text, np.atleast_1d(np.asarray(size, np.float64)))
        return values if isinstance(size, np.ndarray) else float(values[0])


def read_drag_formula(text: str) -> DragFormula:
    """Parse a formula of drag.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> read_drag_formula("1.2 + 0.004*v*w")
    Traceback (most recent call last):
        ...
    ValueError: a formula of w: read `v` in it, expected a number, the speed w in rad/s, pi, or \
one of abs, min, max, sqrt, exp, tanh
    """
    try:
        return DragFormula(text.strip())
    except ReadError as error:
        raise ValueError(f"a formula of {SPEED}: {error.problems[0].message}") from None


def _value(text: str, speeds: Any) -> Any:
    tree = _tree(text)

    def value_of(name: TableName) -> Any:
        return np.array([[math.pi]]) if name.name == "pi" else speeds[:, None, None]

    values = evaluate(tree, value_of)
    return np.broadcast_to(values, (speeds.size, 1, 1))[:, 0, 0]


@lru_cache(maxsize=256)
def _tree(text: str) -> Tree:
    """Parse a formula, and check all names."""
    tree = parse(Excerpt(text, "drag"), Language(FUNCTIONS, _OPERANDS, SPEED, caret=True))
    for part in _names(tree):
        known = isinstance(part, TableName) and part.name in (*NAMES, "pi") and not part.subscripts
        if not known:
            read = part.name if isinstance(part, TableName) else part.written
            message = f"read {quoted(read)} in it, expected {_OPERANDS}"
            raise Excerpt(text, "drag").error(message + nearest(read, FUNCTIONS), part.at)
    return tree


def _names(tree: Tree) -> Iterator[TableName | DottedName]:
    """Yield all names in a tree."""
    if isinstance(tree, Applied):
        for part in tree.operands:
            yield from _names(part)
    elif isinstance(tree, TableName | DottedName):
        yield tree
