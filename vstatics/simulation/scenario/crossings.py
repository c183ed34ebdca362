"""Comparisons in formulas, and the times at which compared functions of time become equal.

Module `corners` finds these times for polynomials, this module for other functions of time.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
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
    """Pair of terms that a formula compares."""

    first: Tree
    second: Tree
    jumps: bool = False
    """True if the formula can jump where both terms are equal, False if the formula bends."""


Pairs: TypeAlias = list[MeetingParts]
"""Pairs with a common first term, and second terms in ascending order."""


def met(tree: Tree) -> Iterator[Pairs]:
    """Yield the pairs of terms that the comparisons, functions and tables of a formula compare."""
    for part in parts(tree):
        if isinstance(part, Applied) and part.name in ENDS | JUMPS:
            operands = (*part.operands, Constant(0.0)) if len(part.operands) == 1 else part.operands
            jumps = part.name in JUMPS
            yield from ([MeetingParts(*pair, jumps)] for pair in combinations(operands, 2))
    yield from asked(tree)


def asked(tree: Tree) -> Iterator[Pairs]:
    """Yield, for each argument of a lookup table, its pairs with all breakpoints in order."""
    for part in parts(tree):
        if isinstance(part, Applied) and isinstance(part.name, TableCall):
            table = part.name.table
            for operand, steps in zip(part.operands, (table.x, table.columns), strict=False):
                yield [MeetingParts(operand, Constant(x), n > 1) for x, n in Counter(steps).items()]


@lru_cache(maxsize=256)
def crossings(tree: Tree, until: float) -> tuple[float, ...]:
    """Find the times at which functions of time, except polynomials, make a formula bend or jump.

    If a function of time is compared with a quantity of the motion, the result contains the
    extremes of the function. Between two extremes it is monotonic, so integration steps cannot miss
    a crossing.

    Parameters
    ----------
    tree : Tree
    until : float
        End of the search. [s]

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> language = Language(["sin", "cos"], "t", "t")
    >>> tree = parse(Excerpt("(sin(t) > 0.5)*(cos(t) > speed)", ""), language)
    >>> [round(time, 9) for time in crossings(tree, 3.2)]
    [0.523598776, 2.617993878, 3.141592654]
    """
    instants = set()
    for pairs in met(tree):
        for first, second, _ in pairs:
            apart = applied("-", first, second)
            if variables(apart) == {"t"}:
                instants.update(_crossings(first, second, until))
                continue
            for part in _timed(apart):
                if not is_polynomial(part) and (turns := slope(part)):
                    instants.update(_crossings(turns, Constant(0.0), until))
    times = sorted(instants)
    earlier = [0.0, *times]
    close = SAME_INSTANT * until
    return tuple(
        time for time, previous in zip(times, earlier, strict=False) if time - previous > close
    )


def _timed(tree: Any) -> Iterator[Tree]:
    """Yield the largest subtrees that depend on time alone."""
    names = variables(tree)
    if names == {"t"}:
        yield tree
    elif "t" in names:
        for operand in tree.operands:
            yield from _timed(operand)


def _crossings(first: Tree, second: Tree, until: float) -> list[float]:
    if is_polynomial(applied("-", first, second)):
        return []
    first_values, second_values = compiled_along(first), compiled_along(second)

    def apart(at: Floats) -> tuple[Floats, Floats]:
        values, compared = first_values(at, 0.0, 0.0), second_values(at, 0.0, 0.0)
        return values - compared, EXACT_SIDES * np.fmax(np.abs(values), np.abs(compared))

    times: list[float] = changes_of_side(apart, 0.0, until).tolist()
    return times
