"""Drawing of links in a half-section: lines, dots at branches, bridges at crossings, names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.labels import Segment, height, width
from vstatics.pictures.drawing.pen import Pen, corners
from vstatics.pictures.schemes.coaxial.drawn.lines import Wires, meeting
from vstatics.pictures.schemes.coaxial.drawn.passing import passed
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import (
    BRAKE_LENGTH,
    LINK_NAME_GAP,
    loose_names,
)
from vstatics.pictures.schemes.ink import SchemeInk, centred

BRIDGE, BRIDGE_GAP = 5.0, 1.4
"""Half the length and half the width of a bridge over a crossed line. [pt]"""


def draw_links(ink: SchemeInk, layout: CoaxialLayout, wires: Wires) -> None:
    """Draw the lines of all links, pale in sections without torque."""
    style, loaded = ink.pen.style, ink.state.loaded
    ends = [*wires.met, *_port_points(ink, layout, wires)]
    for link, lines in wires.lines.items():
        pen = ink.of_link(layout.name(link))
        runs = [(line, True) for line in lines]
        points = {at for line in lines for at in line}
        if loaded is not None and not layout.coaxial.is_housing(link):
            met = {p for name, d, p in ends if name == link and (d < 0 or link in loaded[d])}
            runs, points = passed(lines, met)
        look: Look = {"title": ink.titles.links.get(link, ""), "zorder": 3}
        for color, there in ((style.faint, False), (style.ink, True)):
            segments = [line for line, has_torque in runs if has_torque == there]
            pen.lines(segments, color=color, kind="wire", solid_capstyle="projecting", **look)
        _joints(pen, lines, points)
    for x, y in wires.crossings:
        gaps = [((x + way * BRIDGE, y), (x + way * BRIDGE_GAP, y)) for way in (-1, 1)]
        ink.pen.lines(gaps, color=style.paper, width=3.0, kind="crossing", zorder=3.5)


def draw_link_names(ink: SchemeInk, layout: CoaxialLayout) -> None:
    """Write names of links on bars, and next to the ends of unconnected members."""
    scale = ink.pen.letters
    for link, at in layout.places.names.items():
        name = layout.link_name(link)
        half, high = (width(name) / 2 + 1.5) * scale, (height(name) / 2 - 1.0) * scale
        paper = corners(at[0] - half, at[1] - high, at[0] + half, at[1] + high)
        # The background of a name belongs to the SVG group of the link.
        pen = ink.of_link(layout.name(link))
        pen.area(*paper, color=pen.style.paper, zorder=3.6)
        centred(pen, at, name, color=ink.name_color(link))
    for up, x in zip(layout.uprights, layout.places.at, strict=True):
        for link, by, y in loose_names(layout, up):
            look: Look = {"color": ink.name_color(link), "ha": "left"}
            pen = ink.of_link(layout.name(link))
            centred(pen, (x + by + LINK_NAME_GAP, y), layout.name(link), **look)


def _joints(pen: Pen, lines: Sequence[Segment], points: set[Point]) -> None:
    branches = dict.fromkeys(
        at
        for first, second in combinations(lines, 2)
        if (at := meeting(first, second)) and not (at in first and at in second)
    )
    look: Look = {"width": 4.0, "zorder": 6, "solid_capstyle": "round", "snap": False}
    for color, there in ((pen.style.faint, False), (pen.style.ink, True)):
        dots = [((x, y), (x + 0.1, y)) for x, y in branches if ((x, y) in points) == there]
        pen.lines(dots, color=color, **look)


def _port_points(
    ink: SchemeInk, layout: CoaxialLayout, wires: Wires
) -> Iterator[tuple[int, int, Point]]:
    """Yield each port of the transmission: the link, -1 for the component, and the point."""
    used = {port.link for port in layout.coaxial.scheme.ports if port not in ink.state.idle_ports}
    for link, at_end, _ in wires.ends:
        if link in used:
            yield link, -1, at_end
    for up, at in zip(layout.uprights, layout.places.at, strict=True):
        if up.kind == "top" and layout.coaxial.tops[up.index].port:
            yield up.bars[0].link, -1, (at, layout.places.housing - BRAKE_LENGTH)
