"""Folder in which machine code is stored between runs."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from vstatics.core.extras import build

CACHE_TROUBLE: list[str] = []
"""Reasons why machine code could not be stored or read, to be reported by the command."""


def _cache() -> str:
    """Return a folder for machine code in which no other user can write; "" if no folder is safe.

    Folders are checked from the root of the resolved path downwards, so that no other user can
    replace a folder after its check. The name of the folder depends on the compiled source files
    and tolerances, so that machine code of another version is never used.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    name = build(b"import compiled", b"Tolerances of", b"from numba")
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
                # another process can have just renamed a temporary file
                with suppress(FileNotFoundError):
                    _check(os.path.join(inner, name))  # noqa: PTH118
        if not os.access(folder, os.W_OK):
            CACHE_TROUBLE.append(f"{folder} can't be written")
            return ""
    except OSError as error:
        CACHE_TROUBLE.append(f"{error.filename or folder}: {error.strerror}")
        return ""
    return folder


def _check(path: str, *, may_be_shared: bool = False) -> None:
    """Raise OSError for a file or folder that other users, except root, can change.

    Parameters
    ----------
    path : str
    may_be_shared : bool
        True to accept a folder that others can write to, if its sticky bit protects the files of
        each user.

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
def private() -> Iterator[None]:
    """Prevent other users from writing to files created in the `with` block."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


ROOT = 0
"""User id of root, who can change every file."""
CACHE = _cache()
"""Folder for machine code; empty if no safe folder exists."""
