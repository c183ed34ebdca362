"""Components as boxes, each with its name, its kind or ratio, and its members.

A box with two links is on the line between them. Any other box is drawn like a gear set: a link
leaves at its sides, like a carrier, and the others leave below and above.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import zip_longest
from typing import NamedTuple

from vstatics.core.elements.element import CentralWheel
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.transmission import HOUSING
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.labels import Span, width
from vstatics.pictures.drawing.style import SIZE, Style
from vstatics.pictures.drawing.words import word
from vstatics.pictures.schemes.gear_glyphs import MESH, lines_of
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text
from vstatics.pictures.schemes.sets import HalfSection, WheelColumn, section_of

BOX_NAME_LETTERS = 18
"""Number of letters after which the name of a box is broken at a blank."""
LINE = 1.3 * SIZE
"""Height of a line of text. [pt, scaled with letters]"""
PAD = 5.0
"""Distance from the text to the edge of a box. [pt, scaled with letters]"""
LEAST_BOX = 40.0
"""Smallest width of a box. [pt, scaled with letters]"""
SLOT_GAP = 9.0
"""Distance between the names of two members at a common edge. [pt, scaled with letters]"""
ARM = 10.0
"""Length of the line of a link at the side of a box. [pt]"""
GROUND = 14.0
"""Height of a support at the edge of a box. [pt]"""


class BoxText(NamedTuple):
    """Texts of the box of a component."""

    name: str
    """Name of the component, in one or more lines."""
    note: str
    """Kind or ratio of the component."""
    members: Mapping[str, str]
    """Names of members, or the coefficients of a spring, by the member."""

    @property
    def lines(self) -> int:
        """Number of lines of the name."""
        return 1 + self.name.count("\n")

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of name and kind or ratio [pt, scaled with letters]."""
        return max(width(self.name, bold=True), width(self.note)), LINE * (1 + self.lines)

    def at(self, link: int, device: Device) -> str:
        """Return the names of the members that belong to a link."""
        names = (name for name, member in device.members.items() if member == link)
        return ", ".join(self.members[name] for name in names)

    def on_line(self, device: Device, *, is_level: bool) -> tuple[float, float]:
        """Return the size of a box on a line between two links [pt, scaled with letters]."""
        ends = [width(self.at(link, device)) for link in device.links]
        wide, high = self.size
        ends_wide = sum(ends) + SLOT_GAP if is_level else max(ends)
        return max(wide, ends_wide, LEAST_BOX) + 2 * PAD, high + LINE * (1 if is_level else 2) + PAD


@dataclass(frozen=True)
class BoxSection(HalfSection):
    """Box drawn like a gear set, in the row of the planets of gear sets.

    The link of one member leaves at the sides, like a carrier. The first half of the others leave
    below, the second half above.
    """

    text: BoxText = field(kw_only=True)

    @property
    def side(self) -> str:
        """Name of the member whose link leaves at the sides."""
        return self.text.members[next(iter(self.group.planets))]

    @property
    def _slot(self) -> float:
        wheels = [self.text.members[wheel.member] for wheel in self.group.wheels]
        return max(map(width, wheels), default=0.0) + SLOT_GAP

    @property
    def half(self) -> float:
        """Half the height of the box [pt]."""
        return self.letters * (LINE * (self.text.lines + 1.5) + PAD)

    @property
    def tall(self) -> float:
        """Height needed above the middle of the row [pt]."""
        has_ground = any(wheel.link == HOUSING for wheel in self.group.wheels)
        return self.half + GROUND * has_ground

    @property
    def width(self) -> float:
        """Distance between the outer ends of the lines at both sides [pt]."""
        middle = max(self.text.size[0], width(self.side))
        inner = max(middle, self._slot * len(self.columns), LEAST_BOX) + 2 * PAD
        return self.letters * inner + 2 * ARM

    @property
    def faces(self) -> Span:
        """Positions of the left and right edge of the box [pt]."""
        return ARM, self.width - ARM

    @property
    def pin_end(self) -> float:
        """Position of the right edge of the box [pt]."""
        return self.faces[1]

    def x(self, column: int) -> float:
        """Return the position of the members in a column, below and above the box [pt]."""
        place = column - (len(self.columns) - 1) / 2
        return self.width / 2 + self.letters * self._slot * place

    def radius(self, rim: str) -> float:  # noqa: ARG002 - the edges of a box are level
        """Return half the height of the box, less the distance of meshing gears [pt]."""
        return self.half - MESH


def boxes_of(scheme: Scheme, style: Style) -> tuple[dict[int, HalfSection], dict[int, BoxText]]:
    """Return boxes drawn like gear sets, and texts of boxes on lines, by index in the scheme.

    Examples
    --------
    >>> mechanism = Device("P", "mechanism", {"first": 1, "second": 2, "third": 3}, (0,), ratio=-2)
    >>> pair = Device("pair", "gear_pair", {"first": 1, "second": 3}, (1,))
    >>> rows, lines = boxes_of(Scheme(["a", "b", "c"], [mechanism, pair], []), Style())
    >>> rows[0].text[:2], lines[1][:2]
    (('P', 'u = −2'), ('pair', 'gear pair'))
    """
    sections: dict[int, HalfSection] = {}
    texts: dict[int, BoxText] = {}
    for index, device in enumerate(scheme.devices):
        if device.is_coupling:
            continue
        text = _text(device, style)
        if len(device.links) == 2 and HOUSING not in device.members.values():
            texts[index] = text
        else:
            sections[index] = _section(device, text)
    return sections, texts


def _text(device: Device, style: Style) -> BoxText:
    is_bare = device.kind == "mechanism"
    note = ratio_text(device.ratio) if is_bare else word(device.kind, style)
    members = {
        member: typeset(device.labels[member]) if member in device.labels else word(member, style)
        for member in device.members
    }
    return BoxText(lines_of(device.name, BOX_NAME_LETTERS), note, members)


def _section(device: Device, text: BoxText) -> BoxSection:
    """Return the box of a component. The carrier, or else the last link, leaves at the sides."""
    rotating = [member for member, link in device.members.items() if link != HOUSING]
    side = "carrier" if "carrier" in rotating else rotating[-1]
    columns = [
        WheelColumn({0: side}, *(wheel and wheel._replace(rim=side) for wheel in pair))
        for pair in _wheels(device, side)
    ]
    wheels = [wheel for column in columns for wheel in (column.sun, column.ring) if wheel]
    group = PlanetGroup(device.members[side], wheels, {side: {side: Fraction(1)}})
    return BoxSection(group, {side: 0}, columns, text=text)


def _wheels(device: Device, side: str) -> list[tuple[CentralWheel | None, CentralWheel | None]]:
    """Return the members below and above each column: suns and rings, or all except `side`."""
    element = device.element
    if element is not None and isinstance(element.shape, Planetary) and side == "carrier":
        return [(column.sun, column.ring) for column in section_of(group_of(element)).columns]
    others = [member for member in device.members if member != side]
    half = max(1, (len(others) + 1) // 2)
    wheels = [
        CentralWheel(member, device.members[member], 1, internal=place >= half, rim=side)
        for place, member in enumerate(others)
    ]
    return [*zip_longest(wheels[:half], wheels[half:])] or [(None, None)]
