"""Times at which a formula bends or jumps, where it compares what is straight in time.

``min(t/0.3, 1)`` bends at 0.3, ``100*(1 < t <= 2)`` jumps at 1 and 2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any, NamedTuple

from vstatics.readers.expressions.grammar import Applied, Tree
from vstatics.readers.expressions.operands import Constant, TableName

MOST_BREAKS = 1000
"""Of a formula with more of them none are told: a run that stops at each would take for ever."""

_BENDS = frozenset(("abs", "sign"))
_COMPARES = frozenset(("min", "max", "<", "<=", ">", ">=", "==", "!="))


class _Straight(NamedTuple):
    """``value + slope t``."""

    value: float
    slope: float


def breaks(tree: Tree, constants: Mapping[str, float]) -> tuple[float, ...]:
    """The times, in order; those of what is no straight line are not found.

    Parameters
    ----------
    tree : Tree
    constants : mapping of str to float
        Names that stand for a number.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> text = "max(0, 3*t - 6) + abs(2*(t - 5)/4)*(1 < t)"
    >>> breaks(parse(Excerpt(text, ""), Language(["max", "abs"], "t", "t")), {})
    (1.0, 2.0, 5.0)
    """
    found: set[float] = set()
    _straight(tree, constants, found, {})
    times = sorted(time for time in found if math.isfinite(time))
    return tuple(times) if len(times) <= MOST_BREAKS else ()


def _straight(
    tree: Any, constants: Mapping[str, float], found: set[float], known: dict[int, Any]
) -> _Straight | None:
    """A part as a straight line in time, if it is one; breaks within it are added."""
    if id(tree) not in known:
        known[id(tree)] = None
        if isinstance(tree, Constant):
            known[id(tree)] = _Straight(tree.value, 0.0)
        elif isinstance(tree, TableName):
            known[id(tree)] = _named(tree.name, constants)
        elif isinstance(tree, Applied):
            operands = [_straight(one, constants, found, known) for one in tree.operands]
            found.update(_meetings(tree.name, operands))
            if None not in operands:
                known[id(tree)] = _applied(tree.name, [one for one in operands if one])
    straight: _Straight | None = known[id(tree)]
    return straight


def _named(name: str, constants: Mapping[str, float]) -> _Straight | None:
    if name in constants:
        return _Straight(constants[name], 0.0)
    return _Straight(0.0, 1.0) if name == "t" else None


def _meetings(name: str, operands: list[_Straight | None]) -> Iterator[float]:
    """Where lines that are compared meet, or one is 0."""
    lines = [one for one in operands if one]
    if name in _BENDS and len(operands) == 1:
        lines.append(_Straight(0.0, 0.0))
    elif name not in _COMPARES:
        return
    for one, other in combinations(lines, 2):
        if one.slope != other.slope:
            yield (other.value - one.value) / (one.slope - other.slope)


def _applied(name: str, operands: list[_Straight]) -> _Straight | None:  # noqa: PLR0911 - a table
    """An operation of lines that gives a line."""
    first, second = operands[0], operands[-1]
    match name:
        case "-x":
            return _Straight(-first.value, -first.slope)
        case "+":
            return _Straight(first.value + second.value, first.slope + second.slope)
        case "-":
            return _Straight(first.value - second.value, first.slope - second.slope)
        case "*" if not second.slope:
            return _Straight(first.value * second.value, first.slope * second.value)
        case "*" if not first.slope:
            return _Straight(first.value * second.value, first.value * second.slope)
        case "/" if second.value and not second.slope:
            return _Straight(first.value / second.value, first.slope / second.value)
    return None
