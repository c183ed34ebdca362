"""Strip to the right of a Campbell diagram: a column of natural frequencies for each gear."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.ends import LineEnd, beside, height_of, width_of
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.torsion.pictures.orders.campbell_sheet import CampbellSheet
from vstatics.torsion.pictures.orders.resonances import GearMode

GEAR_PITCH = 12.0
"""Distance between the columns of neighbouring gears. [pt]"""
MOST_STRIP_WIDTH = 150.0
"""Largest width of all columns together. [pt]"""
HALF_MARK = 0.36
"""Half width of the mark of a frequency, divided by the distance of columns."""


class GearStrip(NamedTuple):
    """Strip with a column for each gear, and a mark at each natural frequency."""

    sheet: CampbellSheet

    @property
    def across(self) -> float:
        """Width of all columns together [pt]."""
        return min(GEAR_PITCH * len(self.sheet.gears), MOST_STRIP_WIDTH)

    @property
    def wide(self) -> float:
        """Width of the strip, including numbers of modes at the right edge [pt]."""
        return self.across + width_of(self._ends)

    @property
    def _by_mode(self) -> dict[int, list[GearMode]]:
        shown = (mode for mode in self.sheet.modes if mode.frequency <= self.sheet.top)
        return grouped((mode.number, mode) for mode in shown)

    @property
    def _ends(self) -> list[LineEnd]:
        """Labels at the right edge: the number of each mode at its frequency in the last gear."""
        lasts = [(number, modes[-1].frequency) for number, modes in self._by_mode.items()]
        return [LineEnd(last / self.sheet.top, (str(number),)) for number, last in lasts]

    def draw(self, pen: Pen) -> None:
        """Draw the strip in a panel that has the scale of the diagram."""
        (wide, high), style = pen.size, self.sheet.style
        pitch = wide / len(self.sheet.gears)
        at = [(place + 0.5) * pitch for place in range(len(self.sheet.gears))]
        pen.lines([((x, 0.0), (x, high)) for x in at], color=style.faint, width=0.4, zorder=0.4)
        pen.frame()
        for modes in self._by_mode.values():
            places = [(at[mode.place], pen.up(mode.frequency)) for mode in modes]
            pairs = [[*pair] for pair in itertools.pairwise(places)]
            pen.lines(pairs, color=style.faint, width=0.6)
            half = HALF_MARK * pitch
            marks = [((x - half, y), (x + half, y)) for x, y in places]
            pen.lines(marks, color=style.ink, width=1.3)
        every = math.ceil((height("") + 1) / pitch)
        upright = any(width(name) > pitch - 2 for name in self.sheet.gears)
        for x, name in list(zip(at, self.sheet.gears, strict=True))[::every]:
            pen.text(x, -4.0, name, ha="center", va="top", rotation=90 * upright)
        pen.text(wide / 2, high + 4, style.text("modes by gear"), ha="center", color=style.soft)
        beside(pen, "right", thinned(self._ends, high))


def thinned(ends: list[LineEnd], room: float) -> list[LineEnd]:
    """Choose every n-th name, so that the names fit into a height [pt].

    >>> ends = [LineEnd(0.1 * n, (str(n),)) for n in range(9)]
    >>> [end.names[0] for end in thinned(ends, 60.0)]
    ['0', '2', '4', '6', '8']
    """
    every = math.ceil(height_of(ends) / max(room, 1.0))
    return ends[:: max(every, 1)]
