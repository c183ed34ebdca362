"""Positions of link names, next to the arrows of inputs and outputs, or below a free line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.schemes.axes.letters.obstacles import Obstacle, Rectangle
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.ink import ARROW
from vstatics.pictures.schemes.scheme import Scheme

END_NAME_GAP = 3.0
"""Distance from the end of the line of a link to the name. [pt]"""


def ends_of(placing: AxesPlaces, axis: int) -> tuple[float, float]:
    """Return the leftmost and rightmost position of the links of an axis [pt]."""
    spans = [span for link, span in placing.spans.items() if placing.axis_of(link) == axis]
    return min(span.left for span in spans), max(span.right for span in spans)


def free_names(
    placing: AxesPlaces, scheme: Scheme, solid: Sequence[Obstacle]
) -> Iterator[tuple[int, Point, str]]:
    """Yield names of links without input or output that have room near the line of the link.

    Parameters
    ----------
    solid : sequence of Obstacle
        Obstacles that names must not cover.
    """
    taken = {port.link for port in scheme.ports}
    for station in placing.board.stations:
        taken.update(station.layout.places.names if station.layout else ())
    for axis, links in enumerate(placing.board.axes.axes):
        for link in sorted((links & placing.spans.keys()) - taken):
            span, (left, right) = placing.spans[link], ends_of(placing, axis)
            y = placing.y(axis, span.height)
            wide, off = placing.wide(scheme.name(link)), 10 + END_NAME_GAP
            if span.left == left and not _covers(placing, solid, (left - off - wide, y), wide):
                yield link, (left - off, y), "right"
            elif span.right == right and not _covers(placing, solid, (right + off, y), wide):
                yield link, (right + off, y), "left"
            else:
                place = _room(placing, axis, link, wide + 4)
                low = placing.y(axis, -placing.bases[axis] - 7.5)
                if place is not None and not (
                    span.level and _covers(placing, solid, (place - wide / 2, low), wide)
                ):
                    yield link, (place, low), "center"


def _covers(placing: AxesPlaces, solid: Sequence[Obstacle], left: Point, wide: float) -> bool:
    """Return True if a name that begins at the point `left` would cover an obstacle."""
    (x, y), half = left, 4.0 * placing.letters
    return any(
        item.box.left < x + wide
        and x < item.box.right
        and item.box.low < y + half
        and y - half < item.box.high
        for item in solid
    )


def _room(placing: AxesPlaces, axis: int, link: int, wide: float) -> float | None:
    """Return the middle of the first gap below an axis with room for a name.

    A gap ends where a hollow shaft around the link begins, because a name there would seem to name
    the hollow shaft.
    """
    span = placing.spans[link]
    around = [
        other
        for number, other in placing.spans.items()
        if placing.axis_of(number) == axis and other.level > span.level
    ]
    taken = [
        x
        for x, station in zip(placing.xs, placing.board.stations, strict=True)
        if axis in station.axes and station.kind in ("pair", "differential")
    ]
    taken += (end for other in around for end in (other.left, other.right))
    stops = [span.left, *sorted(x for x in taken if span.left < x < span.right), span.right]
    for start, end in pairwise(stops):
        is_inside = any(other.left < (start + end) / 2 < other.right for other in around)
        if end - start - 14 > wide and not is_inside:
            return (start + end) / 2
    return None


def fixed_names(
    placing: AxesPlaces, scheme: Scheme, free: Iterable[tuple[int, Point, str]]
) -> list[Rectangle]:
    """Return the boxes of link names: at inputs and outputs with the arrows, and the free names."""
    boxes, tall = [], 5.0 * placing.letters
    for port in scheme.ports:
        start, y, way = placing.end_of(port.link)
        end = start + way * (ARROW + END_NAME_GAP + placing.wide(scheme.name(port.link)))
        boxes.append(Rectangle(min(start, end), y - tall, max(start, end), y + tall))
    for link, (x, y), aligned in free:
        wide = placing.wide(scheme.name(link))
        left = x - wide * {"right": 1.0, "center": 0.5, "left": 0.0}[aligned]
        boxes.append(Rectangle(left, y - tall, left + wide, y + tall))
    return boxes
