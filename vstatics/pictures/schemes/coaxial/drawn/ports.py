"""Arrows of ports: input and output, which way their power goes, and what goes on elsewhere."""

from __future__ import annotations

from vstatics.pictures.schemes.coaxial.drawn.ink import SchemeInk, centred
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import PORT, PORT_NAME, ends_of
from vstatics.pictures.schemes.scheme import SchemePort
from vstatics.pictures.schemes.sheet import FURTHER
from vstatics.pictures.sheet.labels import Point

HEAD, HALF_HEAD = 9.0, 3.5
"""Length and half the width of the head of an arrow. [pt]"""
ENTERS = 4.0
"""From the end of a link to the head of an arrow that points to it. [pt]"""


def draw_ports(ink: SchemeInk, layout: CoaxialLayout) -> None:
    """Those at both ends of the axis."""
    (left, right), train = ends_of(layout), layout.own.train
    for link, x, way in ((train.start, left, -1.0), (train.end, right, 1.0)):
        if link:
            draw_end(ink, link, (x, layout.places.axis), way)


def draw_end(ink: SchemeInk, link: int, at: Point, way: float) -> None:
    """The arrow of a link that leaves along the axis, with its name."""
    own = [port for port in ink.scheme.ports if port.link == link]
    port = min(own, key=lambda one: (one in ink.state.idle_ports, one.is_left != (way < 0)))
    port_arrow(ink, port, at, (way, 0.0))
    name = at[0] + way * (PORT + PORT_NAME), at[1]
    ha = "left" if way > 0 else "right"
    centred(ink.pen, name, ink.scheme.name(link), color=ink.name_color(link), ha=ha)


def port_arrow(ink: SchemeInk, port: SchemePort, at: Point, way: Point) -> None:
    """The arrow goes where power goes, as far as is known."""
    (x, y), (dx, dy) = at, way
    color = ink.pen.style.faint if port in ink.state.idle_ports else ink.pen.style.ink
    end = x + dx * PORT, y + dy * PORT
    if port.is_further:
        ink.pen.line(at, end, color=color, zorder=3, linestyle=FURTHER)
        return
    pen = ink.pen.within("port", port="input" if port.role == "input" else "output")
    pen.line(at, end, color=color, zorder=3)
    known = ink.state.leaving.get(port)
    ways = {known} if known is not None else {port.role != "input"}
    ways = {True, False} if port.role == "given" and known is None else ways
    for leaves in ways:
        tip = end if leaves else (x + ENTERS * dx, y + ENTERS * dy)
        back = -HEAD if leaves else HEAD
        base = tip[0] + back * dx, tip[1] + back * dy
        sides = [(base[0] - half * dy, base[1] + half * dx) for half in (HALF_HEAD, -HALF_HEAD)]
        pen.area(tip, *sides, color=color, width=0.5, joinstyle="round", zorder=4)
