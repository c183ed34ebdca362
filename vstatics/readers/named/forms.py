"""Values that a room reads itself, and values that may stand in several forms."""

from __future__ import annotations

from typing import Any

from vstatics.errors import ReadError
from vstatics.model.shape import ByForm, OneOrMany, Parsed
from vstatics.readers.named.nodes import Listing, Mapping, Scalar, Spot, is_null
from vstatics.readers.named.rows import ReadsShapes


def read_parsed(walk: ReadsShapes, spot: Spot, shape: Parsed) -> Any:
    """What a room makes of a text."""
    node = spot.node
    if not isinstance(node, Scalar) or is_null(node):
        return walk.refuse(spot, shape, f"expected {shape.expected}")
    try:
        return shape.parse(node.text)
    except ReadError as error:
        for problem in error.problems:
            offset = problem.place.column - 1 if problem.place else 0
            walk.spots.complain(spot, problem.message, _further(walk, node, offset))
        walk.spots.unreadable.append(spot.path)
        return shape.stand_in
    except ValueError as error:
        return walk.refuse(spot, shape, error)


def _further(walk: ReadsShapes, node: Scalar, offset: int) -> Scalar:
    """The place of an offset into a text, if that stands letter by letter in one line."""
    line = walk.spots.found.source.place(node.line).text
    begin = node.column - 1 + (line[node.column - 1 : node.column] in ("'", '"'))
    as_written = line.startswith(node.text, begin)
    return node._replace(column=begin + offset + 1) if as_written else node


def read_form(walk: ReadsShapes, spot: Spot, shape: ByForm) -> Any:
    """A single value, a list or a mapping."""
    if isinstance(spot.node, Listing):
        return walk.read(spot, shape.listing)
    if isinstance(spot.node, Mapping) and shape.mapping:
        return walk.read(spot, shape.mapping)
    if isinstance(spot.node, Scalar) and not is_null(spot.node):
        return walk.read(spot, shape.scalar)
    return walk.refuse(spot, shape, f"expected {shape.expected}")


def read_one_or_many(walk: ReadsShapes, spot: Spot, shape: OneOrMany) -> Any:
    """A list of items, of one where it stands alone."""
    node = spot.node
    if not isinstance(node, Listing) or all(map(_is_row, node.items)):
        return [walk.read(spot, shape.item)]
    items = enumerate(node.items, 1)
    return [walk.read(spot.item(number, number, item), shape.item) for number, item in items]


def _is_row(node: object) -> bool:
    """Whether it is a list of single values, as a point is."""
    return isinstance(node, Listing) and all(isinstance(item, Scalar) for item in node.items)
