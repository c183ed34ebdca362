"""The operations of a calculation in their order, and the guards of its decisions."""

from __future__ import annotations

from typing import NamedTuple, Never

MOST_OPERATIONS = 20_000
"""Operations on a tape; a calculation that needs more is not worth its tape."""
GUARDS = frozenset({"less", "less_equal", "equal", "not_equal"})
"""Operations that compare: the tape is right for the variants for which all of them hold."""


class Untraceable(Exception):  # noqa: N818
    """The first variant is a special case, that does not stand for others."""


class Plain(NamedTuple):
    """A plain number as operand; a number by itself is a slot of the tape."""

    number: float


Operand = int | Plain

HUGE = 1e100
"""A first variant with a magnitude above it, or below its inverse, is a special case."""
NEGATIONS = {"less": "less_equal", "less_equal": "less"}


def ordered(one: Operand, other: Operand) -> tuple[Operand, Operand]:
    """Operands that can change places, in an order of their own, slots first."""
    if isinstance(other, int) and (isinstance(one, Plain) or other < one):
        return other, one
    return one, other


class Operation(NamedTuple):
    """A step of a tape: the name of a function of two operands, or of three."""

    name: str
    one: Operand
    other: Operand
    third: Operand | None = None

    @property
    def slots(self) -> list[int]:
        """The slots that it takes."""
        operands = {self.one, self.other, self.third}
        return [operand for operand in operands if isinstance(operand, int)]


class Tape:
    """Operations and guards in their order; the first slots are the inputs."""

    def __init__(self, inputs: int) -> None:
        self.inputs = inputs
        self.operations: list[Operation] = []
        self._slots: dict[Operation, int] = {}

    def note(self, name: str, one: Operand, other: Operand, third: Operand | None = None) -> int:
        """The slot of an operation's result; the same operation is noted once.

        Raises
        ------
        Untraceable
            If the tape becomes too long.

        Examples
        --------
        >>> tape = Tape(inputs=2)
        >>> tape.note("add", 0, 1), tape.note("multiply", 2, Plain(0.5)), tape.note("add", 0, 1)
        (2, 3, 2)
        """
        operation = Operation(name, one, other, third)
        slot = self._slots.get(operation)
        if slot is None:
            slot = self._slots[operation] = self.inputs + len(self.operations)
            self.operations.append(operation)
            if len(self.operations) > MOST_OPERATIONS:
                raise Untraceable
        return slot


class Residual:
    """What is left of a sum, near 0 and of any sign: a result, with which nothing is done."""

    __slots__ = ("slot", "tape", "value")

    def __init__(self, tape: Tape, slot: int, value: float) -> None:
        self.tape = tape
        self.slot = slot
        self.value = value

    def _refuse(self, *_: object) -> Never:
        raise Untraceable

    __abs__ = __sub__ = __rsub__ = _refuse
