"""NPZ: an uncompressed ZIP archive with a NumPy array for each column.

The data of pieces are copied unchanged into the archive, which `zipfile` cannot do. The size of
each member is known in advance, and its check sum follows from the check sums of its segments, one
from each piece. All sizes have 64 bits (ZIP64).

Reference: PKWARE, APPNOTE.TXT, .ZIP File Format Specification, 6.3; NumPy, `numpy.lib.format`.
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.jobs.piece_file import Account, Copy

_LOCAL = struct.Struct("<4s5H3L2H")
_LOCAL_SIZES = struct.Struct("<2H2Q")
_CENTRAL = struct.Struct("<4s6H3L5H2L")
_CENTRAL_SIZES = struct.Struct("<2H3Q")
_END_64 = struct.Struct("<4sQ2H2L4Q")
_END_64_PLACE = struct.Struct("<4sLQL")
_END = struct.Struct("<4s4H2LH")
_ZIP_VERSION = 45  # version 4.5 of the format introduced ZIP64
_UTF_8 = 0x800
_DAY_ONE = 0, 0x21  # midnight, 1 January 1980, so that equal data give equal archives
_ZIP64 = 0xFFFFFFFF
# Generator polynomial of CRC-32; the highest bit is the coefficient of x**0.
_POLYNOMIAL = 0xEDB88320


class ColumnType(NamedTuple):
    """Name and data type of a column of the output."""

    name: str
    dtype: np.dtype[Any]


class ArchiveLayout(NamedTuple):
    """Layout of an archive: headers with offsets, and the segments of pieces to be copied."""

    texts: list[tuple[int, bytes]]
    copies: list[Copy]
    length: int


def layout(
    columns: Sequence[ColumnType],
    accounts: Sequence[Account],
    codes: Mapping[str, Sequence[str]],
) -> ArchiveLayout:
    """Return the layout of an archive for the pieces of a sweep.

    Parameters
    ----------
    columns : sequence of ColumnType
        Columns, in the order of the segments within each piece.
    accounts : sequence of Account
        Sizes and check sums of all pieces, in order.
    codes : mapping of str to sequence of str
        Further members of the archive: the meanings of integers in the columns `status` and `gear`.
    """
    rows = sum(account.rows for account in accounts)
    texts: list[tuple[int, bytes]] = []
    copies: list[Copy] = []
    central: list[bytes] = []
    place = 0
    starts = [0] * len(accounts)  # offset of the next column in each piece
    members = [
        (column.name, _array_head(column.dtype, rows), [a.segments[index] for a in accounts])
        for index, column in enumerate(columns)
    ]
    for name, words in codes.items():
        file = io.BytesIO()
        np.lib.format.write_array(file, np.array(words))
        members.append((name, file.getvalue(), []))
    for name, text, segments in members:
        crc = zlib.crc32(text)
        for segment in segments:
            crc = combined_crc(crc, segment.crc, segment.length)
        size = len(text) + sum(segment.length for segment in segments)
        local, entry = _heads(f"{name}.npy", crc, size, place)
        central.append(entry)
        texts.append((place, local + text))
        place += len(local) + len(text)
        for number, segment in enumerate(segments):
            copies.append(Copy(accounts[number].piece, starts[number], place, segment.length))
            starts[number] += segment.length
            place += segment.length
    end = _end(central, place)
    texts.append((place, end))
    return ArchiveLayout(texts, copies, place + len(end))


def _array_head(dtype: np.dtype[Any], rows: int) -> bytes:
    head = io.BytesIO()
    described = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False}
    np.lib.format.write_array_header_1_0(head, {**described, "shape": (rows,)})
    return head.getvalue()


def _heads(name: str, crc: int, size: int, place: int) -> tuple[bytes, bytes]:
    """Return both headers of a member: the local header and the central directory entry."""
    text = name.encode()
    sizes = _LOCAL_SIZES.pack(1, 16, size, size)
    common = _ZIP_VERSION, _UTF_8, 0, *_DAY_ONE, crc, _ZIP64, _ZIP64, len(text)
    local = _LOCAL.pack(b"PK\3\4", *common, len(sizes)) + text + sizes
    sizes = _CENTRAL_SIZES.pack(1, 24, size, size, place)
    entry = _CENTRAL.pack(b"PK\1\2", _ZIP_VERSION, *common, len(sizes), 0, 0, 0, 0, _ZIP64)
    return local, entry + text + sizes


def _end(entries: Sequence[bytes], place: int) -> bytes:
    central = b"".join(entries)
    count = len(entries)
    end_64 = _END_64.pack(
        b"PK\6\6", 44, _ZIP_VERSION, _ZIP_VERSION, 0, 0, count, count, len(central), place
    )
    where = _END_64_PLACE.pack(b"PK\6\7", 0, place + len(central), 1)
    return central + end_64 + where + _END.pack(b"PK\5\6", 0, 0, *[0xFFFF] * 2, _ZIP64, _ZIP64, 0)


def combined_crc(first: int, second: int, length: int) -> int:
    """Return the CRC-32 of two consecutive pieces of data from the CRC-32 of each.

    The second piece has `length` bytes. As in zlib's `crc32_combine`, which Python lacks, the first
    check sum is multiplied by ``x**(8*length)``, which appends `length` zero bytes, and the second
    is added.

    >>> import zlib
    >>> combined_crc(zlib.crc32(b"kinematic "), zlib.crc32(b"scheme"), 6) == zlib.crc32(
    ...     b"kinematic scheme")
    True
    """
    power = 0
    while length:
        if length & 1:
            first = _times(_zeros(power), first)
        length >>= 1
        power += 1
    return first ^ second


@cache
def _zeros(power: int) -> int:
    """Return the polynomial ``x**(8 * 2**power)``, which appends 2**power zero bytes."""
    return _times(_zeros(power - 1), _zeros(power - 1)) if power else 1 << 23


def _times(left: int, right: int) -> int:
    """Multiply two polynomials over GF(2), modulo the polynomial of CRC-32."""
    product = 0
    while left:
        if left >> 31:
            product ^= right
        left = left << 1 & 0xFFFFFFFF
        right = right >> 1 ^ (_POLYNOMIAL if right & 1 else 0)
    return product
