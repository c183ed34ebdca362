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

from vstatics.core.errors import Problem, of_file
from vstatics.core.jobs.input_files import read_file

STDOUT = "-"
STDIN_NAME = "<stdin>"
OLD = ".old"
PREFIX = ".vstatics-"
OWN_FAULTS = {errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP, errno.EILSEQ}
"""Errors of writing that one name has; any other would meet every file."""
Write = Callable[[bytes | memoryview], None]


def is_stream(output: str | None) -> bool:
    """Whether an output is stdout, or is there and no file that could be replaced.

    >>> is_stream("-"), is_stream("/dev/stdout"), is_stream("gears.csv")
    (True, True, False)
    """
    if output is None or output == STDOUT:
        return True
    if output.startswith("/dev/") and not output.startswith("/dev/shm/"):  # noqa: S108
        return True  # /dev/stdout is not to be replaced, whatever it is
    try:
        mode = os.stat(output).st_mode  # noqa: PTH116
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def unwritable(output: str | None, error: OSError) -> Problem:
    """The problem that an output, or stdout, cannot be written."""
    told = f"can't be written: {error.strerror or error}"
    if output is None or output == STDOUT:
        return of_file("E030", "<stdout>", told)
    return missing_folder(output) or of_file("E030", output, told)


def missing_folder(output: str) -> Problem | None:
    """The problem that the directory of an output is not there, which nobody but its user makes.

    >>> str(missing_folder("nowhere/new.csv"))
    "nowhere/new.csv: error: can't be written: there is no directory nowhere, make it [E030]"
    """
    folder = os.path.dirname(output.rstrip("/"))  # noqa: PTH120
    if not folder or os.path.lexists(folder):
        return None
    message = f"can't be written: there is no directory {folder}, make it"
    return of_file("E030", output, message)


def opened(output: str) -> contextlib.AbstractContextManager[Write]:
    """Write to a stream that is there, where it stands: not at the end of a file behind it."""
    own = re.fullmatch(r"/dev/std(?:(out)|err)|(?:/dev|/proc/self)/fd/(\d{1,9})", output)
    if own is None:
        handle = os.open(output, os.O_WRONLY | os.O_APPEND)
    else:
        handle = os.dup(int(own[2]) if own[2] else 1 if own[1] else 2)
    return descriptor_writing(handle)


@contextlib.contextmanager
def descriptor_writing(handle: int) -> Iterator[Write]:
    """Write to a file that is open, and close it."""
    try:
        yield partial(write_all, handle)
    finally:
        os.close(handle)


def replace(path: str, data: bytes, mark: str = "") -> None:
    """Write a file, whole or not at all.

    Parameters
    ----------
    path : str
    data : bytes
    mark : str, optional
        Whose file it is, by which the rest of a killed process is removed later.

    Raises
    ------
    OSError
        If it cannot be written; then the file is as it was.
    """
    with replacing(path, mark) as write:
        write(data)


@contextlib.contextmanager
def replacing(
    path: str, mark: str = "", folder: int | None = None, expected: bytes | None = None
) -> Iterator[Write]:
    """Write beside a file, or in an open folder, and move it into place when the block ends well.

    An old file keeps its permissions; a link stays, and its file is written.

    Raises
    ------
    ChangedFileError
        If the old file then has another content than is expected; it stays as it is.
    """
    if os.path.islink(path):  # noqa: PTH114
        path = os.path.realpath(path)
    mode = _mode(path or os.curdir)
    with whole_file(path, mark, mode, source=folder, expected=expected) as write:
        yield write


