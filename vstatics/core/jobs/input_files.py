"""Input files and streams. Their size is checked before reading."""

from __future__ import annotations

import errno
import os
import stat
from typing import BinaryIO, Protocol, TypeVar, cast

from vstatics.core.errors import Problem, of_file

DOCUMENT_BYTES = 10_000_000
"""Largest size of a document, such as a case, a scenario or a list of files. [bytes]"""
TABLE_BYTES = 256_000_000
"""Largest size of a file of numbers, such as results, variants or records. [bytes]"""

KINDS = {
    stat.S_IFLNK: "a link",
    stat.S_IFDIR: "a folder",
    stat.S_IFREG: "a file",
    stat.S_IFIFO: "a named pipe (FIFO)",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
"""Names of the kinds of files in messages, by type in the file mode."""
AT_ONCE = getattr(os, "O_NONBLOCK", 0)
"""Flag to open a pipe without waiting for another process to write to it."""
_STREAM_PIECE = 2**20
"""Size of a single read from a stream. [bytes]"""
Data = TypeVar("Data", str, bytes)
Data_co = TypeVar("Data_co", str, bytes, covariant=True)


class Readable(Protocol[Data_co]):
    """Stream with a method `read`, which returns an empty text or bytes at the end."""

    def read(self, size: int, /) -> Data_co:
        """Return the next part."""


class TooLargeError(OSError):
    """Error for an input that is larger than its limit, or endless."""

    def __init__(self, most: int, file: str | None = None) -> None:
        message = f"larger than {most / 1e6:g} MB, expected at most this size"
        super().__init__(errno.EFBIG, message, file)


class NotRegularError(OSError):
    """Error for a pipe or device instead of a regular file, because it could block."""

    def __init__(self, mode: int, file: str) -> None:
        kind = KINDS.get(stat.S_IFMT(mode), "not a file")
        super().__init__(errno.EINVAL, f"{kind}, expected a regular file", file)


def read_file(
    file: str | os.PathLike[str], most: int = DOCUMENT_BYTES, *, regular: bool = False
) -> bytes:
    """Return the content of a file.

    Parameters
    ----------
    file : path-like
    most : int
        Largest size. [bytes]
    regular : bool
        True to refuse pipes and devices. A user may name a pipe and wait for it. But a pipe is
        refused if it is in a folder, or if another file names it.

    Raises
    ------
    OSError
        If the file cannot be opened or read. `TooLargeError` and `NotRegularError` are such errors.
    """
    with opened(file, regular=regular) as stream:
        about = os.fstat(stream.fileno())
        is_regular = stat.S_ISREG(about.st_mode)
        if is_regular and about.st_size > most:
            raise TooLargeError(most, os.fspath(file))
        first = about.st_size + 1 if is_regular else _STREAM_PIECE
        return read_stream(stream, most, os.fspath(file), first)


def unreadable(file: str, error: OSError) -> Problem:
    """Return the problem that an input cannot be read.

    >>> str(unreadable("large.yaml", TooLargeError(2_000_000)))
    'large.yaml: error: cannot be read: larger than 2 MB, expected at most this size [E046]'
    """
    ids = {TooLargeError: "E046", NotRegularError: "E047"}
    reason = error.strerror or str(error)
    return of_file(ids.get(type(error), "E006"), file, f"cannot be read: {reason}")


def opened(file: str | os.PathLike[str], *, regular: bool = False) -> BinaryIO:
    """Open a file without a buffer; see `read_file` for parameters and errors."""
    name = os.fspath(file)
    how = _at_once if regular else None
    stream = cast("BinaryIO", open(name, "rb", buffering=0, opener=how))  # noqa: SIM115 - closed by the caller
    if regular and not stat.S_ISREG(mode := os.fstat(stream.fileno()).st_mode):
        stream.close()
        raise NotRegularError(mode, name)
    return stream


def _at_once(name: str, flags: int) -> int:
    """Open a file without waiting for a process that writes to it."""
    return os.open(name, flags | AT_ONCE)


def read_stream(
    stream: Readable[Data], most: int, file: str | None = None, first: int = _STREAM_PIECE
) -> Data:
    r"""Return the whole content of a stream of text or bytes.

    Parameters
    ----------
    stream : Readable
    most : int
        Largest length. [bytes or characters]
    file : str, optional
        Name of the stream in the error message.
    first : int
        Size of the first read. [bytes or characters]

    Raises
    ------
    TooLargeError

    Examples
    --------
    >>> import io
    >>> read_stream(io.BytesIO(b"gears: "), 10)
    b'gears: '
    >>> read_stream(io.StringIO("gears: "), 3)
    Traceback (most recent call last):
    vstatics.core.jobs.input_files.TooLargeError: [Errno 27] larger than 3e-06 MB, ...
    """
    parts: list[Data] = []
    length, size = 0, first
    while part := stream.read(min(size, most + 1 - length)):
        parts.append(part)
        length, size = length + len(part), _STREAM_PIECE
        if length > most:
            raise TooLargeError(most, file)
    return part.join(parts)  # an empty part ends the stream
