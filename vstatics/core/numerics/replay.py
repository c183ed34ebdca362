"""Repetition of a recorded calculation (a tape) on arrays over many variants."""

from __future__ import annotations

import operator
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.memory import Layout, Rows
from vstatics.core.numerics.signed import Signed, Truth, upright
from vstatics.core.numerics.tape import GUARDS, Operand, Plain, Residual, Tape
from vstatics.core.numerics.tolerances import DECIMAL_LEAST
from vstatics.core.numerics.traced import Number, Traced
from vstatics.core.start import NamedTuple

CHUNK = 20480
"""Number of variants calculated together: many for few calls, but few enough for the CPU cache."""


def _absolute(operand: Floats, _: Floats, result: Floats) -> None:
    np.absolute(operand, result)


def _choose(margin: Floats, yes: Floats, no: Floats, result: Floats) -> None:
    # The choice is made between bits, because processors cannot predict branches on margins.
    bits, bits_of_no = result.view(np.int64), np.asarray(no, np.float64).view(np.int64)
    np.bitwise_xor(np.asarray(yes, np.float64).view(np.int64), bits_of_no, bits)
    np.multiply(bits, margin > 0, bits)
    np.bitwise_xor(bits, bits_of_no, bits)


def _store(value: Floats, factor: float, result: Any) -> None:
    """Write a value, multiplied by `factor` (+1 or -1), to an array of any type."""
    np.multiply(value, factor, result, casting="unsafe")


def _minimum(first: Floats, second: Floats, result: Floats) -> None:
    np.minimum(first, second, out=result)


Operator = Callable[..., Any]
"""Function of two or three operands; for arrays, the last argument is the array of the result."""

FUNCTIONS: Mapping[str, tuple[Operator, Operator]] = {
    "add": (np.add, operator.add),
    "subtract": (np.subtract, operator.sub),
    "multiply": (np.multiply, operator.mul),
    "divide": (np.divide, operator.truediv),
    "absolute": (_absolute, lambda number, _: abs(number)),
    "choose": (_choose, lambda margin, number: number if margin > 0 else None),
    "copysign": (np.copysign, lambda size, number: -size if number < 0 else size),
    "minimum": (_minimum, min),
    "less": (np.less, operator.lt),
    "less_equal": (np.less_equal, operator.le),
    "equal": (np.equal, operator.eq),
    "not_equal": (np.not_equal, operator.ne),
    "greater": (np.greater, operator.gt),
    "distant": (np.less_equal, lambda *_: True),
    "apart": (np.less, lambda least, size: least < size * DECIMAL_LEAST),
}
"""Functions on arrays and on single numbers, for operations of a tape.

In plans of any sign, the single numbers are decimals.
"""


def _otherwise(number: float | None, other: float) -> float:
    """Return the first number of a choice, or the second if the first is None."""
    return other if number is None else number


class _WorkingMemory(threading.local):
    """Working arrays of a thread, reused because new memory costs more time than the operations."""

    numbers: Floats = np.empty(0)
    holds: Booleans = np.empty(0, dtype=np.bool_)


_memory = _WorkingMemory()


def _working_arrays(count: int, guards: int, variants: int) -> tuple[Floats, Booleans]:
    """Return uninitialised arrays (numbers, variants) and (guards, variants)."""
    if _memory.numbers.size < count * variants:
        _memory.numbers = np.empty(count * variants)
    if _memory.holds.size < guards * variants:
        _memory.holds = np.empty(guards * variants, dtype=np.bool_)
    numbers, holds = _memory.numbers[: count * variants], _memory.holds[: guards * variants]
    return numbers.reshape(count, variants), holds.reshape(guards, variants)


class Step(NamedTuple):
    """Operation of a replay: functions for arrays and for floats, and numbers of operand cells."""

    function: Operator
    plain: Operator
    first: int
    second: int
    result: int | None
    """Cell of the result; None for a guard, which only marks variants."""
    third: int | None = None
    """Cell of the third operand of a choice."""


