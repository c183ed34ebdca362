"""The table beside a Campbell diagram: each mode with the speeds of its resonances."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.labels import height, width, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, MARGIN, SIZE, Style, number
from vstatics.torsion.pictures.orders.excited import Order
from vstatics.torsion.pictures.orders.resonances import GearMode, is_between

GEARS_WIDTH = 96.0
"""Names of gears are wrapped to it. [pt]"""
COLUMN_GAP = 12.0
"""Between columns. [pt]"""
HEADING_HEIGHT = height("\n") + 4.0
"""Two lines of headings. [pt]"""
ROW_GAP = 0.5
"""Between rows. [pt]"""
IN_A_ROW = 3
"""So many gears in their order are the first and the last of them."""


class TableCell(NamedTuple):
    """A text of a row."""

    text: str
    bold: bool = False


class TableRow(NamedTuple):
    """A mode of a gear, and of the gears of which the same is printed."""

    mode: str
    """Its number."""
    cells: Sequence[TableCell]
    """What stands behind it."""
    begins: bool
    """Whether it is the first of its mode."""

    @property
    def told(self) -> list[TableCell]:
        """All cells."""
        return [TableCell(self.mode), *self.cells]

    @property
    def high(self) -> float:
        """[pt]."""
        return max(height(cell.text) for cell in self.cells) + ROW_GAP


class ResonanceTable(NamedTuple):
    """Rows with their columns."""

    headings: Sequence[str]
    fires: Sequence[bool]
    """By column: whether it is of an order that fires."""
    rows: Sequence[TableRow]
    style: Style

    @property
    def wide(self) -> float:
        """[pt]."""
        return sum(self._widths) + COLUMN_GAP * (len(self.headings) - 1)

    @property
    def _widths(self) -> list[float]:
        columns = zip(*(row.told for row in self.rows), strict=True)
        return [
            max(
                width(heading, bold=fires),
                *(width(cell.text, bold=cell.bold) for cell in column),
            )
            for heading, fires, column in zip(self.headings, self.fires, columns, strict=True)
        ]

    def draw(self, pen: Pen, left: float, top: float, rows: Sequence[TableRow]) -> None:
        """Some of its rows below an ordinate, with the headings [pt]."""
        ends, x = [], left
        for wide in self._widths:
            x += wide
            ends.append(x)
            x += COLUMN_GAP
        style, y = self.style, top - HEADING_HEIGHT + 2
        for end, heading, fires in zip(ends, self.headings, self.fires, strict=True):
            colour = style.engaged if fires else style.soft
            pen.text(end, y, heading, ha="right", va="bottom", color=colour, bold=fires)
        y -= 2
        for row in rows:
            begins = row.begins or row is rows[0]
            if begins:
                rule: Look = {"color": style.faint, "width": LEADER_WIDTH}
                pen.line((left, y), (ends[-1], y), **rule)
            base = y - 0.95 * SIZE
            cells = [*zip(ends, row.told, strict=True)]
            for end, cell in cells if begins else cells[1:]:
                for step, line in enumerate(cell.text.split("\n")):
                    at = base - step * height("")
                    pen.text(end, at, line, ha="right", va="baseline", bold=cell.bold)
            y -= row.high


class TableParts(NamedTuple):
    """Some rows of some tables, below one another."""

    parts: Sequence[tuple[ResonanceTable, Sequence[TableRow]]]

    @property
    def high(self) -> float:
        """With a margin below each [pt]."""
        highs = (HEADING_HEIGHT + sum(row.high for row in rows) + MARGIN for _, rows in self.parts)
        return sum(highs) or MARGIN

    def fitting(self, room: float, least: int = 0) -> tuple[TableParts, TableParts]:
        """As many rows as fit into a height [pt], so many at least, and the others."""
        for place, (table, rows) in enumerate(self.parts):
            room -= HEADING_HEIGHT + MARGIN
            for count, row in enumerate(rows):
                room -= row.high
                if room < 0 and place + count >= least:
                    fits, others = (table, rows[:count]), (table, rows[count:])
                    before = [*self.parts[:place], *([fits] if count else [])]
                    return TableParts(before), TableParts([others, *self.parts[place + 1 :]])
        return self, TableParts([])

    def draw(self, pen: Pen) -> None:
        """Up to the lower edge of a figure."""
        y = self.high
        for table, rows in self.parts:
            table.draw(pen, MARGIN, y, rows)
            y -= HEADING_HEIGHT + sum(row.high for row in rows) + MARGIN


ResonanceSpeeds = tuple[Sequence[float], float] | tuple[Sequence[float], float, float]
"""As `speeds` of `resonance_tables`."""


def resonance_tables(
    modes: Sequence[GearMode],
    orders: Sequence[Order],
    speeds: ResonanceSpeeds,
    room: float,
    style: Style,
) -> list[ResonanceTable]:
    """The table of modes that an order meets; of many orders several, each within a width [pt].

    Parameters
    ----------
    speeds : tuple
        Those of the input in ascending order; resonances between the first and the last are bold.
        The speed up to which resonances are listed; that from which on they are. [rpm]

    Examples
    --------
    >>> from vstatics.torsion.pictures.orders.resonances import GearMode
    >>> some = [GearMode("low", 0, 1, 20.0, 1.0, 0.0)]
    >>> orders = [Order(0.1, False), Order(2.0, True)]
    >>> [made] = resonance_tables(some, orders, ([], 6000.0), 400.0, Style())
    >>> [cell.text for cell in made.rows[0].told]
    ['1', '20.00', '1', '', '600']
    >>> len(resonance_tables(some, orders[1:] * 8, ([], 6000.0), 300.0, Style()))
    2
    """
    made = _table(modes, orders, speeds, style)
    if made is None or made.wide <= room or len(orders) == 1:
        return [made] if made else []
    half = math.ceil(len(orders) / 2)
    return [
        table
        for some in (orders[:half], orders[half:])
        for table in resonance_tables(modes, some, speeds, room, style)
    ]


def _table(
    modes: Sequence[GearMode],
    orders: Sequence[Order],
    speeds: ResonanceSpeeds,
    style: Style,
) -> ResonanceTable | None:
    """The table of some orders, or none."""
    places = {mode.place: mode.gear for mode in modes}
    every = [places[place] for place in sorted(places)]
    is_damped = any(mode.damping_ratio for mode in modes)
    ascending = sorted(modes, key=lambda mode: (mode.number, mode.frequency, mode.place))
    rows: list[TableRow] = []
    for mode_number, same in groupby(ascending, key=lambda mode: mode.number):
        begins = True
        for printed, alike in _printed_alike(same, orders, speeds, is_damped=is_damped).items():
            if any(cell.text for cell in printed[-len(orders) :]):
                names = [places[place] for place in sorted(alike)]
                named = [TableCell(wrapped(gear_run(names, every, style), GEARS_WIDTH))]
                cells = [*named * (len(every) > 1), *printed]
                rows.append(TableRow(str(mode_number), cells, begins))
                begins = False
    if not rows:
        return None
    headings = [
        style.text("mode"),
        *[style.text("gears")] * (len(every) > 1),
        style.text("Hz"),
        style.text("partici-\npation"),
        *[style.text("damping\nratio")] * is_damped,
        *(f"{one.name}\n{style.text('rpm')}" for one in orders),
    ]
    fires = [False] * (len(headings) - len(orders)) + [one.fires for one in orders]
    return ResonanceTable(headings, fires, rows, style)


def _printed_alike(
    modes: Iterable[GearMode],
    orders: Sequence[Order],
    speeds: ResonanceSpeeds,
    *,
    is_damped: bool,
) -> dict[tuple[TableCell, ...], list[int]]:
    """Cells of modes of one number -> places of the gears of which all of them are printed."""
    places: dict[tuple[TableCell, ...], list[int]] = {}
    for mode in modes:
        first = [number(mode.frequency), typeset(f"{mode.participation:.2g}")]
        first += [f"{mode.damping_ratio:.3f}"] * is_damped
        met = [_speed(mode, order, *speeds) for order in orders]
        places.setdefault((*map(TableCell, first), *met), []).append(mode.place)
    return places


def _speed(
    mode: GearMode,
    order: Order,
    running: Sequence[float],
    fastest: float,
    slowest: float = 0.0,
) -> TableCell:
    speed = order.speed(mode.frequency)
    if not (mode.is_excited and is_between(speed, slowest, fastest)):
        return TableCell("")
    runs = len(running) > 1 and running[0] <= speed <= running[-1]
    return TableCell(f"{speed:.0f}", bold=runs)


def gear_run(names: Sequence[str], every: Sequence[str], style: Style) -> str:
    """Names of gears, of several in a row the first and the last.

    >>> gear_run(["1", "2", "3", "5", "R"], ["1", "2", "3", "4", "5", "R"], Style())
    '1–3, 5, R'
    >>> gear_run(["1", "R"], ["1", "R"], Style())
    'all'
    """
    if len(names) == len(every):
        return style.text("all")
    found: list[list[str]] = []
    for name in names:
        place = every.index(name)
        if found and place and every[place - 1] == found[-1][-1]:
            found[-1].append(name)
        else:
            found.append([name])
    parts = [[f"{run[0]}–{run[-1]}"] if len(run) >= IN_A_ROW else run for run in found]
    return ", ".join(one for part in parts for one in part)
