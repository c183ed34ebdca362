"""Where a formula bends or jumps along one of its variables, and what it is between jumps.

A comparison, ``abs``, ``sign``, ``min`` or ``max`` of polynomials does so where these meet. What
is one by pieces, as ``abs(speed)``, is one between two corners: these are looked for again between
those that are known.

``min(t/0.3, 1)`` bends at 0.3, ``100*(abs(speed) < 300)`` jumps at -300 and 300.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from itertools import combinations, pairwise, zip_longest
from typing import Any, TypeAlias

import numpy as np

from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.evaluation import evaluate
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.formula_code import PI
from vstatics.simulation.scenario.table_call import TableCall

MOST_BREAKS = 1000
"""Of a formula with more of them none are told: a run that stops at each would take for ever."""

COMPARES = frozenset(("<", "<=", ">", ">=", "==", "!="))
JUMPS = COMPARES | {"sign"}
BENDS = frozenset(("abs", "min", "max"))
ENDS = BENDS | {"sqrt"}
"""What bends, or ends: a root of what falls below 0."""


_MOST_DEGREE = 8
"""Polynomials of a higher one are not looked at."""

Polynomial: TypeAlias = tuple[float, ...]
"""What stands before 1, x, x^2, ...; the last of several is not 0."""


def value_at(polynomial: Polynomial, x: float) -> float:
    """The value of a polynomial."""
    return reduce(lambda total, factor: total * x + factor, reversed(polynomial))


def corners(tree: Tree, name: str) -> dict[float, bool]:
    """The corners along a variable, in order, each with whether the formula may jump there.

    Those of what is no polynomial are not found.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> text = "max(0, 3*t - 6) + abs(2*(t - 5)/4)*(1 < t)"
    >>> corners(parse(Excerpt(text, ""), Language(["max", "abs"], "t", "t")), "t")
    {1.0: True, 2.0: False, 5.0: False}
    """
    found: dict[float, bool] = {}
    waiting = [(-math.inf, math.inf)]
    while waiting:
        low, high = waiting.pop()
        met: list[tuple[float, bool]] = []
        _polynomial(tree, name, _inside(low, high), met)
        within = [(at, jumps) for at, jumps in met if low <= at <= high and math.isfinite(at)]
        bends = {at for at, jumps in within if not jumps}.difference(found)
        fresh = sorted(bends or {at for at, _ in within}.difference(found))
        for at, jumps in within:
            if at in found or at in fresh:  # beyond a bend what else was met may not be
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
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("5*t*(t < 2)", ""), Language([], "t", "t"))
    >>> [between(tree, "t", *ends).operands[1] for ends in ((-math.inf, 2.0), (2.0, math.inf))]
    [Constant(value=1.0), Constant(value=0.0)]
    """
    decided: Tree = _decided(tree, name, _inside(low, high))
    return decided


def _decided(tree: Any, name: str, at: float, *, inside: bool = False) -> Any:
    """A tree by what it is near a place; `abs`, `min`, `max` only in what is compared."""
    if not isinstance(tree, Applied):
        return tree
    if tree.name in JUMPS:
        value = _polynomial(tree, name, at, [])
        if value is not None:
            return Constant(value_at(value, at))
        inside = True
    operands = tuple(_decided(one, name, at, inside=inside) for one in tree.operands)
    if inside and tree.name in BENDS:
        known = [_polynomial(one, name, at, []) for one in operands]
        if None not in known:
            return _picked(tree, operands, [value_at(one, at) for one in known if one])
    return tree._replace(operands=operands)


def is_polynomial(tree: Tree, name: str) -> bool:
    """Whether a tree is one of a variable, by pieces: then `corners` tells where it meets 0."""
    return _polynomial(tree, name, 0.0, []) is not None


