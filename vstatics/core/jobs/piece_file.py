"""File with a finished piece (a range of variants) of a sweep.

The file is written under another name and then renamed, so it is complete or absent. It begins with
the data, which can be copied unchanged into the output. After the data, a JSON description with
checksums follows (the account), then the length and checksum of the account.
"""

from __future__ import annotations

import errno
import json
import os
import re
import struct
import zlib
from collections.abc import Sequence
from itertools import groupby
from typing import Any, NamedTuple

from vstatics.core.jobs.state_files import StateFolder

ASSEMBLED = "output"
"""Name of the file in which the output is built from pieces."""
_END = struct.Struct("<QL8s")
_MAGIC = b"vstpiece"
_BUFFER = 2**20


class Segment(NamedTuple):
    """Segment of the data of a piece: a column of numbers, or the whole text."""

    length: int
    crc: int


class Noticed(NamedTuple):
    """Message about several variants. The numbers in its text can differ between variants."""

    id: str
    text: str
    """Text of the message for the first variant."""
    first: int
    """Number of the first variant with the message, in the order of the sweep."""
    variants: int
    """Number of variants with the message."""

    @property
    def alike(self) -> tuple[str, str]:
        """Key of messages that differ only in numbers."""
        return self.id, _NUMBER.sub("0", self.text)


_NUMBER = re.compile(r"(?<![\w.])-?\d+(\.\d+)?(e[+-]?\d+)?(?!\w)")
"""Pattern of a number in a message, without digits of names such as C1."""


class Account(NamedTuple):
    """Description of a finished piece: counts, messages, and the layout of the data."""

    piece: int
    rows: int
    counts: dict[str, int]
    """Number of variants (or of gears of variants) by status, including removed variants."""
    segments: tuple[Segment, ...]
    removed: tuple[int, ...] = ()
    """Number of variants that each term of the filter condition removes, in order."""
    outside: tuple[str, ...] = ()
    """Names of laws that were evaluated outside their points."""
    noticed: tuple[Noticed, ...] = ()
    """Messages of the variants."""
    solved: int = 0
    """Number of variants with a solution in all requested gears."""
    work: str = ""
    """Hash of the definition of the work."""

    @property
    def variants(self) -> int:
        """Number of variants (or of gears of variants) of the piece."""
        return sum(self.counts.values())

    @property
    def length(self) -> int:
        """Length of the data [bytes]."""
        return sum(segment.length for segment in self.segments)


class Copy(NamedTuple):
    """Section of a piece to be copied: offsets in the piece file and in the output [bytes]."""

    piece: int
    source: int
    target: int
    length: int


def piece_bytes(  # noqa: PLR0913 PLR0917 (what an account holds)
    piece: int,
    rows: int,
    counts: dict[str, int],
    data: Sequence[Any],
    removed: tuple[int, ...] = (),
    outside: tuple[str, ...] = (),
    noticed: tuple[Noticed, ...] = (),
    solved: int = 0,
    work: str = "",
) -> tuple[Account, list[Any]]:
    """Return the account and the content of a piece file, as buffers to be written in sequence.

    Parameters
    ----------
    piece, rows : int
    counts : dict
        See `Account`.
    data : sequence of bytes-like
        Segments.
    removed, outside, noticed : tuple
    solved : int
    work : str
        See `Account`.
    """
    segments = tuple(Segment(memoryview(segment).nbytes, zlib.crc32(segment)) for segment in data)
    account = Account(piece, rows, counts, segments, removed, outside, noticed, solved, work)
    text = json.dumps(account._asdict()).encode()
    return account, [*data, text, _END.pack(len(text), zlib.crc32(text), _MAGIC)]


def write_piece(directory: str, piece: int, buffers: Sequence[Any]) -> None:
    """Write a piece, completely or not at all.

    Raises
    ------
    OSError
    """
    with StateFolder(directory).replacing(piece_name(piece)) as write:
        for buffer in buffers:
            write(memoryview(buffer).cast("B"))


def read_account(directory: str, piece: int, work: str = "") -> Account | None:
    """Return the account (counts, messages, data layout) of a finished piece.

    The result is None if the file is missing or damaged, or belongs to another piece or other
    `work`.
    """
    try:
        with StateFolder(directory).reading(piece_name(piece)) as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(size - _END.size)
            length, crc, magic = _END.unpack(file.read(_END.size))
            file.seek(size - _END.size - length)
            text = file.read(length)
            if magic != _MAGIC or zlib.crc32(text) != crc:
                return None
            fields = json.loads(text)
            segments = tuple(Segment(*segment) for segment in fields.pop("segments"))
            fields |= {name: tuple(fields[name]) for name in ("removed", "outside")}
            fields["noticed"] = tuple(Noticed(*entry) for entry in fields["noticed"])
            account = Account(segments=segments, **fields)
            file.seek(0)
            whole = all(_crc(file, segment.length) == segment.crc for segment in account.segments)
    except (OSError, ValueError, KeyError, TypeError, struct.error):
        return None
    return account if whole and (account.piece, account.work) == (piece, work) else None


def _crc(file: Any, length: int) -> int:
    crc = 0
    while length:
        data = file.read(min(length, _BUFFER))
        if not data:
            return -1
        crc = zlib.crc32(data, crc)
        length -= len(data)
    return crc


def read_segments(directory: str, account: Account) -> list[bytes]:
    """Read the data of a piece.

    Raises
    ------
    OSError
    """
    with StateFolder(directory).reading(piece_name(account.piece)) as file:
        return [file.read(segment.length) for segment in account.segments]


def piece_name(piece: int) -> str:
    """Return the name of the file of a piece."""
    return f"{piece:08}"


def copy(directory: str, copies: Sequence[Copy]) -> int:
    """Copy parts of pieces into the file `ASSEMBLED`; return the number of bytes copied.

    If possible, the operating system copies the data without passing them to Python.

    Raises
    ------
    OSError
    """
    folder = StateFolder(directory)
    target = folder.open(ASSEMBLED, os.O_WRONLY)
    try:
        for piece, group in groupby(copies, key=lambda part: part.piece):
            source = folder.open(piece_name(piece), os.O_RDONLY)
            try:
                for part in group:
                    _copy(source, target, part)
            finally:
                os.close(source)
    finally:
        os.close(target)
    return sum(part.length for part in copies)


def _copy(source: int, target: int, part: Copy) -> None:
    done = 0
    in_kernel = hasattr(os, "copy_file_range")
    while done < part.length:
        left = part.length - done
        ends = part.source + done, part.target + done
        if in_kernel:
            try:
                copied = os.copy_file_range(source, target, left, *ends)
            except OSError as error:
                if error.errno not in (errno.ENOSYS, errno.EXDEV, errno.EINVAL, errno.EOPNOTSUPP):
                    raise
                in_kernel = False
                continue
        else:
            copied = os.pwrite(target, os.pread(source, min(left, 8 * _BUFFER), ends[0]), ends[1])
        if not copied:
            raise OSError("a finished piece is shorter than it was")
        done += copied
