"""Arrows of ports: input and output with the direction of power, and continuations."""

from __future__ import annotations

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.schemes.coaxial.rooms import PORT_NAME
from vstatics.pictures.schemes.ink import ARROW, FURTHER, SchemeInk, centred, draw_arrow
from vstatics.pictures.schemes.scheme import SchemePort


def draw_end(ink: SchemeInk, link: int, at: Point, way: float) -> None:
    """Draw the arrow and the name of a link that leaves in a direction along the axis."""
    ports = [port for port in ink.scheme.ports if port.link == link]
    port = min(
        ports,
        key=lambda candidate: (candidate in ink.state.idle_ports, candidate.is_left != (way < 0)),
    )
    port_arrow(ink, port, at, (way, 0.0))
    name = at[0] + way * (ARROW + PORT_NAME), at[1]
    ha = "left" if way > 0 else "right"
    centred(ink.pen, name, ink.scheme.name(link), color=ink.name_color(link), ha=ha)


def port_arrow(ink: SchemeInk, port: SchemePort, at: Point, way: Point) -> None:
    """Draw the arrow of a port in the direction of power, if known."""
    color, (x, y), (dx, dy) = ink.end_color([port]), at, way
    if port.is_further:
        end = x + dx * ARROW, y + dy * ARROW
        ink.pen.line(at, end, color=color, zorder=3, linestyle=FURTHER)
        return
    pen = ink.pen.within("port", port="input" if port.role == "input" else "output")
    draw_arrow(pen, at, way, ink.ways([port]), color)
