"""Fuel map of an engine over speed and torque: a grid in CSV, interpolated bilinearly."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.errors import ReadError, count_of, spoken
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.named.headings import SHAFT_COLUMNS, TableColumn
from vstatics.core.readers.unit_table import read_unit_table
from vstatics.vehicle.tolerances import SAME_SPEED

_RATES = {"g/h": 1 / 3600, "kg/h": 1 / 3.6, "g/s": 1.0}
"""Units of fuel consumption, with factors to g/s."""
COLUMNS = (
    *SHAFT_COLUMNS,
    TableColumn(
        "fuel",
        aliases=dict.fromkeys(("fuel consumption", "fuel rate", "fuel flow"), "")
        | {unit: unit for unit in _RATES},
        sizes=_RATES,
        meaning="; g/kWh times speed [rpm] * torque [N*m]/9549.3 is g/h, idle has its own",
    ),
)


class FuelMap(NamedTuple):
    """Fuel rates on a grid of engine speed and torque, constant outside the grid.

    Examples
    --------
    >>> grid = FuelMap(np.array([100.0, 300.0]), np.array([0.0, 100.0]),
    ...                np.array([[0.1, 0.5], [0.3, 1.1]]))
    >>> grid.at(np.array([200.0, 0.0]), np.array([50.0, -20.0]))
    array([0.5, 0.1])
    """

    speeds: Floats
    """Engine speeds of the grid. [rad/s]"""
    torques: Floats
    """Engine torques of the grid. [N*m]"""
    fuel: Floats
    """Fuel rates, shape (speeds, torques). [g/s]"""

    def at(self, speeds: Floats, torques: Floats) -> Floats:
        """Return fuel rates [g/s] at engine speeds and torques; torques below 0 count as 0."""
        grid = LookupTable(
            tuple(self.speeds.tolist()),
            tuple(map(tuple, self.fuel.tolist())),
            tuple(self.torques.tolist()),
        )
        return grid.along(speeds, np.maximum(torques, 0.0))

    def is_beyond(self, speeds: Floats, torques: Floats) -> Booleans:
        """Return True where a speed or torque is above the grid.

        >>> FuelMap(np.array([100.0]), np.array([50.0]), np.zeros((1, 1))).is_beyond(
        ...     np.array([100.0, 101.0]), np.array([50.0, 0.0]))
        array([False,  True])
        """
        limit = 1 + SAME_SPEED
        beyond: Booleans = (speeds > self.speeds[-1] * limit) | (torques > self.torques[-1] * limit)
        return beyond


def read_fuel_map(data: bytes, file: str) -> FuelMap:
    """Read the fuel map of an engine.

    Raises
    ------
    ReadError
        If the file has errors, with every problem and its position.

    Examples
    --------
    >>> text = b"speed [rad/s],torque [N*m],fuel [g/h]\\n100,0,360\\n100,50,720\\n"
    >>> read_fuel_map(text, "fuel.csv").fuel.round(9)
    array([[0.1, 0.2]])
    """
    table = read_unit_table(data, file, "a fuel map: speed, torque, fuel", COLUMNS, "E123")
    speeds, row = np.unique(np.array(table.numbers["speed"]), return_inverse=True)
    torques, column = np.unique(np.array(table.numbers["torque"]), return_inverse=True)
    fuel = np.full((len(speeds), len(torques)), np.nan)
    fuel[row, column] = table.numbers["fuel"]
    at = {heading.column.name: heading for heading in table.head.headings}
    if len(row) != fuel.size or np.isnan(fuel).any():
        message = (
            f"read {count_of('row', len(row))} for {count_of('speed', len(speeds))} and "
            f"{count_of('torque', len(torques))}, expected one row for each pair"
        )
        for speed, torque in np.argwhere(np.isnan(fuel))[:1]:
            missing = (speeds[speed], at["speed"]), (torques[torque], at["torque"])
            pair = spoken(f"{value / heading.size:g} {heading.unit}" for value, heading in missing)
            message += f"; there is no row for {pair}"
        raise ReadError("E123", message, place=table.head_place)
    if (fuel < 0).any():
        wrong = next(index for index, rate in enumerate(table.numbers["fuel"]) if rate < 0)
        message = f"fuel: read {table.read_number('fuel', wrong)}, expected 0 or more"
        raise ReadError("E123", message, place=table.place(wrong))
    return FuelMap(speeds, torques, fuel)
