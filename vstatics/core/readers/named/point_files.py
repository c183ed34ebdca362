"""Points of a law, or a map over speed and torque, in a CSV file."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import product, zip_longest
from pathlib import Path
from typing import Literal

from vstatics.core.errors import spoken
from vstatics.core.model.laws import LossUnit, MapLaw
from vstatics.core.model.shape import Measure
from vstatics.core.readers.named import scalars
from vstatics.core.readers.named.csv_files import csv_rows
from vstatics.core.readers.named.headings import (
    COMMENT_SIGNS,
    MOST_QUOTED,
    SHAFT_NAMES,
    with_unit,
    without_sign,
)
from vstatics.core.readers.named.si_units import measured

MOST_POINT_FILE_BYTES = 1_000_000
"""Maximum number of bytes of a file of points."""
Values = Literal["efficiency", "loss"]
_MEASURES: Mapping[str, Measure] = {"speed": "si_speed", "torque": "si_torque"}
_VALUES = {
    "efficiency": "an efficiency above 0 and up to 1 (100 % with the heading `efficiency [%]`)",
    "loss": "a loss of 0 or more",
}
_LOSS_UNITS: tuple[LossUnit, ...] = ("W", "kW", "N*m")
_HEADS = {
    "": "speed [rad/s],torque [N*m]",
    "efficiency": "speed [rpm],torque [N*m],efficiency",
    "loss": "speed [rpm],torque [N*m],loss [W]",
}
_NAMES = {name: column for column, names in SHAFT_NAMES.items() for name in names} | {
    "eta": "efficiency",
    "power loss": "loss",
}
_Rows = list[tuple[int, list[str]]]
_Reading = Callable[[str], float]


def points_of(name: str) -> list[tuple[float, ...]]:
    """Read the points in a file, in SI units.

    Raises
    ------
    OSError
        If the file cannot be read, or is too large.
    ValueError
        The message states the expected content.
    """
    return _points(_rows_of(name, ""))


def map_of(name: str, values: Values) -> MapLaw:
    """Read a map from a file with the points of a complete grid, in any order.

    Raises
    ------
    OSError
        If the file cannot be read, or is too large.
    ValueError
        The message states the expected content.
    """
    return _map(_rows_of(name, values), values)


def _rows_of(name: str, values: Values | Literal[""]) -> _Rows:
    """Return the wanted columns of a file, in the order of `_HEADS`; the first row has headings.

    Raises
    ------
    OSError
    ValueError
    """
    rows = csv_rows(Path(name), MOST_POINT_FILE_BYTES, lambda cell: _name(cell) in _MEASURES)
    if not rows:
        raise _expected(values, [])
    return _wanted(rows, values)


def _wanted(rows: _Rows, values: Values | Literal[""]) -> _Rows:
    """Return rows without comments and other columns, and with the units in the headings.

    >>> rows = [(1, ["Torque", "Oil", "Speed"]), (2, ["N*m", "C", "rpm"]), (3, ["2", "90", "0"])]
    >>> _wanted([*rows, (4, ["# end"])], "")
    [(1, ['Speed [rpm]', 'Torque [N*m]']), (3, ['0', '2'])]
    """
    (line, heads), *below = (row for row in rows if row is rows[0] or not _is_comment(row[1]))
    if below and not any(sign.isdigit() for cell in below[0][1] for sign in cell):
        units = below.pop(0)[1]
        both = zip_longest(heads, units, fillvalue="")
        heads = [f"{head} [{unit.strip('[]() ')}]" if unit else head for head, unit in both]
    names = list(map(_name, heads))
    wanted = [*_MEASURES, values] if values else [*_MEASURES]
    if any(names.count(name) != 1 for name in wanted):
        raise _expected(values, heads)
    places = [names.index(name) for name in wanted]
    return [
        (line, [row[place] for place in places if place < len(row)])
        for line, row in [(line, heads), *below]
    ]


def _is_comment(row: Sequence[str]) -> bool:
    return row[0].lstrip().startswith(COMMENT_SIGNS)


def _name(heading: str) -> str:
    name = with_unit(without_sign(heading))[0].casefold()
    return _NAMES.get(name, name)


def _points(rows: _Rows) -> list[tuple[float, ...]]:
    """Read points from rows with the columns `speed [unit],torque [unit]`.

    Raises
    ------
    ValueError
        The message states the expected content.

    Examples
    --------
    >>> _points([(1, ["speed [rad/s]", "torque [N*m]"]), (2, ["0", "2"]), (3, ["300", "3.5"])])
    [(0.0, 2.0), (300.0, 3.5)]
    """
    return [point for _, point in _numbers(rows, "")]


def _map(rows: _Rows, values: Values) -> MapLaw:
    """Return the map given by the rows of a file.

    Examples
    --------
    >>> grid = [["100", "0", "90"], ["100", "50", "95"], ["200", "50", "97"], ["200", "0", "92"]]
    >>> head = (1, ["speed [rad/s]", "torque [N*m]", "efficiency [%]"])
    >>> _map([head, *enumerate(grid, 2)], "efficiency").rows
    ((100.0, 0.9, 0.95), (200.0, 0.92, 0.97))
    """
    heads = rows[0][1]
    points: dict[tuple[float, float], tuple[int, float]] = {}
    units = [with_unit(head)[1] or "" for head in heads[:2]]
    for line, (speed, torque, value) in _numbers(rows, values):
        if (speed, torque) in points:
            first = points[speed, torque][0]
            message = f"line {line}: {_point(units, speed, torque)} is on line {first}, too"
            raise ValueError(f"{message}; expected each point once")
        if not (0 < value <= 1 if values == "efficiency" else value >= 0):
            hint = "; omit all rows with speed 0 or torque 0" if value == 0 else ""
            raise ValueError(f"line {line}: read {value:g}, expected {_VALUES[values]}{hint}")
        points[speed, torque] = line, value
    speeds, torques = (sorted({point[place] for point in points}) for place in (0, 1))
    for speed, torque in product(speeds, torques):
        if (speed, torque) not in points:
            where = _point(units, speed, torque)
            raise ValueError(f"expected a full grid: there is no value at {where}")
    grid = [[speed, *(points[speed, torque][1] for torque in torques)] for speed in speeds]
    unit = _plain(with_unit(heads[-1])[1] or "")
    return MapLaw(torques, grid, next((known for known in _LOSS_UNITS if known == unit), ""))


def _expected(values: str, heads: Sequence[str]) -> ValueError:
    read = f", not `{','.join(heads)[:MOST_QUOTED]}`" if heads else ""
    return ValueError(f"expected a CSV file with the headings `{_HEADS[values]}`{read}")


def _point(units: Sequence[str], *values: float) -> str:
    """Return a point as text, with speed and torque in the units of the file."""
    sizes = map(measured, (f"1 {unit}" for unit in units), _MEASURES.values())
    both = zip(values, sizes, units, strict=True)
    return ", ".join(f"{value / size:g} {unit}" for value, size, unit in both)


def _plain(unit: str) -> str:
    return "N*m" if unit in ("Nm", "N m", "N\u00b7m") else unit


def _reading(heading: str, values: str) -> _Reading:
    """Return a function that reads the numbers of a column in SI units."""
    name, unit = _name(heading), (with_unit(heading)[1] or "").removeprefix("-")
    if name in _MEASURES:
        if not unit:
            raise _expected(values, [])
        try:
            measured(f"1 {unit}", _MEASURES[name])
        except ValueError as error:
            raise ValueError(f"line 1: the unit of {name}: {error}") from None
        return partial(_measured, unit, _MEASURES[name])
    allowed = ("", "%") if name == "efficiency" else _LOSS_UNITS
    if _plain(unit) not in allowed:
        words = spoken((unit for unit in allowed if unit), "or")
        raise ValueError(f"line 1: the unit of {name}: read {unit or 'none'}, expected {words}")
    return _percent if unit == "%" else scalars.number


def _measured(unit: str, measure: Measure, cell: str) -> float:
    return measured(f"{cell} {unit}", measure)


def _percent(cell: str) -> float:
    return scalars.number(f"{cell}%")


def _numbers(rows: _Rows, values: str) -> Iterator[tuple[int, tuple[float, ...]]]:
    """Yield the line number and the numbers of each row below the head."""
    (_, heads), *below = rows
    columns = [(_name(head), _reading(head, values)) for head in heads]
    if not below:
        raise ValueError("expected a point at least, below the head")
    for line, row in below:
        if len(row) != len(columns):
            raise ValueError(f"line {line}: expected {len(columns)} numbers")
        numbers = []
        for (name, read), cell in zip(columns, row, strict=True):
            try:
                numbers.append(read(cell))
            except ValueError as error:
                raise ValueError(f"line {line}: {name}: read {cell!r}, {error}") from None
        yield line, tuple(numbers)
