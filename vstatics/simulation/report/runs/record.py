"""Run as JSON data for the script of a page: columns, panels, states, gears, events."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.core.tables.names import written
from vstatics.core.texts import tr
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.paged.inline import colour_name
from vstatics.simulation.pictures.elements import states
from vstatics.simulation.pictures.gears import element_sets, gear_pieces
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, capacity_side, numbers_of
from vstatics.simulation.pictures.panels import panels
from vstatics.simulation.record.columns import main_tables
from vstatics.simulation.record.motion import Event, Motion
from vstatics.simulation.record.picture_tables import chosen
from vstatics.simulation.report.runs.instants import chosen_instants
from vstatics.simulation.tolerances import NO_RANGE

MOST_NUMBERS = 25_000
"""Largest number of values in all columns, which take about 140 kilobytes of the page."""
WORDS = ("gear", "open", "sticks", "slips")
"""Words that the script prints for a gear and for the states of shift elements."""
_TABLES = {
    "speed": "speeds",
    "slip": "slips",
    "torque": "torques",
    "acceleration": "vehicle_acceleration",
    "output": "output_torque",
}
"""Name of the table of a kind of panel; other kinds are themselves names of tables."""


class _RunColumns:
    """Columns of a run on a page; equal columns are stored once."""

    def __init__(self) -> None:
        self.values: list[Floats] = []
        self._tables: list[str] = []
        self._places: dict[bytes, int] = {}

    def add(self, table: str, values: Floats) -> int:
        """Add a column of a table, and return its index."""
        place = self._places.setdefault(values.tobytes(), len(self.values))
        if place == len(self.values):
            self.values.append(values)
            self._tables.append("speeds" if table == "slips" else table)
        return place

    def moving(self) -> Iterator[Floats]:
        """Yield the columns that change by more than the rounding noise of their table."""
        peaks = [float(np.fmax.reduce(np.abs(values))) for values in self.values]
        largest: dict[str, float] = {}
        for table, peak in zip(self._tables, peaks, strict=True):
            largest[table] = max(largest.get(table, 0.0), peak)
        for table, values in zip(self._tables, self.values, strict=True):
            if np.ptp(np.nan_to_num(values)) > NO_RANGE * largest[table]:
                yield values


class PageRun(NamedTuple):
    """Run reduced to the instants that a page contains."""

    motion: Motion
    off: float
    """Largest deviation of straight lines from a column, relative to the column's range. [-]"""


def page_run(results: Results, motion: Motion) -> PageRun:
    """Reduce a run to instants between which straight lines are accurate.

    The instants include events and the extremes of all columns.
    """
    columns = _RunColumns()
    data = _data(results, motion, columns)
    most = MOST_NUMBERS // (1 + len(columns.values))
    events = tuple(event["time"] for event in data["events"])
    sticks = motion.beside.get("sticks", {}).values()
    moving = np.column_stack([*columns.moving(), *sticks, np.zeros((len(motion.time), 0))])
    mask, off = chosen_instants(motion.time, moving, most, events)
    reduced = motion._replace(
        time=motion.time[mask],
        speeds=motion.speeds[mask],
        slips=motion.slips[mask],
        torques=motion.torques[mask],
        heat=motion.heat[mask],
        asked=chosen(motion.asked, mask),
        beside=chosen(motion.beside, mask),
    )
    return PageRun(reduced, off)


def recorded(results: Results, motion: Motion) -> dict[str, Any]:
    """Return a run with panels as JSON data; columns are in SI units without loss of digits.

    Parameters
    ----------
    results : Results
        Results of the case.
    motion : Motion
        Motion of `page_run`.
    """
    columns = _RunColumns()
    data = _data(results, motion, columns)
    time, values = _packed(motion.time), [*map(_packed, columns.values)]
    return {"time": time, "columns": values, **data}


