"""Functions compiled with Numba, for loops that arrays cannot replace.

Without Numba the functions run as plain Python.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, TypeVar

from vstatics.core.numerics.arrays import Floats, Integers

__all__ = ["HAS_COMPILER", "WITHOUT_COMPILER", "compiled", "compiled_part", "fill", "put", "shared"]

HAS_COMPILER = find_spec("numba") is not None
"""True if Numba is installed."""
WITHOUT_COMPILER = "without the package numba a long search takes ten to a hundred times as long"
"""Clause of messages: why a search without Numba is slow."""

if TYPE_CHECKING or HAS_COMPILER:
    from vstatics.synthesis.machine_code import compiled, compiled_part, shared
else:
    Plain = TypeVar("Plain")

    def compiled(plain: Plain) -> Plain:
        """Return a function or class unchanged."""
        return plain

    compiled_part = shared = compiled


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array element by element, because a slice assignment takes seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]


@compiled_part
def fill(into: Floats | Integers, value: float) -> None:
    """Fill an array with a value."""
    for place in range(len(into)):
        into[place] = value
