"""When a step of a sequence is due: a condition of what is seen, and of what has happened."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from vstatics.errors import quoted
from vstatics.readers.expressions.excerpt import Excerpt
from vstatics.readers.expressions.grammar import Applied, Tree
from vstatics.readers.expressions.operands import TableName
from vstatics.simulation.scenario.corners import COMPARES
from vstatics.simulation.scenario.formula import OF_EVENTS, Formula, Vocabulary, read_formula
from vstatics.simulation.scenario.formula_code import Seen, seen_in

_SIDES = {"<": "-", "<=": "-0", ">": "+", ">=": "+0", "==": "0="}
"""Of what is compared, the signs of left less right with which it is true; `!=` is not `==`."""


class StepCondition(NamedTuple):
    """Comparisons and events, joined by `and`, `or`, `not`.

    Examples
    --------
    >>> slow = StepCondition(Formula("slip('C') < 20 and not locks('C')"))
    >>> [one.seen for one in slow.comparisons]
    [(Seen(word='slip', of='C'),)]
    >>> slow.holds(["-"], lambda event: False), slow.holds(["+"], lambda event: False)
    (True, False)
    """

    formula: Formula

    @property
    def comparisons(self) -> tuple[Formula, ...]:
        """The differences that are compared, from the left to the right."""
        parts = (part for part in _parts(self.formula.whole) if isinstance(part, Applied))
        compared = (part._replace(name="-") for part in parts if _compares(part))
        return tuple(self.formula._replace(tree=one) for one in compared)

    def holds(self, sides: Sequence[str], happened: Callable[[Seen], bool]) -> bool:
        """Whether it is true.

        Parameters
        ----------
        sides : sequence of str
            The sign of each comparison's difference, `0` where it is and stays 0, with `=` where it
            is 0 at the instant: then `==` is true.
        happened : callable
            Whether an event has happened, such as ``locks('C')``.
        """
        left = iter(sides)

        def true(part: Any, passing: bool = True) -> bool:  # noqa: FBT001, FBT002 - it recurs
            if isinstance(part, TableName):
                seen = seen_in(part)
                return seen is not None and happened(seen)
            if part.name == "not":
                return not true(part.operands[0], not passing)
            if part.name == "!=":
                return not true(part._replace(name="=="), not passing)
            if _compares(part):
                signs = next(left) if passing else next(left).removesuffix("=")
                return not {*signs}.isdisjoint(_SIDES[part.name])
            parts = [true(one, passing) for one in part.operands]  # all: each takes its sides
            return all(parts) if part.name == "and" else any(parts)

        return true(self.formula.whole)


def read_condition(source: Excerpt, words: Vocabulary) -> StepCondition:
    """Read a condition.

    Raises
    ------
    ReadError
        With the place of what is wrong.

    Examples
    --------
    >>> read_condition(Excerpt("t + 1", "when"), Vocabulary())
    Traceback (most recent call last):
    ...
    vstatics.errors.ReadError: when:1:3: error: expected a condition, such as `t >= 0.5` [E105]
    """
    formula = read_formula(source, ["t"], words)
    for part in _parts(formula.whole):
        is_event = isinstance(part, TableName) and part.name in OF_EVENTS
        if not (is_event or (isinstance(part, Applied) and part.name in (*COMPARES, *_JOINS))):
            at = getattr(part, "at", source.start)
            raise source.error("expected a condition, such as `t >= 0.5`", at)
    for comparison in StepCondition(formula).comparisons:
        inside = [one.word for one in comparison.seen if one.word in OF_EVENTS]
        if inside:
            message = f"{quoted(inside[0])} is true or not, expected it without a comparison"
            raise source.error(message, source.start)
    return StepCondition(formula)


_JOINS = ("and", "or", "not")


def _compares(part: Tree) -> bool:
    return isinstance(part, Applied) and part.name in COMPARES


def _parts(tree: Tree) -> Iterator[Tree]:
    """What is joined, and what joins it, from the left to the right."""
    yield tree
    if isinstance(tree, Applied) and tree.name in _JOINS:
        for one in tree.operands:
            yield from _parts(one)
