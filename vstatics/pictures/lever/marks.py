"""Signs of lever diagrams, collected by their look; lengths in points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from vstatics.model.transmission import HOUSING
from vstatics.pictures.sheet.gear_state import PictureState
from vstatics.pictures.sheet.labels import Paper, Point
from vstatics.pictures.sheet.style import Style

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
"""Kind of point -> corners of its mark."""


class Inks(NamedTuple):
    """Lines and areas of one look, collected to be drawn at once."""

    lines: dict[tuple[Any, ...], list[Sequence[Point]]]
    """Colour, width, dash -> lines."""
    areas: dict[str, list[Sequence[Point]]]
    """Colour -> polygons."""

    def line(self, *places: Point, colour: str, width: float = 1.0, dash: Any = "solid") -> None:
        """A line through places; those on the way of a level line are left out."""
        kept = list(places[:1])
        for (x, y), (_, after) in pairwise(places[1:]):
            if not kept[-1][1] == y == after:
                kept.append((x, y))
        kept.append(places[-1])
        self.lines.setdefault((colour, width, dash), []).append(kept)

    def point(self, place: Point, kind: str, colour: str) -> None:
        """A mark at a place; its kind is one of `MARKS`."""
        x, y = place
        self.area(*((x + right, y + up) for right, up in MARKS[kind]), colour=colour)

    def area(self, *corners: Point, colour: str) -> None:
        """A filled polygon."""
        self.areas.setdefault(colour, []).append(corners)

    def put(self, paper: Paper) -> None:
        """Draw all of it, one artist for each look, broad lines over thin ones."""
        for (colour, width, dash), some in self.lines.items():
            xs = [x for one in some for x in (*(x for x, _ in one), math.nan)]
            ys = [y for one in some for y in (*(y for _, y in one), math.nan)]
            paper.add(
                Line2D(
                    xs,
                    ys,
                    color=colour,
                    linewidth=width,
                    linestyle=dash,
                    solid_capstyle="butt",
                    zorder=2 + width / 10,
                )
            )
        for colour, polygons in self.areas.items():
            codes = [
                code
                for one in polygons
                for code in (Path.MOVETO, *[Path.LINETO] * (len(one) - 1), Path.CLOSEPOLY)
            ]
            path = Path([place for one in polygons for place in (*one, one[0])], codes)
            paper.add(PathPatch(path, facecolor=colour, edgecolor="none", zorder=2.5))


def inks() -> Inks:
    """Nothing drawn yet."""
    return Inks({}, {})


def mark_of(link: int, state: PictureState, *, stands: bool) -> str:
    """What the point of a link is, a key of `MARKS`: also what is joined to input and output.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.pictures.sheet.gear_state import state_of
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> mark_of(1, state, stands=False), mark_of(2, state, stands=True)
    ('in', 'stands')
    """
    body, gear = state.joined[link], state.gear
    if stands or body == HOUSING:
        return "stands"
    if link == state.output:
        return "out"  # also where the input is joined to it
    if body == state.joined[state.input]:
        return "in"
    if body == state.joined[state.output]:
        return "out"
    return "port" if link in gear.speeds or link in gear.torques else ""


def arrow(drawn: Inks, tip: Point, length: float, colour: str) -> None:
    """An arrow along a line, to the right up to a place or, if it is negative, from there."""
    (x, y), size = tip, abs(length)
    head = min(ARROW_HEAD, max(size, 3.0))
    start, end, way = (x - size, x, 1) if length > 0 else (x, x - size, -1)
    drawn.line((start, y), (end - way * head, y), colour=colour, width=2.2)
    drawn.area((end, y), (end - way * head, y + 3), (end - way * head, y - 3), colour=colour)


def ground(drawn: Inks, place: Point, colour: str) -> None:
    """What holds a point: a bar with hatches, right of a place."""
    x, y = place
    drawn.line((x, y - 5), (x, y + 5), colour=colour, width=1.4)
    for up in (-5, -1.5, 2):
        drawn.line((x, y + up + 3), (x + 3.5, y + up), colour=colour, width=0.9)


def plates(drawn: Inks, place: Point, style: Style) -> None:
    """A clutch: two plates that face one another."""
    x, y = place
    for side in (-1.5, 1.5):
        drawn.line((x + side, y - 5), (x + side, y + 5), colour=style.engaged, width=1.6)


def coil(drawn: Inks, place: Point, style: Style) -> None:
    """A spring as shaft."""
    x, y = place
    zigzag = [(x - 6 + 2 * step, y + (0, 3.5, -3.5)[step and 1 + step % 2]) for step in range(6)]
    drawn.line(*zigzag, (x + 6, y), colour=style.ink)


def box(drawn: Inks, middle: Point, size: Point, colour: str) -> None:
    """The outline of a rectangle."""
    (x, y), (wide, high) = middle, (size[0] / 2, size[1] / 2)
    corners = [
        (x - wide, y - high),
        (x + wide, y - high),
        (x + wide, y + high),
        (x - wide, y + high),
    ]
    drawn.line(*corners, corners[0], colour=colour)
