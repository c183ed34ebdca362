"""Memory for the tables of results, used again when they are gone.

Fresh memory costs more time than the calculation that fills it: the system clears each
page, and values that are the same for all variants are written again and again. So a
block that nobody looks at any more is kept for the next results of the same shape, with
a note of what it holds. For that nobody else may write to it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

KEPT_BYTES = 2**27
"""So many bytes are kept at most for results to come."""


class Form(NamedTuple):
    """Shape and type of a table: (gears, width, variants)."""

    shape: tuple[int, int, int]
    kind: type


class Layout(NamedTuple):
    """Which rows vary, and what the others hold for every variant."""

    varied: Sequence[int]
    constants: Sequence[tuple[int, Any]]


class Rows:
    """The rows of all tables of one gear, each over the variants."""

    def __init__(self, arrays: Sequence[Any]) -> None:
        self.arrays = arrays
        self.holds: dict[int, Any] = {}
        """Row -> the value that it is known to hold for every variant."""
        self._layout: Layout | None = None
        """What all rows are known to have."""

    def lay_out(self, layout: Layout) -> list[Any]:
        """Fill the rows that do not vary; the arrays of those that do, to be written to."""
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
        known = self.holds.get(row, self)
        return known is not self and (known == value or (known != known and value != value))  # noqa: PLR0124

    def alike(self, variants: int, layout: Layout) -> Rows:
        """Rows of the same types, for so many variants; those that do not vary are not filled."""
        own = Rows([np.empty(variants, dtype=row.dtype) for row in self.arrays])
        own._layout = layout
        return own

    def put(self, places: Any, own: Rows, chosen: Any, layout: Layout) -> None:
        """Write the chosen variants of other rows to their places among these."""
        for row in layout.varied:
            self.vary(row)[places] = own.arrays[row][chosen]
        for row, value in layout.constants:
            if not self._holds(row, value):
                self.vary(row)[places] = value

    def put_variant(self, variant: int, values: Sequence[Any]) -> None:
        """Write the values of all rows for one variant."""
        self.holds.clear()
        self._layout = None
        for row, value in zip(self.arrays, values, strict=True):
            row[variant] = value

    def vary(self, row: int) -> Any:
        """The array of a row, to be written to."""
        self.holds.pop(row, None)
        self._layout = None
        return self.arrays[row]


class Block:
    """Memory for some tables: the tables, and the same by gears."""

    def __init__(self, forms: Mapping[str, Form]) -> None:
        self.forms = dict(forms)
        self.bytes = np.empty(sum(map(_size, forms.values())), dtype=np.uint8)
        tables = self.tables(self.bytes)
        gears = max((form.shape[0] for form in forms.values()), default=0)
        self.gears = [
            Rows([row for table in tables.values() for row in table[gear]]) for gear in range(gears)
        ]

    def tables(self, memory: Any) -> dict[str, Any]:
        """The tables in memory of this form."""
        tables, start = {}, 0
        for name, form in self.forms.items():
            tables[name] = np.ndarray(form.shape, form.kind, memory, start)
            start += tables[name].nbytes
        return tables


def _size(form: Form) -> int:
    gears, width, variants = form.shape
    return gears * width * variants * np.dtype(form.kind).itemsize


class _Lent:
    """Owner of a block in use: the base of all arrays that show it, gone when they are."""

    def __init__(self, block: Block) -> None:
        self.block = block
        interface = block.bytes.__array_interface__
        self.__array_interface__: dict[str, Any] = {
            **interface,
            "data": (interface["data"][0], True),  # read only
        }

    def __del__(self) -> None:
        # The collector may call this at any moment, so nothing is locked here.
        while (
            sum(block.bytes.nbytes for block in tuple(_free)) + self.block.bytes.nbytes > KEPT_BYTES
        ):
            try:
                _free.popleft()
            except IndexError:
                return  # too large to be kept
        _free.append(self.block)


_free: deque[Block] = deque()
"""Blocks to be used again, the oldest first."""


def block(forms: Mapping[str, Form]) -> Block:
    """A block for tables of this form; those of the largest type first.

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
                continue  # somebody else has just taken it
            return free
    return Block(forms)


def shown(block: Block) -> dict[str, Any]:
    """The tables of a block for everybody, to read; the block is free again without them."""
    return block.tables(np.asarray(_Lent(block)))
