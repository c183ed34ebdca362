"""Symbols of lever diagrams, collected by style to draw many at once; lengths in points."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.pictures.drawing.canvas import Look, Outline, Point
from vstatics.pictures.drawing.gear_state import PictureState
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.pen import Pen, corners, zigzag
from vstatics.pictures.lever.gear import LeverTie
from vstatics.pictures.lever.places import LeverPage, any_freewheel

ARROW_HEAD = 5.0
"""Length of the head of an arrow. [pt]"""
_TURNS = [step * math.pi / 6 for step in range(12)]
MARKS: dict[str, Sequence[Point]] = {
    "in": [(2.8 * math.cos(turn), 2.8 * math.sin(turn)) for turn in _TURNS],
    "out": [(-3.6, 0), (0, 3.6), (3.6, 0), (0, -3.6)],
    "stands": [(-2.7, -2.7), (-2.7, 2.7), (2.7, 2.7), (2.7, -2.7)],
    "port": [(-3.2, -2.4), (0, 3.2), (3.2, -2.4)],
    "": [(-1.7, 0), (0, 1.7), (1.7, 0), (0, -1.7)],
}
"""Corners of the mark of a point, relative to the point, by the kind of point."""
MARK_SIZE = 6.0
"""Smallest distance between two points at which marks do not overlap. [pt]"""


class LeverSheet(NamedTuple):
    """Canvas of a lever diagram, which collects lines and areas of equal style."""

    pen: Pen
    page: LeverPage
    speeds: Span
    """Smallest and largest speed, common to all levers. [-]"""
    per_torque: float
    """Length of the arrow for the input torque. [pt]"""
    lines: dict[tuple[str, float, Any], list[Sequence[Point]]]
    """Collected lines, by colour, width and dashes."""
    areas: dict[str, list[Outline]]
    """Collected areas, by colour."""

    def line(self, *places: Point, colour: str, width: float = 1.0, dash: Any = "solid") -> None:
        """Add a line through points. Needless points on horizontal parts are left out."""
        corners_ = list(places[:1])
        for (x, y), (_, after) in pairwise(places[1:]):
            if not corners_[-1][1] == y == after:
                corners_.append((x, y))
        self.lines.setdefault((colour, width, dash), []).append([*corners_, places[-1]])

    def area(self, *corners: Point, colour: str) -> None:
        """Add a filled polygon."""
        self.areas.setdefault(colour, []).append(Outline.polygon(corners))

    def point(self, place: Point, kind: str, colour: str, *, is_over: bool = False) -> None:
        """Add the mark of a kind of point, optionally with an outline above other marks."""
        x, y = place
        edges = [(x + right, y + up) for right, up in MARKS[kind]]
        if is_over:
            look: Look = {"facecolor": colour, "edgecolor": self.pen.style.paper, "width": 0.8}
            self.pen.area(*edges, zorder=2.6, **look)
        else:
            self.area(*edges, colour=colour)

    def put(self) -> None:
        """Draw everything that was collected, broad lines above thin lines."""
        for (colour, width, dash), some in self.lines.items():
            over = 2 + width / 10
            self.pen.lines(some, width=width, color=colour, linestyle=dash, zorder=over)
        for colour, polygons in self.areas.items():
            points = [point for polygon in polygons for point in polygon.points]
            outline = Outline(points, "".join(polygon.steps for polygon in polygons))
            self.pen.fill(outline, facecolor=colour, zorder=2.5)


def mark_of(link: int, state: PictureState, *, stands: bool) -> str:
    """Return the kind of the point of a link, a key of `MARKS`.

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
        return "out"  # in direct drive, input and output are connected: the output is marked
    if body == state.joined[state.input]:
        return "in"
    if body == state.joined[state.output]:
        return "out"
    return "port" if link in gear.speeds or link in gear.torques else ""


def arrow(sheet: LeverSheet, tip: Point, length: float) -> None:
    """Draw a horizontal arrow that ends at `tip`, or begins there if the length is negative."""
    (x, y), size, colour = tip, abs(length), sheet.pen.style.ink
    head = min(ARROW_HEAD, max(size, 3.0))
    start, end, way = (x - size, x, 1) if length > 0 else (x, x - size, -1)
    neck = end - way * head
    sheet.line((start, y), (neck, y), colour=colour, width=2.2)
    sheet.area((end, y), (neck, y + 3), (neck, y - 3), colour=colour)


def ground(sheet: LeverSheet, place: Point, colour: str) -> None:
    """Draw a support to the right of a point: a bar with hatches."""
    x, y = place
    sheet.line((x, y - 5), (x, y + 5), colour=colour, width=1.4)
    for up in (-5, -1.5, 2):
        sheet.line((x, y + up + 3), (x + 3.5, y + up), colour=colour, width=0.9)


def plates(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw the symbol of a clutch, two opposite plates, on a horizontal or vertical line."""
    for off in (-1.5, 1.5):
        ends = [_turned(place, (off, across), upright=upright) for across in (-5, 5)]
        sheet.line(*ends, colour=sheet.pen.style.engaged, width=1.6)


def coil(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw the symbol of a spring, on a horizontal or vertical line."""
    places = [_turned(place, turn, upright=upright) for turn in zigzag(0.0, 0.0, 6.0, 3.5)]
    sheet.line(*places, colour=sheet.pen.style.ink)


def freewheel(sheet: LeverSheet, place: Point, *, upright: bool = False) -> None:
    """Draw the symbol of a holding freewheel: a wedge against a bar."""
    wedge = [_turned(place, off, upright=upright) for off in ((-3.5, 4), (-3.5, -4), (3, 0))]
    sheet.area(*wedge, colour=sheet.pen.style.engaged)
    bar = [_turned(place, (3.5, across), upright=upright) for across in (-5, 5)]
    sheet.line(*bar, colour=sheet.pen.style.engaged, width=1.4)


SIGNS: dict[str, Callable[..., None]] = {
    "clutch": plates,
    "slack": plates,
    "spring": coil,
    "freewheel": freewheel,
}
"""Functions that draw the symbols of lines, by kind."""


def kind_of(case: Transmission, tie: LeverTie) -> str:
    """Return the kind of the symbol of a clutch or spring, a key of `SIGNS`."""
    held = "freewheel" if any_freewheel(case, [tie.name]) else "clutch"
    return "spring" if tie.is_spring else held


def cut(sheet: LeverSheet, place: Point, colour: str) -> None:
    """Mark the point where a line continues in another row of levers."""
    x, y = place
    sheet.line((x - 2, y + 3), (x + 1, y), (x - 2, y - 3), colour=colour, width=1.2)


def _turned(place: Point, off: Point, *, upright: bool) -> Point:
    """Return a point at an offset along and across a horizontal or vertical line."""
    (x, y), (along, across) = place, off
    return (x + across, y - along) if upright else (x + along, y + across)


def box(sheet: LeverSheet, middle: Point, size: Point, colour: str) -> None:
    """Draw the outline of a rectangle."""
    (x, y), (wide, high) = middle, (size[0] / 2, size[1] / 2)
    edges = corners(x - wide, y - high, x + wide, y + high)
    sheet.line(*edges, edges[0], colour=colour)