def _polynomial(
    tree: Any, name: str, at: float, met: list[tuple[float, bool]]
) -> Polynomial | None:
    """A part as a polynomial near a place, if it is one; where those in it meet is added."""
    if not isinstance(tree, Applied):
        return _of_operand(tree, name)
    inner: list[tuple[float, bool]] = []
    operands = [_polynomial(one, name, at, inner) for one in tree.operands]
    known = [one for one in operands if one]
    if isinstance(tree.name, TableCall):
        met += inner
        return _of_table(tree.name.table, operands, at, met)
    jumps = tree.name in JUMPS
    met += ((place, bends or (jumps and None in operands)) for place, bends in inner)
    if jumps or tree.name in ENDS:
        met += ((place, jumps) for place in _meetings(known, len(operands)))
    if len(known) < len(operands):
        return None
    if jumps or not any(len(one) > 1 for one in known):
        return (_value(tree, [value_at(one, at) for one in known]),)
    if tree.name in BENDS:
        values = [value_at(one, at) for one in known]
        picked: Polynomial = _picked(tree, known, values, lambda one: tuple(-part for part in one))
        return picked
    return _applied(tree.name, known)


def _of_operand(operand: Any, name: str) -> Polynomial | None:
    """A number, or the variable itself."""
    names: dict[str, Polynomial] = {name: (0.0, 1.0), PI: (math.pi,)}
    if isinstance(operand, Constant):
        return (operand.value,)
    return None if operand.subscripts else names.get(operand.name)


def _of_table(
    table: LookupTable,
    operands: Sequence[Polynomial | None],
    at: float,
    met: list[tuple[float, bool]],
) -> Polynomial | None:
    """A table of one variable is straight between its points."""
    [inner, *others] = operands
    if others or inner is None:
        return None
    twice = {one for one, next_one in pairwise(table.x) if one == next_one}
    met += ((root, x in twice) for x in table.x for root in _roots(_sum(inner, (-x,))))
    value, slope = table.line_at(value_at(inner, at))
    return _sum((value,), inner, slope) if slope else (value,)


def _value(tree: Applied, values: list[float]) -> float:
    """Of an operation on numbers."""
    constants = tree._replace(operands=tuple(map(Constant, values)))
    return float(evaluate(constants, lambda _: np.zeros((1, 1))).item())


def _picked(
    tree: Applied,
    operands: Sequence[Any],
    values: Sequence[float],
    minus: Callable[[Any], Any] = lambda one: Applied("-x", (one,), 0, 0),
) -> Any:
    """Which of its operands `abs`, `min` or `max` is, by their values."""
    if tree.name == "abs":
        return minus(operands[0]) if values[0] < 0 else operands[0]
    return operands[values.index((min if tree.name == "min" else max)(values))]


def _meetings(known: list[Polynomial], count: int) -> Iterator[float]:
    """Where polynomials that are compared meet, or one is 0."""
    if count == 1:
        known = [*known, (0.0,)]
    for one, other in combinations(known, 2):
        yield from _roots(_sum(one, other, -1.0))


def _roots(polynomial: Polynomial) -> Iterator[float]:
    """Where a polynomial is 0."""
    if len(polynomial) == 2:
        yield -polynomial[0] / polynomial[1]
    elif len(polynomial) > 2 and all(map(math.isfinite, polynomial)):
        for root in np.roots(polynomial[::-1]):
            if root.imag == 0:
                yield float(root.real)


def _sum(one: Polynomial, other: Polynomial, factor: float = 1.0) -> Polynomial:
    """One and another that is multiplied."""
    made = [a + factor * b for a, b in zip_longest(one, other, fillvalue=0.0)]
    while len(made) > 1 and not made[-1]:
        made.pop()
    return tuple(made)


def _product(one: Polynomial, other: Polynomial) -> Polynomial | None:
    if len(one) + len(other) - 2 > _MOST_DEGREE:
        return None
    shifted = ((*(0.0,) * power, *(part * a for a in other)) for power, part in enumerate(one))
    return reduce(_sum, shifted)


def _applied(name: str, operands: Sequence[Polynomial]) -> Polynomial | None:  # noqa: PLR0911 - a table
    """An operation on polynomials that gives one."""
    first, second = operands[0], operands[-1]
    match name:
        case "-x":
            return _sum((0.0,), first, -1.0)
        case "+":
            return _sum(first, second)
        case "-":
            return _sum(first, second, -1.0)
        case "*":
            return _product(first, second)
        case "/" if len(second) == 1 and second[0]:
            return tuple(part / second[0] for part in first)
        case "**" if len(second) == 1 and second[0] in range(1, _MOST_DEGREE + 1):
            whole: Polynomial | None = first
            for _ in range(int(second[0]) - 1):
                whole = _product(whole, first) if whole else None
            return whole
    return None
