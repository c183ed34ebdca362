"""Schemes one by one, for whoever needs no arrays."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.synthesis.structures import StructureSearch, batches, ports


class FoundScheme(NamedTuple):
    """A scheme, or a choice of its input and output."""

    code: str
    links: int
    """How many there are."""
    input: int | None
    """Links of the code; None where none are chosen."""
    output: int | None


def schemes(search: StructureSearch) -> Iterator[FoundScheme]:
    """All schemes that are asked for, in ascending order of their codes.

    Raises
    ------
    ValueError
        If there can be none such.

    Examples
    --------
    >>> for one in schemes(StructureSearch(2, "order")):
    ...     print(*one)
    0-1-2-0-1-3 4 None None
    0-1-2-0-3-4 5 None None
    >>> next(schemes(StructureSearch(2, ports=True)))
    FoundScheme(code='0-1-2-0-1-3', links=4, input=0, output=1)
    """
    for batch in batches(search):
        codes = ["-".join(map(str, row)) for row in batch.codes.tolist()]
        links = batch.links.tolist()
        if search.ports:
            for row, first, second in zip(*(one.tolist() for one in ports(batch)), strict=True):
                yield FoundScheme(codes[row], links[row], first, second)
        else:
            for code, count in zip(codes, links, strict=True):
                yield FoundScheme(code, count, None, None)