def _data(results: Results, motion: Motion, columns: _RunColumns) -> dict[str, Any]:
    element_states, names = states(motion), motion.elements
    links = {
        name: columns.add("speeds", motion.speeds[:, n]) for n, name in enumerate(motion.links)
    }
    elements = [
        {
            "name": name,
            "slip": columns.add("slips", motion.slips[:, place]),
            "torque": columns.add("torques", motion.torques[:, place]),
            **{
                key: getattr(element, key)
                for element in element_states
                if element.element == place
                for key in ("slips", "sticks")
            },
        }
        for place, name in enumerate(names)
    ]
    shown = panels(results.case, motion)
    numbers = numbers_of([element.name for element in element_states], shown)
    return {
        "links": links,
        "elements": elements,
        "panels": [_panel(panel, motion, numbers, columns) for panel in shown],
        "gears": [
            piece[:3] for piece in gear_pieces(element_sets(results), motion, element_states)
        ],
        "events": [*map(_event, motion.events)],
        "words": {word: tr(word) for word in WORDS},
    }


def _packed(values: Floats) -> str:
    """Encode numbers without loss in base64, byte position by byte position.

    The least significant bytes of all numbers come first, the bytes with sign and exponent last.
    Adjacent bytes are therefore similar and compress well. A constant column is encoded as a single
    number.

    >>> _packed(np.array([1.0, 2.0])), _packed(np.array([1.0, 1.0]))
    ('AAAAAAAAAAAAAAAA8AA/QA==', 'AAAAAAAA8D8=')
    """
    if (values == values[0]).all():
        values = values[:1]
    parts = np.frombuffer(values.astype("<f8").tobytes(), np.uint8).reshape(-1, 8)
    return base64.b64encode(parts.T.tobytes()).decode()


def _event(event: Event) -> dict[str, Any]:
    is_step = event.event == "step"
    text = tr("step {number}", number=event.step) if is_step else tr(event.word or event.event)
    return {"time": event.time, "told": f"{event.element} {text}"}


def _panel(
    panel: MotionPanel, motion: Motion, numbers: Mapping[str, int], columns: _RunColumns
) -> dict[str, Any]:
    text = tr(panel.text)
    title, _, unit = text.rpartition(", ")
    lines = [data for line in panel.lines for data in _lines(panel, line, motion, numbers, columns)]
    return {
        "kind": panel.kind.replace("_", "-"),
        "title": title or text,
        "unit": unit if title else "",
        "per": panel.unit,
        "lines": lines,
        "leftOut": panel.left_out,
    }


def _lines(
    panel: MotionPanel,
    line: MotionLine,
    motion: Motion,
    numbers: Mapping[str, int],
    columns: _RunColumns,
) -> Iterator[dict[str, Any]]:
    looks = line.looks(Style(), numbers)
    friction = motion.beside.get("heat", {motion.elements[0]: None} if motion.elements else {})
    is_loss = panel.kind == "heat" and (bool(line.distinction) or line.names[0] not in friction)
    table = "losses" if is_loss and motion.beside else _TABLES.get(panel.kind, panel.kind)
    for name, label, look in zip(line.names, line.labels, looks, strict=True):
        values = line.values
        if panel.kind == "speed":
            values = motion.speeds[:, motion.links.index(name)]
        data = {
            "label": label,
            "heading": _heading(table, name, motion),
            "column": columns.add(table, values),
            **_look(look),
        }
        if line.capacity is not None:
            side = capacity_side(line.values, line.capacity)
            signed = np.where(np.isfinite(line.capacity), side * line.capacity, np.nan)
            data["capacity"] = columns.add("torques", signed)
            data["capacityHeading"] = _heading("capacities", name, motion)
        yield data


def _heading(table: str, name: str, motion: Motion) -> str:
    """Return the heading of a column as in `vstatics simulate -f csv`: ``speeds[in]``.

    The output torque, or a column without a name, has the name of the table as its heading.
    """
    tables = main_tables(motion)
    rows = tables[table][0] if table in tables else (name,)
    if table == "output_torque" or not name:
        return table
    return f"{table}[{written(rows.index(name), rows)}]"


def _look(look: Look) -> dict[str, Any]:
    """Return a line's colour name and dash pattern [pt]; the pattern is shifted to begin at 0.

    >>> _look({"color": Style().colour(1), "linestyle": (10.0, (5.0, 10.0))})
    {'colour': 'colour1', 'dash': (0.0, 5.0, 5.0, 5.0)}
    """
    dash: tuple[float, ...] = ()
    if not isinstance(look["linestyle"], str):
        start, dash = look["linestyle"]
        if start:  # the dashes of two lines alternate by an offset
            dash = (0.0, sum(dash) - start, dash[0], start - dash[0])
    return {"colour": colour_name(look["color"]), "dash": dash}
