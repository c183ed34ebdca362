"""Links of a half-section: wires, dots where they branch, bridges where two cross, names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from vstatics.pictures.drawing.labels import Point, Segment, height, width
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen, corners
from vstatics.pictures.schemes.coaxial.drawn.lines import meeting, wires_of
from vstatics.pictures.schemes.coaxial.drawn.passing import passed
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import BRAKE, NAME_GAP, ends_of, loose_names
from vstatics.pictures.schemes.ink import SchemeInk, centred

BRIDGE, BRIDGE_GAP = 5.0, 1.4
"""How far a bridge reaches from a crossing, and half its gap. [pt]"""


def draw_links(ink: SchemeInk, layout: CoaxialLayout) -> None:
    """All links; what carries no torque is pale."""
    wires = wires_of(layout)
    style, loaded = ink.pen.style, ink.state.loaded
    ends = [*wires.met, *_port_points(ink, layout)]
    for link, lines in wires.lines.items():
        pen = ink.of_link(layout.name(link))
        runs = [(line, True) for line in lines]
        points = {at for line in lines for at in line}
        if loaded is not None and not layout.own.is_housing(link):
            met = {p for one, d, p in ends if one == link and (d < 0 or link in loaded[d])}
            runs, points = passed(lines, met)
        look: Look = {"title": ink.titles.links.get(link, ""), "zorder": 3}
        for color, there in ((style.faint, False), (style.ink, True)):
            own = [line for line, one in runs if one == there]
            pen.lines(own, color=color, kind="wire", solid_capstyle="projecting", **look)
        _joints(pen, lines, points)
    for x, y in wires.crossings():
        gaps = [((x + way * BRIDGE, y), (x + way * BRIDGE_GAP, y)) for way in (-1, 1)]
        ink.pen.lines(gaps, color=style.paper, width=3.0, kind="crossing", zorder=3.5)


def draw_link_names(ink: SchemeInk, layout: CoaxialLayout) -> None:
    """Names on bars, and beside the ends of members that nothing else joins."""
    scale = ink.pen.letters
    for link, at in layout.places.names.items():
        name = layout.link_name(link)
        half, high = (width(name) / 2 + 1.5) * scale, (height(name) / 2 - 1.0) * scale
        paper = corners(at[0] - half, at[1] - high, at[0] + half, at[1] + high)
        pen = ink.of_link(layout.name(link))  # the paper, too: what is in a group stays together
        pen.area(*paper, color=pen.style.paper, zorder=3.6)
        centred(pen, at, name, color=ink.name_color(link))
    for up, x in zip(layout.uprights, layout.places.at, strict=True):
        for link, by, y in loose_names(layout, up):
            look: Look = {"color": ink.name_color(link), "ha": "left"}
            pen = ink.of_link(layout.name(link))
            centred(pen, (x + by + NAME_GAP, y), layout.name(link), **look)


def _joints(pen: Pen, lines: Sequence[Segment], points: set[Point]) -> None:
    """Dots where a link branches."""
    found: dict[Point, int] = {}
    for one, other in combinations(lines, 2):
        at = meeting(one, other)
        if at is not None and (at not in one or at not in other):
            found[at] = found.get(at, 0) + 1
    look: Look = {"width": 4.0, "zorder": 6, "solid_capstyle": "round", "snap": False}
    for color, there in ((pen.style.faint, False), (pen.style.ink, True)):
        dots = [(x, y) for x, y in found if ((x, y) in points) == there]
        pen.lines([((x, y), (x + 0.1, y)) for x, y in dots], color=color, **look)


def _port_points(ink: SchemeInk, layout: CoaxialLayout) -> Iterator[tuple[int, int, Point]]:
    """Where torque comes and goes by ports; -1 stands for a device."""
    (left, right), train = ends_of(layout), layout.own.train
    used = {port.link for port in layout.own.scheme.ports if port not in ink.state.idle_ports}
    for link, x in ((train.start, left), (train.end, right)):
        if link in used:
            yield link, -1, (x, layout.places.axis)
    for up, at in zip(layout.uprights, layout.places.at, strict=True):
        if up.kind == "top" and layout.own.tops[up.index].port:
            yield up.bars[0].link, -1, (at, layout.places.housing - BRAKE)
