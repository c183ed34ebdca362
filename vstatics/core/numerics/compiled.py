"""Functions compiled with Numba, for loops that arrays cannot replace."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TypeVar, cast

import numba
from numba.core.caching import FunctionCache

from vstatics.core.extras import build
from vstatics.core.numerics.arrays import Floats, Integers

Compiled = TypeVar("Compiled", bound=Callable[..., Any])

CACHE_TROUBLE: list[str] = []
"""Reasons why machine code could not be stored or read, for the command to report."""


def _cache() -> str:
    """Return a folder for machine code in which no other user can write, or "".

    The path is resolved once, and its folders are checked from the root on, so that nobody can
    exchange a folder that is checked later. The name of the folder depends on the compiled files
    and on the tolerances in them, so that machine code of other versions is never used.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    name = build(b"import compiled", b"Tolerances of")
    folder = os.path.realpath(os.path.join(home, "vstatics", name))  # noqa: PTH118
    try:
        path = ""
        for part in folder.split(os.sep):  # noqa: PTH206 - imports of pathlib cost start-up time
            path += part + os.sep
            with suppress(FileExistsError):
                os.mkdir(path, mode=0o700)  # noqa: PTH102
            _check(path, may_be_shared=True)
        _check(folder)
        for inner, folders, names in os.walk(folder):
            for name in (*folders, *names):
                with suppress(FileNotFoundError):  # another process has just finished a file
                    _check(os.path.join(inner, name))  # noqa: PTH118
        if not os.access(folder, os.W_OK):
            CACHE_TROUBLE.append(f"{folder} cannot be written")
            return ""
    except OSError as error:
        CACHE_TROUBLE.append(f"{error.filename or folder}: {error.strerror}")
        return ""
    return folder


def _check(path: str, *, may_be_shared: bool = False) -> None:
    """Refuse a file or folder that users other than the present user and root can change.

    Parameters
    ----------
    path : str
    may_be_shared : bool
        True if others may write in a folder whose sticky bit protects the files of each user.

    Raises
    ------
    OSError
        If the file or folder is refused.
    """
    status = os.lstat(path)
    mode = status.st_mode
    if not (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
        why = "is neither a file nor a folder"
    elif status.st_uid not in (os.geteuid(), ROOT):
        why = "has another owner"
    elif mode & 0o022 and not (may_be_shared and mode & stat.S_ISVTX):
        why = "others may write there (chmod go-w)"
    else:
        return
    raise PermissionError(errno.EPERM, why, path)


@contextmanager
def _private() -> Iterator[None]:
    """Create files that no other user can write."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


ROOT = 0
"""Number of the user who can change every file."""
CACHE = _cache()
"""Folder for machine code; empty if no safe folder exists."""


class _CachedCode(FunctionCache):
    """Machine code in files; unreadable code is compiled again."""

    @contextmanager
    def _guard_against_spurious_io_errors(self) -> Iterator[None]:
        """Guard each reading and writing against any fault of a file."""
        try:
            with _private():
                yield
        except RuntimeError:  # the code is not ready to be stored yet; Numba compiles it again
            pass
        except Exception as error:  # noqa: BLE001 - a damaged pickle may raise anything
            CACHE_TROUBLE.append(f"{CACHE}: {type(error).__name__}: {error}")
            with suppress(Exception):
                self.flush()  # type: ignore[no-untyped-call] # Numba has no types


def compiled(function: Compiled) -> Compiled:
    """Return a function that is compiled at the first call, or loaded as stored machine code."""
    return _compiled(function)


def compiled_part(function: Compiled) -> Compiled:
    """Return a function that only compiled functions call, and that allocates no array.

    It takes half the time to compile, because it needs no conversion of Python objects and no
    counting of references.
    """
    return _compiled(function, no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)


def _compiled(function: Compiled, **options: Any) -> Compiled:
    dispatcher = numba.njit(function, nogil=True, error_model="numpy", **options)
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = CACHE  # type: ignore[attr-defined]
    try:
        if CACHE and dispatcher is not function:
            with _private():
                cache = _CachedCode(function)  # type: ignore[no-untyped-call]
            if cache.cache_path.startswith(CACHE):
                dispatcher._cache = cache  # noqa: SLF001 - as its own enable_caching does
    except (OSError, RuntimeError) as error:
        CACHE_TROUBLE.append(f"{CACHE}: {error}")
    finally:  # other packages' functions are stored where they want
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
    return cast(Compiled, dispatcher)


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array; an assignment of slices would take seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]


@compiled_part
def fill(into: Floats | Integers, value: float) -> None:
    """Fill an array with a value."""
    for place in range(len(into)):
        into[place] = value
