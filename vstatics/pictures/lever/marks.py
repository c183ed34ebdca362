"""Symbols of lever diagrams, collected by style; lengths in points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.core.model.transmission import HOUSING
from vstatics.pictures.drawing.canvas import Look, Outline, Point
from vstatics.pictures.drawing.gear_state import PictureState
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.pen import Pen, corners
from vstatics.pictures.lever.places import LeverPage

ARROW_HEAD = 5.0
"""Length of the head of an arrow."""
_TURNS = [step * math.pi / 6 for step in range(12)]
MARKS: dict[str, Sequence[Point]] = {
    "in": [(2.8 * math.cos(turn), 2.8 * math.sin(turn)) for turn in _TURNS],
    "out": [(-3.6, 0), (0, 3.6), (3.6, 0), (0, -3.6)],
    "stands": [(-2.7, -2.7), (-2.7, 2.7), (2.7, 2.7), (2.7, -2.7)],
    "port": [(-3.2, -2.4), (0, 3.2), (3.2, -2.4)],
    "": [(-1.7, 0), (0, 1.7), (1.7, 0), (0, -1.7)],
}
"""Corners of the mark of each kind of point, relative to the point."""
MARK_SIZE = 6.0
"""Distance of two points below which their marks overlap."""


class LeverSheet(NamedTuple):
    """Canvas of levers; lines and areas of equal style are drawn together."""

    pen: Pen
    page: LeverPage
    speeds: Span
    """Smallest and largest speed. [-]"""
    per_torque: float
    """Length of an arrow per torque."""
    lines: dict[tuple[str, float, Any], list[Sequence[Point]]]
    """Lines that are drawn together, by colour, width and dashes."""
    areas: dict[str, list[Outline]]
    """Polygons that are drawn together, by colour."""

    def line(self, *places: Point, colour: str, width: float = 1.0, dash: Any = "solid") -> None:
        """Add a line through points, without intermediate points of horizontal parts."""
        corners_ = list(places[:1])
        for (x, y), (_, after) in pairwise(places[1:]):
            if not corners_[-1][1] == y == after:
                corners_.append((x, y))
        self.lines.setdefault((colour, width, dash), []).append([*corners_, places[-1]])

    def area(self, *corners: Point, colour: str) -> None:
        """Add a filled polygon."""
        self.areas.setdefault(colour, []).append(Outline.polygon(corners))

    def point(self, place: Point, kind: str, colour: str, *, is_over: bool = False) -> None:
        """Add a mark of a kind in `MARKS`, optionally with an outline over other marks."""
        x, y = place
        edges = [(x + right, y + up) for right, up in MARKS[kind]]
        if is_over:
            look: Look = {"facecolor": colour, "edgecolor": self.pen.style.paper, "width": 0.8}
            self.pen.area(*edges, zorder=2.6, **look)
        else:
            self.area(*edges, colour=colour)

    def put(self) -> None:
        """Draw everything, with an artist for each style, and broad lines over thin lines."""
        for (colour, width, dash), some in self.lines.items():
            over = 2 + width / 10
            self.pen.lines(some, width=width, color=colour, linestyle=dash, zorder=over)
        for colour, polygons in self.areas.items():
            points = [point for polygon in polygons for point in polygon.points]
            outline = Outline(points, "".join(polygon.steps for polygon in polygons))
            self.pen.fill(outline, facecolor=colour, zorder=2.5)


def mark_of(link: int, state: PictureState, *, stands: bool) -> str:
    """Return the key of `MARKS` for the point of a link, including links joined to the ports.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.pictures.drawing.gear_state import state_of
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> mark_of(1, state, stands=False), mark_of(2, state, stands=True)
    ('in', 'stands')
    """
    body, gear = state.joined[link], state.gear
    if stands or body == HOUSING:
        return "stands"
    if link == state.output:
        return "out"  # also in direct drive
    if body == state.joined[state.input]:
        return "in"
    if body == state.joined[state.output]:
        return "out"
    return "port" if link in gear.speeds or link in gear.torques else ""


def arrow(sheet: LeverSheet, tip: Point, length: float) -> None:
    """Draw an arrow that ends at a point, or starts there if the length is negative."""
    (x, y), size, colour = tip, abs(length), sheet.pen.style.ink
    head = min(ARROW_HEAD, max(size, 3.0))
    start, end, way = (x - size, x, 1) if length > 0 else (x, x - size, -1)
    neck = end - way * head
    sheet.line((start, y), (neck, y), colour=colour, width=2.2)
    sheet.area((end, y), (neck, y + 3), (neck, y - 3), colour=colour)


def ground(sheet: LeverSheet, place: Point, colour: str) -> None:
    """Draw a support on the right of a point: a bar with hatches."""
    x, y = place
    sheet.line((x, y - 5), (x, y + 5), colour=colour, width=1.4)
    for up in (-5, -1.5, 2):
        sheet.line((x, y + up + 3), (x + 3.5, y + up), colour=colour, width=0.9)


def plates(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw a clutch on a horizontal or upright line: two opposite plates."""
    for off in (-1.5, 1.5):
        ends = [_turned(place, (off, across), upright=upright) for across in (-5, 5)]
        sheet.line(*ends, colour=sheet.pen.style.engaged, width=1.6)


def coil(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw a spring as a shaft."""
    turns = [(-6 + 2 * step, (0, 3.5, -3.5)[step and 1 + step % 2]) for step in range(6)]
    places = [_turned(place, turn, upright=upright) for turn in (*turns, (6, 0))]
    sheet.line(*places, colour=sheet.pen.style.ink)


def freewheel(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw a holding freewheel: a wedge against a bar."""
    wedge = [_turned(place, off, upright=upright) for off in ((-3.5, 4), (-3.5, -4), (3, 0))]
    sheet.area(*wedge, colour=sheet.pen.style.engaged)
    bar = [_turned(place, (3.5, across), upright=upright) for across in (-5, 5)]
    sheet.line(*bar, colour=sheet.pen.style.engaged, width=1.4)


def cut(sheet: LeverSheet, place: Point, colour: str) -> None:
    """Mark the point where a line continues in the next or previous row of levers."""
    x, y = place
    sheet.line((x - 2, y + 3), (x + 1, y), (x - 2, y - 3), colour=colour, width=1.2)


def _turned(place: Point, off: Point, *, upright: bool) -> Point:
    """Return the point at a distance `off` along and across a line from a place."""
    (x, y), (along, across) = place, off
    return (x + across, y - along) if upright else (x + along, y + across)


def box(sheet: LeverSheet, middle: Point, size: Point, colour: str) -> None:
    """Draw the outline of a rectangle."""
    (x, y), (wide, high) = middle, (size[0] / 2, size[1] / 2)
    edges = corners(x - wide, y - high, x + wide, y + high)
    sheet.line(*edges, edges[0], colour=colour)
