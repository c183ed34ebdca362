"""Row of links with the components between them, and a mode shape over the row."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.labels import LABEL_GAP, LEADER, height, spread, widest, wrapped
from vstatics.pictures.drawing.pen import Pen, zigzag
from vstatics.pictures.drawing.style import LONG_NAME, SMALL_NUMBER, number
from vstatics.torsion.pictures.shapes.links import ModeDevice, ModeLinks

LINK_PITCH = 26.0
"""Usual distance between neighbouring links. [pt]"""
LEAST_ROW_WIDTH = 130.0
"""Smallest width of a row of links. [pt]"""
NEAREST_LINKS = 13.0
"""Distance between links above which all links have names. [pt]"""
BEYOND_ROW = 12.0
"""Largest length by which names extend beyond the ends of the row. [pt]"""
LEVEL_PITCH = 19.0
"""Distance between levels of components below the row. [pt]"""
GROUND_HEIGHT = 24.0
"""Height of the sign of the housing above a link. [pt]"""
LEGEND_SIGN = 22.0
"""Distance from the left end of a sign to the text in the legend. [pt]"""
_ELASTIC = "rigid", "elastic, by number"
_HEAVY = "without inertia", "with inertia"
"""Texts of the legend for dots of links, from bottom to top."""
ROOMY_PITCH = 12.0
"""Distance between links above which springs have numbers. [pt]"""


class Axis(NamedTuple):
    """Positions of links along a row."""

    pen: Pen
    left: float
    """Abscissa of the left end of the row. [pt]"""
    pitch: float
    """Distance between neighbouring links. [pt]"""

    def at(self, place: float) -> float:
        """Return the abscissa [pt] of the link with an index in the row."""
        return self.left + (place + 0.5) * self.pitch


def whole_width(links: ModeLinks) -> float:
    """Return the usual width of a row of links [pt]."""
    return max(len(links.names) * LINK_PITCH, LEAST_ROW_WIDTH)


def least_width(links: ModeLinks) -> float:
    """Return the smallest width of a row in which all links can have names [pt]."""
    return max(len(links.names) * NEAREST_LINKS, LEAST_ROW_WIDTH)


def springs(links: ModeLinks) -> list[str]:
    """Return the names of elastic components, in the order of their printed numbers."""
    return [device.name for device in links.devices if device.elastic]


def _names(links: ModeLinks, pitch: float) -> list[tuple[int, str]]:
    """Return index and name of every n-th link, so that the names have room."""
    names = [wrapped(name, LONG_NAME) for name in links.names]
    needed = sum(height(name) + LABEL_GAP for name in names)
    every = math.ceil(needed / (len(names) * pitch + 2 * BEYOND_ROW)) if names else 1
    return [(place, name) for place, name in enumerate(names) if place % every == 0]


def row_height(links: ModeLinks, pitch: float) -> float:
    """Return the height of the row, with names above and components below [pt]."""
    up = widest(name for _, name in _names(links, pitch))
    up += LEADER + LABEL_GAP
    return up + _above(links) + _below(links)


def _above(links: ModeLinks) -> float:
    return GROUND_HEIGHT if any(device.is_grounded for device in links.devices) else 8.0


def _below(links: ModeLinks) -> float:
    levels = (device.level for device in links.devices if not device.is_grounded)
    return 10.0 + LEVEL_PITCH * max(levels, default=0)


def draw_links(axis: Axis, low: float, links: ModeLinks) -> None:
    """Draw the row of links, with its names and components, above a height [pt]."""
    pen, y = axis.pen, low + _below(links)
    _write_names(axis, y + _above(links), _names(links, axis.pitch))
    count = 0
    for device in links.devices:
        count += device.elastic
        _draw_device(axis, y, device, str(count) if device.elastic else "")
    for place, heavy in enumerate(links.heavy):
        colour = pen.style.colour(links.numbers[place] - 1)
        _draw_link(pen, (axis.at(place), y), colour, heavy=heavy)


def _write_names(axis: Axis, low: float, names: Sequence[tuple[int, str]]) -> None:
    wanted = [axis.at(place) for place, _ in names]
    sizes = [height(name) + LABEL_GAP for _, name in names]
    row = axis.left, axis.left + sum(sizes)
    places = spread(wanted, sizes, min(row[0], wanted[0]) - BEYOND_ROW, axis.pen.size[0])
    both = zip(wanted, places, strict=True)
    pieces = [((at, low), (place, low + 0.6 * LEADER)) for at, place in both]
    axis.pen.lines(pieces, color=axis.pen.style.ink, width=0.5)
    for (_, name), place in zip(names, places, strict=True):
        axis.pen.text(place, low + 0.75 * LEADER, name, rotation=90, ha="center", va="bottom")


def _draw_device(axis: Axis, y: float, device: ModeDevice, mark: str) -> None:
    """Draw a component: on the row, below the row with lines to its links, or at the housing."""
    pen = axis.pen
    colour, wide = (pen.style.ink, 1.2) if device.elastic else (pen.style.faint, 0.9)
    look: Look = {"color": colour, "width": wide, "title": device.name}
    half = min(8.0, 0.3 * axis.pitch)
    if device.is_grounded:
        _draw_ground(axis, y, device, mark, look)
        return
    level = y - LEVEL_PITCH * device.level
    for place in device.members if device.level else ():
        pen.line((axis.at(place), y), (axis.at(place), level), **look)
    for place in device.members[1:-1]:  # a dot marks a joint of lines, not a crossing
        at = axis.at(place), level
        pen.line(at, marker="o", markersize=2.4, color=colour, width=1.5)
    ends = [(axis.at(place), level) for place in (device.members[0], device.members[-1])]
    if not device.elastic:
        pen.line(*ends, **look)
        return
    gaps = range(device.members[0], device.members[-1])
    middle = axis.at(gaps[len(gaps) // 2] + 0.5)
    pen.line(ends[0], (middle - half, level), **look)
    pen.line(*zigzag(middle, level, half, 3.5), **look)
    pen.line((middle + half, level), ends[1], **look)
    if axis.pitch >= ROOMY_PITCH:
        pen.text(middle, level - 5.5, mark, ha="center", va="top", size=SMALL_NUMBER)


def _draw_ground(axis: Axis, y: float, device: ModeDevice, mark: str, look: Look) -> None:
    pen, link, top = axis.pen, axis.at(device.members[0]), y + GROUND_HEIGHT - 6
    x = link + 0.6 * axis.pitch * device.level
    turns = [(x + turn - y, y + 11 + along - x) for along, turn in zigzag(x, y, 7.0, 3.5)]
    pen.line((link, y), *turns, (x, top), **look)
    pen.line((x - 5, top), (x + 5, top), **look)
    for step in (-5, -1, 3):
        pen.line((x + step, top), (x + step + 2.5, top + 3), **look)
    if axis.pitch >= ROOMY_PITCH:
        pen.text(x + 6, y + 11, mark, va="center", size=SMALL_NUMBER)


def draw_legend(pen: Pen, right: float, low: float, *, elastic: bool) -> None:
    """Draw the two-line legend, above `low` and to the left of `right` [pt]."""
    style = pen.style
    texts = [style.text(english) for english in (_ELASTIC if elastic else _HEAVY)]
    left = right - LEGEND_SIGN - widest(texts)
    for row, text in enumerate(texts):
        y = low + row * height("")
        if not elastic:
            _draw_link(pen, (left + 8, y), style.ink, heavy=bool(row))
        elif row:
            pen.line(*zigzag(left + 8, y, 8.0, 3.5), color=style.ink, width=1.2)
        else:
            pen.line((left, y), (left + 16, y), color=style.faint, width=0.9)
        pen.text(left + LEGEND_SIGN, y, text, va="center", color=style.soft)


def _draw_link(pen: Pen, at: Point, colour: str, *, heavy: bool) -> None:
    size, fill = (5.0, colour) if heavy else (3.2, pen.style.paper)
    look: Look = {"markerfacecolor": fill, "markeredgecolor": colour, "markersize": size}
    pen.line(at, marker="o", zorder=4, width=1.5, **look)


class AmplitudeBand(NamedTuple):
    """Vertical scale of the amplitudes of a mode."""

    zero: float
    """Height of amplitude 0. [pt]"""
    unit: float
    """Length of an amplitude of 1. [pt]"""

    def at(self, amplitude: float) -> float:
        """Return the height of an amplitude [pt]."""
        return self.zero + self.unit * amplitude


def draw_shape(
    axis: Axis, band: AmplitudeBand, links: ModeLinks, shape: Mapping[str, float]
) -> None:
    """Draw amplitudes as bars, with lines between the ends of bars of connected links.

    Parameters
    ----------
    shape : mapping of str to float
        Amplitudes of links by name; the largest is 1.
    """
    pen, style = axis.pen, axis.pen.style
    tips = [(axis.at(place), band.at(shape[name])) for place, name in enumerate(links.names)]
    _draw_scale(axis, band, len(tips))
    look: Look
    for kind, look in (
        (0, {"color": style.faint}),
        (2, {"color": style.ink, "linestyle": (0, (3, 1.5))}),
        (1, {"color": style.ink}),
    ):
        chosen = [device.members for device in links.devices if device.kind == kind]
        pairs = [pair for members in chosen for pair in pairwise(members)]
        pen.lines([(tips[left], tips[right]) for left, right in pairs], width=1.2, **look)
    for name, link, heavy, (x, y) in zip(
        links.names, links.numbers, links.heavy, tips, strict=True
    ):
        colour = style.colour(link - 1)
        look = {"color": colour, "width": 1.0, "marker": "o", "markersize": 3.6, "zorder": 4}
        look["markerfacecolor"] = colour if heavy else style.paper
        hint = f"{name}: {number(shape[name])}"
        pen.line((x, band.zero), (x, y), markevery=[1], title=hint, **look)


def _draw_scale(axis: Axis, band: AmplitudeBand, count: int) -> None:
    """Draw lines at the amplitudes -1, 0 and 1, and a vertical line at each link."""
    pen, start, end = axis.pen, axis.left, axis.at(count - 1) + 0.5 * axis.pitch
    for amplitude, text in ((-1, "−1"), (0, "0"), (1, "+1")):
        y, wide = band.at(amplitude), 0.4 if amplitude else 0.8
        pen.line((start, y), (end, y), color=pen.style.faint, width=wide)
        look: Look = {"ha": "right", "va": "center", "color": pen.style.soft}
        pen.text(start - 3, y, text, size=SMALL_NUMBER, **look)
    upright = [((x, band.at(-1)), (x, band.at(1))) for x in map(axis.at, range(count))]
    pen.lines(upright, color=pen.style.faint, width=0.3)
