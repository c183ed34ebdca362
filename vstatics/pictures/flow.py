"""Where the power goes in a gear: bands as wide as their power, with losses and loops."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Polygon, Rectangle
from matplotlib.path import Path

from vstatics.flow.power import flows
from vstatics.flow.power_flow import GearFlow
from vstatics.pictures import labels
from vstatics.pictures.flow_columns import ARM
from vstatics.pictures.flow_graph import graph
from vstatics.pictures.flow_places import Box, FlowLayout, Line, layout
from vstatics.pictures.flow_texts import FlowTexts, heading
from vstatics.pictures.labels import Panel, Point, height, wrapped
from vstatics.pictures.style import TITLE, Style
from vstatics.pictures.svg import halo
from vstatics.pictures.words import gear_title
from vstatics.statics.results import Results

WIDEST = 30.0
"""Of a band of power 1. [pt]"""
THICKEST = 90.0
"""Of any node. [pt]"""
MARGIN = 14.0
"""[pt]"""
LEAST = 330.0
"""Width of the figure, without its margins. [pt]"""
VISIBLE = 0.6
"""Width of a band of hardly any power. [pt]"""
ROUND = 6.0
"""Radius of the inner side of a turn. [pt]"""
BETWEEN = 26.0
"""Gears. [pt]"""
PALE = 0.5
"""How much of a band covers what it crosses."""


class _GearPart(NamedTuple):
    """What is drawn of a gear."""

    title: str
    heading: str
    layout: FlowLayout | None

    @property
    def head(self) -> float:
        """Height of its texts [pt]."""
        return height("", TITLE) + (height(self.heading) if self.heading else 0.0) + 10

    @property
    def high(self) -> float:
        """[pt]."""
        return self.head + (self.layout.height if self.layout else 0.0)


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw the power flow of all gears, one below another, or of some.

    Power runs from left to right, widths of bands are power in one scale for all gears.
    Losses leave downwards, power that circulates goes back below. With losses, if the
    gear has a flow with losses.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> figure = draw(solve(Transmission(3, [], mechanisms, [Gear()])), Style())
    >>> [text.get_text() for text in figure.axes[0].texts if "circulates" in text.get_text()][-1]
    'circulates 1.000: 100.0% of the power in'
    """
    return _figure(results, _chosen(results, gears), style)


