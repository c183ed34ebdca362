"""Lever in the state of a gear with its position on a page, for the functions that draw it."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import LeverSheet
from vstatics.pictures.lever.places import LeverCell


class LeverView(NamedTuple):
    """Lever in the state of a gear, with its position on a page."""

    sheet: LeverSheet
    gear: LeverGear
    place: int
    """Index of the lever from the left."""
    bottom: float
    """Height of the foot of the levers, from which heights of `LeverRow` are measured. [pt]"""
    same: str | None
    """Name of an earlier gear, if any, with an equal lever, whose numbers are not repeated."""

    @property
    def cell(self) -> LeverCell:
        """Lever with the lines of the points and the horizontal position, common to all gears."""
        return self.sheet.page.cells[self.place]

    @property
    def style(self) -> Style:
        """Style of the figure."""
        return self.sheet.pen.style

    @property
    def is_loaded(self) -> bool:
        """True if the lever carries torque, or an unknown torque, in the gear."""
        return self.gear.is_loaded(self.place)

    @property
    def ink(self) -> str:
        """Colour of texts, paler for a lever without torque."""
        return self.style.ink if self.is_loaded else self.style.soft

    def torque(self, node: int) -> float:
        """Return the torque on a point relative to the input torque [-]; 0 for a shaft."""
        return self.gear.torques[self.place][node]

    def speed(self, node: int) -> float:
        """Return the speed of a point relative to the input speed [-]."""
        return self.gear.state.speeds[self.cell.lever.nodes[node].link]

    def across(self, speed: float) -> float:
        """Return the horizontal position of a speed within the area of speeds [pt]."""
        (start, end), (low, high) = self.cell.speeds, self.sheet.speeds
        return start + (speed - low) / (high - low) * (end - start)
