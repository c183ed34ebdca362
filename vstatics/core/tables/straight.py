"""Headings with units of motion along a line, for a case with links that move so."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.grid import Grid

_UNITS = {
    "N*m/rad": "N/m",
    "rad/(N*m)": "m/N",
    "N*m*s/rad": "N*s/m",
    "N*m": "N",
    "kg*m^2": "kg",
    "rad": "m",
    "rad/s^2": "m/s^2",
    "rad/s": "m/s",
}
"""Units of motion along a line, by unit of rotation."""
_ANY = "|".join(map(re.escape, [*_UNITS][:-1]))
_SPEEDS = "|".join(rf"(?<={word} \[)" for word in ("speed", "rate", "velocity"))
_UNIT = re.compile(rf"(?:(?<=\[)|(?<=, ))(?:{_ANY})(?=\]|$)|(?:{_SPEEDS})rad/s(?=\])")
"""Pattern of units of rotation. It includes rad/s for speeds, but not for frequencies."""


def in_both_units(case: Transmission, grids: Iterable[Grid]) -> Iterator[Grid]:
    """Yield tables; headings also contain units of motion along a line if links move so.

    Examples
    --------
    >>> from vstatics.core.tables.grid import grid_of
    >>> case = Transmission(1, [], [], [], masses={1: 2.0})
    >>> [grid] = in_both_units(case, [grid_of("Largest", ["component", "torque [N*m]"], [])])
    >>> grid.columns[1].heading
    'torque [N*m; straight N]'
    """
    for grid in grids:
        columns = [
            column._replace(heading=_in_both_units(column.heading)) for column in grid.columns
        ]
        doubled = grid._replace(title=_in_both_units(grid.title), columns=columns)
        yield doubled if case.masses else grid


def _in_both_units(heading: str) -> str:
    return _UNIT.sub(lambda unit: f"{unit[0]}; straight {_UNITS[unit[0]]}", heading)
