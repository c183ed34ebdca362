"""The names of devices: over what they name, moved away where another stands there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.stations import CAGE, PACK_PITCH, WHEEL, Station
from vstatics.pictures.schemes.axes.wires import sign_height
from vstatics.pictures.sheet.labels import Point
from vstatics.pictures.sheet.style import SIZE

LINE = 1.2 * SIZE
"""Of a name of several lines. [pt]"""
BRAKE, ROOF, BOX, SIGN = 19.0, 22.0, 8.0, 9.0
"""Heights: of a brake and of a drum over the middle of signs, half of a box, of a sign. [pt]"""
CLEAR = 1.5
"""Between letters and what is beside them. [pt]"""
ASIDE = (0.0, -6.0, 6.0, -14.0, 14.0, -28.0)
"""How far to a side a name may stand. [pt]"""
COVERED = 4.0
"""Steps that are worth it where a name would stand on a sign or a line."""
MOST_STEPS = 30
"""By which a name is moved."""


class Rectangle(NamedTuple):
    """By its corners [pt]."""

    left: float
    low: float
    right: float
    high: float

    def meets(self, other: Rectangle) -> bool:
        """Whether they have an area in common."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.low < other.high
            and other.low < self.high
        )


class DeviceLabel(NamedTuple):
    """A name at its place."""

    device: int
    text: str
    at: Point
    """Its middle. [pt]"""
    box: Rectangle


def device_labels(found: AxesPlaces, fixed: list[Rectangle]) -> dict[int, DeviceLabel]:
    """Names by device, none over another or over one of the fixed boxes.

    A name stands as near to what it names as can be, and on as few signs and lines.
    """
    line = LINE * found.letters
    obstacles = list(solid(found))
    taken, labels = [*fixed, *_within_sets(found)], {}
    wanted = sorted(_wanted(found), key=lambda one: (abs(one[2][1]), one[2][0]))
    for device, text, (x, y), up in wanted:
        half, high = found.wide(text, bold=True) / 2 + CLEAR, line * (text.count("\n") + 1)
        boxes, ends = [], [(y, up)]
        if sign_height(found, device) == 0:  # on the axis: the name may stand on its other side
            ends.append((y - up * 2 * (SIGN + 1.5), -up))
        for step in range(MOST_STEPS):
            for end, way in ends:
                base = end + way * step * line / 2
                low, top = (base, base + high) if way > 0 else (base - high, base)
                boxes += [Rectangle(x + by - half, low, x + by + half, top) for by in ASIDE]
        clear = [one for one in boxes if not any(one.meets(other) for other in taken)]
        costs = [
            place / len(ASIDE) + COVERED * sum(one.meets(other) for other in obstacles)
            for place, one in enumerate(boxes)
        ]
        _, box = min(zip(costs, boxes, strict=True), key=lambda one: (one[1] not in clear, one[0]))
        taken.append(box)
        middle = (box.left + box.right) / 2, (box.low + box.high) / 2
        labels[device] = DeviceLabel(device, text, middle, box)
    return labels


def _within_sets(found: AxesPlaces) -> Iterator[Rectangle]:
    """Names and teeth of the wheels of sets."""
    for number, one in enumerate(found.board.stations):
        for glyph in one.glyphs[found.chosen.ways[number] :][:1]:
            left, middle = found.xs[number] - glyph.width / 2, found.sign_height(one.axes[0])
            for (x, y), _, text in glyph.texts:
                at = found.y(one.axes[0], middle + y)
                wide, tall = found.wide(text), LINE * found.letters
                yield Rectangle(left + x, at - tall, left + x + wide, at + tall)


def _wanted(found: AxesPlaces) -> Iterator[tuple[int, str, Point, int]]:
    """Devices, their names, where these begin, and toward where they may move."""
    for number, one in enumerate(found.board.stations):
        for place, text in enumerate(one.names):
            if text:
                yield one.devices[place], text, *_start(found, number, one, place)


def _start(found: AxesPlaces, number: int, one: Station, place: int) -> tuple[Point, int]:
    axis, x = one.axes[0], found.xs[number]
    side = found.board.rows.sides[axis]
    if one.joint is not None:
        radii = found.board.radii[number][::2]
        spans = [found.spans[link] for link in one.links]
        tops = [found.y(own, 0.0) + r for own, r in zip(one.axes, radii, strict=True)]
        tops += [
            found.y(own, span.height)
            for own, span in zip(one.axes, spans, strict=True)
            if span.level < 0
        ]
        return (x, max(tops) + 3.0), 1
    middle = sign_height(found, one.devices[place])
    if len(one.devices) > 1 and one.kind == "coupling":
        text = one.names[place]
        aside = x + one.half + 3.0 + found.wide(text, bold=True) / 2
        lines = text.count("\n") + 1
        return (aside, found.y(axis, middle) - side * LINE * found.letters * lines / 2), side
    if one.kind == "drum":
        x = next(
            own.x
            for own in found.contacts
            if own.device == one.devices[place] and own.link != one.links[0]
        )
    over = {"brake": BRAKE + 6.0, "drum": ROOF + 2.0, "box": BOX + 2.0}.get(one.kind, SIGN + 1.5)
    if one.kind == "differential":
        middle, over = 0.0, CAGE + 2.0
    if one.kind == "set":
        glyph = one.glyphs[found.chosen.ways[number]]
        x += found.wide(one.names[0], bold=True) / 2 + 3.0
        over = glyph.half + 2.0
    return (x, found.y(axis, middle + over)), side


def solid(found: AxesPlaces) -> Iterator[Rectangle]:
    """What letters should not cover: signs, wheels, boxes, shafts."""
    for number, one in enumerate(found.board.stations):
        x, axis = found.xs[number], one.axes[0]
        if one.joint is not None:
            for own, radius in zip(one.axes, found.board.radii[number][::2], strict=True):
                y = found.y(own, 0.0)
                yield Rectangle(x - 1.0, y - radius, x + 1.0, y + radius)
                for rim in (y - radius, y + radius):
                    yield Rectangle(x - WHEEL, rim - 1.5, x + WHEEL, rim + 1.5)
            continue
        for glyph in one.glyphs[found.chosen.ways[number] :][:1]:
            for tap in glyph.taps:
                if tap.reach == "none":
                    at = x - glyph.width / 2 + tap.x
                    middle = found.sign_height(axis) + tap.side * (glyph.half + 5)
                    ends = sorted(found.y(axis, middle + by * tap.side) for by in (-2.0, 6.0))
                    yield Rectangle(at - 10, ends[0], at + 10, ends[1])
        for device in one.devices:
            yield _box_of(found, number, one, axis, sign_height(found, device))
    for link, span in found.spans.items():
        y = found.y(found.axis_of(link), span.height)
        yield Rectangle(span.left, y - 1.0, span.right, y + 1.0)


def _box_of(found: AxesPlaces, number: int, one: Station, axis: int, middle: float) -> Rectangle:
    x, low, high = found.xs[number], middle - SIGN, middle + SIGN
    if one.kind == "set":
        half = one.glyphs[found.chosen.ways[number]].half
        low, high = middle - half, middle + half
    elif one.kind == "differential":
        low, high = -CAGE, CAGE
    elif one.kind in ("brake", "drum"):
        low, high = middle, middle + (BRAKE if one.kind == "brake" else ROOF) + 5.0
    ends = sorted((found.y(axis, low), found.y(axis, high)))
    half = PACK_PITCH * len(one.devices) / 2 if one.kind == "drum" else one.half
    return Rectangle(x - half, ends[0], x + half, ends[1])
