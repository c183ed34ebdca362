"""The lines of links in a half-section, where they cross, and where devices meet them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

from vstatics.pictures.drawing.groups import grouped
from vstatics.pictures.drawing.labels import Point, Segment
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import Bar, Upright
from vstatics.pictures.schemes.coaxial.rooms import BRAKE, ends_of, met_by
from vstatics.pictures.schemes.sets import axles, wheel_taps


class Wires(NamedTuple):
    """The lines of links, and where devices meet them."""

    lines: Mapping[int, Sequence[Segment]]
    met: Sequence[tuple[int, int, Point]]
    """A link, a device, a place."""

    def crossings(self) -> list[Point]:
        """Where an upright line of a link meets a level one of another."""
        found: list[Point] = []
        for one, other in combinations(self.lines, 2):
            for first in self.lines[one]:
                for second in self.lines[other]:
                    at = meeting(first, second)
                    if at is not None and at not in found:
                        found.append(at)
        return found


def meeting(one: Segment, other: Segment) -> Point | None:
    """Where two level or upright lines have a point in common; None if they have none."""
    (a, b), (c, d) = one
    (e, f), (g, h) = other
    left, right = max(a, e), min(c, g)
    low, high = max(b, f), min(d, h)
    return (left, low) if left <= right and low <= high else None


def wires_of(layout: CoaxialLayout) -> Wires:
    """All lines of all links."""
    places = layout.places
    lines: list[tuple[int, Segment]] = []
    met: list[tuple[int, int, Point]] = []
    ends: dict[Bar, list[float]] = {}
    for up, at in zip(layout.uprights, places.at, strict=True):
        for bar, offs in met_by(layout, up).items():
            ends.setdefault(bar, []).extend(at + off for off in offs)
        for link, line in _upright_lines(layout, up, at):
            lines.append((link, line))
        met += _meets(layout, up, at)
    left, right = ends_of(layout)
    for bar, xs in ends.items():
        y = places.heights[bar]
        lines.append((bar.link, ((min(xs), y), (max(xs), y))))
    own = layout.own.train
    for link, x, kind in ((own.start, left, "start"), (own.end, right, "end")):
        for up, at in zip(layout.uprights, places.at, strict=True):
            if up.kind == kind:
                low, high = min(x, at), max(x, at)
                lines.append((link, ((low, places.axis), (high, places.axis))))
    kept = [(link, line) for link, line in lines if line[0] != line[1]]
    return Wires(grouped(kept), met)


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
        yield low.link, ((at, y), (at, places.housing - BRAKE))
    elif y != places.axis:
        yield low.link, ((at, places.axis), (at, y))


def _carrier_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:
    """Pins, arms, and what leads from these to bars."""
    section, heights = layout.section(up), layout.places.heights
    carrier = layout.own.train.sets[up.index].carrier
    pins, arms = axles(section, is_left=any(up.left), is_right=any(up.right))
    yield from ((carrier, _moved(line, at)) for line in (*pins, *arms))
    for x, own in ((0.0, up.left), (section.width, up.right)):
        arm = [y for line in arms if line[0][0] == x for _, y in line]
        for bar in own:
            if bar is not None:
                ys = [*arm, heights[bar]]
                yield carrier, ((at + x, min(ys)), (at + x, max(ys)))


def _wheel_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:
    """From the bars of suns and rings to their teeth."""
    section, heights = layout.section(up), layout.places.heights
    taps = {(tap.x, tap.side): tap.side * tap.depth for tap in wheel_taps(section)}
    for number, (sun, ring) in enumerate(up.wheels):
        x = section.x(number)
        if sun is not None:
            yield sun.link, ((at + x, heights[sun]), (at + x, taps[x, -1]))
        if ring is not None:
            yield ring.link, ((at + x, taps[x, 1]), (at + x, heights[ring]))


def _moved(line: Segment, by: float) -> Segment:
    (a, b), (c, d) = line
    return (a + by, b), (c + by, d)


def _meets(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, int, Point]]:
    """Where a device meets its links."""
    places, device = layout.places, layout.device(up)
    if up.kind == "set":
        section = layout.section(up)
        carrier = layout.own.train.sets[up.index].carrier
        pins, _ = axles(section, is_left=any(up.left), is_right=any(up.right))
        for (x, y), (end, _) in pins:
            yield carrier, device, (at + x, y)
            yield carrier, device, (at + end, y)
        for tap in wheel_taps(section):
            if tap.wire:
                yield tap.wire, device, (at + tap.x, tap.side * tap.depth)
    elif up.kind == "pair":
        bars = sorted(up.bars, key=places.heights.__getitem__)
        middle = layout.middle(up)
        for bar, side in zip(bars, (-1, 1), strict=True):
            yield bar.link, device, (at, middle + side * layout.half(up))
    elif up.kind == "top" and device >= 0:
        yield up.bars[0].link, device, (at, places.housing - BRAKE)


def crossings_of(layout: CoaxialLayout) -> int:
    """How often two links cross."""
    return len(wires_of(layout).crossings())
