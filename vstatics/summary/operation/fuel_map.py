"""What an engine takes over speed and torque: a grid in CSV, bilinear between its points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.errors import Problem, ReadError
from vstatics.numerics.arrays import Floats
from vstatics.readers.unit_table import TableColumn, read_unit_table

COLUMNS = (
    TableColumn("speed", "si_speed"),
    TableColumn("torque", "si_torque"),
    TableColumn("fuel", sizes={"g/h": 1 / 3600, "kg/h": 1 / 3.6, "g/s": 1.0}),
)


class FuelMap(NamedTuple):
    """A grid of fuel over speed and torque; at its edges it goes on as there.

    Examples
    --------
    >>> grid = FuelMap(np.array([100.0, 300.0]), np.array([0.0, 100.0]),
    ...                np.array([[0.1, 0.5], [0.3, 1.1]]))
    >>> grid.at(np.array([200.0, 0.0]), np.array([50.0, -20.0]))
    array([0.5, 0.1])
    """

    speeds: Floats
    """[rad/s]"""
    torques: Floats
    """[N*m]"""
    fuel: Floats
    """(speeds, torques) [g/s]"""

    def at(self, speeds: Floats, torques: Floats) -> Floats:
        """Fuel at points [g/s]; a torque below 0 counts as 0."""
        (row, up), (column, along) = (
            _place(axis, values)
            for axis, values in ((self.speeds, speeds), (self.torques, np.maximum(torques, 0.0)))
        )
        above, beside = (
            np.minimum(row + 1, len(self.speeds) - 1),
            np.minimum(column + 1, len(self.torques) - 1),
        )
        low = self.fuel[row, column] * (1 - along) + self.fuel[row, beside] * along
        high = self.fuel[above, column] * (1 - along) + self.fuel[above, beside] * along
        made: Floats = low * (1 - up) + high * up
        return made


def _place(
    axis: Floats, values: Floats
) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.int64]], Floats]:
    """The cell of each value on an axis, and the part of it; at the edges beyond them."""
    if len(axis) == 1:
        return np.zeros(values.shape, np.int64), np.zeros(values.shape)
    inside = np.clip(values, axis[0], axis[-1])
    cell = np.clip(np.searchsorted(axis, inside, side="right") - 1, 0, len(axis) - 2)
    return cell, (inside - axis[cell]) / (axis[cell + 1] - axis[cell])


def read_fuel_map(data: bytes, file: str) -> FuelMap:
    """Read the fuel map of an engine.

    Raises
    ------
    ReadError
        With every problem and its place.

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
    if len(row) != fuel.size or np.isnan(fuel).any():
        message = (
            f"read {len(row)} rows for {len(speeds)} speeds and {len(torques)} torques, expected "
            "one for each pair: a grid"
        )
        raise ReadError([Problem("E123", message, (), table.source.place(1))])
    if (fuel < 0).any():
        wrong = int(np.flatnonzero(np.array(table.numbers["fuel"]) < 0)[0])
        raise ReadError([Problem("E123", "fuel: expected 0 or more", (), table.place(wrong))])
    return FuelMap(speeds, torques, fuel)
