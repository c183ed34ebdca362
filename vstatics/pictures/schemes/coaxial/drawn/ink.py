"""What half-sections are drawn with: a pen, a scheme in a state, and the colours of its parts."""

from __future__ import annotations

from typing import Any, NamedTuple

from vstatics.pictures.schemes.scheme import Scheme, SchemeState
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.sheet.labels import Point
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import Pen

AXIS_NAME = "1"
"""Of the one axis, in SVG."""


class SchemeInk(NamedTuple):
    """A scheme on paper, in a state."""

    pen: Pen
    scheme: Scheme
    state: SchemeState
    titles: Titles

    def color(self, index: int) -> str:
        """Of a device."""
        style = self.pen.style
        if index in self.state.engaged:
            return style.engaged
        return style.faint if index in self.state.idle else style.ink

    def text_color(self, index: int) -> str:
        """Of the name of a device."""
        return self.pen.style.soft if index in self.state.idle else self.color(index)

    def rod_color(self, index: int) -> str:
        """Of what leads to a coupling."""
        loaded = self.state.loaded
        return self.color(index) if loaded is None or loaded[index] else self.pen.style.faint

    def name_color(self, link: int) -> str:
        """Of the name of a link."""
        return self.pen.style.soft if link in self.state.idle_links else self.pen.style.ink

    def said(self, index: int) -> str:
        """What a device says when a pointer rests on it."""
        return self.titles.devices.get(index, "")

    def of_link(self, name: str) -> Pen:
        """What draws in the group of a link, or of the housing."""
        return self.pen.within("link", name=name, axis=AXIS_NAME)

    def of_device(self, index: int) -> Pen:
        """What draws in the group of a device."""
        device = self.scheme.devices[index]
        kind = "element" if device.is_shift_element else "mechanism"
        return self.pen.within(kind, name=device.name)


def centred(pen: Pen, at: Point, text: str, **look: Any) -> None:
    """A text by its middle."""
    usual: Look = {"ha": "center", "va": "center", "linespacing": 1.0, "zorder": 8}
    pen.text(*at, text, **usual | look)
