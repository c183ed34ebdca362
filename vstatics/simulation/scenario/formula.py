"""A formula of the time, and of the speed and angle of a link; where it bends or jumps.

The language is that of a sweep (`readers.expressions`), with ``^`` beside ``**``, and with
functions of a number. A text becomes a tree, and the tree a function (`formula_code`).

``min(t/0.3, 1)`` bends at 0.3, ``100*(1 < t <= 2)`` jumps at 1 and 2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator
from functools import lru_cache
from itertools import combinations
from typing import Any, NamedTuple

from vstatics.errors import nearest, quoted, spoken
from vstatics.numerics.arrays import Floats
from vstatics.readers.expressions.excerpt import Excerpt
from vstatics.readers.expressions.grammar import Applied, Language, Tree, parse
from vstatics.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.simulation.scenario.formula_code import FUNCTIONS, PI, VARIABLES, compiled, of_times


class Formula(NamedTuple):
    """A formula of t [s], and of speed [rad/s] and angle [rad] of the link itself.

    Examples
    --------
    >>> formula = Formula("-1200*tanh(speed/0.05)")
    >>> formula.variables, formula.function(0.0, 10.0, 0.0)
    (frozenset({'speed'}), -1200.0)
    >>> Formula("2 + 84e-5*t^2").function(100.0, 0.0, 0.0)
    10.4
    """

    text: str

    @property
    def variables(self) -> frozenset[str]:
        """Which of t, speed and angle it has.

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(self.text).variables

    @property
    def function(self) -> Callable[[float, float, float], float]:
        """Its value by t, speed and angle; NaN or infinite where it has none.

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(self.text).function

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which it bends or jumps, as far as it compares straight lines in time [s].

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(self.text).breaks

    def along(self, times: Floats) -> Floats:
        """Its values at many times, of a formula of t alone."""
        return _read(self.text).of_times(times)


def read_formula(source: Excerpt, names: Collection[str] = VARIABLES) -> Formula:
    """Read a formula.

    Parameters
    ----------
    source : Excerpt
    names : collection of str
        What it may have of t, speed and angle.

    Raises
    ------
    ReadError
        With the place of what is wrong.

    Examples
    --------
    >>> read_formula(Excerpt("3000*min(t/0.3, 1)", "FH"), ["t"])
    Formula(text='3000*min(t/0.3, 1)')
    >>> read_formula(Excerpt("3000*speed", "FH"), ["t"])
    Traceback (most recent call last):
    ...
    vstatics.errors.ReadError: FH:1:6: error: read `speed`, expected a formula of t
    """
    _tree(source, names)
    return Formula(source.part.strip())


def _tree(source: Excerpt, names: Collection[str]) -> Tree:
    """The tree of a formula in which only these names stand."""
    operands = f"a number, {spoken(names, 'or')}, or a function such as {', '.join(FUNCTIONS)}"
    tree = parse(source, Language(FUNCTIONS, operands, "t", caret=True))
    for part in _parts(tree):
        if isinstance(part, Applied):
            if (
                part.name not in ("min", "max")
                and part.name in FUNCTIONS
                and len(part.operands) > 1
            ):
                count, example = len(part.operands), f"{part.name}(t)"
                message = f"{part.name} of {count} parts, expected one, as in {example}"
                raise source.error(message, part.at)
        elif isinstance(part, DottedName):
            message = f"read {quoted(part.written)}, expected {operands}"
            raise source.error(message, part.at)
        elif isinstance(part, TableName):
            _check_name(part, names, source)
    return tree


def _check_name(part: TableName, names: Collection[str], source: Excerpt) -> None:
    name = part.name
    if name == PI or name in names:
        if part.subscripts:
            message = f"read `[` behind `{name}`, expected {name} alone"
            message += ": that of the link itself" if name in ("speed", "angle") else ""
            raise source.error(message, part.at)
        return
    expected = f"expected a formula of {spoken(names)}"
    hint = "" if name in VARIABLES else nearest(name, (*names, *FUNCTIONS, PI))
    raise source.error(f"read {quoted(name)}, {expected}{hint}", part.at)


def _parts(tree: Tree) -> Iterator[Tree]:
    """All parts of a tree."""
    waiting = [tree]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, Applied):
            waiting += reversed(part.operands)


class _Read(NamedTuple):
    """What is known of a text."""

    variables: frozenset[str]
    function: Callable[[float, float, float], float]
    of_times: Callable[[Floats], Floats]
    breaks: tuple[float, ...]


@lru_cache(maxsize=256)
def _read(text: str) -> _Read:
    tree = _tree(Excerpt(text, "formula"), VARIABLES)
    names = {part.name for part in _parts(tree) if isinstance(part, TableName)}
    return _Read(frozenset(names - {PI}), compiled(tree), of_times(tree), breaks(tree))


MOST_BREAKS = 1000
"""Of a formula with more of them none are told: a run that stops at each would take for ever."""

_BENDS = frozenset(("abs", "sign"))
_COMPARES = frozenset(("min", "max", "<", "<=", ">", ">=", "==", "!="))


class _Straight(NamedTuple):
    """``value + slope t``."""

    value: float
    slope: float


_LINES = {"t": _Straight(0.0, 1.0), PI: _Straight(math.pi, 0.0)}
"""Names that stand for one."""


def breaks(tree: Tree) -> tuple[float, ...]:
    """The times, in order; those of what is no straight line are not found.

    Examples
    --------
    >>> from vstatics.readers.expressions.excerpt import Excerpt
    >>> from vstatics.readers.expressions.grammar import Language, parse
    >>> text = "max(0, 3*t - 6) + abs(2*(t - 5)/4)*(1 < t)"
    >>> breaks(parse(Excerpt(text, ""), Language(["max", "abs"], "t", "t")))
    (1.0, 2.0, 5.0)
    """
    found: set[float] = set()
    _straight(tree, found, {})
    times = sorted(time for time in found if math.isfinite(time))
    return tuple(times) if len(times) <= MOST_BREAKS else ()


def _straight(tree: Any, found: set[float], known: dict[int, Any]) -> _Straight | None:
    """A part as a straight line in time, if it is one; breaks within it are added."""
    if id(tree) not in known:
        known[id(tree)] = None
        if isinstance(tree, Constant):
            known[id(tree)] = _Straight(tree.value, 0.0)
        elif isinstance(tree, TableName):
            known[id(tree)] = _LINES.get(tree.name)
        elif isinstance(tree, Applied):
            operands = [_straight(one, found, known) for one in tree.operands]
            found.update(_meetings(tree.name, operands))
            if None not in operands:
                known[id(tree)] = _applied(tree.name, [one for one in operands if one])
    straight: _Straight | None = known[id(tree)]
    return straight


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
