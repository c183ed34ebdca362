"""A run as plain data for the script of its page: columns, panels, states, gears, events."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.core.tables.names import written
from vstatics.core.texts import tr
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.paged.inline import colour_name
from vstatics.simulation.pictures.elements import states
from vstatics.simulation.pictures.gears import element_sets, gear_pieces
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, capacity_side, numbers_of
from vstatics.simulation.pictures.panels import panels
from vstatics.simulation.record.beside import chosen
from vstatics.simulation.record.motion import Event, Motion
from vstatics.simulation.report.runs.instants import chosen_instants
from vstatics.simulation.tolerances import NO_RANGE

MOST_NUMBERS = 25_000
"""Of all columns together: with as many a page has some 140 kilobytes more."""
WORDS = ("gear", "open", "sticks", "slips")
"""What the script calls a gear, and the states of shift elements."""
_TABLES = {
    "speed": "speeds",
    "slip": "slips",
    "torque": "torques",
    "acceleration": "vehicle_acceleration",
    "output": "output_torque",
}
"""Tables of a run by the kinds of panels; others are tables themselves."""


class _RunColumns:
    """Columns of a run by their headings, equal ones once."""

    def __init__(self) -> None:
        self.values: list[Floats] = []
        self._tables: list[str] = []
        self._places: dict[bytes, int] = {}

    def add(self, table: str, values: Floats) -> int:
        """A column of a table of a run; its place."""
        place = self._places.setdefault(values.tobytes(), len(self.values))
        if place == len(self.values):
            self.values.append(values)
            self._tables.append("speeds" if table == "slips" else table)
        return place

    def moving(self) -> Iterator[Floats]:
        """Those that change by more than rounding, by the largest of their tables."""
        peaks = [float(np.fmax.reduce(np.abs(one))) for one in self.values]
        largest: dict[str, float] = {}
        for table, peak in zip(self._tables, peaks, strict=True):
            largest[table] = max(largest.get(table, 0.0), peak)
        for table, one in zip(self._tables, self.values, strict=True):
            if np.ptp(np.nan_to_num(one)) > NO_RANGE * largest[table]:
                yield one


class PageRun(NamedTuple):
    """A run with no more instants than its page carries."""

    motion: Motion
    off: float
    """So far lines between its instants are from those left out, by the ranges of columns. [-]"""


def page_run(results: Results, motion: Motion) -> PageRun:
    """A run at so many instants that lines between them draw all that its page shows.

    Events and the extremes of all columns are among them.
    """
    columns = _RunColumns()
    told = _told(results, motion, columns)
    most = MOST_NUMBERS // (1 + len(columns.values))
    events = tuple(one["time"] for one in told["events"])
    sticks = motion.beside.get("sticks", {}).values()
    moving = np.column_stack([*columns.moving(), *sticks, np.zeros((len(motion.time), 0))])
    kept, off = chosen_instants(motion.time, moving, most, events)
    made = motion._replace(
        time=motion.time[kept],
        speeds=motion.speeds[kept],
        slips=motion.slips[kept],
        torques=motion.torques[kept],
        heat=motion.heat[kept],
        asked=chosen(motion.asked, kept),
        beside=chosen(motion.beside, kept),
    )
    return PageRun(made, off)


def recorded(results: Results, motion: Motion) -> dict[str, Any]:
    """A run with its panels as plain data; columns are in SI units with all digits.

    Parameters
    ----------
    results : Results
        Of its case.
    motion : Motion
        As of `page_run`.
    """
    columns = _RunColumns()
    told = _told(results, motion, columns)
    time, values = _packed(motion.time), [*map(_packed, columns.values)]
    return {"time": time, "columns": values, **told}


def _told(results: Results, motion: Motion, columns: _RunColumns) -> dict[str, Any]:
    """All but the columns, which are put where they belong."""
    found, names = states(motion), motion.elements
    links = {
        name: columns.add("speeds", motion.speeds[:, n]) for n, name in enumerate(motion.links)
    }
    elements = [
        {
            "name": name,
            "slip": columns.add("slips", motion.slips[:, place]),
            "torque": columns.add("torques", motion.torques[:, place]),
            **{
                key: getattr(one, key)
                for one in found
                if one.element == place
                for key in ("slips", "sticks")
            },
        }
        for place, name in enumerate(names)
    ]
    shown = panels(results.case, motion)
    numbers = numbers_of([one.name for one in found], shown)
    return {
        "links": links,
        "elements": elements,
        "panels": [_panel(one, motion, numbers, columns) for one in shown],
        "gears": gear_pieces(element_sets(results), motion),
        "events": [*map(_event, motion.events)],
        "words": {one: tr(one) for one in WORDS},
    }


def _packed(values: Floats) -> str:
    """Numbers with all their bits: base64 of all first bytes, the least, then all second ones.

    So what is alike, signs and exponents, stands together. Of equal numbers there is one.

    >>> _packed(np.array([1.0, 2.0])), _packed(np.array([1.0, 1.0]))
    ('AAAAAAAAAAAAAAAA8AA/QA==', 'AAAAAAAA8D8=')
    """
    if (values == values[0]).all():
        values = values[:1]
    parts = np.frombuffer(values.astype("<f8").tobytes(), np.uint8).reshape(-1, 8)
    return base64.b64encode(parts.T.tobytes()).decode()


def _event(event: Event) -> dict[str, Any]:
    what = event.word or event.event
    what = tr("step {number}", number=event.step) if event.event == "step" else tr(what)
    return {"time": event.time, "told": f"{event.element} {what}"}


def _panel(
    panel: MotionPanel, motion: Motion, numbers: Mapping[str, int], columns: _RunColumns
) -> dict[str, Any]:
    said = tr(panel.text)
    what, _, unit = said.rpartition(", ")
    lines = [told for line in panel.lines for told in _lines(panel, line, motion, numbers, columns)]
    return {
        "kind": panel.kind.replace("_", "-"),
        "title": what or said,
        "unit": unit if what else "",
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
    """Of each name of a line; links that turn together have columns of their own."""
    looks, table = line.looks(Style(), numbers), _table(panel, line, motion)
    for name, label, look in zip(line.names, line.labels, looks, strict=True):
        values = line.values
        if panel.kind == "speed":
            values = motion.speeds[:, motion.links.index(name)]
        told = {
            "label": label,
            "heading": _heading(table, name, motion),
            "column": columns.add(table, values),
            **_look(look),
        }
        if line.capacity is not None:
            side = capacity_side(line.values, line.capacity)
            signed = np.where(np.isfinite(line.capacity), side * line.capacity, np.nan)
            told["capacity"] = columns.add("torques", signed)
            told["capacityHeading"] = _heading("capacities", name, motion)
        yield told


def _table(panel: MotionPanel, line: MotionLine, motion: Motion) -> str:
    """The table of a run in which a line stands."""
    [name, *_] = line.names
    friction = motion.beside.get("heat", {motion.elements[0]: None} if motion.elements else {})
    is_loss = panel.kind == "heat" and (bool(line.distinction) or name not in friction)
    return "losses" if is_loss and motion.beside else _TABLES.get(panel.kind, panel.kind)


def _heading(table: str, name: str, motion: Motion) -> str:
    """As of `vstatics simulate -f csv`: ``speeds[in]``.

    A number has no row: neither have the torque of the output and what has no name.
    """
    names = {"speeds": motion.links, "slips": motion.elements, "torques": motion.devices}
    rows: Sequence[str] = names.get(table, (name,))
    if table == "output_torque" or not name:
        return table
    return f"{table}[{written(rows.index(name), rows)}]"


def _look(look: Look) -> dict[str, Any]:
    """The colour of a line by its name on the page, and its dashes from the beginning [pt].

    >>> _look({"color": Style().colour(1), "linestyle": (10.0, (5.0, 10.0))})
    {'colour': 'colour1', 'dash': (0.0, 5.0, 5.0, 5.0)}
    """
    dash: tuple[float, ...] = ()
    if not isinstance(look["linestyle"], str):
        start, dash = look["linestyle"]
        if start:  # within the gap of the stripes of others
            dash = (0.0, sum(dash) - start, dash[0], start - dash[0])
    return {"colour": colour_name(look["color"]), "dash": dash}
