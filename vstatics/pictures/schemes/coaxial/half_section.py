"""Half-section with positions of components and links, and the size of letters."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.schemes.coaxial.layout import Upright
from vstatics.pictures.schemes.coaxial.places import SIGN_PITCH, SectionPlaces
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.gear_glyphs import DEVICE_NAME_LETTERS, lines_of
from vstatics.pictures.schemes.sets import HalfSection
from vstatics.pictures.schemes.shift_element_symbols import half_of

BOX_ROD = 7.0
"""Length of the line between a box and the bar of a link. [pt, scaled with letters]"""


class CoaxialLayout(NamedTuple):
    """Half-section with the positions of all components and links."""

    coaxial: CoaxialScheme
    places: SectionPlaces
    is_ordered: bool
    """False if gear sets should be in the order of the case but could not be."""
    is_small: bool = False
    """True to name only the links at the ends of the axis."""
    letters: float = 1.0
    """Ratio of the size of letters to lengths; above 1 in a reduced drawing. [-]"""
    line_letters: int = DEVICE_NAME_LETTERS
    """Number of letters above which a name is broken at a blank."""
    has_teeth_alone: bool = False
    """True to label gears by tooth numbers without names."""
    named_beside: frozenset[int] = frozenset()
    """Numbers of links whose names are next to arrows instead of on bars."""

    def width(self, text: str, *, bold: bool = False) -> float:
        """Return the width of a text in the unreduced lengths of the layout [pt]."""
        return self.letters * width(text, bold=bold)

    def height(self, text: str) -> float:
        """Return the height of a text in the unreduced lengths of the layout [pt]."""
        return self.letters * height(text)

    def device_name(self, index: int) -> str:
        """Return the name of a component, wrapped into lines."""
        return lines_of(self.coaxial.scheme.devices[index].name, self.line_letters)

    def link_name(self, link: int) -> str:
        """Return the name of a link for a bar, wrapped into lines in a narrow picture."""
        is_narrow = self.line_letters < DEVICE_NAME_LETTERS
        return lines_of(self.name(link), self.line_letters) if is_narrow else self.name(link)

    @property
    def uprights(self) -> list[Upright]:
        """Uprights: components and the ends of the axis, from left to right."""
        return self.places.frame.uprights

    def section(self, up: Upright) -> HalfSection:
        """Return the half-section of the gear set at an upright, mirrored if needed."""
        section = self.coaxial.sections[self.coaxial.sets[up.index]]
        section = section.with_teeth_alone() if self.has_teeth_alone else section
        columns = section.columns[:: -1 if up.is_turned else 1]
        return replace(section, columns=columns, letters=self.letters)

    def device(self, up: Upright) -> int:
        """Return the index in the scheme of the component at an upright; -1 without a component."""
        if up.kind == "set":
            return self.coaxial.sets[up.index]
        if up.kind == "pair":
            return self.coaxial.pairs[up.index]
        return self.coaxial.tops[up.index].device if up.kind == "top" else -1

    def name(self, link: int) -> str:
        """Return the name of a link or of the housing."""
        return "housing" if self.coaxial.is_housing(link) else self.coaxial.scheme.name(link)

    def half(self, up: Upright) -> float:
        """Return half the length of a shift element's or shaft's symbol [pt]."""
        return self.box_size(up)[1] / 2 or half_of(
            self.coaxial.scheme.devices[self.device(up)].sign
        )

    def box_size(self, up: Upright) -> Point:
        """Return width and height of a box on a line [pt]; 0 for a symbol."""
        index = self.device(up)
        if index not in self.coaxial.texts:
            return 0.0, 0.0
        wide, high = self.coaxial.texts[index].on_line(
            self.coaxial.scheme.devices[index], is_level=False
        )
        return self.letters * wide, self.letters * high

    def middle(self, up: Upright) -> float:
        """Return the height of the middle of a shift element's or shaft's symbol [pt]."""
        return sum(self.places.heights[bar] for bar in up.gap) / 2

    def sign_room(self, number: int) -> float:
        """Return the distance between two links that the symbol in between needs [pt]."""
        _, high = self.box_size(Upright("pair", number, []))
        return high + 2 * BOX_ROD * self.letters if high else SIGN_PITCH
