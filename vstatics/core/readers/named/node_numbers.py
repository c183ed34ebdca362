"""Functions that find, read and replace numbers in the nodes of a document, by path."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.errors import quoted, spoken, typed_number
from vstatics.core.model.paths import NoValueError, PathPart, written
from vstatics.core.readers.named.arithmetic import calculated, dimensionless
from vstatics.core.readers.named.nodes import Listing, Mapping, Node, Scalar, is_null, what
from vstatics.core.suggestions import nearest

MOST_KNOWN = 12
"""Maximum number of names listed in a message about an unknown name."""

_CALL = re.compile(r"[^\W\d]\w*\s*\(")
_SIGNS = ("*", "+", "-", "^")
"""Signs after a number that belong to a formula, not to a unit."""


def keys_of(node: Node) -> list[str]:
    """Return the keys, or numbers of items, of a node."""
    match node:
        case Mapping():
            return list(dict.fromkeys(key.text for key, _ in node.entries))
        case Listing():
            return [str(number) for number in range(1, len(node.items) + 1)]
    return []


def child(node: Node, key: str) -> Node | None:
    """Return the node under a key or item number; None if it is missing."""
    match node:
        case Mapping():
            return next((value for name, value in node.entries if name.text == key), None)
        case Listing():
            number = typed_number(key, len(node.items))
            return None if number is None else node.items[number - 1]
    return None


def find_node(root: Node, parts: Sequence[PathPart]) -> Node | None:
    """Return the node at a path; None if a mapping lacks only the last key.

    Raises
    ------
    NoValueError
        If another key is missing. The message names the most similar key.
    """
    node = root
    for number, part in enumerate(parts):
        below = child(node, part.name)
        if below is None:
            before = written([part.name for part in parts[:number]])
            last = number == len(parts) - 1
            if last and isinstance(node, Mapping):
                return None
            raise NoValueError(_missing(node, part.name, before), part.at)
        node = below
    return node


def _missing(node: Node, name: str, before: str) -> str:
    """Return the message that a node has no key `name`."""
    known = keys_of(node)
    of = f" in {quoted(before)}" if before else ""
    match node:
        case Mapping():
            more = f", ... ({len(known)})" if len(known) > MOST_KNOWN else ""
            expected = spoken(map(quoted, known[:MOST_KNOWN]), "or") + more if known else "nothing"
            return f"there is no {quoted(name)}{of}, expected {expected}{nearest(name, known)}"
        case Listing():
            expected = f"the number of an item, 1 to {len(known)}" if known else "nothing"
            return f"read {quoted(name)}, expected {expected}: {quoted(before)} is a list"
    return f"read {quoted(name)}, but {quoted(before)} is {what(node)}, with nothing below it"


class WrittenNumber(NamedTuple):
    """Number as written in a document, with the unit, if any."""

    value: float
    unit: str


def number_of(node: Node) -> WrittenNumber:
    """Return the number in a node.

    Raises
    ------
    ValueError
        If the node contains no number; the message describes the node.

    Examples
    --------
    >>> number_of(Scalar("1.2*600 rpm", 1, 1))
    WrittenNumber(value=720.0, unit='rpm')
    """
    if isinstance(node, Mapping | Listing):
        raise ValueError(f"is {what(node)}: name a number in it")  # noqa: TRY004 (a value of the document)
    if is_null(node):
        raise ValueError("is nothing, expected a number")
    try:
        value, behind = calculated(node.text)
    except ValueError:
        raise ValueError(f"is {what(node)}, expected a number") from None
    if behind[:1] in _SIGNS or _CALL.search(behind):
        raise ValueError(f"is a formula, {what(node)}, expected a number")
    if behind[:1] in ("%", ":"):
        return WrittenNumber(dimensionless(node.text), "")
    return WrittenNumber(value, behind)


def number_text(value: float, unit: str = "") -> str:
    """Return a number as text for a document; whole numbers have no point.

    >>> number_text(42.0), number_text(0.1, "rpm")
    ('42', '0.1 rpm')
    """
    whole = abs(value) < 2**53 and value == int(value)
    text = str(int(value)) if whole else repr(float(value))
    return f"{text} {unit}" if unit else text


def replaced(node: Node, keys: Sequence[str], text: str) -> Node:
    """Return a copy of a tree with a new text at a path. A missing last key is appended.

    Parameters
    ----------
    node : Node
    keys : sequence of str
        Path to a value of the tree, or to a missing key of a mapping.
    text : str

    Examples
    --------
    >>> tree = Mapping([(Scalar("at", 1, 1), Scalar("2", 1, 5))], 1, 1)
    >>> replaced(tree, ["at"], "3").entries[0][1].text
    '3'
    >>> len(replaced(tree, ["overlap"], "0.1").entries)
    2
    """
    if not keys:
        return Scalar(text, node.line, node.column)
    first, *others = keys
    if isinstance(node, Listing):
        items = list(node.items)
        place = int(first) - 1
        items[place] = replaced(items[place], others, text)
        return node._replace(items=items)
    assert isinstance(node, Mapping)  # noqa: S101 (`find_node` found the path)
    entries = list(node.entries)
    for place, (key, value) in enumerate(entries):
        if key.text == first:
            entries[place] = key, replaced(value, others, text)
            return node._replace(entries=entries)
    key = Scalar(first, node.line, node.column)
    return node._replace(entries=[*entries, (key, Scalar(text, node.line, node.column))])
