"""Functions that Numba compiles, for loops that arrays can't do."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from vstatics.extras import build
from vstatics.numerics.arrays import Floats, Integers

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


def _cache() -> str:
    """Where machine code lasts: beside that of other sources it could be taken for theirs."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    for top in (home, tempfile.gettempdir()):
        folder = os.path.join(top, "vstatics", build(b"import compiled"))  # noqa: PTH118
        try:
            os.makedirs(folder, exist_ok=True)  # noqa: PTH103
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            break
    return folder


numba.config.CACHE_DIR = _cache()  # type: ignore[attr-defined]


def compiled(function: Compiled) -> Compiled:
    """A function that is compiled when it is called first; the machine code is kept."""
    return cast(Compiled, numba.njit(function, nogil=True, error_model="numpy", cache=True))


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array; an assignment of slices would take seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]
