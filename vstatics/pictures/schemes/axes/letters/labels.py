"""Search for positions of component names and tooth numbers near the parts that they name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.style import SIZE, SMALL
from vstatics.pictures.schemes.axes.letters.obstacles import (
    IN_SET,
    Obstacle,
    Rectangle,
)
from vstatics.pictures.schemes.axes.places import AxesPlaces

LINE = 1.2
"""Ratio of the height of a line of text to the letter size. [-]"""
CLEAR = 1.5
"""Margin around letters. [pt]"""
ASIDE = (0, 3, -3, 7, -7, 12, -12, -18, 18, -26, 26, 36, -36)
"""Horizontal distances of a text from the named component to try. [pt]"""
AWAY = (0, -1, 2, 4, 7, 10, 14, 18, 23, 30, 40, 52, 66)
"""Vertical distances of a text from the named component to try; -1 overlaps the component. [pt]"""
NAME_GAP = 2.5
"""Distance from the box around a component to the name. [pt]"""
UNDER, BESIDE = 5.0, 9.0
"""Costs of a text below or next to the component, compared with above. [pt of distance]"""
BESIDES = 8
"""Number of steps between the heights to try for a text next to a component."""
SHORT = 30.0
"""Height of a component up to which a text next to it should be at mid-height. [pt]"""
ON_TEXT = 1e5
"""Cost of a text that covers letters of a different text. [pt of distance]"""
STRANGE, NEAR = 12.0, 3.0
"""Cost of a text near another component [pt of distance], and distance that counts as near [pt]."""
OUTWARD = np.array([-1.0, -1.0, 1.0, 1.0])
"""Signs of the outward directions at the left, lower, right and upper side of a box. [-]"""
Boxes = NDArray[np.float64]
"""Boxes around texts, each a row with the left, lower, right and upper side. [pt]"""


class WantedLabel(NamedTuple):
    """Text with the position that is preferred."""

    device: int
    text: str
    above: Point
    """Middle of the lower edge of a text above, or of the upper edge of a text below. [pt]"""
    below: float
    """Height of the edge nearest the component, for a text on the opposite side of it. [pt]
    """
    up: int
    half: float = 3.0
    """Half the width of the named component. [pt]"""
    size: float = SIZE

    @property
    def is_name(self) -> bool:
        """True for the name of a component, False for a tooth number."""
        return self.size == SIZE


class DeviceLabel(NamedTuple):
    """Name or tooth number of a component, with its position."""

    text: str
    at: Point
    """Middle of the text on the canvas. [pt]"""
    box: Rectangle
    is_name: bool
    """True for the name of a component, False for a tooth number."""


def device_labels(
    placing: AxesPlaces, fixed: Sequence[Rectangle], solid: Sequence[Obstacle]
) -> dict[int, list[DeviceLabel]]:
    """Return the texts of each component, which overlap neither each other nor fixed boxes.

    Each text is close to its component, and covers few symbols and lines.
    """
    walls = np.array([[*item.box] for item in solid] + [[*box] for box in fixed])
    costs = np.array([item.cost for item in solid] + [ON_TEXT for _ in fixed])
    within = np.array([item.device if item.cost == IN_SET else -1 for item in solid])
    owners = np.array([[*item.box, item.device] for item in solid])
    labels: dict[int, list[DeviceLabel]] = {}
    wanted = sorted(_names(placing, solid), key=lambda name: (abs(name.above[1]), name.above[0]))
    for wanted_label in (*_teeth(placing), *wanted):
        boxes, dear = _candidates(placing, wanted_label)
        others = owners[(owners[:, 4] != wanted_label.device) & (owners[:, 4] >= 0), :4]
        met = _meets(boxes, walls)
        dear = dear + met @ costs
        if not wanted_label.is_name:  # tooth numbers of planets are inside a gear set
            dear -= met[:, : len(within)] @ (IN_SET * (within == wanted_label.device))
        dear += STRANGE * _meets(boxes + NEAR * OUTWARD, others).any(axis=1)
        box = Rectangle(*boxes[int(np.argmin(dear))].tolist())
        walls, costs = np.vstack([walls, [box]]), np.append(costs, ON_TEXT)
        middle = (box.left + box.right) / 2, (box.low + box.high) / 2
        label = DeviceLabel(wanted_label.text, middle, box, wanted_label.is_name)
        labels.setdefault(wanted_label.device, []).append(label)
    return labels


def _meets(boxes: Boxes, others: Boxes) -> NDArray[np.bool_]:
    first, second = boxes[:, None, :], others[None, :, :]
    common: NDArray[np.bool_] = np.logical_and(
        first[..., :2] < second[..., 2:], second[..., :2] < first[..., 2:]
    )
    return np.logical_and(common[..., 0], common[..., 1])


def _candidates(placing: AxesPlaces, wanted: WantedLabel) -> tuple[Boxes, NDArray[np.float64]]:
    """Return boxes to try for a text around a component, and the cost of each box."""
    (x, y), scale = wanted.above, placing.letters
    half = placing.wide(wanted.text, size=wanted.size, bold=wanted.is_name) / 2 + CLEAR
    tall = LINE * wanted.size * scale * (wanted.text.count("\n") + 1)
    tried = [
        (
            x + aside * scale,
            start + way * away * scale - tall * (way < 0),
            extra + abs(away) + 0.7 * abs(aside),
        )
        for start, way, extra in ((y, wanted.up, 0.0), (wanted.below, -wanted.up, UNDER))
        for away in AWAY
        for aside in ASIDE
    ]
    ends = (y - wanted.up * tall, wanted.below + wanted.up * tall)
    best = (y + wanted.below) / 2 if abs(y - wanted.below) < SHORT else y
    for step in range(BESIDES + 1):
        middle = ends[0] + (ends[1] - ends[0]) * step / BESIDES + wanted.up * tall / 2
        cost, low = BESIDE + 0.1 * abs(middle - best), middle - tall / 2
        tried += [
            (x + way * (wanted.half + off + half), low, cost + off)
            for off in (0.0, 5.0, 12.0)
            for way in (1, -1)
        ]
    across, lows, dear = np.array(tried).T
    lefts = across - half
    return np.stack([lefts, lows, lefts + 2 * half, lows + tall], axis=1), dear


def _teeth(placing: AxesPlaces) -> Iterator[WantedLabel]:
    """Yield tooth numbers with preferred positions: inside the gears of pairs, and at gear sets."""
    for number, station in enumerate(placing.board.stations):
        index, tall = station.devices[0], LINE * SMALL * placing.letters
        if station.teeth:
            radii, ys = (
                placing.board.radii[number][::2],
                [placing.y(end, 0.0) for end in station.axes],
            )
            for place, text in enumerate(station.teeth):
                toward = 1 if ys[1 - place] > ys[place] else -1
                middle_x = placing.xs[number] + 2.5 + placing.wide(text, size=SMALL) / 2
                rim = ys[place] - toward * (radii[place] - 2.5)
                yield WantedLabel(
                    index, text, (middle_x, rim), rim - toward * 5.0, toward, size=SMALL
                )
        for glyph in station.glyphs[placing.chosen.ways[number] :][:1]:
            left, middle = (
                placing.xs[number] - glyph.width / 2,
                placing.sign_height(station.axes[0]),
            )
            for (x, y), edge, text in glyph.texts:
                at = left + x + placing.wide(text, size=SMALL) / 2
                up = placing.board.rows.sides[station.axes[0]] * (-1 if edge == "top" else 1)
                start = placing.y(station.axes[0], middle + y)
                far_start = start + up * tall
                yield WantedLabel(index, text, (at, start), far_start, up, size=SMALL)


def _names(placing: AxesPlaces, solid: Sequence[Obstacle]) -> Iterator[WantedLabel]:
    """Yield names of components, above or below the symbols."""
    ends_of = grouped((item.device, y) for item in solid for y in (item.box.low, item.box.high))
    for number, station in enumerate(placing.board.stations):
        x, side = placing.xs[number], placing.board.rows.sides[station.axes[0]]
        for device, text in zip(station.devices, station.names, strict=False):
            ends = ends_of[device]
            if station.joint is not None:
                radii, side = zip(station.axes, placing.board.radii[number][::2], strict=True), 1
                ends = [placing.y(axis, way * radius) for axis, radius in radii for way in (1, -1)]
            above, below = (max(ends) + NAME_GAP, min(ends) - NAME_GAP)[::side]
            yield WantedLabel(device, text, (x, above), below, side, station.half)
