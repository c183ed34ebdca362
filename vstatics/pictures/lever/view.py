"""A lever in a gear, with its position in a figure, for the functions that draw it."""

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
    """Height from which the heights of `LeverRow` are measured, above the figure's foot. [pt]"""
    same: str | None
    """Earlier gear in which the lever looks equal, so that numbers are not repeated; else None."""

    @property
    def cell(self) -> LeverCell:
        """Lever with its lines, texts and horizontal position, equal in all gears."""
        return self.sheet.page.cells[self.place]

    @property
    def style(self) -> Style:
        """Style of the figure."""
        return self.sheet.pen.style

    @property
    def is_loaded(self) -> bool:
        """True if the lever carries torque in the gear."""
        return self.gear.is_loaded(self.place)

    @property
    def ink(self) -> str:
        """Colour of texts, fainter for a lever without torque."""
        return self.style.ink if self.is_loaded else self.style.soft

    def torque(self, node: int) -> float:
        """Return the torque on a point of the lever [-]; 0 if the lever is a mere shaft."""
        return self.gear.torques[self.place][node] if self.cell.lever.devices else 0.0

    def speed(self, node: int) -> float:
        """Return the speed of a point of the lever [-]."""
        return self.gear.state.speeds[self.cell.lever.nodes[node].link]

    def across(self, speed: float) -> float:
        """Return the horizontal position of a speed within the area of speeds [pt]."""
        (start, end), (low, high) = self.cell.speeds, self.sheet.speeds
        return start + (speed - low) / (high - low) * (end - start)
