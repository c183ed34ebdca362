"""Conditions of sequence steps: comparisons of quantities of the motion, and events."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, NamedTuple

from vstatics.core.errors import listed, quoted, spoken
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName, Velocity
from vstatics.core.readers.named.si_units import measured
from vstatics.simulation.scenario.algebra import parts
from vstatics.simulation.scenario.corners import COMPARES
from vstatics.simulation.scenario.formula import OF_EVENTS, Formula, Vocabulary, read_formula
from vstatics.simulation.scenario.formula_code import Seen, seen_in

_SIDES = {"<": "-", "<=": "-0", ">": "+", ">=": "+0", "==": "0="}
"""Signs of the left minus the right side with which a comparison is true. `!=` negates `==`."""


class StepCondition(NamedTuple):
    """Condition of a sequence step: comparisons and events, joined by `and`, `or`, `not`.

    Examples
    --------
    >>> slow = StepCondition(Formula("slip('C') < 20 and not locks('C')"))
    >>> [comparison.seen for comparison in slow.comparisons]
    [(Seen(word='slip', of='C'),)]
    >>> slow.holds(["-"], lambda event: False), slow.holds(["+"], lambda event: False)
    (True, False)
    """

    formula: Formula

    @property
    def comparisons(self) -> tuple[Formula, ...]:
        """Left minus right side of each comparison, in the order of the text."""
        parts = (part for part in _parts(self.formula.whole) if isinstance(part, Applied))
        compared = (part._replace(name="-") for part in parts if _compares(part))
        return tuple(self.formula._replace(tree=difference) for difference in compared)

    def holds(self, sides: Sequence[str], happened: Callable[[Seen], bool]) -> bool:
        """Return whether the condition is true for the signs of all its comparisons.

        Parameters
        ----------
        sides : sequence of str
            Sign of the difference of each comparison from now on: `-`, `+`, or `0` if it stays 0.
            An additional `=` means that the difference is 0 at this instant, so that `==` is true.
        happened : callable
            Function that returns whether an event such as ``locks('C')`` has happened.
        """
        remaining = iter(sides)

        def true(part: Any, passing: bool = True) -> bool:  # noqa: FBT001, FBT002 - it recurs
            if isinstance(part, TableName):
                seen = seen_in(part)
                return seen is not None and happened(seen)
            if part.name == "not":
                return not true(part.operands[0], not passing)
            if part.name == "!=":
                return not true(part._replace(name="=="), not passing)
            if _compares(part):
                signs = next(remaining) if passing else next(remaining).removesuffix("=")
                return not {*signs}.isdisjoint(_SIDES[part.name])
            # Every operand is evaluated, because each takes its signs from the iterator.
            parts = [true(operand, passing) for operand in part.operands]
            return all(parts) if part.name == "and" else any(parts)

        return true(self.formula.whole)

    def with_wheel_speeds(self, turning: Mapping[str, Callable[[float], float]]) -> StepCondition:
        """Return the condition with wheel speeds instead of vehicle speeds.

        Parameters
        ----------
        turning : mapping of str to callable
            Function from vehicle speed [m/s] to link speed [rad/s], by name of a link with a road.

        Raises
        ------
        ValueError
            If a vehicle speed is compared with anything but the speed of such a link.

        Examples
        --------
        >>> words = Vocabulary({"speed": ["wheel"]})
        >>> fast = read_condition(Excerpt("speed('wheel') > 36 km/h", "when"), words)
        >>> wheels = {"wheel": lambda velocity: velocity / 0.5}
        >>> fast.with_wheel_speeds(wheels).formula.whole.operands[1]
        Constant(value=20.0)
        """
        return StepCondition(
            self.formula._replace(tree=_with_wheel_speeds(self.formula.whole, turning))
        )


def _speed(written: str, at: int) -> Constant | None:
    with suppress(ValueError):
        return Velocity.of(measured(written, "velocity"), written, at)
    with suppress(ValueError):
        return Constant(measured(written, "si_speed"))
    return None


def _with_wheel_speeds(tree: Any, turning: Mapping[str, Callable[[float], float]]) -> Any:
    if not isinstance(tree, Applied):
        return tree
    if not _compares(tree):
        operands = tuple(_with_wheel_speeds(operand, turning) for operand in tree.operands)
        return tree._replace(operands=operands)
    speeds = [part for part in parts(tree) if isinstance(part, Velocity)]
    if not speeds:
        return tree
    read = f"read {quoted(speeds[0].written)}, the speed of a vehicle, expected"
    alone = [_signed(side) for side in tree.operands]
    if any(speed not in alone for speed in speeds):
        raise ValueError(f"{read} it alone on one side of a comparison")
    seen = (seen_in(part) for part in parts(tree) if isinstance(part, TableName))
    links = [word.of for word in seen if word is not None and word.word == "speed"]
    if not links or not turning.keys() >= {*links}:
        known = f"; links with a `road`: {listed(list(turning))}" if turning else ""
        raise ValueError(f"{read} it next to speed() of a link with a `road`{known}")
    if len({turning[link](speed.value) for link in links for speed in speeds[:1]}) > 1:
        raise ValueError(f"{read} it next to links that turn alike, not to {spoken(links)}")
    sides = (_of_wheel(side, turning[links[0]]) for side in tree.operands)
    return tree._replace(operands=tuple(sides))


def _signed(side: Tree) -> Tree:
    return side.operands[0] if isinstance(side, Applied) and side.name == "-x" else side


def _of_wheel(side: Any, turning: Callable[[float], float]) -> Any:
    """Return a side of a comparison, with a wheel speed instead of a vehicle speed."""
    if isinstance(side, Velocity):
        return Constant(turning(side.value))
    if isinstance(side, Applied) and isinstance(_signed(side), Velocity):
        return side._replace(operands=(_of_wheel(_signed(side), turning),))
    return side


def read_condition(source: Excerpt, words: Vocabulary) -> StepCondition:
    """Read the condition of a sequence step.

    Raises
    ------
    ReadError
        If the text is not a condition, with the position of the fault.

    Examples
    --------
    >>> read_condition(Excerpt("t + 1", "when"), Vocabulary())
    Traceback (most recent call last):
    ...
    vstatics.core.errors.ReadError: when:1:3: error: expected a condition, such as `t >= 0.5` [E105]
    """
    formula = read_formula(source, ["t"], words, quantity=_speed)
    for part in _parts(formula.whole):
        is_event = isinstance(part, TableName) and part.name in OF_EVENTS
        if not (is_event or (isinstance(part, Applied) and part.name in (*COMPARES, *_JOINS))):
            at = getattr(part, "at", source.start)
            raise source.error("expected a condition, such as `t >= 0.5`", at)
    for comparison in StepCondition(formula).comparisons:
        events = [seen.word for seen in comparison.seen if seen.word in OF_EVENTS]
        if events:
            raise source.error(
                f"{quoted(events[0])} is true or not, expected it without a comparison",
                source.start,
            )
    return StepCondition(formula)


_JOINS = ("and", "or", "not")


def _compares(part: Tree) -> bool:
    return isinstance(part, Applied) and part.name in COMPARES


def _parts(tree: Tree) -> Iterator[Tree]:
    """Yield a condition and all its operands, through `and`, `or` and `not`, from left to right."""
    yield tree
    if isinstance(tree, Applied) and tree.name in _JOINS:
        for operand in tree.operands:
            yield from _parts(operand)
