"""Driving cycle in CSV: time, speed, and optionally gear and slope of the road.

The slope is the sine of the angle of ascent, or the angle itself. Published cycles have a grade
instead: the rise divided by the horizontal distance.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, listed, of_file, quoted, spoken
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.headings import TableColumn
from vstatics.core.readers.unit_table import UnitTable, read_unit_table

SLOPE = "as it is the sine of the angle"
_ANGLES = dict.fromkeys(("deg", "°", "degree", "degrees"), math.pi / 180) | {"rad": 1.0}
_PARTS = dict.fromkeys(("%", "pct", "percent"), 0.01) | dict.fromkeys(("‰", "permille"), 0.001)
_TIMES = (
    *("t", "test time", "cycle time", "elapsed time", "total elapsed time", "total time"),
    *("timestamp", "time stamp", "datetime", "date time"),
)
_SECONDS = ("s", "sec", "secs", "second", "seconds", "cycsecs", "<t>")  # for FASTSim, VECTO
_SPEEDS = (
    *("v", "velocity", "vehicle speed", "vehicle velocity", "target speed", "target velocity"),
    *("road speed", "cycle speed", "reference speed", "set speed", "speed target"),
    *("gps speed", "speed (gps)", "speed (obd)"),
)
_GRADES = (
    *("gradient", "grad", "road grade", "road gradient", "incline", "inclination"),
    *("cycgrade",),  # for FASTSim
)
_GEAR = TableColumn(
    "gear",
    is_text=True,
    optional=True,
    aliases=dict.fromkeys(("selected gear", "gear number", "<gear>"), ""),
)
COLUMNS = (
    TableColumn(
        "time",
        "time",
        aliases=dict.fromkeys(_TIMES, "")
        | dict.fromkeys(_SECONDS, "s")
        | {"minutes": "min", "hours": "h"},
    ),
    TableColumn(
        "speed",
        "velocity",
        usual="km/h",
        aliases=dict.fromkeys(_SPEEDS, "")
        | dict.fromkeys(("cycmps", "mps", "m/s", "speed meters per second"), "m/s")
        | dict.fromkeys(("<v>", "km/h", "kmh", "kph"), "km/h")
        | {"mph": "mph"},
    ),
    _GEAR,
    TableColumn(
        "slope",
        optional=True,
        sizes={"": 1.0, "-": 1.0, **_ANGLES},
        meaning=f", {SLOPE}; a column `grade [%]` is rise over horizontal distance",
    ),
    TableColumn(
        "grade",
        optional=True,
        sizes={"": 1.0, "-": 1.0, **_PARTS, **_ANGLES},
        aliases=dict.fromkeys(_GRADES, "") | {"<grad>": "%"},
    ),
)
_OF_SUMO = {
    "time": {"timestep time": "s"},
    "speed": {"vehicle speed": "m/s"},
    "slope": {"vehicle slope": "deg"},
}
"""Headings of SUMO files with their units.

