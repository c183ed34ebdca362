"""Where the power goes in a gear: bands as wide as their power, with losses and loops."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.flow.power import flows
from vstatics.flow.power_flow import GearFlow
from vstatics.pictures.flow.graph import graph
from vstatics.pictures.flow.layout import layout
from vstatics.pictures.flow.places import FlowLayout
from vstatics.pictures.flow.signs import FlowView, hatched_look, loop_colour
from vstatics.pictures.flow.texts import FlowTexts, heading
from vstatics.pictures.flow.titles import FlowTitles, titles
from vstatics.pictures.sheet.head import Meaning, sheet_head
from vstatics.pictures.sheet.labels import height, title_width
from vstatics.pictures.sheet.style import WIDE_MARGIN, Style
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.statics.results import Results

BAND_WIDTH = 30.0
"""Of a band of power 1. [pt]"""
MOST_NODE_HEIGHT = 90.0
"""Of any node. [pt]"""
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

    layout: FlowLayout
    titles: FlowTitles


_Chosen = tuple[GearFlow, FlowGear | None]
"""Nothing of a gear in which no power is drawn."""


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """The power flow of all gears, one below another, or of some; all figures in one scale.

    Power runs from left to right, widths of bands are power in one scale for all gears.
    Losses leave downwards, power that circulates goes back below. With losses, if the
    gear has a flow with losses.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> [[figure]] = each(solve(Transmission(3, [], mechanisms, [Gear()])), Style(), [()])
    >>> [text.get_text() for text in figure.texts if "circulates" in text.get_text()][-1]
    'circulates 1.000: 100.0% of the power in'
    """
    every = flows(results)
    numbers = [gears or range(1, len(every) + 1) for gears in shown]
    chosen = [every[number - 1] for own in numbers for number in own]
    placings = iter(placed(chosen, style))
    for own in numbers:
        found: list[_Chosen] = []
        for number in own:
            flow, placing, drawn = every[number - 1], next(placings), None
            if placing is not None and flow.shown is not None:
                said = titles(FlowTexts(flow, flow.shown, style), results.gear(number))
                drawn = FlowGear(placing, said)
            found.append((flow, drawn))
        yield [_figure(results, found, style)]


def placed(found: Sequence[GearFlow], style: Style) -> list[FlowLayout | None]:
    """The layouts of gears in one scale; None of a gear of which nothing is to be drawn."""
    graphs = [graph(flow.shown) if flow.shown is not None else None for flow in found]
    powers = [
        drawn.through(node) for drawn in graphs if drawn for run in drawn.runs for node in run
    ]
    scale = min(BAND_WIDTH, MOST_NODE_HEIGHT / max(powers, default=1.0))
    return [
        layout(drawn, scale, FlowTexts(flow, flow.shown, style))
        if flow.shown and drawn and drawn.runs
        else None
        for flow, drawn in zip(found, graphs, strict=True)
    ]


def _figure(results: Results, chosen: Sequence[_Chosen], style: Style) -> Figure:
    """One gear, or several with headings."""
    shown = [one for _, one in chosen if one]
    names = [gear_title(flow.gear, style) for flow, _ in chosen]
    is_alone = len(chosen) == 1
    subject = style.text("power flow", "поток мощности")
    name = title(results.case, f"{subject}, {names[0]}" if is_alone else subject)
    of_name = min(title_width(name), TITLE_WIDTH) if style.titled else 0.0
    wide = max([LEAST_FLOW_WIDTH, of_name, *(one.layout.width for one in shown)])
    texts = [heading(flow, wide, style) for flow, _ in chosen]
    heads = [
        0.0 if is_alone else height(one) + height(text)
        for one, text in zip(names, texts, strict=True)
    ]
    heights = [
        over + (BELOW_TEXT + one.layout.height if one else 0.0)
        for over, (_, one) in zip(heads, chosen, strict=True)
    ]
    head = sheet_head(name, texts[0] if is_alone else "", _key(shown, style), wide, style)
    above = head.high + BELOW_TEXT
    high = above + sum(heights) + FLOW_GEAR_GAP * (len(chosen) - 1) + WIDE_MARGIN
    pen = head.over((wide + 2 * WIDE_MARGIN, high - head.high), WIDE_MARGIN, style)
    top = high - above
    for place, (_, one) in enumerate(chosen):
        if not is_alone:
            pen.text(WIDE_MARGIN, top, names[place], va="top", bold=True)
            at = WIDE_MARGIN, top - height(names[place])
            pen.text(*at, texts[place], va="top", color=style.soft)
        if one:
            start = top - heights[place] + one.layout.height
            FlowView(pen, WIDE_MARGIN, start, one.titles).draw(one.layout)
        top -= heights[place] + FLOW_GEAR_GAP
    return pen.figure


def _key(shown: Sequence[FlowGear], style: Style) -> list[Meaning]:
    """What colours mean, of those that the picture has."""
    pairs = [(one.titles, line.band) for one in shown for line in one.layout.lines]
    loops = [said.is_doubtful(band) for said, band in pairs if band.loop is not None]
    lost = any(box.cell.lost for one in shown for box in one.layout.boxes)
    divided = any(one.titles.texts.flow.by_convention for one in shown)
    loop = loop_colour(style)
    by_convention = (
        "divided by convention, turns as one piece",
        "разделена условно внутри одного целого",
    )
    doubtful = "circulates, may not be in the metal", "циркулирует, в металле может не быть"
    return [
        (shown, "power", "мощность", {"facecolor": style.power}),
        (divided, *by_convention, hatched_look(style.power, style)),
        (lost, "lost", "потери", {"facecolor": style.lost}),
        (False in loops, "circulates", "циркулирует", {"facecolor": loop}),
        (True in loops, *doubtful, hatched_look(loop, style)),
    ]
