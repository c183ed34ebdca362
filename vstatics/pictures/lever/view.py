"""A lever in one gear at its place in a figure."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import LeverSheet
from vstatics.pictures.lever.places import LeverCell


class LeverView(NamedTuple):
    """A lever in a gear, and where it stands in a figure."""

    sheet: LeverSheet
    gear: LeverGear
    place: int
    """Of the lever, from the left."""
    bottom: float
    """Its foot."""
    same: str | None
    """The gear before that shows the same; numbers are left out then."""

    @property
    def cell(self) -> LeverCell:
        """The lever."""
        return self.sheet.page.cells[self.place]

    @property
    def style(self) -> Style:
        """Of the figure."""
        return self.sheet.pen.style

    @property
    def is_loaded(self) -> bool:
        """Whether it carries torque; else it is pale."""
        return self.gear.is_loaded(self.place)

    @property
    def ink(self) -> str:
        """Of texts."""
        return self.style.ink if self.is_loaded else self.style.soft

    def torque(self, node: int) -> float:
        """On a point; a shaft has none of its own [-]."""
        return self.gear.torques[self.place][node] if self.cell.lever.devices else 0.0

    def speed(self, node: int) -> float:
        """Of a point [-]."""
        return self.gear.state.speeds[self.cell.lever.nodes[node].link]

    def across(self, speed: float) -> float:
        """Where a speed is."""
        (start, end), (low, high) = self.cell.speeds, self.sheet.speeds
        return start + (speed - low) / (high - low) * (end - start)
