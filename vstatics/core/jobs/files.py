"""Files that are written completely or not at all, and streams that are written in place."""

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
"""Error numbers for faults of a single file name. Other errors affect all files."""
Write = Callable[[bytes | memoryview], None]


def is_stream(output: str | None) -> bool:
    """Return whether an output is a stream: stdout, or an existing file that cannot be replaced.

    >>> is_stream("-"), is_stream("/dev/stdout"), is_stream("gears.csv")
    (True, True, False)
    """
    if output is None or output == STDOUT:
        return True
    if output.startswith("/dev/") and not output.startswith("/dev/shm/"):  # noqa: S108
        return True  # /dev/stdout must not be replaced, even if it is a file
    try:
        mode = os.stat(output).st_mode  # noqa: PTH116
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def unwritable(output: str | None, error: OSError) -> Problem:
    """Return the problem that an output, or stdout, cannot be written."""
    message = f"cannot be written: {error.strerror or error}"
    if output is None or output == STDOUT:
        return of_file("E030", "<stdout>", message)
    return missing_folder(output) or of_file("E030", output, message)


def missing_folder(output: str) -> Problem | None:
    """Return a problem if an output has a directory that does not exist.

    >>> str(missing_folder("nowhere/new.csv"))
    'nowhere/new.csv: error: cannot be written: there is no directory nowhere; create it [E030]'
    """
    folder = os.path.dirname(output.rstrip("/"))  # noqa: PTH120
    if not folder or os.path.lexists(folder):
        return None
    message = f"cannot be written: there is no directory {folder}; create it"
    return of_file("E030", output, message)


def opened(output: str) -> contextlib.AbstractContextManager[Write]:
    """Open an existing stream for writing. A redirected file continues at its current position."""
    standard = re.fullmatch(r"/dev/std(?:(out)|err)|(?:/dev|/proc/self)/fd/(\d{1,9})", output)
    if standard is None:
        handle = os.open(output, os.O_WRONLY | os.O_APPEND)
    else:
        handle = os.dup(int(standard[2]) if standard[2] else 1 if standard[1] else 2)
    return descriptor_writing(handle)


@contextlib.contextmanager
def descriptor_writing(handle: int) -> Iterator[Write]:
    """Yield a function that writes to an open file, and close the file after the block."""
    try:
        yield partial(write_all, handle)
    finally:
        os.close(handle)


def replace(path: str, data: bytes, mark: str = "") -> None:
    """Write a file, completely or not at all.

    Parameters
    ----------
    path : str
    data : bytes
    mark : str, optional
        Text in the names of temporary files. If a process is killed, a later process removes the
        temporary files with this mark.

    Raises
    ------
    OSError
        If the file cannot be written. An earlier file is then unchanged.
    """
    with replacing(path, mark) as write:
        write(data)


@contextlib.contextmanager
def replacing(
    path: str, mark: str = "", folder: int | None = None, expected: bytes | None = None
) -> Iterator[Write]:
    """Write a temporary file, and move it into place when the block ends without error.

    An earlier file keeps its permissions. If `path` is a link, its target is replaced.

    Raises
    ------
    ChangedFileError
        If the earlier file, which then does not change, has other than the `expected` content.
    """
    mode = _mode(path or os.curdir, os.lstat)
    if mode is not None and stat.S_ISLNK(mode):
        path = os.path.realpath(path)
        mode = _mode(path)
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
    """Write a temporary file, and rename it to `path` when the block ends without error.

    Parameters
    ----------
    path : str
    mark : str
        Mark in the temporary name; see `replace`.
    mode : int, optional
        Permissions of the file, by default from the umask.
    source, target : int, optional
        Descriptors of the folders of the temporary file and of `path`.
    expected : bytes, optional
        Required content of the replaced file. It cannot be combined with `source` and `target`.

    Raises
    ------
    ChangedFileError
        If the replaced file, which then does not change, has other than the `expected` content.
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
    """Error for a file that another process has changed."""


def _exchange(new: str, path: str, expected: bytes) -> None:
    """Replace a file of known content by a new file.

    If possible, both files are exchanged in a single step, and the content of the old file is
    compared afterwards. A change just before the exchange is then not lost.
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
    """Exchange two files in a single step; return False if the system does not support this."""
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
    """Wait until a file is completely on the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def set_aside(path: str) -> str:
    """Rename an earlier regular file with the suffix `OLD`; return its new name, or ""."""
    with contextlib.suppress(FileNotFoundError):
        if stat.S_ISREG(os.lstat(path).st_mode):
            os.replace(path, path + OLD)  # noqa: PTH105
            return path + OLD
    return ""


def hash_of(case: bytes) -> str:
    """Return the SHA-256 hash of the bytes of a case."""
    from hashlib import sha256  # costs start-up time

    return sha256(case).hexdigest()


def hash_of_file(name: str) -> str | None:
    """Return the SHA-256 hash of a file; None for an unreadable or special file."""
    try:
        if stat.S_ISREG(os.stat(name).st_mode):  # noqa: PTH116
            with open(name, "rb") as file:  # noqa: PTH123
                return hash_of(file.read())
    except OSError:
        pass
    return None


def is_temporary(name: str) -> bool:
    """Return whether a file name denotes a temporary, unfinished file."""
    return name.startswith(PREFIX) or name.endswith(".tmp")  # earlier versions used this suffix


def front(mark: str) -> str:
    """Return the prefix of the names of temporary files that have a mark."""
    return f"{PREFIX}{mark}-" if mark else PREFIX


def _new_file(folder: str, mark: str, opened: int | None) -> tuple[str, int]:
    """Create a temporary file in a folder, and return its name and descriptor."""
    for number in itertools.count():
        temporary = os.path.join(folder, f"{front(mark)}{os.getpid()}-{number}")  # noqa: PTH118
        try:
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
            return temporary, os.open(temporary, flags, 0o666, dir_fd=opened)
        except FileExistsError:  # a killed process left this file
            continue
        except OSError as error:
            error.filename = folder or os.curdir  # users know the folder, not the temporary file
            raise
    raise AssertionError


def write_all(handle: int, data: bytes | memoryview) -> None:
    """Write all data, in several calls if necessary, because a call writes 2 GB at most."""
    remaining = memoryview(data)
    while remaining:
        remaining = remaining[os.write(handle, remaining) :]


def _mode(path: str, status: Callable[[str], os.stat_result] = os.stat) -> int | None:
    """Return type and permissions of a file, or None without a file; refuse a directory."""
    try:
        mode = status(path).st_mode
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    return mode
