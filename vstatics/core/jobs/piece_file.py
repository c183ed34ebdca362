"""A finished piece of a sweep as a file.

It is written under another name and then renamed: it is whole or absent. Its data come
first, so that they can be copied into the output as they are, then an account of them in
JSON, with their check sums, and the length and the check sum of the account.
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
"""The file that becomes the output."""
_END = struct.Struct("<QL8s")
_MAGIC = b"vstpiece"
_BUFFER = 2**20


class Segment(NamedTuple):
    """A part of the data of a piece: a column of numbers, or all its text."""

    length: int
    crc: int


class Noticed(NamedTuple):
    """A message that variants have alike, but for numbers in its text."""

    id: str
    text: str
    """That of the first variant."""
    first: int
    """The number of that variant."""
    variants: int
    """How many have it."""

    @property
    def alike(self) -> tuple[str, str]:
        """Equal of messages that differ in numbers alone."""
        return self.id, _NUMBER.sub("0", self.text)


_NUMBER = re.compile(r"(?<![\w.])-?\d+(\.\d+)?(e[+-]?\d+)?(?!\w)")
"""In a message; the digits of a name such as C1 are none."""


class Account(NamedTuple):
    """What a finished piece holds."""

    piece: int
    rows: int
    counts: dict[str, int]
    """How many variants have a status, those without a row too."""
    segments: tuple[Segment, ...]
    removed: tuple[int, ...] = ()
    """How many of those that are left each part of a condition removed."""
    outside: tuple[str, ...] = ()
    """What was asked outside its points."""
    noticed: tuple[Noticed, ...] = ()
    """Messages of the variants."""
    work: str = ""
    """Hash of the definition of the work of which it is a piece."""

    @property
    def variants(self) -> int:
        """All variants of the piece."""
        return sum(self.counts.values())

    @property
    def length(self) -> int:
        """Bytes of the data."""
        return sum(segment.length for segment in self.segments)


class Copy(NamedTuple):
    """A part of a piece, and where it goes."""

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
    work: str = "",
) -> tuple[Account, list[Any]]:
    """A finished piece as buffers to write one behind the other.

    Parameters
    ----------
    piece, rows : int
    counts : dict
        See `Account`.
    data : sequence of bytes-like
        A segment each.
    removed, outside, noticed : tuple
    work : str
        See `Account`.
    """
    segments = tuple(Segment(memoryview(one).nbytes, zlib.crc32(one)) for one in data)
    account = Account(piece, rows, counts, segments, removed, outside, noticed, work)
    text = json.dumps(account._asdict()).encode()
    return account, [*data, text, _END.pack(len(text), zlib.crc32(text), _MAGIC)]


def write_piece(directory: str, piece: int, buffers: Sequence[Any]) -> None:
    """Write a piece, whole or not at all.

    Raises
    ------
    OSError
    """
    with StateFolder(directory).replacing(piece_name(piece)) as write:
        for buffer in buffers:
            write(memoryview(buffer).cast("B"))


def read_account(directory: str, piece: int, work: str = "") -> Account | None:
    """The account of a piece, if it is there and its data are what this work wrote."""
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
            fields["noticed"] = tuple(Noticed(*one) for one in fields["noticed"])
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


def piece_path(directory: str, piece: int) -> str:
    """Return the path of the file of a piece."""
    return StateFolder(directory).file(piece_name(piece))


def copy(directory: str, copies: Sequence[Copy]) -> int:
    """Copy parts of pieces into the file that becomes the output; how many bytes.

    The kernel does it where it can.

    Raises
    ------
    OSError
    """
    folder = StateFolder(directory)
    target = folder.open(ASSEMBLED, os.O_WRONLY)
    try:
        for piece, group in groupby(copies, key=lambda one: one.piece):
            source = folder.open(piece_name(piece), os.O_RDONLY)
            try:
                for one in group:
                    _copy(source, target, one)
            finally:
                os.close(source)
    finally:
        os.close(target)
    return sum(one.length for one in copies)


def _copy(source: int, target: int, one: Copy) -> None:
    done = 0
    in_kernel = hasattr(os, "copy_file_range")
    while done < one.length:
        left = one.length - done
        ends = one.source + done, one.target + done
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
