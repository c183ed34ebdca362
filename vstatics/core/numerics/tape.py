"""Tape: the list of operations of a recorded calculation, including guards for its decisions."""

from __future__ import annotations

from typing import Never

from vstatics.core.start import NamedTuple

MOST_OPERATIONS = 20_000
"""Largest number of operations on a tape. Recording a longer calculation does not save time."""
GUARDS = frozenset({"less", "less_equal", "equal", "not_equal", "distant", "apart"})
"""Names of comparisons. A tape applies only to variants in which all comparisons are true.

The guards `distant` and `apart` exclude variants only because of the rounding of floats.
"""


class Untraceable(Exception):  # noqa: N818
    """Error: the recorded variant is a special case, and so cannot represent other variants."""


class Plain(NamedTuple):
    """Constant as an operand, in contrast to the number of a slot."""

    number: float


Operand = int | Plain
"""Operand of an operation: number of a slot of the tape, or a constant."""

HUGE = 1e100
"""Largest permitted magnitude in the first variant, and inverse of the smallest."""
NEGATIONS = {"less": "less_equal", "less_equal": "less", "close": "distant", "apart": "less_equal"}
"""Negation of each comparison, if the operands are also exchanged."""


def ordered(first: Operand, second: Operand) -> tuple[Operand, Operand]:
    """Return the operands of a commutative operation in a standard order, slots first."""
    if isinstance(second, int) and (isinstance(first, Plain) or second < first):
        return second, first
    return first, second


class Operation(NamedTuple):
    """Operation on a tape: name of a function, and two or three operands."""

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
    """List of operations and guards. Slots (numbered results) begin with the inputs."""

    def __init__(self, inputs: int) -> None:
        self.inputs = inputs
        self.operations: list[Operation] = []
        self._slots: dict[Operation, int] = {}

    def note(self, name: str, first: Operand, second: Operand, third: Operand | None = None) -> int:
        """Return the slot of an operation's result, after recording the operation if it is new.

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
    """Recorded sum of any sign whose terms nearly cancel; only for final results."""

    __slots__ = ("slot", "tape", "value")

    def __init__(self, tape: Tape, slot: int, value: float) -> None:
        self.tape = tape
        self.slot = slot
        self.value = value

    def _refuse(self, *_: object) -> Never:
        raise Untraceable

    __abs__ = __sub__ = __rsub__ = _refuse
