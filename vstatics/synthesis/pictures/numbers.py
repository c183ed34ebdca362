"""Numbers beside points, so that they cover no other number and few points."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from vstatics.pictures.drawing.labels import LABEL_GAP, Point, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SIZE
from vstatics.synthesis.boxes.listing import ListedBox

SAME_POINT = 2.0
"""Points that are closer are one. [pt]"""
SPOT, LARGE_SPOT = 4.5, 6.5
"""Of the point of a box, and of one that nothing is better than in all figures. [pt]"""
DISTANCES = (9.0, 13.0, 18.0, 27.0, 40.0, 60.0, 85.0)
"""Of the middle of a number from its point. [pt]"""
STRANGE_NUMBER_COST = 18.0
"""What it costs that a number is nearer to the point of another one. [pt]"""
HIDDEN_NUMBER_COST = 1000.0
"""What it costs that a number covers another one, or a point. [pt]"""
NUMBER_DIRECTIONS = 16
"""Directions that are tried for a number."""


class BoxPoint(NamedTuple):
    """Boxes of one family at one place."""

    at: Point
    """[pt]"""
    boxes: list[ListedBox]


class _BoxNumber(NamedTuple):
    """A number that looks for its place."""

    at: Point
    """Its own point."""
    size: Point
    points: list[Point]
    """All points that it could cover."""
    rivals: list[Point]
    """Points of other numbers."""

    def is_strange(self, place: Point) -> bool:
        """Whether a number there would seem to belong to the point of another one."""
        distance = math.dist(place, self.at)
        return any(math.dist(place, other) < 1.2 * distance for other in self.rivals)

    def cost(self, place: Point, taken: Sequence[tuple[Point, Point]]) -> float:
        """How much a number covers, and how far it stands from its point."""
        (x, y), (wide, high) = place, self.size
        others = sum(
            abs(x - left) < (wide + other) / 2 + LABEL_GAP and abs(y - low) < (high + up) / 2 + 1
            for (left, low), (other, up) in taken
        )
        covered = sum(
            abs(x - left) < (wide + LARGE_SPOT) / 2 and abs(y - low) < (high + LARGE_SPOT) / 2
            for left, low in self.points
        )
        strange = STRANGE_NUMBER_COST * self.is_strange(place)
        return HIDDEN_NUMBER_COST * (others + covered) + strange + math.dist(place, self.at)


def number_spots(pen: Pen, spots: Sequence[BoxPoint], numbers: set[int]) -> bool:
    """The numbers of boxes with a diagram, so that they cover no other and no point.

    Returns
    -------
    bool
        Whether there are more boxes at any of their places.
    """
    taken: list[tuple[Point, Point]] = []
    points = [spot.at for spot in spots]
    texts = list(_texts(spots, numbers))
    for at, text in texts:
        wide = width(text)
        near = [point for point in points if math.dist(point, at) < DISTANCES[-1] + 2 * wide]
        rivals = [other for other, _ in texts if other != at]
        own = _BoxNumber(at, (wide, SIZE), near, rivals)
        place = min(_places(at, wide, pen), key=partial(own.cost, taken=taken))
        taken.append((place, own.size))
        if math.dist(place, at) > DISTANCES[1] + wide / 2 or own.is_strange(place):
            x, y = (  # the place of its edge that is nearest to its point
                min(max(to, middle - long / 2 - 1), middle + long / 2 + 1)
                for to, middle, long in zip(at, place, own.size, strict=True)
            )
            pen.line(at, (x, y), color=pen.style.soft, width=0.5, zorder=7)
        said = f"{pen.style.text('boxes')} {text}"
        pen.text(*place, text, title=said, over=True, ha="center", va="center", zorder=8)
    return any("+" in text for _, text in texts)


def rounded(at: Point) -> tuple[int, int]:
    """A place, the same for points that are one."""
    return round(at[0] / SAME_POINT), round(at[1] / SAME_POINT)


def _texts(spots: Sequence[BoxPoint], numbers: set[int]) -> Iterator[tuple[Point, str]]:
    """What is written beside each place: the numbers of its diagrams, of all families there."""
    together: dict[tuple[int, int], tuple[Point, list[int]]] = {}
    for spot in spots:
        own = together.setdefault(rounded(spot.at), (spot.at, []))[1]
        own.extend(box.number for box in spot.boxes)
    for at, found in together.values():
        shown = sorted(numbers.intersection(found))
        if shown:
            yield at, _few(shown, len(found))


def _few(numbers: Sequence[int], count: int) -> str:
    """Numbers at one place, as many as have room there, and how many boxes more are there.

    >>> _few([1, 4], 2), _few([1], 3), _few([1, 4, 5, 9, 12], 7)
    ('1, 4', '1 +2', '1, 4, 5 +4')
    """
    shown = ", ".join(map(str, numbers[:3]))
    more = count - len(numbers[:3])
    return f"{shown} +{more}" if more else shown


def _places(at: Point, wide: float, pen: Pen) -> Iterator[Point]:
    """Where a number may stand, the nearest first."""
    (x, y), (right, high) = at, pen.size
    for distance in DISTANCES:
        for step in range(NUMBER_DIRECTIONS):
            angle = 2 * math.pi * (step / NUMBER_DIRECTIONS + 1 / 8)
            across = x + (distance + wide / 2) * math.cos(angle)
            up = y + distance * math.sin(angle)
            if wide / 2 < across < right - wide / 2 and SIZE < up < high - SIZE:
                yield across, up
    yield x, y + DISTANCES[0]
