"""A directory that one process has for as long as it lives, however it ends."""

from __future__ import annotations

import contextlib
import errno
import os
import time

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.state_files import StateFolder

WITHOUT = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)
"""How a file system says that it has no locks."""
LOCK_TENTHS = 10
"""Tenths of a second to wait for it."""


def lock(folder: StateFolder, name: str, what: str) -> int | None:
    """Make a folder, if need be, and lock it; the file to `unlock` in the end.

    None where a system, or the file system, has no such locks.

    Parameters
    ----------
    folder : StateFolder
    name : str
        Of the file in the folder; it names the process.
    what : str
        What the process does, for the message to others.

    Raises
    ------
    ReadError
        If another process has it, or something else has its name.
    OSError
    """
    folder.make()
    try:
        import fcntl
    except ImportError:
        return None
    holder = ""
    for attempt in range(LOCK_TENTHS):
        if attempt:
            time.sleep(0.1)  # workers of a killed process leave soon
            folder.make()
        file = folder.open(name, os.O_RDWR | os.O_CREAT)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.read(file, 100).decode(errors="replace").strip()
        except OSError as error:
            folder.remove(name)
            os.close(file)
            if error.errno in WITHOUT:
                return None
            raise
        else:
            if folder.has(name, file):  # else it was removed, by one that has finished
                with contextlib.suppress(OSError):  # a full disk: it is locked all the same
                    os.ftruncate(file, 0)
                    os.write(file, f"{os.getpid()}\n".encode())
                return file
        os.close(file)
    process = f" (process {holder})" if holder else ""
    message = f"another {what}{process} is writing this output"
    raise ReadError([of_file("E034", folder.path, message)])


def unlock(file: int | None) -> None:
    """Let go of a folder."""
    if file is not None:
        with contextlib.suppress(OSError):  # a full disk elsewhere: the number is not there
            os.close(file)
