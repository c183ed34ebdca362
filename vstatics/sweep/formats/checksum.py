"""The CRC-32 of two stretches one behind the other, from those of each."""

from __future__ import annotations

from functools import cache

_POLYNOMIAL = 0xEDB88320
Matrix = tuple[int, ...]
"""32 columns over the field of two numbers, as bits."""


def combined(first: int, second: int, length: int) -> int:
    """The CRC-32 of two stretches of data, the second of `length` bytes.

    As `crc32_combine` of zlib, which Python does not offer: the first sum is carried
    through `length` zero bytes, and then the second is added.

    >>> import zlib
    >>> combined(zlib.crc32(b"kinematic "), zlib.crc32(b"scheme"), 6) == zlib.crc32(
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
def _zeros(power: int) -> Matrix:
    """What 2**power zero bytes do to a sum."""
    if power:
        half = _zeros(power - 1)
        return tuple(_times(half, column) for column in half)
    bit: Matrix = (_POLYNOMIAL, *(1 << place for place in range(31)))
    for _ in range(3):
        bit = tuple(_times(bit, column) for column in bit)
    return bit


def _times(matrix: Matrix, vector: int) -> int:
    total = 0
    for column in matrix:
        if not vector:
            break
        if vector & 1:
            total ^= column
        vector >>= 1
    return total
