"""What is calculated with trees of formulas: sums, products, slopes over time, straight forms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial, reduce
from typing import Any, NamedTuple

from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.formula_code import PI, compiled

_STEPS = frozenset(("<", "<=", ">", ">=", "==", "!=", "and", "or", "not", "sign"))
"""Operations whose values change by jumps alone."""


def parts(tree: Tree) -> Iterator[Tree]:
    """All parts of a tree."""
    waiting = [tree]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, Applied):
            waiting += reversed(part.operands)


def variables(tree: Tree) -> frozenset[str]:
    """Which names stand in a tree, but pi; of what is seen elsewhere its word and its name."""
    names = (one for one in parts(tree) if isinstance(one, TableName) and one.name != PI)
    return frozenset(one.name + "".join(row.written for row in one.subscripts) for one in names)


def number(tree: Tree) -> float | None:
    """The value of a tree without variables."""
    return None if variables(tree) else compiled(tree)(0.0, 0.0, 0.0)


def applied(name: str, *operands: Tree) -> Tree:
    """An operation, wherever it stands: equal ones are the same tree."""
    return Applied(name, operands, 0, 0)


def bare(tree: Any) -> Tree:
    """A tree without the places in its text."""
    if isinstance(tree, Applied):
        return applied(tree.name, *map(bare, tree.operands))
    if isinstance(tree, TableName):
        rows = tuple(one._replace(at=0) for one in tree.subscripts)
        tree = TableName(tree.name, rows, 0)
    whole: Tree = tree
    return whole


def plus(first: Tree, second: Tree) -> Tree:
    """A sum."""
    if Constant(0.0) in (first, second):
        return second if first == Constant(0.0) else first
    return applied("+", first, second)


def times(first: Tree, second: Tree) -> Tree:
    """A product."""
    if Constant(0.0) in (first, second):
        return Constant(0.0)
    if Constant(1.0) in (first, second):
        return second if first == Constant(1.0) else first
    if isinstance(first, Constant) and isinstance(second, Constant):
        return Constant(first.value * second.value)
    if isinstance(second, Applied) and second.name == "*" and isinstance(first, Constant):
        return times(times(first, second.operands[0]), second.operands[1])
    return applied("*", first, second)


def minus(tree: Tree) -> Tree:
    """Of a tree."""
    return times(Constant(-1.0), tree)


_OUTER: Mapping[str, Callable[[Tree, Tree], Tree]] = {
    "abs": lambda inner, _: applied("sign", inner),
    "sqrt": lambda _, whole: applied("/", Constant(0.5), whole),
    "exp": lambda _, whole: whole,
    "tanh": lambda _, whole: plus(Constant(1.0), minus(times(whole, whole))),
    "sin": lambda inner, _: applied("cos", inner),
    "cos": lambda inner, _: minus(applied("sin", inner)),
}
"""Slopes of functions, by what they are of and by their values."""


def slope(tree: Tree) -> Tree | None:
    """The change of a tree of t with t; None where no tree tells it, as of ``2^t``.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("2*sin(3*t) + t^2", ""), Language(["sin"], "t", "t", caret=True))
    >>> compiled(slope(tree))(0.0, 0.0, 0.0)
    6.0
    """
    if not isinstance(tree, Applied):
        return Constant(float(isinstance(tree, TableName) and tree.name == "t"))
    if tree.name in _STEPS or "t" not in variables(tree):
        return Constant(0.0)
    operands: Sequence[Tree] = tree.operands
    slopes = [one for one in map(slope, operands) if one]
    return _combined(tree, operands, slopes) if len(slopes) == len(operands) else None


def _combined(tree: Applied, operands: Sequence[Tree], slopes: Sequence[Tree]) -> Tree | None:  # noqa: PLR0911 - a table
    """The slope of an operation by those of its operands."""
    first, second, one, other = operands[0], operands[-1], slopes[0], slopes[-1]
    match tree.name:
        case "-x":
            return minus(one)
        case "+":
            return plus(one, other)
        case "-":
            return plus(one, minus(other))
        case "*":
            return plus(times(one, second), times(first, other))
        case "/":
            return applied("/", plus(one, minus(times(tree, other))), second)
        case "**":
            power = number(second)
            if power is None:
                return None
            less = applied("**", first, Constant(power - 1))
            return times(one, times(Constant(power), less))
        case "min" | "max":
            return reduce(partial(_picked, tree.name), zip(operands, slopes, strict=True))[1]
    outer = _OUTER.get(tree.name)
    return times(one, outer(first, tree)) if outer else None


def _picked(name: str, one: tuple[Tree, Tree], other: tuple[Tree, Tree]) -> tuple[Tree, Tree]:
    """Of `min` or `max` of two, each with its slope."""
    is_first = applied("<" if name == "min" else ">", one[0], other[0])
    change = plus(one[1], minus(other[1]))
    return applied(name, one[0], other[0]), plus(other[1], times(is_first, change))


class StraightForm(NamedTuple):
    """``a speed + b angle + g(t)``."""

    speed: float
    angle: float
    rest: Tree

    def plus(self, other: StraightForm, factor: float = 1.0) -> StraightForm:
        """The sum with another one, multiplied."""
        more = other.times(factor)
        rest = plus(self.rest, more.rest)
        return StraightForm(self.speed + more.speed, self.angle + more.angle, rest)

    def times(self, factor: float) -> StraightForm:
        """Its product with a number."""
        rest = times(Constant(factor), self.rest)
        return StraightForm(self.speed * factor, self.angle * factor, rest)


def straight(tree: Tree) -> StraightForm | None:  # noqa: PLR0911 - a table
    """A tree as a straight form, if it is one.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> form = straight(parse(Excerpt("5 - 2*(speed - 3*angle)", ""), Language([], "t", "t")))
    >>> form.speed, form.angle, number(form.rest)
    (-2.0, 6.0, 5.0)
    """
    names = variables(tree)
    if not names & {"speed", "angle"}:
        return StraightForm(0.0, 0.0, tree)
    if not isinstance(tree, Applied):
        return StraightForm(float("speed" in names), float("angle" in names), Constant(0.0))
    operands: Sequence[Tree] = tree.operands
    first, second = straight(operands[0]), straight(operands[-1])
    left, right = number(operands[0]), number(operands[-1])
    match tree.name:
        case "-x" if first:
            return first.times(-1.0)
        case "+" if first and second:
            return first.plus(second)
        case "-" if first and second:
            return first.plus(second, -1.0)
        case "*" if first and right is not None:
            return first.times(right)
        case "*" if second and left is not None:
            return second.times(left)
        case "/" if first and right:
            return first.times(1 / right)
    return None
