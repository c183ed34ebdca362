"""Drawing tools of schemes: pen, colours of components and links, arrows."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self

from vstatics.core.groups import grouped
from vstatics.core.model.transmission import HOUSING
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.pen import LINE_WIDTH, Pen
from vstatics.pictures.schemes.gear_glyphs import HATCH_WIDTH, TOOTH, hatching
from vstatics.pictures.schemes.scheme import Scheme, SchemePort, SchemeState
from vstatics.pictures.schemes.shift_element_symbols import Coupled, draw_coupled
from vstatics.pictures.schemes.titles import Titles

AXIS_DASHES = (0, (12, 3, 2, 3))
"""Dash pattern of an axis of rotation."""
FURTHER = (0, (1.5, 1.5))
"""Dash pattern of a line that continues in a further row."""
ARROW = 26.0
"""Length of an arrow at the end of a link. [pt]"""
HEAD, HALF_HEAD = 9.0, 3.5
"""Length and half width of an arrow head. [pt]"""
ENTERS = 4.0
"""Distance from the end of a link to the head of an entering arrow. [pt]"""


@dataclass(frozen=True)
class SchemeInk:
    """Pen for a scheme, with the state of a gear."""

    pen: Pen
    scheme: Scheme
    state: SchemeState
    titles: Titles
    axis: int = field(default=1, kw_only=True)
    """Number of the axis about which the links rotate, from 1."""

    def color(self, index: int) -> str:
        """Return the colour of the symbol of a component."""
        style = self.pen.style
        if index in self.state.engaged:
            return style.engaged
        return style.faint if index in self.state.idle else style.ink

    def text_color(self, index: int) -> str:
        """Return the colour of the name of a component."""
        return self.pen.style.soft if index in self.state.idle else self.color(index)

    def rod_color(self, index: int) -> str:
        """Return the colour of the line from a link to a shift element, a spring or a support."""
        loaded = self.state.loaded
        return self.color(index) if loaded is None or loaded[index] else self.pen.style.faint

    def name_color(self, link: int) -> str:
        """Return the colour of the name of a link."""
        return self.pen.style.soft if link in self.state.idle_links else self.pen.style.ink

    def end_color(self, ports: Sequence[SchemePort]) -> str:
        """Return the colour of the line to ports, pale for ports without torque in the gear."""
        state, style = self.state, self.pen.style
        is_used = state.loaded is None or any(port not in state.idle_ports for port in ports)
        return style.ink if is_used else style.faint

    def said(self, index: int) -> str:
        """Return the tooltip of a component."""
        return self.titles.devices.get(index, "")

    def of_link(self, name: str, axis: int = 0) -> Pen:
        """Return a pen for the SVG group of a link or the housing, on the present or given axis."""
        return self.pen.within("link", name=name, axis=str(axis or self.axis))

    def of_device(self, index: int) -> Self:
        """Return a copy that draws into the SVG group of a component."""
        device = self.scheme.devices[index]
        kind = "element" if device.is_shift_element else "mechanism"
        return replace(self, pen=self.pen.within(kind, name=device.name))

    def draw_sign(self, index: int, start: Point, end: Point, housing: int = 0) -> None:
        """Draw the symbol of a component on a line; for the parameters see `Coupled`."""
        device = self.scheme.devices[index]
        look = self.color(index), self.state.is_closed(index), self.rod_color(index), housing
        is_backward = device.members.get("first") == HOUSING
        coupled = Coupled(device.sign, start, end, *look, self.said(index), is_backward)
        draw_coupled(self.of_device(index).pen, coupled)

    def name_sign(self, index: int, at: Point, name: str, **look: Any) -> None:
        """Write the name of a component, bold if it is engaged and does not slip."""
        usual: Look = {"color": self.text_color(index), "bold": self.state.is_closed(index)}
        centred(self.of_device(index).pen, at, name, **usual, **look)

    def draw_strokes(self, index: int, strokes: Iterable[tuple[float, Sequence[Point]]]) -> None:
        """Draw the lines of a gear set by width, hatched if the gear set rotates as a block."""
        pen, looks = self.of_device(index).pen, grouped(strokes)
        if index in self.state.pieces:
            xs, ys = zip(*(point for line in looks[TOOTH] for point in line), strict=True)
            lines = hatching((min(xs), min(ys)), (max(xs), max(ys)))
            pen.lines(lines, color=pen.style.soft, width=HATCH_WIDTH, zorder=1)
        look: Look = {"color": self.color(index), "zorder": 4, "solid_capstyle": "projecting"}
        for thick, places in looks.items():
            title = self.said(index) if thick == LINE_WIDTH else ""
            pen.lines(places, width=thick, title=title, **look)

    def ways(self, ports: Sequence[SchemePort]) -> set[bool]:
        """Return the directions of power at ports: True for leaving, False for entering power.

        Without a solution, input and output have their usual direction, and other ports both
        directions.
        """
        known = {self.state.leaving[port] for port in ports if port in self.state.leaving}
        meant = {port.role == "output" for port in ports if port.role != "given"}
        return known or meant or ({True, False} if ports else set())


def centred(pen: Pen, at: Point, text: str, **look: Any) -> None:
    """Write a text centred at a point."""
    usual: Look = {"ha": "center", "va": "center", "linespacing": 1.0, "zorder": 8}
    pen.text(*at, text, **usual | look)


def draw_arrow(pen: Pen, at: Point, way: Point, ways: Collection[bool], color: str) -> Point:
    """Draw a line from the end of a link, with an arrow head for each direction of power.

    Returns the outer end of the line.
    """
    (x, y), (dx, dy) = at, way
    end = x + dx * ARROW, y + dy * ARROW
    pen.line(at, end, color=color, zorder=3)
    for leaves in ways:
        tip = end if leaves else (x + ENTERS * dx, y + ENTERS * dy)
        back = -HEAD if leaves else HEAD
        base = tip[0] + back * dx, tip[1] + back * dy
        sides = [(base[0] - half * dy, base[1] + half * dx) for half in (HALF_HEAD, -HALF_HEAD)]
        pen.area(tip, *sides, color=color, width=0.5, joinstyle="round", zorder=4)
    return end
