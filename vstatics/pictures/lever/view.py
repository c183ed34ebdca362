"""Drawing of a lever in a gear, at a place in a figure."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import LeverSheet
from vstatics.pictures.lever.places import LeverCell


class LeverView(NamedTuple):
    """Lever in a gear, with the position in a figure."""

    sheet: LeverSheet
    gear: LeverGear
    place: int
    """Index of the lever, from the left."""
    bottom: float
    """Height of the foot."""
    same: str | None
    """Earlier gear in which the lever looks equal, so that numbers are not repeated; else None."""

    @property
    def cell(self) -> LeverCell:
        """Cell of the lever."""
        return self.sheet.page.cells[self.place]

    @property
    def style(self) -> Style:
        """Style of the figure."""
        return self.sheet.pen.style

    @property
    def is_loaded(self) -> bool:
        """True for a lever with torque."""
        return self.gear.is_loaded(self.place)

    @property
    def ink(self) -> str:
        """Colour of texts."""
        return self.style.ink if self.is_loaded else self.style.soft

    def torque(self, node: int) -> float:
        """Return the torque on a point [-], 0 for a shaft."""
        return self.gear.torques[self.place][node] if self.cell.lever.devices else 0.0

    def speed(self, node: int) -> float:
        """Return the speed of a point [-]."""
        return self.gear.state.speeds[self.cell.lever.nodes[node].link]

    def across(self, speed: float) -> float:
        """Return the horizontal position of a speed."""
        (start, end), (low, high) = self.cell.speeds, self.sheet.speeds
        return start + (speed - low) / (high - low) * (end - start)
