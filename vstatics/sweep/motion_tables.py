"""The tables of a run of a scenario, as the expressions of a sweep speak of them.

>>> sorted(name for name in TABLES if along_time(name))
['slips', 'speeds', 'time', 'torques']
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.record.motion import EventKind, Motion
from vstatics.simulation.scenario.laws import Resistance, Road
from vstatics.simulation.scenario.parts import Scenario

Kind = Literal["link", "shift element", "device", "friction", "loss", "target", "number"]
"""What has a row; a number has none. Friction is that of shift elements, of links with a resistance
or a road, of springs with a limit; losses are those of devices and of links with drag."""
OfRow: TypeAlias = Callable[[Motion, str, int], float]
"""A number of a run by the name of a row, and its place."""


class MotionTable(NamedTuple):
    """A table of a run: along time, or with a number for each row."""

    kind: Kind
    of_row: OfRow | None = None


def _of_peak(field: Literal["torque", "time"]) -> OfRow:
    def number(motion: Motion, row: str, _: int) -> float:
        return float(getattr(motion.peaks.get(row), field, math.nan))

    return number


def _of_energy(field: Literal["heat", "losses", "heat_per_area"], otherwise: float) -> OfRow:
    def number(motion: Motion, row: str, _: int) -> float:
        return float(getattr(motion.energy, field).get(row, otherwise))

    return number


def _of_event(kind: EventKind, place: Literal[0, -1]) -> OfRow:
    """The time of the first or the last event of a kind."""

    def number(motion: Motion, row: str, _: int) -> float:
        times = [one.time for one in motion.events if (one.element, one.event) == (row, kind)]
        return times[place] if times else math.nan

    return number


def _events(motion: Motion, row: str, _: int) -> float:
    return float(sum(event.element == row for event in motion.events))


def _of_target(field: Literal["time", "distance"]) -> OfRow:
    def number(motion: Motion, _: str, place: int) -> float:
        reached = motion.reached
        return float(getattr(reached[place], field)) if place < len(reached) else math.nan

    return number


TIME = "time"
"""The instants themselves."""
TABLES: Mapping[str, MotionTable] = {
    TIME: MotionTable("number"),
    "speeds": MotionTable("link"),
    "slips": MotionTable("shift element"),
    "torques": MotionTable("device"),
    "heat": MotionTable("friction", _of_energy("heat", 0.0)),
    "heat_per_area": MotionTable("shift element", _of_energy("heat_per_area", math.nan)),
    "losses": MotionTable("loss", _of_energy("losses", 0.0)),
    "peaks": MotionTable("device", _of_peak("torque")),
    "peak_times": MotionTable("device", _of_peak("time")),
    "locks": MotionTable("friction", _of_event("locks", 0)),
    "last_locks": MotionTable("friction", _of_event("locks", -1)),
    "breaks": MotionTable("friction", _of_event("slips", 0)),
    "reverses": MotionTable("friction", _of_event("reverses", 0)),
    "impacts": MotionTable("friction", _of_event("impact", 0)),
    "events": MotionTable("friction", _events),
    "time_to": MotionTable("target", _of_target("time")),
    "distance_to": MotionTable("target", _of_target("distance")),
    "work": MotionTable("number"),
    "kinetic": MotionTable("number"),
    "elastic": MotionTable("number"),
    "impact": MotionTable("number"),
    "balance": MotionTable("number"),
}
"""By name; [s], [rad/s], [N*m], [J], [J/m^2], [m]."""


def along_time(name: str) -> bool:
    """Whether a table has values at each instant."""
    return name == TIME or (TABLES[name].of_row is None and TABLES[name].kind != "number")


def rows_of_kind(kind: Kind, scenario: Scenario) -> tuple[str, ...]:
    """The names of the rows of tables of a kind."""
    case = scenario.case
    names: list[str] = []
    if kind == "link":
        names += case.link_names[: case.own_links]
    if kind in ("shift element", "friction"):
        names += [element.name for element in case.shift_elements]
    if kind == "friction":
        loaded = {link for link, law in scenario.torques if isinstance(law, Resistance | Road)}
        names += [case.link_names[link - 1] for link in sorted(loaded)]
        names += [spring.name for spring in case.springs if spring.limit is not None]
    if kind in ("device", "loss"):
        names += [*case.devices, *(converter.name for converter in scenario.converters)]
    if kind == "device":
        names += [case.link_names[link - 1] for link in scenario.speeds]
    if kind == "loss":
        dragged = {link for gear in case.gears for link in gear.drag}
        names += [case.link_names[link - 1] for link in sorted(dragged)]
    if kind == "target":
        names += [
            f"{case.link_names[link - 1]} {speed:.12g}"
            for link, speeds in scenario.targets.items()
            for speed in speeds
        ]
    return tuple(names)


class MotionTables:
    """The tables of one run: shape (1, instants or 1[, rows]).

    Parameters
    ----------
    motion : Motion, optional
        None: nothing is known of the run, so there is NaN alone.
    rows : callable
        Gives the names of the rows of a kind.
    """

    def __init__(self, motion: Motion | None, rows: Callable[[Kind], Sequence[str]]) -> None:
        self.motion = motion
        self.rows = rows

    def existing(self, name: str) -> Floats:
        """A table by its name; NaN where there is nothing to be said."""
        known, motion, names = TABLES[name], self.motion, self.rows(TABLES[name].kind)
        axes = (1, 1) if known.kind == "number" else (1, 1, len(names))
        if motion is None:
            return np.full(axes, math.nan)
        if name == TIME:
            return motion.time[np.newaxis]
        if known.kind == "number":
            return np.full(axes, getattr(motion.energy, name))
        if known.of_row is None:
            return _along_time(motion, name, names)[np.newaxis]
        numbers = [known.of_row(motion, row, place) for place, row in enumerate(names)]
        return np.array(numbers).reshape(axes)


def _along_time(motion: Motion, name: str, wanted: Sequence[str]) -> Floats:
    """A table of shape (instants, rows); NaN for a row that the run has not."""
    table, names = {
        "speeds": (motion.speeds, motion.links),
        "slips": (motion.slips, motion.elements),
        "torques": (motion.torques, motion.devices),
    }[name]
    if tuple(wanted) == tuple(names):
        return table
    places = {one: place for place, one in enumerate(names)}
    lacking = np.full(len(table), math.nan)
    columns = [table[:, places[one]] if one in places else lacking for one in wanted]
    return np.array(columns).reshape(len(columns), len(table)).T
