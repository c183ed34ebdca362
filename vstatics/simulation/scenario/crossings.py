"""What formulas compare, and when it meets where it follows from the time, but by no polynomial.

Polynomials are the matter of `corners`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.sides import changes_of_side
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import applied, parts, slope, variables
from vstatics.simulation.scenario.corners import ENDS, JUMPS, is_polynomial
from vstatics.simulation.scenario.formula_code import compiled_along
from vstatics.simulation.scenario.table_call import TableCall
from vstatics.simulation.tolerances import EXACT_SIDES, SAME_INSTANT


class MeetingParts(NamedTuple):
    """Two parts of a formula that are compared with each other."""

    first: Tree
    second: Tree
    jumps: bool = False
    """Whether the formula may jump where both are equal; else it bends there."""


Pairs: TypeAlias = list[MeetingParts]
"""One part of a formula, compared with several others in ascending order."""


def met(tree: Tree) -> Iterator[Pairs]:
    """What is compared in a formula, and what tables are asked with."""
    for part in parts(tree):
        if isinstance(part, Applied) and part.name in ENDS | JUMPS:
            operands = (*part.operands, Constant(0.0)) if len(part.operands) == 1 else part.operands
            jumps = part.name in JUMPS
            yield from ([MeetingParts(*pair, jumps)] for pair in combinations(operands, 2))
    yield from asked(tree)


def asked(tree: Tree) -> Iterator[Pairs]:
    """What tables are asked with, beside their steps in order."""
    for part in parts(tree):
        if isinstance(part, Applied) and isinstance(part.name, TableCall):
            table = part.name.table
            for operand, steps in zip(part.operands, (table.x, table.columns), strict=False):
                yield [MeetingParts(operand, Constant(x), n > 1) for x, n in Counter(steps).items()]


def crossings(tree: Tree, until: float) -> tuple[float, ...]:
    """Times at which a formula bends or jumps by what is no polynomial of the time.

    What is compared with a motion counts where it turns: a motion that is followed from one such
    time to the next meets it in between.

    Parameters
    ----------
    tree : Tree
    until : float
        The last time that counts. [s]

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> language = Language(["sin", "cos"], "t", "t")
    >>> tree = parse(Excerpt("(sin(t) > 0.5)*(cos(t) > speed)", ""), language)
    >>> [round(time, 9) for time in crossings(tree, 3.2)]
    [0.523598776, 2.617993878, 3.141592654]
    """
    found: set[float] = set()
    for pairs in met(tree):
        for first, second, _ in pairs:
            apart = applied("-", first, second)
            if variables(apart) == {"t"}:
                found.update(_crossings(first, second, until))
                continue
            for one in _timed(apart):
                if not is_polynomial(one, "t") and (turns := slope(one)):
                    found.update(_crossings(turns, Constant(0.0), until))
    times = sorted(found)
    ahead = [0.0, *times]
    close = SAME_INSTANT * until
    return tuple(time for time, last in zip(times, ahead, strict=False) if time - last > close)


def _timed(tree: Any) -> Iterator[Tree]:
    """The largest parts that depend on nothing but the time."""
    names = variables(tree)
    if names == {"t"}:
        yield tree
    elif "t" in names:
        for one in tree.operands:
            yield from _timed(one)


def _crossings(first: Tree, second: Tree, until: float) -> list[float]:
    """Where one is on another side of the other, if `corners` does not tell that."""
    if is_polynomial(applied("-", first, second), "t"):
        return []
    one, other = compiled_along(first), compiled_along(second)

    def apart(times: Floats) -> tuple[Floats, Floats]:
        values, others = one(times, 0.0, 0.0), other(times, 0.0, 0.0)
        return values - others, EXACT_SIDES * np.fmax(np.abs(values), np.abs(others))

    found: list[float] = changes_of_side(apart, 0.0, until).tolist()
    return found
