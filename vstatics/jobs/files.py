"""Files that are there whole or not at all, and streams that are written where they stand."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import re
import stat
from collections.abc import Callable, Iterator
from functools import partial


@contextlib.contextmanager
def opened(output: str) -> Iterator[Callable[[bytes], None]]:
    """Write to a stream that is there, where it stands: not at the end of a file behind it."""
    own = re.fullmatch(r"/dev/std(?:(out)|err)|(?:/dev|/proc/self)/fd/(\d{1,9})", output)
    if own is None:
        handle = os.open(output, os.O_WRONLY | os.O_APPEND)
    else:
        handle = os.dup(int(own[2]) if own[2] else 1 if own[1] else 2)
    try:
        yield partial(_write, handle)
    finally:
        os.close(handle)


def replace(path: str, data: bytes) -> None:
    """Write a file, whole or not at all.

    Raises
    ------
    OSError
        If it cannot be written; then the file is as it was.
    """
    with replacing(path) as write:
        write(data)


@contextlib.contextmanager
def replacing(path: str) -> Iterator[Callable[[bytes], None]]:
    """Write beside a file, and move it into place when the block ends well.

    An old file keeps its permissions; a link stays, and its file is written.
    """
    if os.path.islink(path):  # noqa: PTH114
        path = os.path.realpath(path)
    mode = _mode(path or os.curdir)
    temporary, handle = _beside(path)
    try:
        try:
            if mode is not None:
                os.fchmod(handle, stat.S_IMODE(mode))
            yield partial(_write, handle)
        finally:
            os.close(handle)
        os.replace(temporary, path)  # noqa: PTH105
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)  # noqa: PTH108
        raise


def forget(folder: str, process: int) -> None:
    """Remove the file that a process was writing in a folder when it was ended."""
    with contextlib.suppress(OSError):
        os.unlink(_temporary_name(folder, process))  # noqa: PTH108


def _temporary_name(folder: str, process: int, number: int = 0) -> str:
    """The name under which a process writes a file before it moves it into place."""
    return os.path.join(folder, f".vstatics-{process}-{number}")  # noqa: PTH118


def _beside(path: str) -> tuple[str, int]:
    """A new file in the same folder, with the permissions of the umask; its name and handle."""
    folder = os.path.dirname(path)  # noqa: PTH120
    for number in itertools.count():
        temporary = _temporary_name(folder, os.getpid(), number)
        with contextlib.suppress(FileExistsError):  # left by a process that was killed
            return temporary, os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    raise AssertionError


def _write(handle: int, data: bytes) -> None:
    """Write all of it; a file system that is nearly full may take a part at a time."""
    while data:
        data = data[os.write(handle, data) :]


def _mode(path: str) -> int | None:
    """Type and permissions of a file, if it is there; it is no directory."""
    try:
        mode = os.stat(path).st_mode  # noqa: PTH116
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    return mode
