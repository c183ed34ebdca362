"""Schemes as lines of JSON, many at a time.

The lines are composed of common pieces of text. A JSON encoder would take ten times as long, which
is longer than the search for the schemes.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import permutations

import numpy as np

from vstatics.synthesis.structures.arrays import MEMBERS
from vstatics.synthesis.structures.growth import SchemeBatch, StructureSearch, matrices, ports

NO_PORTS = '{}"input": null, "output": null}}\n'
"""End of the line of a scheme without input and output."""
ZERO, TEN = np.uint8(ord("0")), np.uint8(10)


def lines(search: StructureSearch, batch: SchemeBatch) -> bytes:
    """Return a line of JSON for each scheme, or for each choice of input and output.

    Examples
    --------
    >>> from vstatics.synthesis.structures.growth import batches
    >>> search = StructureSearch(1, "members", ports=True)
    >>> [batch] = batches(search)
    >>> print(lines(search, batch).decode(), end="")
    {"code": "0-1-2", "links": 3, "input": 0, "output": 1}
    {"code": "0-1-2", "links": 3, "input": 0, "output": 2}
    {"code": "0-1-2", "links": 3, "input": 1, "output": 0}
    """
    if not (search.ports or search.matrix):
        return _without_ports(batch)
    base = int(batch.links.max(initial=0))
    members = batch.codes.reshape(len(batch.codes), -1, MEMBERS).astype(np.intp)
    keys = (members[..., 0] * base + members[..., 1]) * base + members[..., 2]
    texts = _set_texts(base)
    ends = [f'", "links": {links}, ' for links in range(base + 1)]
    heads = [
        '{"code": "' + "-".join([texts[key] for key in row]) + ends[links]
        for row, links in zip(keys.tolist(), batch.links.tolist(), strict=True)
    ]
    if search.matrix:
        pairs = zip(heads, matrices(batch), strict=True)
        heads = [f'{head}"matrix": {matrix}, ' for head, matrix in pairs]
    text = _with_ports(heads, batch) if search.ports else "".join(map(NO_PORTS.format, heads))
    return text.encode()


def _without_ports(batch: SchemeBatch) -> bytes:
    """Write all lines at once: each number has two characters, and blanks are removed."""
    places = "\0\0"
    code = "-".join([places] * batch.codes.shape[1])
    line = f'{{"code": "{code}", "links": {places}, "input": null, "output": null}}\n'
    text = np.frombuffer(line.encode(), np.uint8)
    tens, units = np.flatnonzero(text == 0).reshape(-1, 2).T
    numbers = np.column_stack([batch.codes, batch.links.astype(np.uint8)])
    rows = np.tile(text, (len(numbers), 1))
    rows[:, units] = ZERO + numbers % TEN
    rows[:, tens] = np.where(numbers < TEN, 0, ZERO + numbers // TEN)
    data: bytes = rows[rows != 0].tobytes()
    return data


def _with_ports(heads: Sequence[str], batch: SchemeBatch) -> str:
    """Write a line for each choice of input and output, from the text of the scheme."""
    choices = ports(batch)
    pairs = choices.input * int(batch.links.max()) + choices.output
    stops = np.cumsum(np.bincount(choices.which, minlength=len(heads))).tolist()
    parts = []
    start = 0
    for head, links, stop in zip(heads, batch.links.tolist(), stops, strict=True):
        if stop - start == links * (links - 1):
            ends = _all_ends(links)
        else:
            texts = _ends(int(batch.links.max()))
            ends = [texts[pair] for pair in pairs[start:stop].tolist()]
        parts.append(head + head.join(ends))
        start = stop
    return "".join(parts)


@cache
def _set_texts(base: int) -> list[str]:
    numbers = range(base)
    return [f"{a}-{b}-{c}" for a in numbers for b in numbers for c in numbers]


@cache
def _ends(base: int) -> list[str]:
    return [_end(first, last) for first in range(base) for last in range(base)]


@cache
def _all_ends(links: int) -> list[str]:
    return [_end(first, last) for first, last in permutations(range(links), 2)]


def _end(first: int, second: int) -> str:
    return f'"input": {first}, "output": {second}}}\n'
