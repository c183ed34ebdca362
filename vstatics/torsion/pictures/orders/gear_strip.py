"""The strip beside a Campbell diagram: the natural frequencies gear by gear, on its own scale."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.ends import LineEnd, beside, height_of, width_of
from vstatics.pictures.drawing.groups import grouped
from vstatics.pictures.drawing.labels import Label, height, width
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import Style
from vstatics.torsion.pictures.orders.resonances import GearMode

GEAR_PITCH = 12.0
"""From gear to gear. [pt]"""
MOST_STRIP_WIDTH = 150.0
"""Of all gears. [pt]"""
HALF_MARK = 0.36
"""Half of the mark of a frequency, by the pitch."""


class GearStrip(NamedTuple):
    """Gears, and their modes."""

    gears: Sequence[str]
    modes: Sequence[GearMode]
    top: float
    """Of the scale. [Hz]"""
    style: Style

    @property
    def across(self) -> float:
        """Width of the gears [pt]."""
        return min(GEAR_PITCH * len(self.gears), MOST_STRIP_WIDTH)

    @property
    def wide(self) -> float:
        """With the numbers of modes [pt]."""
        return self.across + width_of(self._ends)

    @property
    def _by_mode(self) -> dict[int, list[GearMode]]:
        shown = (one for one in self.modes if one.frequency <= self.top)
        return grouped((one.number, one) for one in shown)

    @property
    def _ends(self) -> list[LineEnd]:
        """The numbers of modes, each at the last gear that has it."""
        lasts = [(number, own[-1].frequency) for number, own in self._by_mode.items()]
        return [LineEnd(last / self.top, (str(number),)) for number, last in lasts]

    def draw(self, pen: Pen) -> None:
        """In a panel with the scale of the diagram."""
        (wide, high), style = pen.size, self.style
        pitch = wide / len(self.gears)
        at = [(place + 0.5) * pitch for place in range(len(self.gears))]
        pen.lines([((x, 0.0), (x, high)) for x in at], color=style.faint, width=0.4, zorder=0.4)
        pen.frame()
        for own in self._by_mode.values():
            places = [(at[one.place], pen.up(one.frequency)) for one in own]
            pen.lines(
                [[one, other] for one, other in itertools.pairwise(places)],
                color=style.faint,
                width=0.6,
            )
            half = HALF_MARK * pitch
            marks = [((x - half, y), (x + half, y)) for x, y in places]
            pen.lines(marks, color=style.ink, width=1.3)
        every = math.ceil((height("") + 1) / pitch)
        upright = any(width(one) > pitch - 2 for one in self.gears)
        names = [
            Label(x, name if place % every == 0 else "", style.ink)
            for place, (x, name) in enumerate(zip(at, self.gears, strict=True))
        ]
        for one in names:
            look: Look = {"ha": "center", "va": "top", "rotation": 90 * upright}
            pen.text(one.at, -4.0, one.text, **look)
        pen.text(wide / 2, high + 4, style.text("modes by gear"), ha="center", color=style.soft)
        ends = self._ends
        every = math.ceil(height_of(ends) / high)
        beside(pen, "right", ends[:: max(every, 1)])
