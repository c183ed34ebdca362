"""Table below a Campbell diagram: modes, with the resonant speeds of each order."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.labels import height, width, wrapped
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, MARGIN, SIZE, Style, number
from vstatics.torsion.pictures.orders.campbell_sheet import CampbellSheet
from vstatics.torsion.pictures.orders.orders_and_speeds import Order
from vstatics.torsion.pictures.orders.resonances import GearMode, by_number, is_between

GEARS_WIDTH = 96.0
"""Width at which the names of gears are wrapped. [pt]"""
TABLE_GAP = 12.0
"""Gap between columns. [pt]"""
HEADING_HEIGHT = height("\n") + 4.0
"""Height of two lines of headings. [pt]"""
ROW_GAP = 0.5
"""Gap between rows. [pt]"""
IN_A_ROW = 3
"""Number of successive gears from which they are written as a range, such as 1–3."""


class TableCell(NamedTuple):
    """Cell of a table of resonances."""

    text: str
    bold: bool = False


class TableRow(NamedTuple):
    """Row of a mode, for all gears whose printed values are equal."""

    mode: str
    """Number of the mode."""
    cells: Sequence[TableCell]
    """Cells after the number of the mode."""

    @property
    def all_cells(self) -> list[TableCell]:
        """All cells of the row, beginning with the number of the mode."""
        return [TableCell(self.mode), *self.cells]

    @property
    def high(self) -> float:
        """Height of the row [pt]."""
        return max(height(cell.text) for cell in self.cells) + ROW_GAP


class ResonanceTable(NamedTuple):
    """Table of resonances for some orders."""

    headings: Sequence[str]
    fires: Sequence[bool]
    """Flag for each column: True for a firing order."""
    rows: Sequence[TableRow]
    style: Style

    @property
    def wide(self) -> float:
        """Width of the table [pt]."""
        return sum(self._widths) + TABLE_GAP * (len(self.headings) - 1)

    @property
    def _widths(self) -> list[float]:
        columns = zip(*(row.all_cells for row in self.rows), strict=True)
        return [
            max(
                width(heading, bold=fires),
                *(width(cell.text, bold=cell.bold) for cell in column),
            )
            for heading, fires, column in zip(self.headings, self.fires, columns, strict=True)
        ]

    def draw(self, pen: Pen, left: float, top: float, rows: Sequence[TableRow]) -> None:
        """Draw the headings and some rows of the table, downward from a height [pt]."""
        ends, x = [], left
        for wide in self._widths:
            x += wide
            ends.append(x)
            x += TABLE_GAP
        style, y = self.style, top - HEADING_HEIGHT + 2
        for end, heading, fires in zip(ends, self.headings, self.fires, strict=True):
            colour = style.engaged if fires else style.soft
            pen.text(end, y, heading, ha="right", va="bottom", color=colour, bold=fires)
        y -= 2
        drawn = ""
        for row in rows:
            begins, drawn = row.mode != drawn, row.mode
            if begins:
                rule: Look = {"color": style.faint, "width": LEADER_WIDTH}
                pen.line((left, y), (ends[-1], y), **rule)
            base = y - 0.95 * SIZE
            cells = [*zip(ends, row.all_cells, strict=True)]
            for end, cell in cells if begins else cells[1:]:
                for step, line in enumerate(cell.text.split("\n")):
                    at = base - step * height("")
                    pen.text(end, at, line, ha="right", va="baseline", bold=cell.bold)
            y -= row.high


class TableParts(NamedTuple):
    """Tables in a column, each with some of its rows."""

    parts: Sequence[tuple[ResonanceTable, Sequence[TableRow]]]

    @property
    def high(self) -> float:
        """Height of all tables, with a margin below each table [pt]."""
        highs = (HEADING_HEIGHT + sum(row.high for row in rows) + MARGIN for _, rows in self.parts)
        return sum(highs) or MARGIN

    def fitting(self, room: float, least: int = 0) -> tuple[TableParts, TableParts]:
        """Split off the rows that fit into `room` [pt], or `least` rows if fewer fit."""
        for place, (table, rows) in enumerate(self.parts):
            room -= HEADING_HEIGHT + MARGIN
            for count, row in enumerate(rows):
                room -= row.high
                if room < 0 and place + count >= least:
                    fits, remaining = (table, rows[:count]), (table, rows[count:])
                    before = [*self.parts[:place], *([fits] if count else [])]
                    return TableParts(before), TableParts([remaining, *self.parts[place + 1 :]])
        return self, TableParts([])

    def draw(self, pen: Pen) -> None:
        """Draw all tables, down to the lower edge of a figure."""
        y = self.high
        for table, rows in self.parts:
            table.draw(pen, MARGIN, y, rows)
            y -= HEADING_HEIGHT + sum(row.high for row in rows) + MARGIN


def resonance_tables(sheet: CampbellSheet, room: float) -> list[ResonanceTable]:
    """Return tables of resonances, each with as many orders as fit into the width `room` [pt].

    Resonances between the speeds at which the input runs are bold.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Transmission
    >>> from vstatics.pictures.drawing.style import Style
    >>> from vstatics.torsion.pictures.orders.orders_and_speeds import Order
    >>> modes, case = [GearMode("low", 0, 1, 20.0, 1.0, 0.0)], Transmission(2, [], [], [])
    >>> orders = [Order(0.1, False), Order(2.0, True)]
    >>> sheet = CampbellSheet(case, ["low"], [], "", modes, orders, [], 6000.0, 0.0, Style())
    >>> [table] = resonance_tables(sheet, 400.0)
    >>> [cell.text for cell in table.rows[0].all_cells]
    ['1', '20.00', '1', '', '600']
    >>> len(resonance_tables(sheet._replace(orders=orders[1:] * 8), 300.0))
    2
    """
    table, orders = _table(sheet), sheet.orders
    if table is None or table.wide <= room or len(orders) == 1:
        return [table] if table else []
    half = math.ceil(len(orders) / 2)
    return [
        part
        for some in (orders[:half], orders[half:])
        for part in resonance_tables(sheet._replace(orders=some), room)
    ]


def _table(sheet: CampbellSheet) -> ResonanceTable | None:
    modes, orders, style, every = sheet.modes, sheet.orders, sheet.style, sheet.gears
    is_damped = any(mode.damping_ratio for mode in modes)
    rows: list[TableRow] = []
    for mode_number, same in by_number(modes):
        for printed, alike in _printed_alike(same, sheet, is_damped=is_damped).items():
            if any(cell.text for cell in printed[-len(orders) :]):
                names = [every[place] for place in sorted(alike)]
                named = [TableCell(wrapped(gear_run(names, every, style), GEARS_WIDTH))]
                cells = [*named * (len(every) > 1), *printed]
                rows.append(TableRow(str(mode_number), cells))
    if not rows:
        return None
    headings = [
        style.text("mode"),
        *[style.text("gears")] * (len(every) > 1),
        style.text("Hz"),
        style.text("partici-\npation"),
        *[style.text("damping\nratio")] * is_damped,
        *(f"{order.name}\n{style.text('rpm')}" for order in orders),
    ]
    fires = [False] * (len(headings) - len(orders)) + [order.fires for order in orders]
    return ResonanceTable(headings, fires, rows, style)


def _printed_alike(
    modes: Iterable[GearMode], sheet: CampbellSheet, *, is_damped: bool
) -> dict[tuple[TableCell, ...], list[int]]:
    """Return the indices of the gears of a mode, grouped by their printed cells."""
    places: dict[tuple[TableCell, ...], list[int]] = {}
    for mode in modes:
        first = [number(mode.frequency), typeset(f"{mode.participation:.2g}")]
        first += [f"{mode.damping_ratio:.3f}"] * is_damped
        resonances = [_speed(mode, order, sheet) for order in sheet.orders]
        places.setdefault((*map(TableCell, first), *resonances), []).append(mode.place)
    return places


def _speed(mode: GearMode, order: Order, sheet: CampbellSheet) -> TableCell:
    speed, running = order.speed(mode.frequency), sheet.running
    if not (mode.is_excited and is_between(speed, sheet.slowest, sheet.fastest)):
        return TableCell("")
    runs = len(running) > 1 and running[0] <= speed <= running[-1]
    return TableCell(f"{speed:.0f}", bold=runs)


def gear_run(names: Sequence[str], every: Sequence[str], style: Style) -> str:
    """Return the names of gears as a text, in which successive gears form ranges.

    >>> gear_run(["1", "2", "3", "5", "R"], ["1", "2", "3", "4", "5", "R"], Style())
    '1–3, 5, R'
    >>> gear_run(["1", "R"], ["1", "R"], Style())
    'all'
    """
    if len(names) == len(every):
        return style.text("all")
    runs: list[list[str]] = []
    for name in names:
        place = every.index(name)
        if runs and place and every[place - 1] == runs[-1][-1]:
            runs[-1].append(name)
        else:
            runs.append([name])
    parts = [[f"{run[0]}–{run[-1]}"] if len(run) >= IN_A_ROW else run for run in runs]
    return ", ".join(text for part in parts for text in part)
