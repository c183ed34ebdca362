"""Lines of links in a half-section, with crossings and connections to components."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, combinations, product, starmap
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Segment
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import Upright
from vstatics.pictures.schemes.coaxial.rooms import BRAKE_LENGTH, axis_ends, met_by
from vstatics.pictures.schemes.gear_glyphs import ABOVE, BELOW
from vstatics.pictures.schemes.sets import axles, wheel_taps


class Wires(NamedTuple):
    """Lines of links in a half-section, and the points where components meet the lines."""

    lines: Mapping[int, Sequence[Segment]]
    met: Sequence[tuple[int, int, Point]]
    """Points where components meet lines, each with the link, the component and the point."""
    ends: Sequence[tuple[int, Point, float]]
    """Ends of the axis, as in `axis_ends`."""
    crossings: Sequence[Point]
    """Points where lines of different links meet."""


def meeting(first: Segment, second: Segment) -> Point | None:
    """Return the common point, if any, of two horizontal or vertical lines."""
    (a, b), (c, d) = first
    (e, f), (g, h) = second
    left, right = max(a, e), min(c, g)
    low, high = max(b, f), min(d, h)
    return (left, low) if left <= right and low <= high else None


def wires_of(layout: CoaxialLayout) -> Wires:
    """Return the lines of all links."""
    places = layout.places
    uprights = [*zip(layout.uprights, places.at, strict=True)]
    lines = [line for up, at in uprights for line in _upright_lines(layout, up, at)]
    met = [point for up, at in uprights for point in _meets(layout, up, at)]
    ends = grouped(
        [
            (bar, at + off)
            for up, at in uprights
            for bar, offs in met_by(layout, up).items()
            for off in offs
        ]
    )
    for bar, xs in ends.items():
        y = places.heights[bar]
        lines.append((bar.link, ((min(xs), y), (max(xs), y))))
    axis = axis_ends(layout)
    for (link, (x, y), _), kind in zip(axis, ("start", "end"), strict=True):
        for up, at in uprights:
            if up.kind == kind:
                lines.append((link, ((min(x, at), y), (max(x, at), y))))
    by_link = grouped([(link, line) for link, line in lines if line[0] != line[1]])
    pairs = chain.from_iterable(starmap(product, combinations(by_link.values(), 2)))
    crossings = filter(None, dict.fromkeys(starmap(meeting, pairs)))
    return Wires(by_link, met, axis, [*crossings])


def _upright_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:
    if up.kind == "set":
        yield from _carrier_lines(layout, up, at)
        yield from _wheel_lines(layout, up, at)
        return
    places = layout.places
    low, *further = sorted(up.bars, key=places.heights.__getitem__)
    y = places.heights[low]
    if up.kind == "pair":
        (high,), half = further, layout.half(up)
        middle = layout.middle(up)
        yield low.link, ((at, y), (at, middle - half))
        yield high.link, ((at, middle + half), (at, places.heights[high]))
    elif up.kind == "wall":
        yield low.link, ((at, y), (at, places.heights[further[0]]))
    elif up.kind == "top":
        yield low.link, ((at, y), (at, places.housing - BRAKE_LENGTH))
    elif y != places.axis:
        yield low.link, ((at, places.axis), (at, y))


def _axles(layout: CoaxialLayout, up: Upright) -> tuple[int, list[Segment], list[Segment]]:
    """Return the carrier of a gear set, with its axles and arms."""
    lines = axles(layout.section(up), is_left=any(up.left), is_right=any(up.right))
    return layout.coaxial.train.sets[up.index].carrier, *lines


def _carrier_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:
    section, heights = layout.section(up), layout.places.heights
    carrier, pins, arms = _axles(layout, up)
    for (x, y), (x2, y2) in (*pins, *arms):
        yield carrier, ((x + at, y), (x2 + at, y2))
    for x, bars in ((0.0, up.left), (section.width, up.right)):
        arm = [y for line in arms if line[0][0] == x for _, y in line]
        for bar in bars:
            if bar is not None:
                ys = [*arm, heights[bar]]
                yield carrier, ((at + x, min(ys)), (at + x, max(ys)))


def _wheel_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:
    section, heights = layout.section(up), layout.places.heights
    taps = {(tap.x, tap.side): tap.y for tap in wheel_taps(section)}
    for number, both in enumerate(up.wheels):
        x = section.x(number)
        for bar, side in zip(both, (BELOW, ABOVE), strict=True):
            if bar is not None:
                low, high = sorted((taps[x, side], heights[bar]))
                yield bar.link, ((at + x, low), (at + x, high))


def _meets(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, int, Point]]:
    places, device = layout.places, layout.device(up)
    if up.kind == "set":
        carrier, pins, _ = _axles(layout, up)
        for (x, y), (end, _) in pins:
            yield carrier, device, (at + x, y)
            yield carrier, device, (at + end, y)
        for tap in wheel_taps(layout.section(up)):
            if tap.wire:
                yield tap.wire, device, (at + tap.x, tap.y)
    elif up.kind == "pair":
        bars = sorted(up.bars, key=places.heights.__getitem__)
        middle = layout.middle(up)
        for bar, side in zip(bars, (-1, 1), strict=True):
            yield bar.link, device, (at, middle + side * layout.half(up))
    elif up.kind == "top" and device >= 0:
        yield up.bars[0].link, device, (at, places.housing - BRAKE_LENGTH)
