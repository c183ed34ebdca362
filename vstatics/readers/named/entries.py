"""The entries of a mapping: keys with their values, without those that a case cannot have."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.errors import quoted, spoken
from vstatics.model.shape import KeyShape
from vstatics.readers.named.nodes import Mapping, Node, Scalar, Spot, Spots, is_null, shown

NO_MERGE = "merge key `<<` is not taken, write its keys out"


def entries(spots: Spots, spot: Spot) -> Iterator[tuple[Scalar, Node]]:
    """The entries of the mapping at a spot; problems are told of what is left out."""
    assert isinstance(spot.node, Mapping)  # noqa: S101 - for mypy
    seen: dict[str, Scalar] = {}
    for key, value in spot.node.entries:
        if is_merge(key):
            spots.complain(spot, NO_MERGE, key)
        elif is_null(key) or not key.text:
            spots.complain(spot, "an empty key, expected a name", key)
        elif key.text in seen:
            first = seen[key.text]
            message = f"key `{shown(key.text)}` is given twice"
            other = f"the first is on line {first.line}, column {first.column}"
            spots.complain(spot, f"{message}, {other}", key)
        else:
            seen[key.text] = key
            yield key, value


def known_entries(spots: Spots, spot: Spot, keys: Sequence[KeyShape]) -> dict[str, Node]:
    """The values by declared keys; an optional key without a value is not given.

    A mistyped key is read as what was meant, so that one slip brings no others.
    """
    known = {key.name: key for key in keys}
    given: dict[str, Node] = {}
    meant: dict[str, Node] = {}
    for key, value in entries(spots, spot):
        if key.text not in known:
            hint = spots.found.hint(key.text, known)
            expected = hint or f", expected {spoken(map(quoted, known))}"
            if key.text.isdigit():
                expected = "; write a decimal point, not a decimal comma"
            spots.complain(spot, f"unknown key `{shown(key.text)}`{expected}", key)
            meant.update((name, value) for name in known if f"`{name}`" in hint)
        elif known[key.text].required or not is_null(value):
            given[key.text] = value
    return meant | given


def is_merge(key: Scalar) -> bool:
    """Whether it is the `<<` of YAML, which merges a mapping into another."""
    return key.plain and key.text == "<<"