PlainStep = tuple[Operator, int, int, int | None]
"""Operation on single numbers: function, cells of two operands and of the result (None: a guard).

Python unpacks a tuple in a fraction of the time of a named tuple.
"""


class Replay(NamedTuple):
    """Steps that calculate results from inputs, with numbered cells as operands.

    The cells are the inputs, the varying results and the working arrays, in this order. Constants
    follow in reverse order, so that negative numbers count them from the end.
    """

    steps: Sequence[Step]
    working: int
    """Number of working arrays."""
    plain: Sequence[float]
    """Constants in reverse order."""
    layout: Layout
    """Results that vary and results that are constant."""
    plain_steps: Sequence[PlainStep]
    """Steps with the functions for a single number."""
    after_inputs: Sequence[float]
    """Values of the cells after the inputs in `run_one`: zeros, constants of steps and results."""
    results: Sequence[int]
    """Index of the cell of each result in `run_one`."""

    def run(self, magnitudes: Floats, rows: Rows, passed: Booleans) -> None:
        """Write the results of all variants, and set `passed` to False where a guard fails.

        Parameters
        ----------
        magnitudes : ndarray, shape (inputs, variants)
        passed : ndarray, shape (variants,)
        """
        variants = len(passed)
        varied = rows.lay_out(self.layout)
        guards = sum(step.result is None for step in self.steps)
        buffers, holds = _working_arrays(self.working, guards, min(CHUNK, variants))
        for start in range(0, variants, CHUNK):
            part = slice(start, min(start + CHUNK, variants))
            size = part.stop - part.start
            cells = [
                *magnitudes[:, part],
                *[row[part] for row in varied],
                *buffers[:, :size],
                *self.plain,
            ]
            held = iter(holds[:, :size])
            for function, _, first, second, result, third in self.steps:
                if result is None:
                    function(cells[first], cells[second], next(held))
                elif third is None:
                    function(cells[first], cells[second], cells[result])
                else:
                    function(cells[first], cells[second], cells[third], cells[result])
            passed[part] &= holds[:, :size].all(axis=0)

    def run_one(self, magnitudes: Iterable[float]) -> list[float] | None:
        """Return the results of a single variant, or None if a guard fails.

        Plans of fixed sign need floats, which take a quarter of the time of arrays with a single
        number. Plans of any sign need decimals, also in `after_inputs`.
        """
        cells = [*magnitudes, *self.after_inputs]
        for function, first, second, result in self.plain_steps:
            number = function(cells[first], cells[second])
            if result is not None:
                cells[result] = number
            elif not number:
                return None
        return [cells[cell] for cell in self.results]


def replay(tape: Tape, results: Sequence[Number | Residual | Truth]) -> Replay:
    """Return the steps for all operations of a tape that guards or results need."""
    varied: list[int] = []
    copies: dict[int, list[tuple[int, float]]] = {}
    for row, result in enumerate(results):
        if isinstance(result, Traced | Signed | Residual | Truth):
            slot, sign = _slot(result)
            copies.setdefault(slot, []).append((tape.inputs + len(varied), sign))
            varied.append(row)
    last = _last_uses(tape, copies)
    cells = _Cells(tape.inputs, len(varied))
    steps: list[Step] = []
    for slot in range(tape.inputs):
        steps += cells.copied(slot, copies)
    for slot, operation in enumerate(tape.operations, tape.inputs):
        if slot in last:
            name, first, second, third = operation
            operands = cells.of(first), cells.of(second)
            more = None if third is None else cells.of(third)
            released = [used for used in operation.slots if last[used] == slot]
            if third is None:
                cells.release(released)
            cell = None if name in GUARDS else cells.taken(slot, copies)
            # a choice writes its result before it has read all operands, so its cell cannot be
            # reused
            if third is not None:
                cells.release(released)
            steps.append(Step(*FUNCTIONS[name], *operands, cell, more))
            steps += cells.copied(slot, copies)
    varies = set(varied)
    constants: list[tuple[int, Any]] = [
        (row, value) for row, value in enumerate(results) if row not in varies
    ]
    plain = [constant.number for constant in reversed(cells.plain)]
    unknown = len(varied) + cells.working
    count = tape.inputs + unknown + len(plain)
    cell_of = {row: cell for cell, row in enumerate(varied, tape.inputs)}
    cell_of |= {row: cell for cell, (row, _) in enumerate(constants, count)}
    plain_steps: list[PlainStep] = []
    for step in steps:
        plain_steps.append((step.plain, step.first % count, step.second % count, step.result))
        if step.third is not None and step.result is not None:
            plain_steps.append((_otherwise, step.result, step.third % count, step.result))
    return Replay(
        steps,
        cells.working,
        plain,
        Layout(varied, constants),
        plain_steps,
        [*[0.0] * unknown, *plain, *(value for _, value in constants)],
        [cell_of[row] for row in range(len(results))],
    )


