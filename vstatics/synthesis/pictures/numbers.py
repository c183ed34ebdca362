"""Placement of numbers next to points, so that they cover neither each other nor many points."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import LABEL_GAP, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SIZE
from vstatics.synthesis.boxes.listing import ListedBox

SAME_POINT = 2.0
"""Distance within which points coincide. [pt]"""
SPOT, LARGE_SPOT = 4.5, 6.5
"""Size of the point of a gearbox, and of a gearbox in the Pareto list. [pt]"""
DISTANCES = (9.0, 13.0, 18.0, 27.0, 40.0, 60.0, 85.0)
"""Distances to try between the middle of a number and the point. [pt]"""
STRANGE_NUMBER_COST = 18.0
"""Cost of a number that is nearer to the point of a different number. [pt of distance]"""
HIDDEN_NUMBER_COST = 1000.0
"""Cost of a number that covers another number or a point. [pt of distance]"""
NUMBER_DIRECTIONS = 16
"""Number of directions from a point in which its text is tried."""


class BoxPoint(NamedTuple):
    """Gearboxes of a family whose points coincide."""

    at: Point
    """Position of the point. [pt]"""
    boxes: list[ListedBox]


class _BoxNumber(NamedTuple):
    """Number to be placed next to a point."""

    at: Point
    """Position of the number's point. [pt]"""
    size: Point
    points: list[Point]
    """Positions of points that the number could cover. [pt]"""
    rivals: list[Point]
    """Positions of the points of other numbers. [pt]"""

    def is_strange(self, place: Point) -> bool:
        """Check whether a number at a position would seem to belong to a different point."""
        distance = math.dist(place, self.at)
        return any(math.dist(place, other) < 1.2 * distance for other in self.rivals)

    def cost(self, place: Point, taken: Sequence[tuple[Point, Point]]) -> float:
        """Return the cost of a position: covered numbers and points, and the distance."""
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
    """Draw the numbers of gearboxes with a diagram, without overlaps where possible.

    Returns
    -------
    bool
        Whether a point also represents gearboxes without a diagram.
    """
    taken: list[tuple[Point, Point]] = []
    points = [spot.at for spot in spots]
    texts = list(_texts(spots, numbers))
    for at, text in texts:
        wide = width(text)
        near = [point for point in points if math.dist(point, at) < DISTANCES[-1] + 2 * wide]
        rivals = [other for other, _ in texts if other != at]
        box_number = _BoxNumber(at, (wide, SIZE), near, rivals)
        place = min(_places(at, wide, pen), key=partial(box_number.cost, taken=taken))
        taken.append((place, box_number.size))
        if math.dist(place, at) > DISTANCES[1] + wide / 2 or box_number.is_strange(place):
            x, y = (  # the point of the text's edge that is nearest to the gearbox's point
                min(max(target, middle - long / 2 - 1), middle + long / 2 + 1)
                for target, middle, long in zip(at, place, box_number.size, strict=True)
            )
            pen.line(at, (x, y), color=pen.style.soft, width=0.5, zorder=7)
        title = f"{pen.style.text('boxes')} {text}"
        pen.text(*place, text, title=title, over=True, ha="center", va="center", zorder=8)
    return any("+" in text for _, text in texts)


def rounded(at: Point) -> tuple[int, int]:
    """Return a position as integers, equal for points that coincide."""
    return round(at[0] / SAME_POINT), round(at[1] / SAME_POINT)


def _texts(spots: Sequence[BoxPoint], numbers: set[int]) -> Iterator[tuple[Point, str]]:
    """Yield the text next to each point, with the numbers of gearboxes that have a diagram."""
    together: dict[tuple[int, int], tuple[Point, list[int]]] = {}
    for spot in spots:
        numbers_there = together.setdefault(rounded(spot.at), (spot.at, []))[1]
        numbers_there.extend(box.number for box in spot.boxes)
    for at, all_numbers in together.values():
        shown = sorted(numbers.intersection(all_numbers))
        if shown:
            yield at, _few(shown, len(all_numbers))


def _few(numbers: Sequence[int], count: int) -> str:
    """Return up to three numbers at a point, and the count of further gearboxes.

    >>> _few([1, 4], 2), _few([1], 3), _few([1, 4, 5, 9, 12], 7)
    ('1, 4', '1 +2', '1, 4, 5 +4')
    """
    shown = ", ".join(map(str, numbers[:3]))
    more = count - len(numbers[:3])
    return f"{shown} +{more}" if more else shown


def _places(at: Point, wide: float, pen: Pen) -> Iterator[Point]:
    (x, y), (right, high) = at, pen.size
    for distance in DISTANCES:
        for step in range(NUMBER_DIRECTIONS):
            angle = 2 * math.pi * (step / NUMBER_DIRECTIONS + 1 / 8)
            across = x + (distance + wide / 2) * math.cos(angle)
            up = y + distance * math.sin(angle)
            if wide / 2 < across < right - wide / 2 and SIZE < up < high - SIZE:
                yield across, up
    yield x, y + DISTANCES[0]
