"""Tape of a calculation: its operations in order, and the guards of its decisions."""

from __future__ import annotations

from typing import NamedTuple, Never

MOST_OPERATIONS = 20_000
"""Most operations on a tape; a longer calculation is not worth recording."""
GUARDS = frozenset({"less", "less_equal", "equal", "not_equal"})
"""Operations that compare; a tape is valid for variants that pass all comparisons."""


class Untraceable(Exception):  # noqa: N818
    """Exception for a first variant that is a special case."""


class Plain(NamedTuple):
    """Plain number as an operand; an int is the number of a slot."""

    number: float


Operand = int | Plain
"""Slot of the tape, or a plain number."""

HUGE = 1e100
"""Largest permitted magnitude in the first variant; the smallest permitted is the inverse."""
NEGATIONS = {"less": "less_equal", "less_equal": "less"}
"""Negation of each comparison, for exchanged operands."""


def ordered(first: Operand, second: Operand) -> tuple[Operand, Operand]:
    """Return commutative operands in a canonical order, slots first."""
    if isinstance(second, int) and (isinstance(first, Plain) or second < first):
        return second, first
    return first, second


class Operation(NamedTuple):
    """Step of a tape: a named function of two or three operands."""

    name: str
    first: Operand
    second: Operand
    third: Operand | None = None

    @property
    def slots(self) -> list[int]:
        """Slots that the operation reads."""
        operands = {self.first, self.second, self.third}
        return [operand for operand in operands if isinstance(operand, int)]


class Tape:
    """Operations and guards in order; the first slots are the inputs."""

    def __init__(self, inputs: int) -> None:
        self.inputs = inputs
        self.operations: list[Operation] = []
        self._slots: dict[Operation, int] = {}

    def note(self, name: str, first: Operand, second: Operand, third: Operand | None = None) -> int:
        """Record an operation, unless recorded before, and return the slot of the result.

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
        operation = Operation(name, first, second, third)
        slot = self._slots.get(operation)
        if slot is None:
            slot = self._slots[operation] = self.inputs + len(self.operations)
            self.operations.append(operation)
            if len(self.operations) > MOST_OPERATIONS:
                raise Untraceable
        return slot


class Residual:
    """Difference of nearly equal sums, near 0, of any sign: a result that is not used further."""

    __slots__ = ("slot", "tape", "value")

    def __init__(self, tape: Tape, slot: int, value: float) -> None:
        self.tape = tape
        self.slot = slot
        self.value = value

    def _refuse(self, *_: object) -> Never:
        raise Untraceable

    __abs__ = __sub__ = __rsub__ = _refuse
