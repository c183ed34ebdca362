"""Algebra of formulas, as trees of operations: sums, products, derivatives, linear forms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial, reduce
from typing import Any, NamedTuple

from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.formula_code import PI, compiled

_STEPS = frozenset(("<", "<=", ">", ">=", "==", "!=", "and", "or", "not", "sign"))
"""Operations whose values are constant between jumps."""


def parts(tree: Tree) -> Iterator[Tree]:
    """Yield all subtrees of a formula, outermost first."""
    waiting = [tree]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, Applied):
            waiting += reversed(part.operands)


def variables(tree: Tree) -> frozenset[str]:
    """Return the names of variables in a tree, with their subscripts, but without pi."""
    names = (name for name in parts(tree) if isinstance(name, TableName) and name.name != PI)
    return frozenset(name.name + "".join(row.written for row in name.subscripts) for name in names)


def number(tree: Tree) -> float | None:
    """Return the value of a tree without variables, otherwise None."""
    return None if variables(tree) else compiled(tree)(0.0, 0.0, 0.0)


def applied(name: str, *operands: Tree) -> Tree:
    """Build an operation without its position in a text, so that equal operations compare equal."""
    return Applied(name, operands, 0, 0)


def bare(tree: Any) -> Tree:
    """Return a tree without positions in a text, so that equal formulas compare equal."""
    if isinstance(tree, Applied):
        return applied(tree.name, *map(bare, tree.operands))
    if isinstance(tree, TableName):
        rows = tuple(row._replace(at=0) for row in tree.subscripts)
        tree = TableName(tree.name, rows, 0)
    whole: Tree = tree
    return whole


def with_names(tree: Any, replaced: Callable[[TableName], Tree]) -> Tree:
    """Return a tree with each name replaced by the tree that `replaced` returns."""
    if isinstance(tree, Applied):
        operands = (with_names(operand, replaced) for operand in tree.operands)
        return tree._replace(operands=tuple(operands))
    whole: Tree = replaced(tree) if isinstance(tree, TableName) else tree
    return whole


def plus(first: Tree, second: Tree) -> Tree:
    """Return the sum of two trees."""
    if Constant(0.0) in (first, second):
        return second if first == Constant(0.0) else first
    return applied("+", first, second)


def times(first: Tree, second: Tree) -> Tree:
    """Return the product of two trees."""
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
    """Return the negative of a tree."""
    return times(Constant(-1.0), tree)


_OUTER: Mapping[str, Callable[[Tree, Tree], Tree]] = {
    "abs": lambda inner, _: applied("sign", inner),
    "sqrt": lambda _, whole: applied("/", Constant(0.5), whole),
    "exp": lambda _, whole: whole,
    "tanh": lambda _, whole: plus(Constant(1.0), minus(times(whole, whole))),
    "sin": lambda inner, _: applied("cos", inner),
    "cos": lambda inner, _: minus(applied("sin", inner)),
    "log": lambda inner, _: applied("/", Constant(1.0), inner),
    "atan": lambda inner, _: applied("/", Constant(1.0), plus(Constant(1.0), times(inner, inner))),
}
"""Derivative of each function, calculated from the trees of its argument and its value."""


def slope(tree: Tree) -> Tree | None:
    """Return the derivative of a tree with respect to t, or None if unknown, as for ``2^t``.

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
    operands = tree.operands
    slopes = [change for change in map(slope, operands) if change]
    return _combined(tree, operands, slopes) if len(slopes) == len(operands) else None


def _combined(tree: Applied, operands: Sequence[Tree], slopes: Sequence[Tree]) -> Tree | None:  # noqa: PLR0911 - a table
    first, second, change, last_change = operands[0], operands[-1], slopes[0], slopes[-1]
    match tree.name:
        case "-x":
            return minus(change)
        case "+":
            return plus(change, last_change)
        case "-":
            return plus(change, minus(last_change))
        case "*":
            return plus(times(change, second), times(first, last_change))
        case "/":
            return applied("/", plus(change, minus(times(tree, last_change))), second)
        case "**":
            power = number(second)
            if power is None:
                return None
            lowered = applied("**", first, Constant(power - 1))
            return times(change, times(Constant(power), lowered))
        case "min" | "max":
            return reduce(partial(_picked, tree.name), zip(operands, slopes, strict=True))[1]
    outer = _OUTER.get(tree.name)
    return times(change, outer(first, tree)) if outer else None


def _picked(name: str, left: tuple[Tree, Tree], right: tuple[Tree, Tree]) -> tuple[Tree, Tree]:
    """Return the value and the derivative of `min` or `max`; each operand is such a pair, too."""
    is_first = applied("<" if name == "min" else ">", left[0], right[0])
    change = plus(left[1], minus(right[1]))
    return applied(name, left[0], right[0]), plus(right[1], times(is_first, change))


class StraightForm(NamedTuple):
    """Linear form ``speed*w + angle*phi + offset(t)`` in the speed w and angle phi of a link."""

    speed: float
    angle: float
    offset: Tree

    def plus(self, other: StraightForm, factor: float = 1.0) -> StraightForm:
        """Return the sum of this form and `other` times `factor`."""
        addend = other.times(factor)
        offset = plus(self.offset, addend.offset)
        return StraightForm(self.speed + addend.speed, self.angle + addend.angle, offset)

    def times(self, factor: float) -> StraightForm:
        """Return this form times a factor."""
        offset = times(Constant(factor), self.offset)
        return StraightForm(self.speed * factor, self.angle * factor, offset)


def straight(tree: Tree) -> StraightForm | None:  # noqa: PLR0911 - a table
    """Return a tree as a linear form in speed and angle, None if not linear.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> form = straight(parse(Excerpt("5 - 2*(speed - 3*angle)", ""), Language([], "t", "t")))
    >>> form.speed, form.angle, number(form.offset)
    (-2.0, 6.0, 5.0)
    """
    names = variables(tree)
    if not names & {"speed", "angle"}:
        return StraightForm(0.0, 0.0, tree)
    if not isinstance(tree, Applied):
        return StraightForm(float("speed" in names), float("angle" in names), Constant(0.0))
    operands = tree.operands
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