def sheets(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """A figure for each gear."""
    return [_figure(results, [flow], style) for flow in _chosen(results, gears)]


def _chosen(results: Results, gears: Sequence[int]) -> list[GearFlow]:
    """Those of all gears, or of some."""
    every = flows(results)
    return [every[gear - 1] for gear in gears] or every


def _figure(results: Results, chosen: Sequence[GearFlow], style: Style) -> Figure:
    layouts = placed(chosen, style)
    wide = max([LEAST, *(one.width for one in layouts if one)])
    gears = [
        _GearPart(gear_title(flow.gear, style), heading(flow, wide, style), placing)
        for flow, placing in zip(chosen, layouts, strict=True)
    ]
    case = wrapped(results.case.name, wide, TITLE)
    name = height(case, TITLE) if case else 0.0
    shown = [layout for layout in layouts if layout]
    top = name + (height("") + BETWEEN / 2 if shown else 0.0)
    high = top + sum(one.high for one in gears) + BETWEEN * (len(gears) - 1)
    across, up = wide + 2 * MARGIN, high + 2 * MARGIN
    figure = labels.figure(across, up)
    panel = labels.panel(figure, 0, 0, across, up)
    panel.axes.set(xlim=(0, across), ylim=(0, up))
    panel.axes.set_axis_off()
    panel.write(MARGIN, up - MARGIN, case, va="top", size=TITLE, color=style.ink)
    _legend(panel, up - MARGIN - name - height("") / 2, shown, style)
    low = up - MARGIN - top
    for one in gears:
        _draw_gear(panel, low, one, style)
        low -= one.high + BETWEEN
    return figure


def placed(found: Sequence[GearFlow], style: Style) -> list[FlowLayout | None]:
    """The layouts of gears in one scale; None of a gear of which nothing is to be drawn."""
    sides = [flow.lossy or flow.ideal for flow in found]
    graphs = [graph(side) if side is not None else None for side in sides]
    powers = [drawn.through(node) for drawn in graphs if drawn for node in drawn.layers]
    scale = min(WIDEST, THICKEST / max(powers, default=1.0))
    return [
        layout(drawn, scale, FlowTexts(flow, side, style))
        if side and drawn and drawn.bands
        else None
        for flow, side, drawn in zip(found, sides, graphs, strict=True)
    ]


def _legend(panel: Panel, y: float, shown: Sequence[FlowLayout], style: Style) -> None:
    """What colours mean, of those that the picture has."""
    loops = any(line.band.loop is not None for one in shown for line in one.lines)
    losses = any(box.cell.lost for one in shown for box in one.boxes)
    x = MARGIN
    for colour, text, there in (
        (style.power, style.text("power", "мощность"), bool(shown)),
        (style.lost, style.text("lost", "потери"), losses),
        (style.circulating, style.text("circulates", "циркулирует"), loops),
    ):
        if there:
            patch = Rectangle((x, y - 3), 12, 6, linewidth=0, color=colour)
            patch.set_alpha(PALE if colour == style.circulating else 1.0)
            panel.axes.add_patch(patch)
            panel.write(x + 16, y, text, va="center", color=style.ink)
            x += 32 + labels.width(text)


def _draw_gear(panel: Panel, top: float, one: _GearPart, style: Style) -> None:
    """A gear below a height."""
    panel.write(MARGIN, top, one.title, va="top", size=TITLE, weight="bold", color=style.ink)
    panel.write(MARGIN, top - height("", TITLE), one.heading, va="top", color=style.soft)
    if one.layout is None:
        return
    top -= one.head
    for line in one.layout.lines:
        _draw_line(panel, top, line, style)
    for box in one.layout.boxes:
        _draw_box(panel, top, box, style)
    for note in one.layout.notes:
        how = {"color": style.circulating if note.loop else style.ink, "va": "center"}
        panel.write(
            MARGIN + note.x, top - note.y, note.text, ha="center", zorder=5, **how, **halo(style)
        )


def _draw_line(panel: Panel, top: float, line: Line, style: Style) -> None:
    points = [(MARGIN + x, top - y) for x, y in line.points]
    path = _corners(points, line.width) if line.band.back else _curves(points)
    colour = style.power if line.band.loop is None else style.circulating
    wide = max(line.width, VISIBLE)
    how = {
        "edgecolor": colour,
        "facecolor": "none",
        "alpha": 1.0 if line.band.loop is None else PALE,
        "capstyle": "butt",
    }
    panel.axes.add_patch(PathPatch(path, linewidth=wide, **how))

    if line.band.back:
        for start, end in (points[1:3], points[3:5]):
            _arrow(panel, start, end, min(max(line.width / 4, 2.0), 5.0), colour)


def _arrow(panel: Panel, start: Point, end: Point, size: float, colour: str) -> None:
    """Which way something runs, halfway between two places one above the other."""
    x, y = start[0], (start[1] + end[1]) / 2
    tip = math.copysign(size, end[1] - start[1])
    shape = [(x - size, y - tip), (x + size, y - tip), (x, y + tip)]
    panel.axes.add_patch(Polygon(shape, color=colour, linewidth=0))


def _curves(points: Sequence[Point]) -> Path:
    """Through points, level at each."""
    places, codes = [points[0]], [Path.MOVETO]
    for (left, start), (right, end) in pairwise(points):
        middle = (left + right) / 2
        places += [(middle, start), (middle, end), (right, end)]
        codes += [Path.CURVE4] * 3
    return Path(places, codes)


def _corners(points: Sequence[Point], wide: float) -> Path:
    """From corner to corner, each as round as there is room."""
    places, codes = [points[0]], [Path.MOVETO]
    last = len(points) - 1
    room = [  # two corners share what is between them
        math.dist(*pair) / (1 if place in (0, last - 1) else 2)
        for place, pair in enumerate(pairwise(points))
    ]
    for place in range(1, last):
        corner = points[place]
        rounding = min(wide / 2 + ROUND, room[place - 1], room[place])
        start, end = (_towards(corner, points[place + step], rounding) for step in (-1, 1))
        places += [start, corner, end]
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    return Path([*places, points[-1]], [*codes, Path.LINETO])


def _towards(place: Point, other: Point, way: float) -> Point:
    part = way / (math.dist(place, other) or 1.0)
    return place[0] + (other[0] - place[0]) * part, place[1] + (other[1] - place[1]) * part


def _draw_box(panel: Panel, top: float, box: Box, style: Style) -> None:
    """A node: a bar for a link, a box for a device, an arrow for a port; and its loss."""
    cell = box.cell
    left, right, middle = MARGIN + box.left, MARGIN + box.right, MARGIN + box.middle
    high, low = top - box.top, top - box.bottom
    kind = cell.node.kind if cell.node else ""
    how = {"ha": "center", "zorder": 5, **halo(style)}
    if cell.lost:
        tip = low - ARM - cell.loss / 2
        half = max(cell.loss, VISIBLE) / 2
        head = half + 2.5
        shaft = [(middle + half, low), (middle + half, tip + head)]
        outline = [*shaft, (middle + head, tip + head), (middle, tip)]
        outline += [(2 * middle - x, y) for x, y in reversed(outline[:-1])]
        panel.axes.add_patch(Polygon(outline, color=style.lost, linewidth=0))
        panel.write(middle, tip - 1, cell.lost, va="top", color=style.lost, **how)
    point = min(6.0, box.cell.body / 2) if kind == "port" else 0.0
    shape = [(left, high), (right - point, high), (right, (high + low) / 2), (right - point, low)]
    shape += [(left, low)]
    face = {"link": style.ink, "port": style.faint}.get(kind, style.paper)
    outer = Polygon(shape, zorder=3, facecolor=face, edgecolor=style.ink, linewidth=0.9)
    panel.axes.add_patch(outer)
    panel.write(middle, high + 2, cell.text, va="bottom", color=style.ink, **how)
