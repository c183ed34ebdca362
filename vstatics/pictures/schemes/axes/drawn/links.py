"""Canvas of a gearbox with several axes in a gear, and drawing of links with names and ports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.pen import LINE_WIDTH
from vstatics.pictures.drawing.style import SMALL
from vstatics.pictures.schemes.axes.contacts import ROAD_RADIUS
from vstatics.pictures.schemes.axes.letters.extent import AxesLetters
from vstatics.pictures.schemes.axes.letters.link_names import END_NAME_GAP, ends_of
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.wires import LinkLines, branches, crossings, link_lines
from vstatics.pictures.schemes.coaxial.drawn.passing import passed
from vstatics.pictures.schemes.ink import AXIS_DASHES, SchemeInk, centred, draw_arrow

DOT = 4.2
"""Diameter of the dot where the line of a link branches. [pt]"""
BRIDGE = 3.0
"""Half the length of the gap in a line at a crossing. [pt]"""


@dataclass(frozen=True)
class AxesSheet(SchemeInk):
    """Canvas of a stick diagram with several axes, in a gear or without a gear."""

    placing: AxesPlaces
    letters: AxesLetters

    def is_used(self, index: int, link: int) -> bool:
        """Return True if torque passes between a link and a component.

        An index below 0 stands for an input or output.
        """
        if self.state.loaded is None:
            return True
        if index < 0:
            return link not in {port.link for port in self.state.idle_ports}
        return link in self.state.loaded[index]

    def line_color(self, index: int, link: int) -> str:
        """Return the colour of the line from a link to a component, or to an input or output."""
        return self.pen.style.ink if self.is_used(index, link) else self.pen.style.faint

    def name(self, index: int) -> None:
        """Write the name of a component, and the tooth numbers if wanted."""
        sheet = self.of_device(index)
        is_bold = index in self.state.engaged or not self.scheme.devices[index].is_coupling
        for label in self.letters.labels.get(index, ()):
            look: Look = {"bold": is_bold} if label.is_name else {"size": SMALL}
            sheet.text(label.at, label.text, color=self.text_color(index), **look)

    def text(self, at: Point, text: str, **look: Any) -> None:
        """Write a text centred at a point, above all lines."""
        centred(self.pen, at, text, **{"over": True} | look)


def draw_links(sheet: AxesSheet) -> None:
    """Draw the axes, and the lines of all links with the crossings."""
    placing, pen = sheet.placing, sheet.pen
    for axis in dict.fromkeys(placing.axis_of(link) for link in sorted(placing.spans)):
        left, right = ends_of(placing, axis)
        y = placing.y(axis, 0.0)
        look: Look = {"color": pen.style.faint, "linestyle": AXIS_DASHES, "zorder": 1, "width": 0.7}
        pen.line((left - 8, y), (right + 8, y), kind="axis", data={"axis": str(axis + 1)}, **look)
    lines = link_lines(placing)
    for link, wires in lines.items():
        _draw_link(sheet, link, wires)
    for crossing in crossings(lines):
        x, y = crossing.at
        ends, paper = ((x - BRIDGE, y), (x + BRIDGE, y)), pen.style.paper
        pen.line(*ends, kind="crossing", width=3.0, color=paper, zorder=3.1)


def _draw_link(sheet: AxesSheet, link: int, wires: LinkLines) -> None:
    placing, style = sheet.placing, sheet.pen.style
    axis, span = placing.axis_of(link), placing.spans[link]
    pen = sheet.of_link(sheet.scheme.name(link), axis + 1)
    title = sheet.titles.links.get(link, "")
    look: Look = {"solid_capstyle": "projecting", "zorder": 3}
    runs = [(wires.level, True)]
    if sheet.state.loaded is not None:
        met = {
            (contact.x, wires.level[0][1])
            for contact in placing.contacts
            if contact.link == link
            and sheet.is_used(contact.device, link)
            and not (contact.kind == "road" and link in sheet.state.idle_links)
        }
        runs, _ = passed([wires.level], met)
    for line, is_used in runs:
        color = style.ink if is_used else style.faint
        pen.line(*line, color=color, kind="wire", title=title, **look)
        if span.level > 0:  # the line of a hollow shaft is repeated below the axis
            y = placing.y(axis, -span.height)
            pen.line(*((x, y) for x, _ in line), color=color, **look)
    for device, path in wires.upright:
        color = sheet.line_color(device, link)
        look["zorder"] = 3.3 if color == style.ink else 3.2
        pen.line(*path, color=color, kind="wire", title=title, **look)
    dots = grouped(
        (at, sheet.is_used(device, link)) for device, at in branches(placing, link, wires)
    )
    for (x, y), are_used in dots.items():
        color = style.ink if any(are_used) else style.faint
        dot: Look = {"width": DOT, "zorder": 3.6, "solid_capstyle": "round", "snap": False}
        pen.line((x, y), (x + 0.1, y), color=color, **dot)
    if link in placing.board.road_wheels:
        _road_wheel(sheet, link)


def _road_wheel(sheet: AxesSheet, link: int) -> None:
    """Draw the section of a tyre above and below the axis, and the ground."""
    placing, style = sheet.placing, sheet.pen.style
    x, y = placing.road_end(link), placing.y(placing.axis_of(link), 0.0)
    pen = sheet.pen.within("road-wheel", link=sheet.scheme.name(link))
    color = style.faint if link in sheet.state.idle_links else style.ink
    look: Look = {"color": color, "title": sheet.titles.links.get(link, ""), "zorder": 3.4}
    rim = ROAD_RADIUS - 9.0
    pen.line((x, y - rim), (x, y + rim), **look)
    outline = ((-2.5, 0), (-4.5, 2), (-4.5, 7), (-3, 9), (3, 9), (4.5, 7), (4.5, 2), (2.5, 0))
    for way in (1, -1):
        corners = [(x + across, y + way * (rim + up)) for across, up in outline]
        filled: Look = {"facecolor": style.paper, "edgecolor": color, "zorder": 3.5}
        pen.area(*corners, width=LINE_WIDTH, joinstyle="round", **filled)


def draw_ends(sheet: AxesSheet) -> None:
    """Draw inputs and outputs with the names of the links, and other link names with room."""
    placing = sheet.placing
    for port in sheet.scheme.ports:
        x, y, way = placing.end_of(port.link)
        pen = sheet.pen.within("port", port="input" if port.role == "input" else "output")
        x, y = draw_arrow(pen, (x, y), (way, 0.0), sheet.ways([port]), sheet.end_color([port]))
        look: Look = {"color": sheet.name_color(port.link), "ha": "left" if way > 0 else "right"}
        sheet.text((x + way * END_NAME_GAP, y), sheet.scheme.name(port.link), **look)
    for link, at, aligned in sheet.letters.free:
        sheet.text(at, sheet.scheme.name(link), ha=aligned, color=sheet.name_color(link))
