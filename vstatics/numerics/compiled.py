"""Functions that Numba compiles, for loops that arrays can't do."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TypeVar, cast

import numba
from numba.core.caching import FunctionCache

from vstatics.extras import build
from vstatics.numerics.arrays import Floats, Integers

Compiled = TypeVar("Compiled", bound=Callable[..., Any])

CACHE_TROUBLE: list[str] = []
"""Why machine code is not kept, or what is kept could not be read; for the command to tell."""


def _home() -> str:
    """Where machine code of this program lasts."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    return os.path.join(home, "vstatics")  # noqa: PTH118


def _cache() -> str:
    """A folder for machine code that nobody else can write, or none: what is in it is run.

    It is by the files that are compiled and the tolerances in them: machine code of other ones
    could be taken for theirs.
    """
    home = _home()
    folder = os.path.join(home, build(b"import compiled", b"Tolerances of"))  # noqa: PTH118
    try:
        for path in (home, folder):
            if not os.path.isdir(path):  # noqa: PTH112
                os.makedirs(path, mode=0o700, exist_ok=True)  # noqa: PTH103
            found = os.stat(path)  # noqa: PTH116
            if found.st_uid != os.geteuid() or found.st_mode & 0o022:
                CACHE_TROUBLE.append(f"{path} is another's, or others may write in it")
                return ""
        if not os.access(folder, os.W_OK):
            CACHE_TROUBLE.append(f"{folder} can't be written")
            return ""
    except OSError as error:
        CACHE_TROUBLE.append(f"{folder}: {error.strerror}")
        return ""
    return folder


CACHE = _cache()


class _KeptCode(FunctionCache):
    """Machine code in files; what can't be read or written is compiled again."""

    @contextmanager
    def _guard_against_spurious_io_errors(self) -> Iterator[None]:
        """Around each reading and writing: whatever is wrong with a file ends there."""
        try:
            yield
        except RuntimeError:  # the code is not ready to be kept yet: Numba compiles it again
            pass
        except Exception as error:  # noqa: BLE001 - a damaged pickle may raise anything
            CACHE_TROUBLE.append(f"{CACHE}: {type(error).__name__}: {error}")
            with suppress(Exception):
                self.flush()  # type: ignore[no-untyped-call] # Numba has no types


def compiled(function: Compiled) -> Compiled:
    """A function that is compiled when it is called first; the machine code is kept if it can."""
    made = numba.njit(function, nogil=True, error_model="numpy")
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = CACHE  # type: ignore[attr-defined]
    try:
        if CACHE and made is not function:
            kept = _KeptCode(function)  # type: ignore[no-untyped-call]
            if kept.cache_path.startswith(CACHE):
                made._cache = kept  # noqa: SLF001 - as its own enable_caching does
    except (OSError, RuntimeError) as error:
        CACHE_TROUBLE.append(f"{CACHE}: {error}")
    finally:  # functions of others are kept where they want
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
    return cast(Compiled, made)


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array; an assignment of slices would take seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]


@compiled
def fill(into: Floats | Integers, value: float) -> None:
    """Give all places of an array one value."""
    for place in range(len(into)):
        into[place] = value
