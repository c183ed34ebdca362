"""Links in a row with the devices between them, and the shape of a mode over them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import Chart
from vstatics.pictures.sheet.labels import LEADER, Label, Point
from vstatics.pictures.sheet.style import Style, number
from vstatics.pictures.sheet.svg import told
from vstatics.pictures.vibration.links import ModeDevice, ModeLinks

LINK_PITCH = 26.0
"""From link to link. [pt]"""
LEAST, MOST = 130.0, 1600.0
"""Width of all links. [pt]"""
LEVEL = 19.0
"""From level to level of devices. [pt]"""
GROUND_HEIGHT = 24.0
"""From a link up to the housing. [pt]"""
LINK_NAME_LENGTH = 110.0
"""Names are wrapped to this length. [pt]"""
SPRING_NUMBER_SIZE = 6.5
"""Of the numbers of springs. [pt]"""
ROOMY = 18.0
"""With less from link to link there are no numbers of springs. [pt]"""


class Axis(NamedTuple):
    """Where the links stand."""

    panel: Chart
    left: float
    """[pt]"""
    pitch: float
    """[pt]"""

    def at(self, place: float) -> float:
        """The abscissa of a place in the row, from 0 [pt]."""
        return self.left + (place + 0.5) * self.pitch


def breadth(count: int) -> float:
    """Width of so many links [pt]."""
    return min(max(count * LINK_PITCH, LEAST), max(MOST, 2.0 * count))


def springs(links: ModeLinks) -> list[str]:
    """Names of elastic devices in the order of their numbers."""
    return [device.name for device in links.devices if device.elastic]


def _names(links: ModeLinks, pitch: float) -> list[tuple[int, str]]:
    """Places and names; of many links only some, so that they have room."""
    names = [labels.wrapped(name, LINK_NAME_LENGTH) for name in links.names]
    highest = max(map(labels.height, names), default=0.0) + labels.LABEL_GAP
    every = math.ceil(highest / pitch) if len(names) * pitch >= MOST else 1
    return [(place, name) for place, name in enumerate(names) if place % every == 0]


def height(links: ModeLinks, pitch: float) -> float:
    """Of the row with the names above it and the devices below it [pt]."""
    up = max((labels.width(name) for _, name in _names(links, pitch)), default=0.0)
    up += LEADER + labels.LABEL_GAP
    return up + _above(links) + _below(links)


def _above(links: ModeLinks) -> float:
    return GROUND_HEIGHT if any(one.is_grounded for one in links.devices) else 8.0


def _below(links: ModeLinks) -> float:
    levels = (one.level for one in links.devices if not one.is_grounded)
    return 10.0 + LEVEL * max(levels, default=0)


def draw_links(axis: Axis, low: float, links: ModeLinks, style: Style) -> None:
    """The row of links above an ordinate [pt]: names, springs, what is rigid."""
    panel, y = axis.panel, low + _below(links)
    at = [Label(axis.at(place), name, style.ink) for place, name in _names(links, axis.pitch)]
    _write_names(panel, y + _above(links), at)
    count = 0
    for device in links.devices:
        count += device.elastic
        _draw_device(axis, y, device, str(count) if device.elastic else "", style)
    for place, heavy in enumerate(links.heavy):
        colour = style.colour(links.numbers[place] - 1)
        _draw_dot(panel, (axis.at(place), y), colour, style, heavy=heavy)


def _write_names(panel: Chart, low: float, names: list[Label]) -> None:
    """Upright, each with a line to its link."""
    sizes = [labels.height(one.text) + labels.LABEL_GAP for one in names]
    places = labels.spread([one.at for one in names], sizes, 0.0, panel.width)
    high = low + 0.6 * LEADER
    both = list(zip(names, places, strict=True))
    pieces = [((name.at, low), (place, high)) for name, place in both]
    panel.lines(pieces, color=names[0].colour if names else "none", linewidth=0.5)
    for name, place in both:
        how: dict[str, Any] = {"rotation": 90, "ha": "center", "va": "bottom"}
        panel.write(place, low + 0.75 * LEADER, name.text, color=name.colour, **how)


def _draw_device(axis: Axis, y: float, device: ModeDevice, mark: str, style: Style) -> None:
    """A device: on the line, below it with a line to each of its links, or at the housing."""
    panel = axis.panel
    colour = style.ink if device.elastic else style.faint
    look: dict[str, Any] = {"color": colour, "linewidth": 1.2 if device.elastic else 0.9}
    look["gid"] = told(device.name)
    half = min(8.0, 0.3 * axis.pitch)
    if device.is_grounded:
        _draw_ground(axis, y, device, mark, look)
        return
    level = y - LEVEL * device.level
    for place in device.members if device.level else ():
        panel.line((axis.at(place), y), (axis.at(place), level), **look)
    for place in device.members[1:-1]:  # else it might pass for a crossing
        panel.line((axis.at(place), level), marker="o", markersize=2.4, color=colour)
    ends = axis.at(device.members[0]), axis.at(device.members[-1])
    if not device.elastic:
        panel.line((ends[0], level), (ends[1], level), **look)
        return
    gaps = list(range(device.members[0], device.members[-1]))
    middle = axis.at(gaps[len(gaps) // 2] + 0.5)
    panel.line((ends[0], level), (middle - half, level), **look)
    panel.line(*_zigzag(middle, level, half), **look)
    panel.line((middle + half, level), (ends[1], level), **look)
    if axis.pitch >= ROOMY:
        how: dict[str, Any] = {"ha": "center", "va": "top", "fontsize": SPRING_NUMBER_SIZE}
        panel.write(middle, level - 5.5, mark, **how)


def _zigzag(x: float, y: float, half: float) -> list[tuple[float, float]]:
    """The windings of a spring along a level line."""
    turns = [(x + half * (step / 4 - 1), y + 3.5 * (1, -1)[step % 2]) for step in range(1, 8)]
    return [(x - half, y), *turns, (x + half, y)]


def _draw_ground(axis: Axis, y: float, device: ModeDevice, mark: str, look: Any) -> None:
    """A spring from a link up to the housing."""
    panel, link, top = axis.panel, axis.at(device.members[0]), y + GROUND_HEIGHT - 6
    x = link + 0.6 * axis.pitch * device.level
    turns = [(x + turn - y, y + 11 + along - x) for along, turn in _zigzag(x, y, 7.0)]
    panel.line((link, y), *turns, (x, top), **look)
    panel.line((x - 5, top), (x + 5, top), **look)
    for step in (-5, -1, 3):
        panel.line((x + step, top), (x + step + 2.5, top + 3), **look)
    if axis.pitch >= ROOMY:
        panel.write(x + 6, y + 11, mark, va="center", fontsize=SPRING_NUMBER_SIZE)


def draw_legend(panel: Chart, left: float, low: float, style: Style, *, elastic: bool) -> None:
    """What the marks of the row mean, two lines above an ordinate [pt]."""
    line = labels.height("")
    for row, (english, russian) in enumerate(
        (("rigid", "жёсткая связь"), ("elastic, by number", "упругая, с номером"))
        if elastic
        else (("without inertia", "без инерции"), ("with inertia", "с инерцией"))
    ):
        y = low + row * line
        if not elastic:
            _draw_dot(panel, (left + 8, y), style.ink, style, heavy=bool(row))
        elif row:
            panel.line(*_zigzag(left + 8, y, 8.0), color=style.ink, linewidth=1.2)
        else:
            panel.line((left, y), (left + 16, y), color=style.faint, linewidth=0.9)
        panel.write(left + 22, y, style.text(english, russian), va="center", color=style.soft)


def _draw_dot(
    panel: Chart, at: tuple[float, float], colour: str, style: Style, *, heavy: bool
) -> None:
    """A link."""
    look: dict[str, Any] = {"marker": "o", "markersize": 5.0 if heavy else 3.2, "zorder": 4}
    fill = colour if heavy else style.paper
    panel.line(at, markerfacecolor=fill, markeredgecolor=colour, **look)


Segment = tuple[Point, Point]


class AmplitudeBand(NamedTuple):
    """Where amplitudes are drawn."""

    rest: float
    """The ordinate of what stands. [pt]"""
    unit: float
    """The length of an amplitude of 1. [pt]"""

    def at(self, amplitude: float) -> float:
        """The ordinate of an amplitude [pt]."""
        return self.rest + self.unit * amplitude


def draw(
    axis: Axis, band: AmplitudeBand, links: ModeLinks, shape: Mapping[str, float], style: Style
) -> None:
    """Amplitudes as bars from the line of rest, joined as the links are.

    Parameters
    ----------
    shape : mapping of str to float
        Amplitudes of links by their names, of 1 at most.
    """
    tips = [(axis.at(place), band.at(shape[name])) for place, name in enumerate(links.names)]
    _draw_scale(axis, band, len(tips), style)
    _draw_devices(axis.panel, tips, links, style)
    for name, link, heavy, (x, y) in zip(
        links.names, links.numbers, links.heavy, tips, strict=True
    ):
        colour = style.colour(link - 1)
        look: dict[str, Any] = {"color": colour, "linewidth": 1.0, "marker": "o", "zorder": 4}
        fill = {"markerfacecolor": colour if heavy else style.paper, "markersize": 3.6}
        said = told(f"{name}: {number(shape[name])}")
        axis.panel.line((x, band.rest), (x, y), markevery=[1], gid=said, **look, **fill)


def _draw_scale(axis: Axis, band: AmplitudeBand, count: int, style: Style) -> None:
    """Lines at rest and at the largest amplitudes, and one for each link."""
    start, end = axis.left, axis.at(count - 1) + 0.5 * axis.pitch
    for amplitude, text in ((-1, "−1"), (0, "0"), (1, "+1")):
        y = band.at(amplitude)
        wide = 0.4 if amplitude else 0.8
        axis.panel.line((start, y), (end, y), color=style.faint, linewidth=wide)
        how: dict[str, Any] = {"ha": "right", "va": "center", "fontsize": SPRING_NUMBER_SIZE}
        axis.panel.write(start - 3, y, text, color=style.soft, **how)
    low, high = band.at(-1), band.at(1)
    upright = [((x, low), (x, high)) for x in map(axis.at, range(count))]
    axis.panel.lines(upright, color=style.faint, linewidth=0.3)


def _draw_devices(panel: Chart, tips: list[Point], links: ModeLinks, style: Style) -> None:
    """Lines between the links that devices join; dashed where a twist has more than two."""
    rigid: list[Segment] = []
    shafts: list[Segment] = []
    others: list[Segment] = []
    for device in links.devices:
        pairs = [(tips[one], tips[other]) for one, other in pairwise(device.members)]
        (rigid if not device.elastic else shafts if len(pairs) == 1 else others).extend(pairs)
    panel.lines(rigid, color=style.faint, linewidth=1.2)
    panel.lines(others, color=style.ink, linewidth=1.2, linestyle=(0, (3, 1.5)))
    panel.lines(shafts, color=style.ink, linewidth=1.2)
