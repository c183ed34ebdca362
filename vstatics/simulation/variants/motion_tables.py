"""Tables of a run, by their names in expressions of a sweep.

>>> [name for name in TABLES if along_time(name)][:5]
['time', 'speeds', 'slips', 'torques', 'accelerations']
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.record.asked import TABLES as ASKED
from vstatics.simulation.record.columns import main_tables
from vstatics.simulation.record.motion import EventKind, Motion
from vstatics.simulation.record.row_names import Kind
from vstatics.sweep.results.meanings import PART_NUMBERS

OfRow: TypeAlias = Callable[[Motion, str, int], float]
"""Function of a motion, row name and row index that returns the number in the row."""


class MotionTable(NamedTuple):
    """Table of a run: columns over time, or a number in each row."""

    kind: Kind
    unit: str
    """Unit of the values; see `AskedTable`."""
    of_row: OfRow | None = None


def _peak(field: Literal["torque", "time"], motion: Motion, row: str, _: int) -> float:
    return float(getattr(motion.peaks.get(row), field, math.nan))


def _energy(field: str, otherwise: float, motion: Motion, row: str, _: int) -> float:
    return float(getattr(motion.energy, field).get(row, otherwise))


def _event_time(kind: EventKind, place: Literal[0, -1], motion: Motion, row: str, _: int) -> float:
    """Return the time [s] of the first (`place` = 0) or last (-1) event of a kind."""
    times = [event.time for event in motion.events if (event.element, event.event) == (row, kind)]
    return times[place] if times else math.nan


def _events(motion: Motion, row: str, _: int) -> float:
    return float(sum(event.element == row for event in motion.events))


def _damage(motion: Motion, row: str, _: int) -> float:
    return motion.damage[row].damage if row in motion.damage else math.nan


def _dynamic_factor(motion: Motion, row: str, _: int) -> float:
    factor = motion.dynamic_factors.get(row)
    return math.nan if factor is None else factor


def _step_time(motion: Motion, row: str, _: int) -> float:
    done = (event.time for event in motion.events if f"{event.element},{event.step}" == row)
    return next(done, math.nan)


def _target(field: Literal["time", "distance"], motion: Motion, _: str, place: int) -> float:
    return float(getattr(motion.reached[place], field)) if motion.reached[place:] else math.nan


TIME = "time"
"""Name of the table with the times of all instants."""
TABLES = {
    TIME: MotionTable("number", "s"),
    "speeds": MotionTable("link", "rad/s"),
    "slips": MotionTable("shift element", "rad/s"),
    "torques": MotionTable("device", "N*m"),
    **{name: MotionTable(table.kind, table.unit) for name, table in ASKED.items()},
    "heat": MotionTable("friction", "J", partial(_energy, "heat", 0.0)),
    "heat_per_area": MotionTable(
        "shift element", "J/m^2", partial(_energy, "heat_per_area", math.nan)
    ),
    "losses": MotionTable("loss", "J", partial(_energy, "losses", 0.0)),
    "peaks": MotionTable("device", "N*m", partial(_peak, "torque")),
    "peak_times": MotionTable("device", "s", partial(_peak, "time")),
    "dynamic_factor": MotionTable("device", "", _dynamic_factor),
    "locks": MotionTable("friction", "s", partial(_event_time, "locks", 0)),
    "last_locks": MotionTable("friction", "s", partial(_event_time, "locks", -1)),
    "breaks": MotionTable("friction", "s", partial(_event_time, "slips", 0)),
    "reverses": MotionTable("friction", "s", partial(_event_time, "reverses", 0)),
    "impacts": MotionTable("friction", "s", partial(_event_time, "impact", 0)),
    "events": MotionTable("friction", "", _events),
    "steps": MotionTable("step", "s", _step_time),
    "time_to": MotionTable("target", "s", partial(_target, "time")),
    "distance_to": MotionTable("target", "m", partial(_target, "distance")),
    "damage": MotionTable("device with fatigue", "", _damage),
    "work": MotionTable("number", "J"),
    "kinetic": MotionTable("number", "J"),
    "elastic": MotionTable("number", "J"),
    "impact": MotionTable("number", "J"),
    "balance": MotionTable("number", ""),
}


def along_time(name: str) -> bool:
    """Return whether a table has values at each instant."""
    table = TABLES[name]
    return name == TIME or (table.of_row is None and (table.kind != "number" or name in ASKED))


class MotionTables:
    """Tables of a run: shape (1, instants), or (1, 1), with a further axis for rows if any.

    Parameters
    ----------
    motion : Motion, optional
        Run; without a run all values are NaN.
    rows : callable
        Function from a kind of rows to the names of the rows.
    mechanisms : int
        Number of mechanisms of the case.
    """

    def __init__(
        self, motion: Motion | None, rows: Callable[[Kind], Sequence[str]], mechanisms: int = 0
    ) -> None:
        self.motion = motion
        self.rows = rows
        self.mechanisms = mechanisms

    def existing(self, name: str) -> Floats:
        """Return the table called `name`; missing values are NaN."""
        if name in PART_NUMBERS.values():
            [quantity] = (key for key, table in PART_NUMBERS.items() if table == name)
            parts = self.motion.case.mechanisms if self.motion and self.motion.case else ()
            values = [getattr(part, quantity) for part in parts] or [math.nan] * self.mechanisms
            return np.array(values, float).reshape(1, 1, -1)
        known, motion, names = TABLES[name], self.motion, self.rows(TABLES[name].kind)
        axes = (1, 1) if known.kind == "number" else (1, 1, len(names))
        if motion is None:
            return np.full(axes, math.nan)
        if name == TIME:
            return motion.time[np.newaxis]
        if known.kind == "number":
            at_end = getattr(motion.energy, name, None)
            return np.full(axes, at_end) if name not in ASKED else _along_time(motion, name, [""]).T
        if known.of_row is None:
            return _along_time(motion, name, names)[np.newaxis]
        numbers = [known.of_row(motion, row, place) for place, row in enumerate(names)]
        return np.array(numbers).reshape(axes)


def _along_time(motion: Motion, name: str, wanted: Sequence[str]) -> Floats:
    """Return a table over time, shape (instants, rows), with NaN for missing rows."""
    if name in ASKED:
        known = motion.asked.get(name, {})
    else:
        names, table = main_tables(motion)[name]
        if tuple(wanted) == names:
            return table.T
        known = dict(zip(names, table, strict=True))
    lacking = np.full(len(motion.time), math.nan)
    columns = [known.get(row, lacking) for row in wanted]
    return np.array(columns).reshape(len(columns), len(motion.time)).T