@contextlib.contextmanager
def whole_file(  # noqa: PLR0913
    path: str,
    mark: str = "",
    mode: int | None = None,
    *,
    source: int | None = None,
    target: int | None = None,
    expected: bytes | None = None,
) -> Iterator[Write]:
    """Write a new file, and rename it to a path when the block ends well.

    Parameters
    ----------
    path : str
    mark : str
        As of `replace`.
    mode : int, optional
        Its permissions; otherwise those of the umask.
    source, target : int, optional
        Open folders: in which it is written, instead of the folder of the path, and in which
        the path is.
    expected : bytes, optional
        Content of the file that is replaced; it has no open folders.

    Raises
    ------
    ChangedFileError
        If that file has another content; it stays as it is.
    """
    folder = os.path.dirname(path) if source is None else ""  # noqa: PTH120
    temporary, handle = _new_file(folder, mark, source)
    try:
        with descriptor_writing(handle) as write:
            if mode is not None:
                os.fchmod(handle, stat.S_IMODE(mode))
            yield write
        if expected is None:
            os.replace(temporary, path, src_dir_fd=source, dst_dir_fd=target)
        else:
            _exchange(temporary, path, expected)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary, dir_fd=source)
        raise


class ChangedFileError(Exception):
    """Error for a file that another process has written meanwhile."""


def _exchange(new: str, path: str, expected: bytes) -> None:
    """Move a new file into the place of a file whose content is known.

    Where the system can, both change places in one step, and the old file is compared after it:
    a text that somebody writes between a comparison and a renaming is not lost.
    """
    if not _holds(path, expected):
        raise ChangedFileError
    if not _swapped(new, path):
        os.replace(new, path)  # noqa: PTH105
    elif _holds(new, expected):
        os.unlink(new)  # noqa: PTH108
    else:
        _swapped(new, path)
        raise ChangedFileError


def _swapped(new: str, old: str) -> bool:
    """Exchange two files in one step; false where the system cannot."""
    import ctypes  # costs start-up time

    rename = getattr(ctypes.CDLL(None), "renameat2", None) if os.name == "posix" else None
    if rename is None:
        return False
    here, exchange = -100, 2  # AT_FDCWD, RENAME_EXCHANGE
    return bool(rename(here, os.fsencode(new), here, os.fsencode(old), exchange) == 0)


def _holds(path: str, expected: bytes) -> bool:
    with contextlib.suppress(OSError):
        return read_file(path, len(expected), regular=True) == expected
    return False


def sync(path: str) -> None:
    """Wait until what was written to a file is on the disk, whoever wrote it."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def set_aside(path: str) -> str:
    """Rename an earlier file, so that nobody takes it for a new one; its name now, if there was."""
    with contextlib.suppress(FileNotFoundError):
        if stat.S_ISREG(os.lstat(path).st_mode):
            os.replace(path, path + OLD)  # noqa: PTH105
            return path + OLD
    return ""


def hash_of(case: bytes) -> str:
    """The hash of a case as it was read."""
    from hashlib import sha256  # costs start-up time

    return sha256(case).hexdigest()


def hash_of_file(name: str) -> str | None:
    """The hash of a case; None if it is no file that stays."""
    try:
        if stat.S_ISREG(os.stat(name).st_mode):  # noqa: PTH116
            with open(name, "rb") as file:  # noqa: PTH123
                return hash_of(file.read())
    except OSError:
        pass
    return None


def is_temporary(name: str) -> bool:
    """Whether a file was not finished, by its name."""
    return name.startswith(PREFIX) or name.endswith(".tmp")  # the earlier names


def front(mark: str) -> str:
    """Return the beginning of the names of files of a mark."""
    return f"{PREFIX}{mark}-" if mark else PREFIX


def _new_file(folder: str, mark: str, opened: int | None) -> tuple[str, int]:
    """Create a file in a folder, with the permissions of the umask; its name and handle."""
    for number in itertools.count():
        temporary = os.path.join(folder, f"{front(mark)}{os.getpid()}-{number}")  # noqa: PTH118
        try:
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
            return temporary, os.open(temporary, flags, 0o666, dir_fd=opened)
        except FileExistsError:  # left by a process that was killed
            continue
        except OSError as error:
            error.filename = folder or os.curdir  # not our own file
            raise
    raise AssertionError


def write_all(handle: int, data: bytes | memoryview) -> None:
    """Write all of it: one call takes 2 GB at most, and less where a disk gets full."""
    left = memoryview(data)
    while left:
        left = left[os.write(handle, left) :]


def _mode(path: str) -> int | None:
    """Type and permissions of a file, if it is there; it is no directory."""
    try:
        mode = os.stat(path).st_mode  # noqa: PTH116
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    return mode
