"""A directory that one process has for as long as it lives, however it ends."""

from __future__ import annotations

import contextlib
import errno
import os
import time

from vstatics.errors import ReadError, of_file

WITHOUT = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)
"""How a file system says that it has no locks."""
LOCK_TENTHS = 10
"""Tenths of a second to wait for it."""


def lock(directory: str, name: str, what: str) -> int | None:
    """Make a directory, if need be, and lock it; the file to `unlock` in the end.

    None where a system, or the file system, has no such locks.

    Parameters
    ----------
    directory : str
    name : str
        Of the file in the directory; it names the process.
    what : str
        What the process does, for the message to others.

    Raises
    ------
    ReadError
        If another process has it.
    OSError
    """
    _make(directory)
    try:
        import fcntl
    except ImportError:
        return None
    holder = ""
    for attempt in range(LOCK_TENTHS):
        if attempt:
            time.sleep(0.1)  # workers of a killed process leave soon
            _make(directory)
        path = os.path.join(directory, name)  # noqa: PTH118
        file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.read(file, 100).decode(errors="replace").strip()
        except OSError as error:
            unlock(file, path)
            if error.errno in WITHOUT:
                return None
            raise
        else:
            if _is_same(file, path):  # else it was removed, by one that has finished
                os.truncate(file, 0)
                os.write(file, f"{os.getpid()}\n".encode())
                return file
        os.close(file)
    process = f" (process {holder})" if holder else ""
    raise ReadError([of_file("E034", directory, f"another {what}{process} is writing this output")])


def unlock(file: int | None, path: str = "") -> None:
    """Let go of a directory; with a path remove the file before."""
    if file is not None:
        if path:
            with contextlib.suppress(OSError):
                os.unlink(path)  # noqa: PTH108
        os.close(file)


def _make(directory: str) -> None:
    with contextlib.suppress(FileExistsError):
        os.mkdir(directory)  # noqa: PTH102


def _is_same(file: int, path: str) -> bool:
    """Whether an open file still has this name."""
    try:
        return os.path.samestat(os.fstat(file), os.stat(path))  # noqa: PTH116
    except OSError:
        return False
