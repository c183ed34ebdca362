"""Points of a law, or a map over speed and torque, in a CSV file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product, repeat
from pathlib import Path
from typing import Literal

from vstatics.core.model.laws import LossUnit, MapLaw, PointLaw
from vstatics.core.readers.named import scalars
from vstatics.core.readers.named.csv_files import lines_of
from vstatics.core.readers.named.csv_rows import has_cells, numbered_rows
from vstatics.core.readers.named.headings import (
    SHAFT_COLUMNS,
    Heading,
    HeadingError,
    TableColumn,
    is_comment,
    read_headings,
    with_unit,
)
from vstatics.core.readers.named.si_units import measured

MOST_POINT_FILE_BYTES = 1_000_000
"""Maximum number of bytes of a file of points."""
Values = Literal["efficiency", "loss"]
_VALUES = {
    "efficiency": "an efficiency above 0 and up to 1 (100 % with the heading `efficiency [%]`)",
    "loss": "a loss of 0 or more",
}
_POWERS: Mapping[str, LossUnit] = {"W": "W", "kW": "kW"}
_LOSSES = {"W": 1.0, "kW": 1000.0, **dict.fromkeys(("N*m", "Nm", "N m", "N\u00b7m"), math.nan)}
"""Units of a loss, with factors to W; a torque has no factor."""
_LOSS_NAMES = ("power loss", "torque loss", "loss torque", "losses", "p loss")
_DRAG_NAMES = ("drag torque", "friction torque", "drag", "friction")
_SLIP_NAMES = ("slip", "slip speed")
"""Headings of the slip speed of a shift element."""
_MAP_NAMES = ("efficiency", "eta", "loss", "fuel", "fuel consumption", "fuel rate", "fuel flow")
"""Headings of maps. The torques in a file with such a heading are not drag torques."""
_COLUMNS = {
    "": (
        SHAFT_COLUMNS[0]._replace(
            aliases={**SHAFT_COLUMNS[0].aliases, **dict.fromkeys(_SLIP_NAMES, "")}
        ),
        SHAFT_COLUMNS[1]._replace(
            aliases={**SHAFT_COLUMNS[1].aliases, **dict.fromkeys(_DRAG_NAMES, "")}
        ),
    ),
    "efficiency": (
        *SHAFT_COLUMNS,
        TableColumn("efficiency", aliases={"eta": ""}, sizes={"": 1.0, "-": 1.0, "%": 0.01}),
    ),
    "loss": (
        *SHAFT_COLUMNS,
        TableColumn("loss", aliases=dict.fromkeys(_LOSS_NAMES, ""), sizes=_LOSSES),
    ),
}
_Row = tuple[int, list[float]]
"""Line number of a row, and its numbers in SI units, or in the unit of a loss."""


def points_of(name: str) -> PointLaw:
    """Read a drag torque over speed from a file of points.

    Raises
    ------
    OSError
        If the file cannot be read, or is too large.
    ValueError
        The message states the expected content.
    """
    heads, rows = _table(lines_of(Path(name), MOST_POINT_FILE_BYTES), "")
    before = -math.inf
    for line, (speed, torque) in rows:
        _expect_magnitude(heads, speed, line)
        if speed <= before:
            above = f"a speed above {_point(heads, before)}: points must ascend"
            raise ValueError(f"line {line}: read {_point(heads, speed)}, expected {above}")
        if torque < 0:
            read = _point(heads[1:], torque)
            raise ValueError(f"line {line}: read {read}, expected a torque of 0 or more")
        before = speed
    return PointLaw([numbers for _, numbers in rows])


def map_of(name: str, values: Values) -> MapLaw:
    """Read a map from a file with the points of a complete grid, in any order.

    Raises
    ------
    OSError
        If the file cannot be read, or is too large.
    ValueError
        The message states the expected content.
    """
    return _map(lines_of(Path(name), MOST_POINT_FILE_BYTES), values)


def _map(lines: Sequence[str], values: Values) -> MapLaw:
    """Return the map given by the lines of a file.

    Examples
    --------
    >>> lines = ["speed [rad/s],torque [N*m],efficiency [%]", "100,0,90", "100,50,95"]
    >>> _map([*lines, "200,50,97", "200,0,92"], "efficiency").rows
    ((100.0, 0.9, 0.95), (200.0, 0.92, 0.97))
    """
    heads, rows = _table(lines, values)
    points: dict[tuple[float, float], tuple[int, float]] = {}
    for line, (speed, torque, value) in rows:
        if (speed, torque) in points:
            first = points[speed, torque][0]
            message = f"line {line}: {_point(heads, speed, torque)} is on line {first}, too"
            raise ValueError(f"{message}; expected each point once")
        _expect_magnitude(heads, speed, line)
        if not (0 < value <= 1 if values == "efficiency" else value >= 0):
            hint = "; omit all rows with speed 0 or torque 0" if value == 0 else ""
            read = f"{value * 100:g} %" if heads[-1].unit == "%" else f"{value:g}"
            raise ValueError(f"line {line}: read {read}, expected {_VALUES[values]}{hint}")
        points[speed, torque] = line, value
    if heads[-1].unit == "%" and all(value <= 0.01 for _, value in points.values()):
        hint = "fractions need a heading without %, such as `efficiency`"
        raise ValueError(f"read no value above 1 %, expected percentages such as 95; {hint}")
    speeds, torques = (sorted({point[place] for point in points}) for place in (0, 1))
    for speed, torque in product(speeds, torques):
        if (speed, torque) not in points:
            where = _point(heads, speed, torque)
            raise ValueError(f"expected a full grid: there is no value at {where}")
    grid = [[speed, *(points[speed, torque][1] for torque in torques)] for speed in speeds]
    unit = _POWERS.get(heads[-1].unit or "", "N*m") if values == "loss" else ""
    return MapLaw(torques, grid, unit)


def _expect_magnitude(heads: Sequence[Heading], speed: float, line: int) -> None:
    if speed < 0:
        read = _point(heads, speed)
        raise ValueError(f"line {line}: read {read}, expected 0 or more: magnitudes count")


def _point(heads: Sequence[Heading], *values: float) -> str:
    """Return a point as text, with speed and torque in the units of the file."""
    both = zip(values, heads, strict=False)
    return ", ".join(f"{value / head.size:g} {head.unit}" for value, head in both)


def _table(lines: Sequence[str], values: Values | Literal[""]) -> tuple[list[Heading], list[_Row]]:
    """Return the headings of speed, torque and value, in this order, and the rows.

    Raises
    ------
    ValueError
        The message states the expected content.

    Examples
    --------
    >>> _table(["Torque,Oil,Speed", "N*m,C,rad/s", "2,90,0", "# end"], "")[1]
    [(3, [0.0, 2.0])]
    """
    columns = _COLUMNS[values]
    what = f"a CSV file with the headings `{','.join(column.heading for column in columns)}`"
    filled = (pair for pair in enumerate(lines, 1) if has_cells(pair[1]))
    try:
        head = read_headings(filled, what, columns, skips=True)
    except HeadingError as error:
        raise ValueError(f"line {error.line}: {error}") from None
    names = (with_unit(heading)[0].casefold() for heading in head.skipped if not values)
    if kind := next((name for name in names if name in _MAP_NAMES), ""):
        message = f"line {head.number}: read the heading {kind!r} of a map, expected {what}"
        raise ValueError(message)
    heads = sorted(head.headings, key=lambda heading: columns.index(heading.column))
    # A line of units can have fewer cells than the line of names above it.
    full = head.separator.join("x" * head.width)
    below = numbered_rows(chain(repeat("", head.last - 1), [full], lines[head.last :]))
    next(below)
    rows = [
        (line, list(_numbers(heads, row, line))) for line, row in below if not is_comment(row[0])
    ]
    if not rows:
        raise ValueError("expected a point at least, below the head")
    return heads, rows


def _numbers(heads: Sequence[Heading], row: Sequence[str], line: int) -> Iterator[float]:
    for column, place, unit in heads:
        if place >= len(row):
            raise ValueError(f"line {line}: expected {len(heads)} numbers")
        cell = row[place].strip().removesuffix(unit or "")  # cells can repeat the unit
        try:
            if column.measure:
                yield measured(f"{cell} {unit}", column.measure)
            else:
                yield scalars.number(cell + "%" * (unit == "%"))
        except ValueError as error:
            message = f"line {line}: {column.name}: read {row[place]!r}, {error}"
            raise ValueError(message) from None
