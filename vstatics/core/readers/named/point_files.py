"""Points of a law in a CSV file."""

from __future__ import annotations

from pathlib import Path

from vstatics.core.model.shape import Measure
from vstatics.core.readers.named.csv_files import csv_rows
from vstatics.core.readers.named.headings import with_unit
from vstatics.core.readers.named.si_units import measured

MOST_POINT_FILE_BYTES = 1_000_000
"""Maximum number of bytes of a file of points."""
_COLUMNS: tuple[tuple[str, Measure], ...] = (("speed", "si_speed"), ("torque", "si_torque"))


def points_of(name: str) -> list[tuple[float, ...]]:
    """Read the points of a file.

    Raises
    ------
    OSError
        If the file cannot be read, or is too large.
    ValueError
        With the expected content.
    """
    return _points(csv_rows(Path(name), MOST_POINT_FILE_BYTES, lambda cell: _name(cell) == "speed"))


def _name(heading: str) -> str:
    return with_unit(heading)[0].casefold()


def _points(rows: list[tuple[int, list[str]]]) -> list[tuple[float, ...]]:
    """Read points from rows with the columns `speed [unit],torque [unit]`.

    Raises
    ------
    ValueError
        With the expected content.

    Examples
    --------
    >>> _points([(1, ["speed [rad/s]", "torque [N*m]"]), (2, ["0", "2"]), (3, ["300", "3.5"])])
    [(0.0, 2.0), (300.0, 3.5)]
    """
    heads = rows[0][1] if rows else []
    units = [unit for _, unit in map(with_unit, heads) if unit]
    if list(map(_name, heads)) != [name for name, _ in _COLUMNS] or len(units) != len(heads):
        raise ValueError("expected a CSV file with the head `speed [rad/s],torque [N*m]`")
    for unit, (name, kind) in zip(units, _COLUMNS, strict=True):
        try:
            measured(f"1 {unit}", kind)
        except ValueError as error:
            raise ValueError(f"line 1: the unit of {name}: {error}") from None
    points = []
    for number, row in rows[1:]:
        if len(row) != len(units):
            raise ValueError(f"line {number}: expected {len(units)} numbers")
        try:
            cells = zip(row, units, _COLUMNS, strict=True)
            points.append(
                tuple(measured(f"{cell} {unit}", kind) for cell, unit, (_, kind) in cells)
            )
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    if not points:
        raise ValueError("expected a point at least, below the head")
    return points