def _slot(result: Traced | Signed | Residual | Truth) -> tuple[int, float]:
    if isinstance(result, Residual):
        return result.slot, 1.0
    if isinstance(result, Truth):
        margin = upright(result.tape, result.margin)
        return result.tape.note("greater", margin, Plain(0.0)), 1.0
    if isinstance(result, Signed):
        return result.slot, -1.0 if result.negated else 1.0
    assert isinstance(result.magnitude.operand, int)  # noqa: S101 - a plain number is not traced
    return result.magnitude.operand, float(result.sign)


def _last_uses(tape: Tape, copies: Mapping[int, Any]) -> dict[int, int]:
    """Return the slot of the last operation that uses each slot.

    A guard, or a slot that only a result uses, is its own last use. Unused slots are omitted.
    """
    last = {slot: slot for slot in copies}
    for index in reversed(range(len(tape.operations))):
        slot = tape.inputs + index
        operation = tape.operations[index]
        if operation.name in GUARDS:
            last[slot] = slot
        if slot in last:
            for operand in operation.slots:
                last[operand] = max(last.get(operand, slot), slot)
    return last


class _Cells:
    """Assignment of tape slots and constants to cells, which reuses working arrays."""

    def __init__(self, inputs: int, varied: int) -> None:
        self.plain: list[Plain] = []
        self.working = 0
        self._first_working = inputs + varied
        self._cells: dict[int, int] = {slot: slot for slot in range(inputs)}
        self._free: list[int] = []

    def of(self, operand: Operand) -> int:
        """Return the cell of a slot or of a constant."""
        if isinstance(operand, int):
            return self._cells[operand]
        if operand not in self.plain:
            self.plain.append(operand)
        return -1 - self.plain.index(operand)

    def taken(self, slot: int, copies: Mapping[int, Sequence[tuple[int, float]]]) -> int:
        """Return a cell for a new slot: the cell of a result, or a working array."""
        result = next((cell for cell, sign in copies.get(slot, ()) if sign > 0), None)
        if result is None and not self._free:
            self._free.append(self._first_working + self.working)
            self.working += 1
        self._cells[slot] = self._free.pop() if result is None else result
        return self._cells[slot]

    def release(self, slots: Iterable[int]) -> None:
        """Make the working arrays of slots available for reuse."""
        self._free += [self._cells[s] for s in slots if self._cells[s] >= self._first_working]

    def copied(
        self, slot: int, copies: Mapping[int, Sequence[tuple[int, float]]]
    ) -> Iterator[Step]:
        """Yield steps that copy a slot to all further results with the same value."""
        for cell, sign in copies.get(slot, ()):
            if cell != self._cells[slot]:
                yield Step(_store, operator.mul, self._cells[slot], self.of(Plain(sign)), cell)
