"""Corners (bends and jumps) of a formula along a variable, and the pieces between them.

A comparison, ``abs``, ``sign``, ``min`` or ``max`` of polynomials bends or jumps where the
polynomials are equal. A piecewise polynomial, such as ``abs(speed)``, is a polynomial between two
corners, so the search is repeated between the known corners until no new corner appears.

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

COMPARES = frozenset(("<", "<=", ">", ">=", "==", "!="))
JUMPS = COMPARES | {"sign"}
BENDS = frozenset(("abs", "min", "max"))
ENDS = BENDS | {"sqrt"}
"""Functions that bend, and `sqrt`, whose domain begins at 0 with an infinite slope."""


_MOST_DEGREE = 8
"""Highest degree of polynomials inside functions with corners, such as `abs`."""

Polynomial: TypeAlias = tuple[float, ...]
"""Coefficients of 1, x, x^2, ...; the last is not 0 unless it is the only coefficient."""


def value_at(polynomial: Polynomial, x: float) -> float:
    """Return the value of a polynomial."""
    return reduce(lambda total, factor: total * x + factor, reversed(polynomial))


def corners(tree: Tree, name: str) -> dict[float, bool]:
    """Find the corners along a variable in order, each with True if a jump is possible there.

    Only corners of piecewise polynomials are found.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> text = "max(0, 3*t - 6) + abs(2*(t - 5)/4)*(1 < t)"
    >>> corners(parse(Excerpt(text, ""), Language(["max", "abs"], "t", "t")), "t")
    {1.0: True, 2.0: False, 5.0: False}
    """
    known: dict[float, bool] = {}
    waiting = [(-math.inf, math.inf)]
    while waiting:
        low, high = waiting.pop()
        meetings: list[tuple[float, bool]] = []
        _polynomial(tree, name, _number_between(low, high), meetings)
        within = [
            (place, jumps)
            for place, jumps in meetings
            if low <= place <= high and math.isfinite(place)
        ]
        bends = {place for place, jumps in within if not jumps}.difference(known)
        fresh = sorted(bends or {place for place, _ in within}.difference(known))
        # If there are new bends, no new jumps are added, because jumps can vanish beyond a bend.
        for place, jumps in within:
            if place in known or place in fresh:
                known[place] = known.get(place, False) or jumps
        if len(known) > MOST_BREAKS:
            return {}
        if fresh:
            waiting += pairwise([low, *fresh, high])
    return dict(sorted(known.items()))


def _number_between(low: float, high: float) -> float:
    if math.isinf(low):
        return 0.0 if math.isinf(high) else high - max(1.0, abs(high))
    return low + max(1.0, abs(low)) if math.isinf(high) else low / 2 + high / 2


def between(tree: Tree, name: str, low: float, high: float) -> Tree:
    """Restrict a formula to the range between neighbouring jumps; comparisons become numbers.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("5*t*(t < 2)", ""), Language([], "t", "t"))
    >>> [between(tree, "t", *ends).operands[1] for ends in ((-math.inf, 2.0), (2.0, math.inf))]
    [Constant(value=1.0), Constant(value=0.0)]
    """
    decided: Tree = _decided(tree, name, _number_between(low, high))
    return decided


def _decided(tree: Any, name: str, at: float, *, inside: bool = False) -> Any:
    """Simplify a tree near a value of its variable: comparisons and `sign` become numbers.

    Inside comparisons that stay, `abs`, `min` and `max` become the operand that they equal.
    """
    if not isinstance(tree, Applied):
        return tree
    if tree.name in JUMPS:
        value = _polynomial(tree, name, at, [])
        if value is not None:
            return Constant(value_at(value, at))
        inside = True
    operands = tuple(_decided(operand, name, at, inside=inside) for operand in tree.operands)
    if inside and tree.name in BENDS:
        known = [_polynomial(operand, name, at, []) for operand in operands]
        if None not in known:
            return _picked(tree, operands, [value_at(operand, at) for operand in known if operand])
    return tree._replace(operands=operands)


def is_polynomial(tree: Tree) -> bool:
    """Return whether a tree is a piecewise polynomial of t, as `corners` requires."""
    return _polynomial(tree, "t", 0.0, []) is not None


def _polynomial(
    tree: Any, name: str, at: float, met: list[tuple[float, bool]]
) -> Polynomial | None:
    """Return a tree as a polynomial near a value of its variable, and append corners to `met`."""
    if not isinstance(tree, Applied):
        return _of_operand(tree, name)
    inner: list[tuple[float, bool]] = []
    operands = [_polynomial(polynomial, name, at, inner) for polynomial in tree.operands]
    known = [polynomial for polynomial in operands if polynomial]
    if isinstance(tree.name, TableCall):
        met += inner
        return _of_table(tree.name.table, operands, at, met)
    jumps = tree.name in JUMPS
    met += ((place, bends or (jumps and None in operands)) for place, bends in inner)
    if jumps or tree.name in ENDS:
        compared = [*known, (0.0,)] if len(operands) == 1 else known
        pairs = combinations(compared, 2)
        met += ((root, jumps) for pair in pairs for root in _roots(_sum(*pair, -1.0)))
    if len(known) < len(operands):
        return None
    if jumps or not any(len(polynomial) > 1 for polynomial in known):
        numbers = tuple(Constant(value_at(polynomial, at)) for polynomial in known)
        constants = tree._replace(operands=numbers)
        return (float(evaluate(constants, lambda _: np.zeros((1, 1))).item()),)
    if tree.name in BENDS:
        values = [value_at(polynomial, at) for polynomial in known]
        picked: Polynomial = _picked(
            tree, known, values, lambda polynomial: tuple(-part for part in polynomial)
        )
        return picked
    return _applied(tree.name, known)


def _of_operand(operand: Any, name: str) -> Polynomial | None:
    names = {name: (0.0, 1.0), PI: (math.pi,)}
    if isinstance(operand, Constant):
        return (operand.value,)
    return None if operand.subscripts else names.get(operand.name)


def _of_table(
    table: LookupTable,
    operands: Sequence[Polynomial | None],
    at: float,
    met: list[tuple[float, bool]],
) -> Polynomial | None:
    """Return a table with a single argument as the straight line between two breakpoints."""
    [inner, *others] = operands
    if others or inner is None:
        return None
    jumps = {step for step, next_step in pairwise(table.x) if step == next_step}
    met += ((root, x in jumps) for x in table.x for root in _roots(_sum(inner, (-x,))))
    value, slope = table.line_at(value_at(inner, at))
    return _sum((value,), inner, slope) if slope else (value,)


def _picked(
    tree: Applied,
    operands: Sequence[Any],
    values: Sequence[float],
    minus: Callable[[Any], Any] = lambda operand: Applied("-x", (operand,), 0, 0),
) -> Any:
    """Return the operand, negated if necessary, that `abs`, `min` or `max` equals."""
    if tree.name == "abs":
        return minus(operands[0]) if values[0] < 0 else operands[0]
    return operands[values.index((min if tree.name == "min" else max)(values))]


def _roots(polynomial: Polynomial) -> Iterator[float]:
    if len(polynomial) == 2:
        yield -polynomial[0] / polynomial[1]
    elif len(polynomial) > 2 and all(map(math.isfinite, polynomial)):
        for root in np.roots(polynomial[::-1]):
            if root.imag == 0:
                yield float(root.real)


def _sum(polynomial: Polynomial, other: Polynomial, factor: float = 1.0) -> Polynomial:
    coefficients = [a + factor * b for a, b in zip_longest(polynomial, other, fillvalue=0.0)]
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    return tuple(coefficients)


def _product(left: Polynomial, right: Polynomial) -> Polynomial | None:
    if len(left) + len(right) - 2 > _MOST_DEGREE:
        return None
    shifted = (
        (*(0.0,) * power, *(coefficient * a for a in right))
        for power, coefficient in enumerate(left)
    )
    return reduce(_sum, shifted)


def _applied(name: str, operands: Sequence[Polynomial]) -> Polynomial | None:  # noqa: PLR0911 - a table
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
            return tuple(coefficient / second[0] for coefficient in first)
        case "**" if len(second) == 1 and second[0] in range(1, _MOST_DEGREE + 1):
            product: Polynomial | None = first
            for _ in range(int(second[0]) - 1):
                product = _product(product, first) if product else None
            return product
    return None
