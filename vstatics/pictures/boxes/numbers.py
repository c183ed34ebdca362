"""Numbers beside points, so that they cover no other number and few points."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import Chart
from vstatics.pictures.sheet.labels import LABEL_GAP, Point
from vstatics.pictures.sheet.style import SIZE, Style
from vstatics.pictures.sheet.svg import halo
from vstatics.synthesis.boxes.listing import ListedBox

SAME_POINT = 2.0
"""Points that are closer are one. [pt]"""
SPOT, LARGE_SPOT = 4.5, 6.5
"""Of the point of a box, and of one that nothing is better than in all figures. [pt]"""
DISTANCES = (9.0, 13.0, 18.0, 27.0, 40.0, 60.0, 85.0)
"""Of the middle of a number from its point. [pt]"""
STRANGE = 18.0
"""What it costs that a number is nearer to the point of another one. [pt]"""
HIDDEN = 1000.0
"""What it costs that a number covers another one, or a point. [pt]"""
WAYS = 16
"""Directions that are tried for a number."""


class BoxPoint(NamedTuple):
    """Boxes of one family at one place."""

    at: Point
    """[pt]"""
    boxes: list[ListedBox]

    @property
    def is_pareto(self) -> bool:
        """Whether nothing is better than one of them in all figures."""
        return any(box.pareto for box in self.boxes)


class _BoxNumber(NamedTuple):
    """A number that looks for its place."""

    at: Point
    """Its own point."""
    size: Point
    points: list[Point]
    """All points that it could cover."""
    rivals: list[Point]
    """Points of other numbers."""


def number_spots(chart: Chart, spots: Sequence[BoxPoint], numbers: set[int], style: Style) -> bool:
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
        wide = labels.width(text)
        near = [point for point in points if math.dist(point, at) < DISTANCES[-1] + 2 * wide]
        rivals = [other for other, _ in texts if other != at]
        own = _BoxNumber(at, (wide, SIZE), near, rivals)
        place = min(_places(at, wide, chart), key=partial(_cost, own=own, taken=taken))
        taken.append((place, own.size))
        if math.dist(place, at) > DISTANCES[1] + wide / 2 or _is_strange(place, own):
            chart.line(at, _edge(place, own), color=style.soft, linewidth=0.5, zorder=7)
        how: dict[str, Any] = {"ha": "center", "va": "center", "zorder": 8}
        boxes = style.text("boxes", "схемы")
        chart.write(place[0], place[1], text, **how | halo(style, f"{boxes} {text}"))
    return any("+" in text for _, text in texts)


def _edge(place: Point, own: _BoxNumber) -> Point:
    """The place of the edge of a number that is nearest to its point."""
    halves = (length / 2 + 1 for length in own.size)
    x, y = (
        min(max(to, middle - half), middle + half)
        for to, middle, half in zip(own.at, place, halves, strict=True)
    )
    return x, y


def _is_strange(place: Point, own: _BoxNumber) -> bool:
    """Whether a number there would seem to belong to the point of another one."""
    distance = math.dist(place, own.at)
    return any(math.dist(place, other) < 1.2 * distance for other in own.rivals)


def _texts(spots: Sequence[BoxPoint], numbers: set[int]) -> Iterator[tuple[Point, str]]:
    """What is written beside each place: the numbers of its diagrams, of all families there."""
    together: dict[tuple[int, int], tuple[Point, list[int]]] = {}
    for spot in spots:
        key = round(spot.at[0] / SAME_POINT), round(spot.at[1] / SAME_POINT)
        together.setdefault(key, (spot.at, []))[1].extend(box.number for box in spot.boxes)
    for at, found in together.values():
        own = sorted(numbers.intersection(found))
        if own:
            yield at, _few(own, len(found))


def _few(numbers: Sequence[int], count: int) -> str:
    """Numbers at one place, as many as have room there, and how many boxes more are there.

    >>> _few([1, 4], 2), _few([1], 3), _few([1, 4, 5, 9, 12], 7)
    ('1, 4', '1 +2', '1, 4, 5 +4')
    """
    shown = ", ".join(map(str, numbers[:3]))
    more = count - len(numbers[:3])
    return f"{shown} +{more}" if more else shown


def _places(at: Point, wide: float, chart: Chart) -> Iterator[Point]:
    """Where a number may stand, the nearest first."""
    for distance in DISTANCES:
        for step in range(WAYS):
            angle = 2 * math.pi * (step / WAYS + 1 / 8)
            x = at[0] + (distance + wide / 2) * math.cos(angle)
            y = at[1] + distance * math.sin(angle)
            if wide / 2 < x < chart.width - wide / 2 and SIZE < y < chart.height - SIZE:
                yield x, y
    yield at[0], at[1] + DISTANCES[0]


def _cost(place: Point, own: _BoxNumber, taken: Sequence[tuple[Point, Point]]) -> float:
    """How much a number covers, and how far it stands from its point."""
    (x, y), (wide, high) = place, own.size
    others = sum(
        abs(x - left) < (wide + other) / 2 + LABEL_GAP and abs(y - low) < (high + up) / 2 + 1
        for (left, low), (other, up) in taken
    )
    covered = sum(
        abs(x - left) < (wide + LARGE_SPOT) / 2 and abs(y - low) < (high + LARGE_SPOT) / 2
        for left, low in own.points
    )
    strange = STRANGE * _is_strange(place, own)
    return HIDDEN * (others + covered) + strange + math.dist(place, own.at)
