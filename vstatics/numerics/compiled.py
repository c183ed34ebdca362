"""Functions that Numba compiles, for loops that arrays can't do."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from vstatics.extras import build
from vstatics.numerics.arrays import Floats, Integers

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


def _cache() -> str:
    """Where machine code lasts: a folder that nobody else can write, or none.

    It is by the files that are compiled and the tolerances in them: machine code of other ones
    could be taken for theirs.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    folder = os.path.join(home, "vstatics", build(b"import compiled", b"Tolerances of"))  # noqa: PTH118
    try:
        os.makedirs(folder, mode=0o700, exist_ok=True)  # noqa: PTH103
        is_own = not os.stat(folder).st_mode & 0o022  # noqa: PTH116
    except OSError:
        return ""
    return folder if is_own and os.access(folder, os.W_OK) else ""


CACHE = _cache()


def compiled(function: Compiled) -> Compiled:
    """A function that is compiled when it is called first; the machine code is kept if it can."""
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = CACHE  # type: ignore[attr-defined]
    try:
        made = numba.njit(function, nogil=True, error_model="numpy", cache=bool(CACHE))
    finally:  # functions of others are kept where they want
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
    return cast(Compiled, made)


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array; an assignment of slices would take seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]
