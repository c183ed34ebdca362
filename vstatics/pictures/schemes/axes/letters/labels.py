"""Where names of devices and teeth of wheels stand: near what they name, clear of all else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.drawing.style import SIZE, SMALL
from vstatics.pictures.schemes.axes.letters.obstacles import (
    BOX,
    BRAKE,
    GROUND,
    IN_SET,
    ROOF,
    SIGN,
    Obstacle,
    Rectangle,
)
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.stations import CAGE, Station
from vstatics.pictures.schemes.axes.wires import sign_height

LINE = 1.2
"""Height of a line of a text over the size of its letters."""
CLEAR = 1.5
"""Between letters and what is beside them. [pt]"""
ASIDE = (0, 3, 7, 12, 18, 26, 36)
AWAY = (0, -1, 2, 4, 7, 10, 14, 18, 23, 30, 40, 52, 66)
"""How far to a side and away from what it names a text may stand. [pt]"""
UNDER, BESIDE = 5.0, 9.0
"""What standing on the other side of it, or beside it, costs in points of distance."""
BESIDES = 8
"""Heights at which a text may stand beside it, less one."""
SHORT = 30.0
"""Beside what is lower a text stands best at its middle, else at its end. [pt]"""
ON_TEXT = 1e5
"""What it costs to stand on other letters."""
STRANGE, NEAR = 12.0, 3.0
"""What it costs to be near another device, and how near that is. [pt]"""
OUTWARD = np.array([-1.0, -1.0, 1.0, 1.0])
Boxes = NDArray[np.float64]
"""A row for each: left, low, right, high."""


class WantedLabel(NamedTuple):
    """A text, and where it would stand best."""

    device: int
    text: str
    above: Point
    """The middle of its lower edge where it stands above; of the upper one where `up` is -1."""
    below: float
    """The height at which it begins on the other side. [pt]"""
    up: int
    half: float = 3.0
    """Half the width of what it names. [pt]"""
    size: float = SIZE

    @property
    def is_name(self) -> bool:
        """Of a device, not the teeth of a wheel."""
        return self.size == SIZE


class DeviceLabel(NamedTuple):
    """A text at its place."""

    text: str
    at: Point
    """Its middle. [pt]"""
    box: Rectangle
    is_name: bool
    """Or else the teeth of a wheel."""


def device_labels(
    found: AxesPlaces, fixed: Sequence[Rectangle], solid: Sequence[Obstacle]
) -> dict[int, list[DeviceLabel]]:
    """Texts by device, none over another or over one of the fixed boxes.

    A text stands as near to what it names as can be, and on as few signs and lines.
    """
    walls = np.array([[*one.box] for one in solid] + [[*box] for box in fixed])
    costs = np.array([one.cost for one in solid] + [ON_TEXT for _ in fixed])
    within = np.array([one.device if one.cost == IN_SET else -1 for one in solid])
    owners = np.array([[*one.box, one.device] for one in solid])
    labels: dict[int, list[DeviceLabel]] = {}
    wanted = sorted(_names(found), key=lambda one: (abs(one.above[1]), one.above[0]))
    for own in (*_teeth(found), *wanted):
        boxes, dear = _candidates(found, own)
        others = owners[(owners[:, 4] != own.device) & (owners[:, 4] >= 0), :4]
        met = _meets(boxes, walls)
        dear = dear + met @ costs
        if not own.is_name:  # the teeth of a planet stand within its set
            dear -= met[:, : len(within)] @ (IN_SET * (within == own.device))
        dear += STRANGE * _meets(boxes + NEAR * OUTWARD, others).any(axis=1)
        box = Rectangle(*boxes[int(np.argmin(dear))].tolist())
        walls, costs = np.vstack([walls, [box]]), np.append(costs, ON_TEXT)
        middle = (box.left + box.right) / 2, (box.low + box.high) / 2
        one = DeviceLabel(own.text, middle, box, own.is_name)
        labels.setdefault(own.device, []).append(one)
    return labels


def _meets(boxes: Boxes, others: Boxes) -> NDArray[np.bool_]:
    """Which boxes have an area in common with which others."""
    one, other = boxes[:, None, :], others[None, :, :]
    found: NDArray[np.bool_] = np.logical_and(
        one[..., :2] < other[..., 2:], other[..., :2] < one[..., 2:]
    )
    return np.logical_and(found[..., 0], found[..., 1])


def _candidates(found: AxesPlaces, own: WantedLabel) -> tuple[Boxes, NDArray[np.float64]]:
    """Boxes of a text around what it names, and what each costs for its distance."""
    (x, y), scale = own.above, found.letters
    half = found.wide(own.text, size=own.size, bold=own.is_name) / 2 + CLEAR
    tall = LINE * own.size * scale * (own.text.count("\n") + 1)
    rows: list[tuple[float, float, float, float]] = []
    dear: list[float] = []
    for start, way, extra in ((y, own.up, 0.0), (own.below, -own.up, UNDER)):
        for away in AWAY:
            base = start + way * away * scale
            low = base if way > 0 else base - tall
            for aside in sorted({by * side for by in ASIDE for side in (1, -1)}, key=abs):
                left = x + aside * scale - half
                rows.append((left, low, left + 2 * half, low + tall))
                dear.append(extra + abs(away) + 0.7 * abs(aside))
    ends = (y - own.up * tall, own.below + own.up * tall)
    best = (y + own.below) / 2 if abs(y - own.below) < SHORT else y
    for step in range(BESIDES + 1):
        middle = ends[0] + (ends[1] - ends[0]) * step / BESIDES + own.up * tall / 2
        for off in (0.0, 5.0, 12.0):
            for way in (1, -1):
                left = x + way * (own.half + off + half) - half
                rows.append((left, middle - tall / 2, left + 2 * half, middle + tall / 2))
                dear.append(BESIDE + off + 0.1 * abs(middle - best))
    return np.array(rows), np.array(dear)


def _teeth(found: AxesPlaces) -> Iterator[WantedLabel]:
    """Teeth of the wheels of pairs, by station, inside their rims; of those of sets."""
    for number, one in enumerate(found.board.stations):
        index, tall = one.devices[0], LINE * SMALL * found.letters
        if one.teeth:
            radii, ys = found.board.radii[number][::2], [found.y(own, 0.0) for own in one.axes]
            for place, text in enumerate(one.teeth):
                toward = 1 if ys[1 - place] > ys[place] else -1
                beside = found.xs[number] + 2.5 + found.wide(text, size=SMALL) / 2
                rim = ys[place] - toward * (radii[place] - 2.5)
                ends = rim, rim - toward * 5.0
                yield WantedLabel(
                    one.devices[0], text, (beside, ends[0]), ends[1], toward, size=SMALL
                )
        for glyph in one.glyphs[found.chosen.ways[number] :][:1]:
            left, middle = found.xs[number] - glyph.width / 2, found.sign_height(one.axes[0])
            for (x, y), edge, text in glyph.texts:
                at = left + x + found.wide(text, size=SMALL) / 2
                up = found.board.rows.sides[one.axes[0]] * (-1 if edge == "top" else 1)
                start = found.y(one.axes[0], middle + y)
                other = start + up * tall
                yield WantedLabel(index, text, (at, start), other, up, size=SMALL)


def _names(found: AxesPlaces) -> Iterator[WantedLabel]:
    """Names of devices with the places where these begin."""
    for number, one in enumerate(found.board.stations):
        for place, text in enumerate(one.names):
            if text:
                start = _start(found, number, one, place)
                yield WantedLabel(one.devices[place], text, *start, one.half)


def _start(found: AxesPlaces, number: int, one: Station, place: int) -> tuple[Point, float, int]:
    """Over a device, under it, and which of both is up."""
    axis, x = one.axes[0], found.xs[number]
    side = found.board.rows.sides[axis]
    if one.joint is not None:
        radii = found.board.radii[number][::2]
        ends = [
            found.y(own, 0.0) + way * r
            for own, r in zip(one.axes, radii, strict=True)
            for way in (1, -1)
        ]
        return (x, max(ends) + 3.0), min(ends) - 3.0, 1
    middle = sign_height(found, one.devices[place])
    if one.kind == "drum":
        x = next(
            own.x
            for own in found.contacts
            if own.device == one.devices[place] and own.link != one.links[0]
        )
    over = {"brake": BRAKE + GROUND, "drum": ROOF, "box": BOX}.get(one.kind, SIGN)
    under = {"brake": 0.0, "drum": 0.0, "box": BOX}.get(one.kind, SIGN)
    if one.kind == "differential":
        middle, over, under = 0.0, CAGE, CAGE
    if one.kind == "set":
        over = under = one.glyphs[found.chosen.ways[number]].half
    gap = 2.5
    return (x, found.y(axis, middle + over + gap)), found.y(axis, middle - under - gap), side
