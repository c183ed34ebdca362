"""Headings of tables of a case whose links partly move straight."""

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
"""Of what turns -> of what moves straight."""
_ANY = "|".join(map(re.escape, [*_UNITS][:-1]))
_SPEEDS = "|".join(rf"(?<={word} \[)" for word in ("speed", "rate", "velocity"))
_UNIT = re.compile(rf"(?:(?<=\[)|(?<=, ))(?:{_ANY})(?=\]|$)|(?:{_SPEEDS})rad/s(?=\])")
"""Frequencies are in rad/s of a vibration, whatever moves."""


def in_both_units(case: Transmission, grids: Iterable[Grid]) -> Iterator[Grid]:
    """Tables whose headings tell the units of straight links, too, if the case has any.

    Examples
    --------
    >>> from vstatics.core.tables.grid import grid_of
    >>> case = Transmission(1, [], [], [], masses={1: 2.0})
    >>> [grid] = in_both_units(case, [grid_of("Largest", ["device", "torque [N*m]"], [])])
    >>> grid.columns[1].heading
    'torque [N*m; straight N]'
    """
    for grid in grids:
        columns = [one._replace(heading=_told(one.heading)) for one in grid.columns]
        told = grid._replace(title=_told(grid.title), columns=columns)
        yield told if case.masses else grid


def _told(heading: str) -> str:
    return _UNIT.sub(lambda unit: f"{unit[0]}; straight {_UNITS[unit[0]]}", heading)
