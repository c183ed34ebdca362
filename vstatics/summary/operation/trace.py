"""A driving cycle in CSV: time, speed, perhaps the gear and the slope, the sine of its angle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.errors import Problem, ReadError
from vstatics.numerics.arrays import Floats
from vstatics.readers.unit_table import TableColumn, UnitTable, read_unit_table

SLOPE = "as it is the sine of the angle"
COLUMNS = (
    TableColumn("time", "time"),
    TableColumn("speed", "velocity"),
    TableColumn("gear", is_text=True, optional=True),
    TableColumn("slope", optional=True, meaning=f", {SLOPE}"),
)


class Trace(NamedTuple):
    """A driving cycle, from row to row."""

    duration: Floats
    """[s]"""
    speed: Floats
    """The mean of two rows. [m/s]"""
    acceleration: Floats
    """[m/s^2]"""
    slope: Floats
    """Sine of the ascent, of the first row. [-]"""
    gears: list[str]
    """Of the first row; nothing where the trace has none."""
    table: UnitTable

    @property
    def ends(self) -> tuple[Floats, Floats]:
        """Speeds of both rows [m/s]."""
        change = self.acceleration * self.duration / 2
        return self.speed - change, self.speed + change


def read_trace(data: bytes, file: str) -> Trace:
    """Read a driving cycle.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> trace = read_trace(b"time [s],speed [km/h]\\n0,0\\n2,36\\n", "t.csv")
    >>> trace.speed.round(9), trace.acceleration.round(9)
    (array([5.]), array([5.]))
    """
    table = read_unit_table(data, file, "a driving cycle: time, speed", COLUMNS, "E122")
    times, speeds = (np.array(table.numbers[name]) for name in ("time", "speed"))
    slopes = np.array(table.numbers.get("slope", [0.0] * len(times)))
    wrong = [(row, "time", times) for row in (np.flatnonzero(np.diff(times) <= 0) + 1).tolist()]
    wrong += [(row, "speed", speeds) for row in np.flatnonzero(speeds < 0).tolist()]
    wrong += [(row, "slope", slopes) for row in np.flatnonzero(np.abs(slopes) > 1).tolist()]
    expected = {
        "time": "a later time than above",
        "speed": "0 or more",
        "slope": f"-1 to 1, {SLOPE}",
    }
    problems = [
        Problem(
            "E122", f"{name}: read {column[row]:g}, expected {expected[name]}", (), table.place(row)
        )
        for row, name, column in sorted(wrong, key=lambda one: one[0])
    ]
    if not problems and len(times) < 2:
        problems.append(Problem("E122", "read one row, expected two at least", (), table.place(0)))
    if problems:
        raise ReadError(problems[:20])
    duration = np.diff(times)
    return Trace(
        duration,
        (speeds[1:] + speeds[:-1]) / 2,
        np.diff(speeds) / duration,
        slopes[:-1],
        table.texts.get("gear", [])[:-1],
        table,
    )
