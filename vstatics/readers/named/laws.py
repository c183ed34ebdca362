"""Laws of a case: points, efficiencies over speed or torque, points in a file beside the case."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any

from vstatics.errors import quoted
from vstatics.model.parts import Law
from vstatics.model.shape import ByLaw, Measure
from vstatics.readers.named.compounds import ReadsShapes
from vstatics.readers.named.nodes import Listing, Mapping, Spot

MOST_BYTES = 1_000_000
"""Of a file of points."""
_HEAD = re.compile(r"\s*(?P<name>speed|torque)\s*\[(?P<unit>[^\]]+)\]\s*")
_COLUMNS: tuple[tuple[str, Measure], ...] = (("speed", "si_speed"), ("torque", "si_torque"))


def read_law(walk: ReadsShapes, spot: Spot, shape: ByLaw) -> Any:
    """A number, or a law."""
    if isinstance(spot.node, Mapping):
        made = walk.read(spot, shape.mapping)
        if isinstance(made, Law):
            return made
        file = made.get("file")
        return _of_file(walk, spot, shape, file) if file else 0.0
    if isinstance(spot.node, Listing) and shape.row is not None:
        from vstatics.model.laws import PointLaw  # cases without laws do without

        if not spot.node.items:
            return walk.refuse(spot, shape, f"expected points: [[{shape.row.kind}], ...]")
        return PointLaw(walk.items(spot, spot.node.items, shape.row))
    return walk.read(spot, shape.scalar)


def _of_file(walk: ReadsShapes, spot: Spot, shape: ByLaw, name: str) -> Any:
    """The points of a file, whose name is relative to the folder of the case."""
    from vstatics.model.laws import PointLaw  # likewise

    path = Path(walk.spots.found.source.file).parent / name
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
        return PointLaw(_points(data))
    except OSError as error:
        why = error.strerror or str(error)
        return walk.refuse(spot, shape, f"which can't be read: {why}", quoted(name))
    except (ValueError, csv.Error) as error:
        return walk.refuse(spot, shape, error, quoted(name))


def _points(data: bytes) -> list[tuple[float, ...]]:
    """Rows of a CSV file with the columns `speed [unit],torque [unit]`.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> _points(b"speed [rad/s],torque [N*m]\\n0,2\\n300,3.5\\n")
    [(0.0, 2.0), (300.0, 3.5)]
    """
    from vstatics.readers.named.si_units import measured

    if len(data) > MOST_BYTES:
        raise ValueError(f"expected a file of {MOST_BYTES // 1000} kB at most")
    rows = list(csv.reader(io.StringIO(data.decode("utf-8-sig"))))
    heads = [_HEAD.fullmatch(head) for head in rows[0]] if rows else []
    names = [head["name"] for head in heads if head]
    if names != [name for name, _ in _COLUMNS] or len(names) != len(heads):
        raise ValueError("expected a CSV file with the head `speed [rad/s],torque [N*m]`")
    points = []
    for number, row in enumerate(rows[1:], 2):
        if not row:
            continue
        if len(row) != len(names):
            raise ValueError(f"line {number}: expected {len(names)} numbers")
        try:
            cells = zip(row, heads, _COLUMNS, strict=True)
            points.append(
                tuple(
                    measured(f"{cell} {head['unit']}", kind)
                    for cell, head, (_, kind) in cells
                    if head
                )
            )
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    if not points:
        raise ValueError("expected a point at least, below the head")
    return points
