"""Symbols of shift elements between two wires, or between a wire and the housing."""

from __future__ import annotations

from vstatics.pictures.schemes.pen import LINE, Pen, Point

PLATE = 9.0
"""Half the length of a plate. [pt]"""
SPLIT = {"freewheel": 6.0, "dog_clutch": 4.0}
"""Half the length along the line, where it is not that of plates. [pt]"""


def coupling(pen: Pen, kind: str, ends: tuple[Point, Point], color: str, *, closed: bool) -> None:
    """A shift element on a level or upright line, from its first link to its second."""
    start, end = ends
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    length = abs(end[0] - start[0]) + abs(end[1] - start[1])
    dx, dy = (end[0] - start[0]) / length, (end[1] - start[1]) / length

    def at(forward: float, across: float) -> Point:
        return middle[0] + forward * dx - across * dy, middle[1] + forward * dy + across * dx

    half = SPLIT.get(kind, 3.0)
    pen.line(start, at(-half, 0), color=color)
    pen.line(at(half, 0), end, color=color)
    if kind == "freewheel":
        fill = color if closed else pen.style.paper
        pen.shape([at(-half, 6), at(-half, -6), at(half, 0)], fill=fill, edge=color)
        pen.line(at(half, 7), at(half, -7), color=color, width=2.0)
        return
    if closed:
        corners = [at(-half, PLATE), at(half, PLATE), at(half, -PLATE), at(-half, -PLATE)]
        pen.shape(corners, fill=color, edge=color)
    for place in (-half, half):
        pen.line(at(place, PLATE), at(place, -PLATE), color=color, width=2 * LINE)
    if kind == "dog_clutch":
        for side, places in ((-half, (-7.0, 0.0, 7.0)), (half, (-3.5, 3.5))):
            for across in places:  # teeth of the one between teeth of the other
                pen.line(at(side, across), at(-side / 3, across), color=color)
