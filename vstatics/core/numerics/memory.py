"""Memory for arrays of results, reused after the arrays have been deleted.

New memory costs more time than the calculation that fills it, because the operating system clears
each page, and because values that are equal for all variants must be written again. A block that is
no longer referenced is therefore stored for the next results of the same shape, with the constants
in it. Users get read-only arrays, so that these constants stay valid.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from itertools import accumulate
from typing import Any

import numpy as np

from vstatics.core.start import NamedTuple

KEPT_BYTES = 2**27
"""Largest total size of the stored blocks, in bytes."""


class Form(NamedTuple):
    """Shape (gears, rows, variants) and data type of a table, which is an array of results."""

    shape: tuple[int, int, int]
    kind: type


class Layout(NamedTuple):
    """Rows of a gear that vary between variants, and constants of all other rows."""

    varied: Sequence[int]
    constants: Sequence[tuple[int, Any]]


class Rows:
    """Rows of all tables for a gear; each row is an array over the variants."""

    def __init__(self, arrays: Sequence[Any]) -> None:
        self.arrays = arrays
        self.holds: dict[int, Any] = {}
        """Constants by row, for rows that already contain the constant in every variant."""
        self._layout: Layout | None = None
        """Layout for which the rows are filled at present; None if unknown."""

    def lay_out(self, layout: Layout) -> list[Any]:
        """Fill the constant rows, and return the arrays of the varying rows for writing."""
        if self._layout is not layout:
            for row, value in layout.constants:
                if not self._holds(row, value):
                    self.arrays[row].fill(value)
                    self.holds[row] = value
            for row in layout.varied:
                self.holds.pop(row, None)
            self._layout = layout
        return [self.arrays[row] for row in layout.varied]

    def _holds(self, row: int, value: Any) -> bool:
        if row not in self.holds:
            return False
        known = self.holds[row]
        if known == value:  # 0 and -0 are equal, but are not written alike
            return bool(known) or math.copysign(1.0, known) == math.copysign(1.0, value)
        return bool(known != known and value != value)  # noqa: PLR0124

    def alike(self, variants: int, layout: Layout) -> Rows:
        """Return uninitialised rows of the same data types for another number of variants."""
        rows = Rows([np.empty(variants, dtype=row.dtype) for row in self.arrays])
        rows._layout = layout
        return rows

    def put(self, places: Any, rows: Rows, chosen: Any, layout: Layout) -> None:
        """Copy the variants `chosen` of other rows to the variants `places`."""
        for row in layout.varied:
            self.vary(row)[places] = rows.arrays[row][chosen]
        for row, value in layout.constants:
            if not self._holds(row, value):
                self.vary(row)[places] = value

    def put_variant(self, variant: int, values: Sequence[Any]) -> None:
        """Write the values of all rows for a variant."""
        holds = self.holds
        for row, value in enumerate(values):
            # Identity is a fast test; `holds` itself stands for a missing constant.
            if not (holds.get(row, holds) is value or self._holds(row, value)):
                self.vary(row)[variant] = value

    def vary(self, row: int) -> Any:
        """Return the array of a row for writing, which invalidates the constant of the row."""
        self.holds.pop(row, None)
        self._layout = None
        return self.arrays[row]


class Block:
    """Memory for the tables of a calculation, which can be addressed by table and by gear."""

    def __init__(self, forms: Mapping[str, Form]) -> None:
        self.forms = dict(forms)
        *self.starts, size = accumulate(map(_size, forms.values()), initial=0)
        self.bytes = np.empty(size, dtype=np.uint8)
        tables = self.tables(self.bytes)
        gears = max((form.shape[0] for form in forms.values()), default=0)
        self.gears = [
            Rows([row for table in tables.values() for row in table[gear]]) for gear in range(gears)
        ]

    def tables(self, memory: Any) -> dict[str, Any]:
        """Return arrays for the tables of the block, located in `memory`."""
        return {
            name: np.ndarray(form.shape, form.kind, memory, start)
            for (name, form), start in zip(self.forms.items(), self.starts, strict=True)
        }


def _size(form: Form) -> int:
    gears, width, variants = form.shape
    return gears * width * variants * np.dtype(form.kind).itemsize


class _Lent:
    """Owner of a block in use, which is the base object of all arrays on the block.

    Python deletes the owner after the last of these arrays. The block is then stored for reuse.
    """

    def __init__(self, block: Block) -> None:
        self.block = block
        interface = block.bytes.__array_interface__
        self.__array_interface__: dict[str, Any] = {
            **interface,
            "data": (interface["data"][0], True),  # read only
        }

    def __del__(self) -> None:
        # The garbage collector can call this method at any time, so a lock could cause a deadlock.
        while (
            sum(block.bytes.nbytes for block in tuple(_free)) + self.block.bytes.nbytes > KEPT_BYTES
        ):
            try:
                _free.popleft()
            except IndexError:
                return  # too large to be stored
        _free.append(self.block)


_free: deque[Block] = deque()
"""Blocks for reuse, oldest first."""


def block(forms: Mapping[str, Form]) -> Block:
    """Return a block for tables; `forms` must be sorted by size of the data type, largest first.

    >>> made = block({"ratio": Form((6, 1, 100), np.float64)})
    >>> made.gears[0].lay_out(Layout([], [(0, 1.0)]))
    []
    >>> shown(made)["ratio"].shape
    (6, 1, 100)
    """
    for free in reversed(tuple(_free)):
        if free.forms == forms:
            try:
                _free.remove(free)
            except ValueError:
                continue  # another thread has just begun to use the block
            return free
    return Block(forms)


def shown(block: Block) -> dict[str, Any]:
    """Return the tables of a block, read-only; deletion of the last table frees the block."""
    return block.tables(np.asarray(_Lent(block)))