The units are assumed only if all these headings occur. Otherwise `vehicle_speed` needs its unit.
"""
_SUMO_COLUMNS = tuple(
    column._replace(aliases={**column.aliases, **_OF_SUMO.get(column.name, {})})
    for column in COLUMNS
)
LATEST, FASTEST, QUICKEST = 1e12, 1e6, 1e9
"""Largest time [s], speed [m/s] and acceleration [m/s^2], which keep the energies finite."""
_HALF_DAY = 12 * 3600.0
"""Smallest step back in time that probably means that a clock passed midnight. [s]"""
_LATER = "a later time in each row"

BLOCK_ROWS = 20_000
"""Number of steps that are calculated together, which limits memory in long cycles."""
_HEAD_BYTES = 4096
MOST_SHOWN_FAULTS = 20
"""Largest number of errors that are reported."""


def blocks(count: int) -> Iterator[slice]:
    """Yield slices of `count` steps; the steps of a slice are calculated together.

    >>> list(blocks(25_000))
    [slice(0, 20000, None), slice(20000, 40000, None)]
    """
    for start in range(0, count, BLOCK_ROWS):
        yield slice(start, start + BLOCK_ROWS)


class Trace(NamedTuple):
    """Driving cycle as time steps between successive rows."""

    duration: Floats
    """Time between the two rows of a step. [s]"""
    speed: Floats
    """Mean road speed of the two rows. [m/s]"""
    acceleration: Floats
    """Constant acceleration between the two rows. [m/s^2]"""
    slope: Floats
    """Sine of the angle of ascent, from the first row of a step. [-]"""
    gears: list[str]
    """Gear names, from the first row of each step; empty without a column `gear`."""
    table: UnitTable

    @property
    def ends(self) -> tuple[Floats, Floats]:
        """Road speeds at the beginnings and at the ends of the steps [m/s]."""
        change = self.acceleration * self.duration / 2
        return self.speed - change, self.speed + change

    @property
    def notes(self) -> list[Problem]:
        """Notes about skipped columns, located at the headings."""
        skipped = self._skipped
        if not skipped:
            return []
        columns = "a column" if len(skipped) == 1 else f"{len(skipped)} columns"
        text = f"{columns} with an unknown name ignored: {listed(skipped)}"
        return [Problem("N005", text, (), self.place)]

    @property
    def hint_of_gears(self) -> str:
        """Hint with the names of a column of gears, if columns with other names were skipped."""
        if not self._skipped:
            return ""
        names = spoken(map(quoted, (_GEAR.name, *_GEAR.aliases)), "or")
        return f"; the column can be called {names}, not {listed(self._skipped)}"

    @property
    def _skipped(self) -> list[str]:
        return [quoted(heading) for heading in self.table.head.skipped if heading]

    @property
    def place(self) -> Place:
        """Position of the headings in the file."""
        return self.table.head_place


def read_trace(data: bytes, file: str) -> Trace:
    """Read a driving cycle.

    Raises
    ------
    ReadError
        If the file has errors, with every problem and its position.

    Examples
    --------
    >>> trace = read_trace(b"time [s],speed [km/h]\\n0,0\\n2,36\\n", "t.csv")
    >>> trace.speed.round(9), trace.acceleration.round(9)
    (array([5.]), array([5.]))
    >>> read_trace(b"cycSecs,cycMps,cycGrade\\n0,5,0.75\\n2,5,0\\n", "t.csv").slope.round(9)
    array([0.6])
    """
    expected = "a driving cycle: time, speed"
    if b",duration [s]," in data[:_HEAD_BYTES]:
        message = f"these are time steps, for `summary --duty` and `plot`, expected {expected}"
        raise ReadError([of_file("E122", file, message)])
    columns = _SUMO_COLUMNS if b"timestep_time" in data[:_HEAD_BYTES] else COLUMNS
    table = read_unit_table(data, file, expected, columns, "E122", skips=True)
    table = _with_sines(table)
    times, speeds = (np.array(table.numbers[name]) for name in ("time", "speed"))
    problems = list(_problems(table, times, speeds))
    if problems:
        raise ReadError(problems)
    duration = np.diff(times)
    acceleration = np.diff(speeds) / duration
    grades = np.array(table.numbers.get("grade", np.zeros(len(table.lines))))
    slopes = np.array(table.numbers.get("slope", grades / np.hypot(1.0, grades)))
    return Trace(
        duration,
        (speeds[1:] + speeds[:-1]) / 2,
        acceleration,
        slopes[:-1],
        list(table.texts.get("gear", [])[:-1]),
        table,
    )


def _with_sines(table: UnitTable) -> UnitTable:
    """Return a table with a slope or grade as an angle replaced by the sine, up to 90 degrees."""
    numbers = dict(table.numbers)
    for heading in table.head.headings:
        name = heading.column.name
        if name in ("slope", "grade") and heading.unit in _ANGLES:
            angles = numbers.pop(name)
            numbers["slope"] = [math.sin(x) if abs(x) <= math.pi / 2 else x for x in angles]
    return table._replace(numbers=numbers)


def _problems(table: UnitTable, times: Floats, speeds: Floats) -> Iterator[Problem]:
    units = {heading.column.name: heading.unit for heading in table.head.headings}
    if {"slope", "grade"} <= units.keys():
        message = "read both `slope` and `grade`, expected one of them"
        yield Problem("E122", message, (), table.head_place)
    if len(times) < 2:
        yield Problem("E122", "read one row, expected at least two", (), table.place(0))
    within = np.clip(times, -LATEST, LATEST), np.clip(speeds, 0.0, FASTEST)
    durations, changes = (np.diff(column, prepend=np.nan) for column in within)
    with np.errstate(all="ignore"):
        accelerations = np.abs(changes / durations)
    slopes, grades = (np.array(table.numbers.get(name, ())) for name in ("slope", "grade"))
    checks = (
        ("time", durations <= 0, _LATER),
        ("time", times != within[0], f"at most {LATEST:g} s"),
        ("speed", speeds < 0, "0 or more"),
        ("speed", speeds > FASTEST, f"at most {FASTEST:g} m/s"),
        (
            "speed",
            (durations > 0) & (accelerations > QUICKEST),
            f"a change by at most {QUICKEST:g} m/s^2",
        ),
        ("slope", np.abs(slopes) > 1, f"-1 to 1, {SLOPE}"),
        (
            "grade",
            (np.abs(grades) > 1) & (units.get("grade") in (None, "", "-")),
            "-1 to 1 without a unit; numbers in percent need the heading `grade [%]`",
        ),
    )
    wrong = [
        (row, name, expected)
        for name, are_wrong, expected in checks
        for row in np.flatnonzero(are_wrong).tolist()[:MOST_SHOWN_FAULTS]
    ]
    for row, name, expected in sorted(wrong, key=lambda fault: fault[0])[:MOST_SHOWN_FAULTS]:
        hint = ""
        read = table.read_number(name, row) if name == "speed" else f"{table.numbers[name][row]:g}"
        if expected == _LATER:
            read = f"{times[row]:.10g} s after {times[row - 1]:.10g} s"
            if times[row] < times[row - 1] - _HALF_DAY:
                hint = "; if the clock passes midnight, write the dates, too"
        message = f"{name}: read {read}, expected {expected}{hint}"
        yield Problem("E122", message, (), table.place(row))
