"""Replacement of numbers in the text of a document.

Comments, blanks, line endings and units remain unchanged.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.model.paths import Keys, dotted
from vstatics.core.readers.named.node_numbers import number_of, number_text
from vstatics.core.readers.named.nodes import BYTE_ORDER_MARKS, Listing, Node, Scalar, text_of
from vstatics.core.readers.named.nodes import Mapping as MappingNode

_ENDS = re.compile(r"\r\n|\r|\n")
_PROPERTIES = re.compile(r"(?:[&!][^\s,\[\]{}]*\s+)*")
"""Pattern of an anchor or a tag, which can precede a value in YAML."""


class NumberSpot(NamedTuple):
    """Number of a document, with its start and end in the text."""

    value: float
    unit: str
    start: int
    end: int


def number_spots(text: str, root: Node) -> dict[Keys, NumberSpot]:
    r"""Return the numbers of a document with places in the text, by path.

    Numbers that are written with escape sequences or on several lines are omitted.

    Parameters
    ----------
    text : str
        Text with its original line endings.
    root : Node
        Nodes of this text.

    Examples
    --------
    >>> from vstatics.core.readers.named.nodes import decode
    >>> from vstatics.core.readers.named.yaml_nodes import yaml_tree
    >>> text = "load:\r\n  speed: 2*500 rpm # fast\r\n"
    >>> number_spots(text, yaml_tree(decode(text.encode(), "a.yaml")))
    {('load', 'speed'): NumberSpot(value=1000.0, unit='rpm', start=16, end=21)}
    """
    starts = [0, *(ending.end() for ending in _ENDS.finditer(text))]
    spots = {}
    for keys, node in _scalars(root, ()):
        try:
            value, unit = number_of(node)
        except ValueError:
            continue
        at = starts[node.line - 1] + node.column - 1
        match = _PROPERTIES.match(text, at)
        at = match.end() if match else at
        at += not node.plain and text[at : at + 1] in ("'", '"')
        # The start of a value with escape sequences is -1.
        start = at if node.text and text.startswith(node.text, at) else -1
        end = start + len(node.text.rstrip().removesuffix(unit).rstrip())
        if start >= 0:
            spots[keys] = NumberSpot(value, unit, start, end)
    return spots


def _scalars(node: Node, keys: Keys) -> Iterator[tuple[Keys, Scalar]]:
    match node:
        case Scalar():
            yield keys, node
        case Listing(items=items):
            for number, value in enumerate(items, 1):
                yield from _scalars(value, (*keys, str(number)))
        case MappingNode(entries=entries):
            for key, value in entries:
                yield from _scalars(value, (*keys, key.text))


def with_written(
    data: bytes, spots: Mapping[Keys, NumberSpot], values: Mapping[Keys, float]
) -> bytes:
    """Return the text of a document with new numbers. Equal numbers stay as written.

    Parameters
    ----------
    data : bytes
        The document.
    spots : mapping
        Numbers of the document, from `number_spots`.
    values : mapping of Keys to float
        New values, in the units written after the numbers.

    Raises
    ------
    ValueError
        If a number has two paths because of an alias, and `values` contains two different values.

    Examples
    --------
    >>> spots = {("speed",): NumberSpot(1000.0, "rpm", 7, 12)}
    >>> with_written(b"speed: 2*500 rpm # fast", spots, {("speed",): 1200.0})
    b'speed: 1200 rpm # fast'
    """
    text = text_of(data)
    changed: dict[int, tuple[int, str]] = {}
    for keys, value in values.items():
        spot = spots[keys]
        new = text[spot.start : spot.end] if value == spot.value else number_text(value)
        if changed.setdefault(spot.start, (spot.end, new)) != (spot.end, new):
            raise ValueError(f"{dotted(keys)} appears where another number appears, too")
    for start in sorted(changed, reverse=True):
        end, new = changed[start]
        text = text[:start] + new + text[end:]
    mark, encoding = next(
        ((mark, encoding) for mark, _, encoding in BYTE_ORDER_MARKS if data.startswith(mark)),
        (b"", "utf-8"),
    )
    return mark + text.encode(encoding)
