"""Where names of links stand: beside the arrows of ports, and where else there is room."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.schemes.axes.letters.obstacles import Obstacle, Rectangle
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.ink import ARROW
from vstatics.pictures.schemes.scheme import Scheme

NAME_GAP = 3.0
"""From an end to its name. [pt]"""


def ends_of(found: AxesPlaces, axis: int) -> tuple[float, float]:
    """From where to where the links of an axis reach [pt]."""
    own = [span for link, span in found.spans.items() if found.axis_of(link) == axis]
    return min(one.left for one in own), max(one.right for one in own)


def free_names(
    found: AxesPlaces, scheme: Scheme, named: set[int], solid: Sequence[Obstacle]
) -> Iterator[tuple[int, Point, str]]:
    """Names of links that have room at an end of their row, or on the other side of it.

    Parameters
    ----------
    named : set of int
        Links that have names.
    solid : sequence of Obstacle
        What names keep clear of.
    """
    taken = {link for one in found.board.stations if one.layout for link in one.layout.places.names}
    has_port = {port.link for port in scheme.ports}
    for axis, links in enumerate(found.board.axes.axes):
        own = [link for link in sorted(links) if link in found.spans]
        if not own:
            continue
        left, right = ends_of(found, axis)
        for link in own:
            if link in taken:
                continue
            span = found.spans[link]
            y = found.y(axis, span.height)
            if link in named or link in has_port:
                continue
            wide, off = found.wide(scheme.name(link)), 10 + NAME_GAP
            if span.left == left and not _covers(found, solid, (left - off - wide, y), wide):
                named.add(link)
                yield link, (left - off, y), "right"
            elif span.right == right and not _covers(found, solid, (right + off, y), wide):
                named.add(link)
                yield link, (right + off, y), "left"
            else:
                place = _room(found, axis, link, found.wide(scheme.name(link)) + 4)
                if place is not None:
                    named.add(link)
                    yield link, (place, found.y(axis, -found.bases[axis] - 7.5)), "center"


def _covers(found: AxesPlaces, solid: Sequence[Obstacle], left: Point, wide: float) -> bool:
    """Whether a name, by its left end, would cover a wheel of another axis, or a sign."""
    (x, y), half = left, 4.0 * found.letters
    return any(
        one.box.left < x + wide
        and x < one.box.right
        and one.box.low < y + half
        and y - half < one.box.high
        for one in solid
    )


def _room(found: AxesPlaces, axis: int, link: int, wide: float) -> float | None:
    """The middle of the first gap on the other side of an axis that a name has room in."""
    span = found.spans[link]
    if span.level:
        return None
    taken = sorted(
        x
        for x, one in zip(found.xs, found.board.stations, strict=True)
        if axis in one.axes and one.kind in ("pair", "differential")
    )
    stops = [span.left, *(x for x in taken if span.left < x < span.right), span.right]
    for start, end in pairwise(stops):
        if end - start - 14 > wide:
            return (start + end) / 2
    return None


def fixed_names(found: AxesPlaces, scheme: Scheme, solid: Sequence[Obstacle]) -> list[Rectangle]:
    """Of links, with the arrows of ports: what all other names keep clear of."""
    boxes, tall = [], 5.0 * found.letters
    for port in scheme.ports:
        span, axis = found.spans[port.link], found.axis_of(port.link)
        y, way = found.y(axis, found.port_height(port.link)), -1
        if port.link in found.chosen.rightward:
            way = 1
        start = span.right if way > 0 else span.left
        end = start + way * (ARROW + NAME_GAP + found.wide(scheme.name(port.link)))
        boxes.append(Rectangle(min(start, end), y - tall, max(start, end), y + tall))
    for link, (x, y), aligned in free_names(
        found, scheme, {port.link for port in scheme.ports}, solid
    ):
        wide = found.wide(scheme.name(link))
        left = x - wide * {"right": 1.0, "center": 0.5, "left": 0.0}[aligned]
        boxes.append(Rectangle(left, y - tall, left + wide, y + tall))
    return boxes
