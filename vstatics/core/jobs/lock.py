"""Lock of a folder that a process holds while it runs."""

from __future__ import annotations

import contextlib
import errno
import os
import time

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.state_files import StateFolder

WITHOUT = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)
"""Error numbers of file systems without locks."""
LOCK_TENTHS = 10
"""Longest time to wait for the lock. [0.1 s]"""


def lock(folder: StateFolder, name: str, what: str) -> int | None:
    """Create a folder if necessary, lock the folder, and return the descriptor of the lock file.

    The descriptor is the argument of `unlock`, or None on systems without locks.

    Parameters
    ----------
    folder : StateFolder
    name : str
        Name of the lock file, which contains the process id.
    what : str
        Name of the work, for the message in other processes.

    Raises
    ------
    ReadError
        If another process holds the lock, or a different kind of file has this name.
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
            time.sleep(0.1)  # workers of a killed process end soon and release the lock
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
            if folder.has(name, file):  # False if the previous owner has removed the file
                with contextlib.suppress(OSError):  # the lock must also work on a full disk
                    os.ftruncate(file, 0)
                    os.write(file, f"{os.getpid()}\n".encode())
                return file
        os.close(file)
    process = f" (process {holder})" if holder else ""
    message = f"another {what}{process} is writing this output"
    raise ReadError([of_file("E034", folder.path, message)])


def unlock(file: int | None) -> None:
    """Release the lock of a folder."""
    if file is not None:
        with contextlib.suppress(OSError):  # some network drives report a full disk only here
            os.close(file)
