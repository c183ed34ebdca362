"""Readers of laws in a case: points, maps, and files with points or a map."""

from __future__ import annotations

import os
from typing import Any

from vstatics.core.errors import quoted
from vstatics.core.model.parts import BatteryBalance, Law
from vstatics.core.model.shape import Balances, ByLaw, Leaf
from vstatics.core.readers.named.compounds import ReadsShapes
from vstatics.core.readers.named.leaves import stand_in
from vstatics.core.readers.named.nodes import Listing, Mapping, Spot


def read_law(walk: ReadsShapes, spot: Spot, shape: ByLaw) -> Any:
    """Read a number or a law."""
    if isinstance(spot.node, Mapping):
        law = walk.read(spot, shape.mapping)
        if isinstance(law, Law):
            return law
        file = law.get("file")
        return _of_file(walk, spot, shape, file) if file else stand_in(shape)
    if isinstance(spot.node, Listing) and shape.row is not None:
        from vstatics.core.model.laws import PointLaw  # needed by few cases

        if not spot.node.items:
            return walk.refuse(spot, shape, f"expected points: [[{shape.row.kind}], ...]")
        return PointLaw(walk.items(spot, spot.node.items, shape.row))
    if shape.scalar is None:
        return walk.refuse(spot, shape, "expected a mapping with `over`, `columns` and `rows`")
    return walk.read(spot, shape.scalar)


def _of_file(walk: ReadsShapes, spot: Spot, shape: ByLaw, name: str) -> Any:
    """Read the points or the map of a file, whose name is relative to the folder of the case."""
    from vstatics.core.readers.named.point_files import map_of, points_of  # needed by few cases

    path = os.path.join(os.path.dirname(walk.spots.document.source.file), name)  # noqa: PTH118 PTH120
    law: Law
    try:
        law = map_of(path, shape.values) if shape.values else points_of(path)
    except OSError as error:
        why = error.strerror or str(error)
        return walk.refuse(spot, shape, f"which cannot be read: {why}", quoted(name), "E006")
    except ValueError as error:
        return walk.refuse(spot, shape, error, quoted(name), "E121")
    law.file = path
    return law


def read_balance(walk: ReadsShapes, spot: Spot, shape: Balances) -> Any:
    """Read a battery balance: efficiencies of machines by link, and the power of the battery."""
    node = spot.node
    if not isinstance(node, Mapping):
        return walk.refuse(spot, shape, "expected a mapping: an efficiency for each link")
    battery = 0.0
    for key, value in node.entries:
        if key.text == shape.power:
            battery = walk.read(spot.key(shape.power, shape.power, value), Leaf("power"))
    others = [entry for entry in node.entries if entry[0].text != shape.power]
    numbers = walk.read(spot._replace(node=node._replace(entries=others)), shape.links)
    return BatteryBalance(tuple(numbers.items()), battery)
