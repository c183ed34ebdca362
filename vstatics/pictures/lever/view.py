"""A lever in one gear as it stands in a figure, and what a script needs to move it."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any, NamedTuple

from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import LeverMark, LeverSheet
from vstatics.pictures.lever.places import LeverCell
from vstatics.pictures.sheet.labels import POINTS_PER_INCH
from vstatics.pictures.sheet.pen import known
from vstatics.pictures.sheet.style import Style


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

    @property
    def number(self) -> int:
        """Of the lever among those that are told."""
        return len(self.sheet.told) - 1

    def following(self, of: str, node: int = 0, **data: Any) -> AbstractContextManager[LeverSheet]:
        """Where something that a script moves is drawn."""
        return self.sheet.following(of=of, lever=self.number, node=node, **data)

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

    def mark(self) -> LeverMark:
        """What a script needs to move a lever."""
        cell, lever = self.cell, self.cell.lever
        foot = self.sheet.pen.figure.get_figheight() * POINTS_PER_INCH - self.bottom
        nodes = {
            number: {
                "link": node.link,
                "position": known(node.position),
                "at": foot - cell.rows[number].at if number in cell.rows else None,
                "y": foot - cell.rows[number].y if number in cell.rows else None,
                "sources": node.sources if lever.devices else (),
                "speed": known(self.speed(number)),
                "torque": known(self.torque(number)),
            }
            for number, node in enumerate(lever.nodes)
        }
        places = cell.left, cell.at, cell.right, cell.speeds
        return LeverMark(*places, lever.devices, lever.ratio is not None, nodes)
