"""Where the power goes in a gear: bands as wide as their power, with losses and loops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.flow.power import flows
from vstatics.flow.power_flow import GearFlow
from vstatics.pictures.flow.graph import graph
from vstatics.pictures.flow.layout import layout
from vstatics.pictures.flow.places import FlowLayout
from vstatics.pictures.flow.signs import FlowPen, hatched_look, loop_colour
from vstatics.pictures.flow.texts import FlowTexts, heading
from vstatics.pictures.flow.titles import FlowTitles, titles
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.head import KeySign, chart_head
from vstatics.pictures.sheet.labels import Paper, height
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import TITLE, Style
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.statics.results import Results

BAND_WIDTH = 30.0
"""Of a band of power 1. [pt]"""
THICKEST = 90.0
"""Of any node. [pt]"""
FLOW_MARGIN = 14.0
"""[pt]"""
LEAST_FLOW_WIDTH = 330.0
"""Width of the figure, without its margins. [pt]"""
TITLE_WIDTH = 450.0
"""A title is not wrapped up to here. [pt]"""
FLOW_GEAR_GAP = 22.0
"""Gears. [pt]"""
BELOW_TEXT = 8.0
"""Between a text of the whole figure and what follows. [pt]"""


class FlowGear(NamedTuple):
    """What is drawn of a gear."""

    flow: GearFlow
    layout: FlowLayout
    titles: FlowTitles


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
    >>> [text.get_text() for text in figure.texts if "circulates" in text.get_text()][-1]
    'circulates 1.000: 100.0% of the power in'
    """
    return _figure(results, _chosen(results, style, gears), style)


def of_each_gear(results: Results, style: Style) -> Iterator[Figure]:
    """A figure for each gear, in one scale for all."""
    for one in _chosen(results, style, ()):
        yield _figure(results, [one], style)


_Chosen = tuple[GearFlow, FlowGear | None]
"""Nothing of a gear in which no power is drawn."""


def _chosen(results: Results, style: Style, gears: Sequence[int]) -> list[_Chosen]:
    """Those of all gears, or of some."""
    every = flows(results)
    numbers = list(gears) or range(1, len(every) + 1)
    chosen = [every[number - 1] for number in numbers]
    placings = placed(chosen, style)
    found: list[_Chosen] = []
    for number, flow, placing in zip(numbers, chosen, placings, strict=True):
        side = flow.lossy or flow.ideal
        if placing is None or side is None:
            found.append((flow, None))
        else:
            said = titles(FlowTexts(flow, side, style), flow, results.gear(number))
            found.append((flow, FlowGear(flow, placing, said)))
    return found


def placed(found: Sequence[GearFlow], style: Style) -> list[FlowLayout | None]:
    """The layouts of gears in one scale; None of a gear of which nothing is to be drawn."""
    sides = [flow.lossy or flow.ideal for flow in found]
    graphs = [graph(side) if side is not None else None for side in sides]
    powers = [
        drawn.through(node) for drawn in graphs if drawn for run in drawn.runs for node in run
    ]
    scale = min(BAND_WIDTH, THICKEST / max(powers, default=1.0))
    return [
        layout(drawn, scale, FlowTexts(flow, side, style))
        if side and drawn and drawn.runs
        else None
        for flow, side, drawn in zip(found, sides, graphs, strict=True)
    ]


class _GearBlock(NamedTuple):
    """A gear with its heading, which one alone has in the title."""

    name: str
    text: str
    gear: FlowGear | None

    @property
    def high(self) -> float:
        """[pt]."""
        heads = sum(height(one) for one in (self.name, self.text) if one)
        return heads + (BELOW_TEXT + self.gear.layout.height if self.gear else 0.0)

    def draw(self, paper: Paper, top: float, style: Style) -> None:
        """Below a height [pt]."""
        if self.name:
            paper.write(FLOW_MARGIN, top, self.name, va="top", weight="bold", color=style.ink)
            place = FLOW_MARGIN, top - height(self.name)
            paper.write(*place, self.text, va="top", color=style.soft)
        if self.gear:
            start = top - self.high + self.gear.layout.height
            FlowPen(paper, FLOW_MARGIN, start, self.gear.titles, style).draw(self.gear.layout)


def _figure(results: Results, chosen: Sequence[_Chosen], style: Style) -> Figure:
    """One gear, or several with headings."""
    shown = [one for _, one in chosen if one]
    alone = len(chosen) == 1
    subject = style.text("power flow", "поток мощности")
    subject += f", {gear_title(chosen[0][0].gear, style)}" if alone else ""
    name = title(results.case, subject)
    of_name = min(labels.width(name, TITLE, bold=True), TITLE_WIDTH) if style.titled else 0.0
    wide = max([LEAST_FLOW_WIDTH, of_name, *(one.layout.width for one in shown)])
    blocks = [
        _GearBlock(gear_title(flow.gear, style), heading(flow, wide, style), one)
        for flow, one in chosen
    ]
    head = chart_head(name, blocks[0].text if alone else "", _key(shown, style), wide, style)
    if alone:
        blocks = [blocks[0]._replace(name="", text="")]
    high = (
        head.high + BELOW_TEXT + sum(one.high for one in blocks) + FLOW_GEAR_GAP * (len(blocks) - 1)
    )
    figure = labels.figure(wide + 2 * FLOW_MARGIN, high + 2 * FLOW_MARGIN)
    paper, top = Paper(figure), high + FLOW_MARGIN
    head.draw(paper, FLOW_MARGIN, top, style)
    top -= head.high + BELOW_TEXT
    for block in blocks:
        block.draw(paper, top, style)
        top -= block.high + FLOW_GEAR_GAP
    return figure


def _key(shown: Sequence[FlowGear], style: Style) -> list[KeySign]:
    """What colours mean, of those that the picture has."""
    pairs = [(one.titles, line.band) for one in shown for line in one.layout.lines]
    loops = [said.is_doubtful(band) for said, band in pairs if band.loop is not None]
    lost = any(box.cell.lost for one in shown for box in one.layout.boxes)
    divided = any(one.flow.by_convention for one in shown)
    plain: Look = {"linewidth": 0}
    loop = loop_colour(style)
    rows = (
        (shown, "power", "мощность", {"facecolor": style.power, **plain}),
        (
            divided,
            "divided by convention, turns as one piece",
            "разделена условно внутри одного целого",
            hatched_look(style.power, style),
        ),
        (lost, "lost", "потери", {"facecolor": style.lost, **plain}),
        (False in loops, "circulates", "циркулирует", {"facecolor": loop, **plain}),
        (
            True in loops,
            "circulates, may not be in the metal",
            "циркулирует, в металле может не быть",
            hatched_look(loop, style),
        ),
    )
    return [
        KeySign(style.text(english, russian), look)
        for there, english, russian, look in rows
        if there
    ]
