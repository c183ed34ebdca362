"""Where a formula bends or jumps along one of its variables, and what it is between jumps.

A comparison, ``abs``, ``sign``, ``min`` or ``max`` of straight lines does so where these meet.
What is straight by pieces, as ``abs(speed)``, is a line between two corners: these are looked for
again between those that are known.

``min(t/0.3, 1)`` bends at 0.3, ``100*(abs(speed) < 300)`` jumps at -300 and 300.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations, pairwise
from typing import Any, NamedTuple

import numpy as np

from vstatics.readers.expressions.evaluation import evaluate
from vstatics.readers.expressions.grammar import Applied, Tree
from vstatics.readers.expressions.operands import Constant
from vstatics.simulation.scenario.formula_code import NO_TABLES, PI
from vstatics.simulation.scenario.tables import Table

MOST_BREAKS = 1000
"""Of a formula with more of them none are told: a run that stops at each would take for ever."""

COMPARES = frozenset(("<", "<=", ">", ">=", "==", "!="))
JUMPS = COMPARES | {"sign"}
_MEETS = JUMPS | {"abs", "min", "max"}


class StraightLine(NamedTuple):
    """``value + slope x``."""

    value: float
    slope: float

    def at(self, x: float) -> float:
        """Its value."""
        return self.value + self.slope * x


def corners(tree: Tree, name: str, tables: Mapping[str, Table] = NO_TABLES) -> dict[float, bool]:
    """The corners along a variable, in order, each with whether the formula may jump there.

    Those of what is no straight line are not found.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> text = "max(0, 3*t - 6) + abs(2*(t - 5)/4)*(1 < t)"
    >>> corners(parse(Excerpt(text, ""), Language(["max", "abs"], "t", "t")), "t")
    {1.0: True, 2.0: False, 5.0: False}
    """
    found: dict[float, bool] = {}
    waiting = [(-math.inf, math.inf)]
    while waiting:
        low, high = waiting.pop()
        met: list[tuple[float, bool]] = []
        _line(tree, name, _inside(low, high), met, tables)
        within = [(at, jumps) for at, jumps in met if low <= at <= high and math.isfinite(at)]
        fresh = sorted({at for at, _ in within}.difference(found))
        for at, jumps in within:
            found[at] = found.get(at, False) or jumps
        if len(found) > MOST_BREAKS:
            return {}
        if fresh:
            waiting += pairwise([low, *fresh, high])
    return dict(sorted(found.items()))


def _inside(low: float, high: float) -> float:
    """A place between two, either of which may be infinite."""
    if math.isinf(low):
        return 0.0 if math.isinf(high) else high - max(1.0, abs(high))
    return low + max(1.0, abs(low)) if math.isinf(high) else low / 2 + high / 2


def between(tree: Tree, name: str, low: float, high: float) -> Tree:
    """The formula between two jumps along a variable: what is decided there is a number.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("5*t*(t < 2)", ""), Language([], "t", "t"))
    >>> [between(tree, "t", *ends).operands[1] for ends in ((-math.inf, 2.0), (2.0, math.inf))]
    [Constant(value=1.0), Constant(value=0.0)]
    """
    decided: Tree = _decided(tree, name, _inside(low, high))
    return decided


def _decided(tree: Any, name: str, at: float) -> Any:
    if not isinstance(tree, Applied):
        return tree
    if tree.name in JUMPS:
        line = _line(tree, name, at, [])
        if line is not None:
            return Constant(line.at(at))
    return tree._replace(operands=tuple(_decided(one, name, at) for one in tree.operands))


def _line(
    tree: Any,
    name: str,
    at: float,
    met: list[tuple[float, bool]],
    tables: Mapping[str, Table] = NO_TABLES,
) -> StraightLine | None:
    """A part as a straight line near a place, if it is one; where lines in it meet is added."""
    if not isinstance(tree, Applied):
        return _of_operand(tree, name)
    operands = [_line(one, name, at, met, tables) for one in tree.operands]
    if tree.name in tables:
        return _of_table(tables[tree.name], operands, at, met)
    lines = [one for one in operands if one]
    if tree.name in _MEETS:
        met += ((place, tree.name in JUMPS) for place in _meetings(lines, len(operands)))
    if len(lines) < len(operands):
        return None
    if not any(line.slope for line in lines) or tree.name in JUMPS:
        return StraightLine(_value(tree, [line.at(at) for line in lines]), 0.0)
    if tree.name in ("abs", "min", "max"):
        return _picked(tree.name, lines, at)
    return _applied(tree.name, lines)


def _of_operand(operand: Any, name: str) -> StraightLine | None:
    """A number, or the variable itself."""
    if isinstance(operand, Constant):
        return StraightLine(operand.value, 0.0)
    known = {name: StraightLine(0.0, 1.0), PI: StraightLine(math.pi, 0.0)}
    return None if operand.subscripts else known.get(operand.name)


def _of_table(
    table: Table,
    operands: list[StraightLine | None],
    at: float,
    met: list[tuple[float, bool]],
) -> StraightLine | None:
    """A table of one variable is straight between its points."""
    [line, *others] = operands
    if others or line is None:
        return None
    if line.slope:
        twice = {one for one, next_one in pairwise(table.x) if one == next_one}
        met += (((x - line.value) / line.slope, x in twice) for x in table.x)
    value, slope = table.line_at(line.at(at))
    return StraightLine(value + slope * line.value, slope * line.slope)


def _value(tree: Applied, values: list[float]) -> float:
    """Of an operation on numbers."""
    constants = tree._replace(operands=tuple(map(Constant, values)))
    return float(evaluate(constants, lambda _: np.zeros((1, 1))).item())


def _picked(name: str, lines: list[StraightLine], at: float) -> StraightLine:
    """Which line `abs`, `min` or `max` is near a place."""
    if name == "abs" or len(lines) == 1:
        [line] = lines
        negative = name == "abs" and line.at(at) < 0
        return StraightLine(-line.value, -line.slope) if negative else line
    return (min if name == "min" else max)(lines, key=lambda line: line.at(at))


def _meetings(lines: list[StraightLine], count: int) -> Iterator[float]:
    """Where lines that are compared meet, or one is 0."""
    if count == 1:
        lines = [*lines, StraightLine(0.0, 0.0)]
    for one, other in combinations(lines, 2):
        if one.slope != other.slope:
            yield (other.value - one.value) / (one.slope - other.slope)


def _applied(name: str, operands: list[StraightLine]) -> StraightLine | None:  # noqa: PLR0911 - a table
    """An operation of lines that gives a line."""
    first, second = operands[0], operands[-1]
    match name:
        case "-x":
            return StraightLine(-first.value, -first.slope)
        case "+":
            return StraightLine(first.value + second.value, first.slope + second.slope)
        case "-":
            return StraightLine(first.value - second.value, first.slope - second.slope)
        case "*" if not second.slope:
            return StraightLine(first.value * second.value, first.slope * second.value)
        case "*" if not first.slope:
            return StraightLine(first.value * second.value, first.value * second.slope)
        case "/" if second.value and not second.slope:
            return StraightLine(first.value / second.value, first.slope / second.value)
    return None
