"""A half-section with its places: what stands there, what it is called, how large letters are."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Point, height, width
from vstatics.pictures.drawing.words import teeth_alone
from vstatics.pictures.schemes.coaxial.layout import Upright
from vstatics.pictures.schemes.coaxial.places import SIGN_PITCH, SectionPlaces
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.glyphs import DEVICE_NAME_LETTERS, lines_of
from vstatics.pictures.schemes.sets import HalfSection
from vstatics.pictures.schemes.signs import half_of

BOX_ROD = 7.0
"""Length of the line between a box and a bar [pt of letters]."""


class CoaxialLayout(NamedTuple):
    """A half-section with its places."""

    own: CoaxialScheme
    places: SectionPlaces
    is_ordered: bool
    """False if sets should stand in their order, but do not."""
    is_small: bool = False
    """Whether links have no names but those at the ends of the axis."""
    letters: float = 1.0
    """Size of letters over lengths, where lines are drawn smaller and letters are not."""
    line_letters: int = DEVICE_NAME_LETTERS
    """Longer names are broken at blanks."""
    has_teeth_alone: bool = False
    """Whether wheels have their teeth without their names, where these have no room."""
    named_beside: frozenset[int] = frozenset()
    """Links whose names stand at arrows, not on bars."""

    def width(self, text: str, *, bold: bool = False) -> float:
        """Of a text, as lengths are here [pt]."""
        return self.letters * width(text, bold=bold)

    def height(self, text: str) -> float:
        """Of a text, as lengths are here [pt]."""
        return self.letters * height(text)

    def device_name(self, index: int) -> str:
        """In lines."""
        return lines_of(self.own.scheme.devices[index].name, self.line_letters)

    def link_name(self, link: int) -> str:
        """In lines, where it stands on a bar."""
        is_narrow = self.line_letters < DEVICE_NAME_LETTERS
        return lines_of(self.name(link), self.line_letters) if is_narrow else self.name(link)

    @property
    def uprights(self) -> list[Upright]:
        """From left to right."""
        return self.places.frame.uprights

    def section(self, up: Upright) -> HalfSection:
        """A set as it stands there."""
        section = self.own.sections[self.own.sets[up.index]]
        columns = list(section.columns)
        turned = columns[::-1] if up.is_turned else columns
        names = section.names
        if self.has_teeth_alone:
            names = {member: teeth_alone(name) for member, name in names.items()}
        return replace(section, columns=turned, letters=self.letters, names=names)

    def device(self, up: Upright) -> int:
        """The place of a device in the scheme; -1 for what is none."""
        if up.kind == "set":
            return self.own.sets[up.index]
        if up.kind == "pair":
            return self.own.pairs[up.index]
        return self.own.tops[up.index].device if up.kind == "top" else -1

    def name(self, link: int) -> str:
        """Of a link, or of the housing."""
        return "housing" if self.own.is_housing(link) else self.own.scheme.name(link)

    def half(self, up: Upright) -> float:
        """Half the length of the sign of a coupling."""
        return self.box_size(up)[1] / 2 or half_of(self.own.scheme.devices[self.device(up)].sign)

    def box_size(self, up: Upright) -> Point:
        """Width and height of a box on a line [pt]; 0 of a sign."""
        index = self.device(up)
        if index not in self.own.texts:
            return 0.0, 0.0
        wide, high = self.own.texts[index].on_line(self.own.scheme.devices[index], is_level=False)
        return self.letters * wide, self.letters * high

    def middle(self, up: Upright) -> float:
        """Height of the middle of the sign of a coupling [pt]."""
        return sum(self.places.heights[bar] for bar in up.gap) / 2

    def sign_room(self, number: int) -> float:
        """Distance between two bars that the sign of a pair needs [pt]."""
        _, high = self.box_size(Upright("pair", number, []))
        return high + 2 * BOX_ROD * self.letters if high else SIGN_PITCH
