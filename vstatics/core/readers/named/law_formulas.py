"""Laws as formulas: drag `1.2 + 0.004*w`, efficiency `0.98 - 1.5/(T + 20)`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Any, ClassVar, Self

import numpy as np

from vstatics.core.errors import ReadError, quoted
from vstatics.core.model.parts import Law, Size
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.expressions.evaluation import FUNCTIONS, evaluate, expect_operands
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Language, Tree, parse
from vstatics.core.readers.expressions.operands import DottedName, TableName
from vstatics.core.readers.named.arithmetic import slip
from vstatics.core.suggestions import nearest

SPEED, TORQUE = "w", "T"
"""Names in a formula for the speed [rad/s] and torque [N*m], usually without sign."""
OF_SPEED: Mapping[str, str] = MappingProxyType({SPEED: "speed", "speed": "speed"})
"""Names in formulas of drag, and their quantity. In a scenario the speed has a sign."""
OF_BOTH: Mapping[str, str] = MappingProxyType({**OF_SPEED, TORQUE: "torque", "torque": "torque"})
"""Names in formulas of efficiency, and their quantities."""


class _LawFormula(Law):
    """Law given by a formula of speed, or of speed and torque."""

    quantities: ClassVar[Mapping[str, str]]
    """Names permitted in the formula, and their quantities."""

    def __new__(cls, text: str) -> Self:
        tree = _tree(text, tuple(cls.quantities))
        of = {cls.quantities[name] for name in map(_name, _parts(tree)) if name in cls.quantities}
        law = super().__new__(cls, cls._at_0(_value(text, cls, dict.fromkeys(of, np.zeros(1)))))
        law.over = "both" if len(of) == 2 else "torque" if of == {"torque"} else "speed"
        law.text = text
        return law

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments for pickling."""
        return (self.text,)

    @staticmethod
    def _at_0(values: Floats) -> float:
        return float(values[0])

    def at(self, *sizes: Size) -> Size:
        """Return the value at a speed, a torque or both (numbers or arrays); NaN if undefined."""
        names = ("speed", "torque") if self.over == "both" else (self.over,)
        arrays = np.broadcast_arrays(*(np.atleast_1d(np.asarray(size, float)) for size in sizes))
        values = _value(self.text, type(self), dict(zip(names, arrays, strict=True)))
        is_array = any(isinstance(size, np.ndarray) for size in sizes)
        return values if is_array else float(values[0])  # type: ignore[return-value] # as given

    def is_outside(self, *sizes: Floats) -> Booleans:
        """Return False, because a formula applies everywhere."""
        return np.zeros(np.shape(sizes[0]), np.bool_)


class DragFormula(_LawFormula):
    """Drag torque [N*m] as a formula of the speed w [rad/s].

    Examples
    --------
    >>> law = DragFormula("1.2 + 0.004*w")
    >>> law.at(100.0), law.at(np.array([0.0, 50.0])).tolist(), float(law)
    (1.6, [1.2, 1.4], 1.2)
    """

    quantities = OF_SPEED


class EfficiencyFormula(_LawFormula):
    """Efficiency [-] as a formula of the speed w [rad/s] and the torque T [N*m].

    The float itself is the value at 0, or 1 if that value is not a valid efficiency.

    Examples
    --------
    >>> law = EfficiencyFormula("0.98 - 1.5/(T + 25)")
    >>> law.at(75.0), law.over, float(law)
    (0.965, 'torque', 0.9199999999999999)
    """

    quantities = OF_BOTH

    @staticmethod
    def _at_0(values: Floats) -> float:
        return float(values[0]) if 0 < values[0] <= 1 else 1.0


def read_formula(text: str, law: type[_LawFormula]) -> _LawFormula:
    """Parse a formula.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> read_formula("1.2 + 0.004*v*w", DragFormula)
    Traceback (most recent call last):
        ...
    ValueError: a formula of w: read `v` in it, expected a number, the speed w in rad/s, pi, or \
one of abs, min, max, sqrt, exp, tanh, sin, cos, sign, log, atan
    """
    try:
        return law(text.strip())
    except ReadError as error:
        of = f"{SPEED} and {TORQUE}" if law is EfficiencyFormula else SPEED
        message = error.problems[0].message
        message += slip(text) if message.startswith("read `,`") else ""
        raise ValueError(f"a formula of {of}: {message}") from None


def _value(text: str, law: type[_LawFormula], given: Mapping[str, Floats]) -> Floats:
    size = max((len(values) for values in given.values()), default=1)

    def value_of(name: TableName) -> Floats:
        if name.name == "pi":
            return np.array([[math.pi]])
        return given[law.quantities[name.name]][:, None, None]

    values = evaluate(_tree(text, tuple(law.quantities)), value_of)
    return np.broadcast_to(values, (size, 1, 1))[:, 0, 0]


@lru_cache(maxsize=256)
def _tree(text: str, names: tuple[str, ...]) -> Tree:
    """Parse a formula, and check all names and operands."""
    torque = f", the torque {TORQUE} in N*m" if TORQUE in names else ""
    operands = f"a number, the speed {SPEED} in rad/s{torque}, pi, or one of {', '.join(FUNCTIONS)}"
    excerpt = Excerpt(text, "law")
    tree = parse(excerpt, Language(FUNCTIONS, operands, SPEED, caret=True))
    for part in _parts(tree):
        if isinstance(part, Applied):
            expect_operands(part, excerpt, SPEED)
            continue
        known = isinstance(part, TableName) and not part.subscripts
        if not known or _name(part) not in (*names, "pi"):
            read = _name(part)
            message = f"read {quoted(read)} in it, expected {operands}"
            raise excerpt.error(message + nearest(read, FUNCTIONS), part.at)
    return tree


_Part = Applied | TableName | DottedName


def _name(part: _Part) -> str:
    return part.written if isinstance(part, DottedName) else part.name


def _parts(tree: Tree) -> Iterator[_Part]:
    """Yield all operators, functions and names in a tree."""
    if isinstance(tree, _Part):
        yield tree
    if isinstance(tree, Applied):
        for part in tree.operands:
            yield from _parts(part)
