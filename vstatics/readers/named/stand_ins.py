"""What stands in for a value that cannot be read, so that reading goes on behind it."""

from __future__ import annotations

from typing import Any

from vstatics.model.shape import (
    ByKey,
    Either,
    Ends,
    Leaf,
    LeafKind,
    Links,
    ListOf,
    Pair,
    Shape,
)
from vstatics.readers.named.references import NO_ELEMENT, NO_LINK

_MANY_LINKS = 10**9  # takes every link number in; the model refuses it, and this is not told
_NO_LINKS = (NO_LINK, NO_LINK)
EXPECTED: dict[LeafKind, tuple[str, Any]] = {  # what is expected, what stands in for it
    "text": ("text", ""),
    "number": ("a number", 1.0),
    "count": ("a whole number", 1),
    "share": ("a share of 0 or more", 0.0),
    "speed": ("a speed with its unit", 1.0),
    "torque": ("a torque with its unit", 1.0),
    "relative_speed": ("a speed", 0.0),
    "relative_torque": ("a torque", 0.0),
    "link": ("a link", NO_LINK),
    "element": ("the name of a shift element", NO_ELEMENT),
    "flag": ("`true` or `false`", False),
    "choice": ("text", None),
}


def stand_in(shape: Shape) -> Any:  # noqa: PLR0911 - a table
    """What stands in for a value that cannot be read."""
    match shape:
        case Leaf():
            return shape.choices[0] if shape.choices else EXPECTED[shape.kind][1]
        case ByKey():
            return shape.make(**values_before(shape))
        case Either():
            return shape.record.make(links=_NO_LINKS)
        case Ends():
            return _NO_LINKS
        case Links():
            return _MANY_LINKS
        case ListOf():
            return ()
        case Pair():
            return ("", "")
    return {}


def values_before(shape: ByKey) -> dict[str, Any]:
    """The values of a record as far as they are known before it is read."""
    defaults = {key.name: key.default for key in shape.keys if key.default is not None}
    return {key.name: stand_in(key.shape) for key in shape.keys if key.required} | defaults
