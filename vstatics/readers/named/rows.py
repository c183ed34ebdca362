"""Lists of values in a fixed order, and points made of such rows."""

from __future__ import annotations

from typing import Any, Protocol

from vstatics.model.shape import ByPoints, RowOf, Shape
from vstatics.readers.named.nodes import Listing, Mapping, Spot, Spots, is_null


class ReadsShapes(Protocol):
    """What the walk does for a row."""

    spots: Spots

    def read(self, spot: Spot, shape: Shape) -> Any:
        """The value at a spot, or a stand-in after a problem."""

    def refuse(self, spot: Spot, shape: Shape, expected: object, read: str = "") -> Any:
        """A stand-in for what cannot be read, after the problem."""


def read_row(walk: ReadsShapes, spot: Spot, shape: RowOf) -> Any:
    """As many values as the row has."""
    node, count = spot.node, len(shape.items)
    if not isinstance(node, Listing) or len(node.items) != count:
        read = f"a list of {len(node.items)}" if isinstance(node, Listing) else ""
        return walk.refuse(spot, shape, f"expected {count} numbers: [{shape.kind}]", read)
    items = enumerate(zip(node.items, shape.items, strict=True), 1)
    return tuple(walk.read(spot.item(n, n, item), leaf) for n, (item, leaf) in items)


def read_points(walk: ReadsShapes, spot: Spot, shape: ByPoints) -> Any:
    """Rows in order; one number is a row at 0."""
    node, leaf = spot.node, shape.row.items[-1]
    if isinstance(node, Listing):
        if not node.items:
            return walk.refuse(spot, shape, f"expected points: [[{shape.row.kind}], ...]")
        items = enumerate(node.items, 1)
        return tuple(walk.read(spot.item(n, n, item), shape.row) for n, item in items)
    if isinstance(node, Mapping) or is_null(node):
        expected = f"expected a number, or points: [[{shape.row.kind}], ...]"
        return walk.refuse(spot, shape, expected)
    return ((0.0, walk.read(spot._replace(path=(*spot.path, 1, 2)), leaf)),)
