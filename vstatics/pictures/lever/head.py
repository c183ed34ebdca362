"""Heading of a gear in a lever diagram, with the ratio in large letters."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.labels import height, width, wrapped
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SIZE, TITLE, Style, number
from vstatics.pictures.drawing.words import fault, gear_title
from vstatics.pictures.lever.gear import LeverGear

RATIO_SIZE = 15.0
"""Size of the letters of a ratio. [pt]"""
BETWEEN = 12.0
"""Distance between the name, the ratio and the engaged shift elements of a gear. [pt]"""


class GearHead(NamedTuple):
    """Name, ratio and engaged shift elements of a gear; lengths in points."""

    name: str
    ratio: str
    """Ratio as text, or the reason why the ratio is undefined."""
    elements: str
    """Engaged shift elements and given speeds, wrapped into lines."""
    starts: tuple[float, float]
    """Distances from the left end to the ratio, and to the text of the shift elements. [pt]"""

    @property
    def high(self) -> float:
        """Height of the heading with the gap below."""
        return 1.15 * RATIO_SIZE + 4 + max(height(self.elements) - height(""), 0.0)

    def draw(self, pen: Pen, x: float, top: float) -> None:
        """Draw the heading with the upper left corner at (`x`, `top`)."""
        y = top - 0.9 * RATIO_SIZE
        pen.text(x, y, self.name, size=TITLE, bold=True)
        at, start = self.starts
        pen.text(x + at, y, self.ratio, size=RATIO_SIZE, bold=True)
        up = y + 0.75 * SIZE  # 0.75 is the height of capitals relative to the letter size
        pen.text(x + start, up, self.elements, color=pen.style.engaged, va="top")


def gear_head(
    case: Transmission, gear: LeverGear, room: float, style: Style, *, is_alone: bool
) -> GearHead:
    """Return the heading of a gear in a width [pt]. A gear that is alone is named in the title."""
    state = gear.state
    ratios = [f"i = {number(state.ratio)}"] if math.isfinite(state.ratio) else []
    ratio = "; ".join(ratios + [fault(message, style) for message in state.faults[:1]])
    said = [", ".join(element.name for element in case.elements_at(state.gear.joining))]
    for place, slip in state.gear.slip.items():
        if slip:
            name = case.shift_elements[place - 1].name
            said.append(f"{style.text('slip')} {name} = {typeset(f'{slip:.4g}')}")
    for link, speed in state.gear.speeds.items():
        said.append(f"{case.link_name(link)} = {typeset(case.speed_text(speed))}")
    name = "" if is_alone else gear_title(state.gear.name, style)
    named = width(name, TITLE, bold=True) + BETWEEN if name else 0.0
    start = named + (width(ratio, RATIO_SIZE, bold=True) + BETWEEN if ratio else 0.0)
    elements = wrapped("; ".join(filter(None, said)), room - start)
    return GearHead(name, ratio, elements if style.titled or not is_alone else "", (named, start))
