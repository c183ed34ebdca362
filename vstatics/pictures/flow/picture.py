"""Where the power goes in a gear: bands as wide as their power, with losses and loops."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from matplotlib.figure import Figure

from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.labels import title_width
from vstatics.pictures.drawing.style import SHORT_NAME, WIDE_MARGIN, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.pictures.flow.graph import Graph, graph
from vstatics.pictures.flow.layout import layout
from vstatics.pictures.flow.places import FlowLayout
from vstatics.pictures.flow.rows import rows
from vstatics.pictures.flow.sheets import (
    FlowBlock,
    FlowGear,
    gear_blocks,
    nothing,
    row_blocks,
    sheets,
)
from vstatics.pictures.flow.signs import MILD_HATCH, hatched_look, loop_colour
from vstatics.pictures.flow.texts import FlowTexts, heading
from vstatics.pictures.flow.titles import FlowTitles, titles

BAND_WIDTH = 30.0
"""Of a band of power 1. [pt]"""
MOST_NODE_HEIGHT = 90.0
"""Of any node. [pt]"""
LEAST_FLOW_WIDTH = 330.0
"""Width of the figure, without its margins. [pt]"""
TITLE_WIDTH = 450.0
"""A title is not wrapped up to here. [pt]"""
NAME_WIDTHS = (SHORT_NAME, 60.0, 44.0)
"""To which names of nodes are wrapped; the less where a gear is wider than the page. [pt]"""


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """The power flow of all gears, or of some; all figures in one scale.

    Power runs from left to right, widths of bands are power in one scale for all gears.
    Losses leave downwards, power that circulates goes back below. With losses, if the
    gear has a flow with losses. Of several gears those in which nothing branches are a line
    of text.

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
        gears = [
            FlowGear(flow, next(placings), _titles(results, flow, number, style))
            for number in own
            for flow in [every[number - 1]]
        ]
        yield list(
            _alone(results, gears[0], style) if len(gears) == 1 else _all(results, gears, style)
        )


def _titles(results: Results, flow: GearFlow, number: int, style: Style) -> FlowTitles | None:
    if flow.shown is None:
        return None
    return titles(FlowTexts(flow, flow.shown, style), results.gear_at(number - 1))


def placed(found: Sequence[GearFlow], style: Style) -> list[list[FlowLayout]]:
    """The rows of gears in one scale; none of a gear of which nothing is to be drawn."""
    graphs = [graph(flow.shown) if flow.shown is not None else None for flow in found]
    powers = [
        drawn.through(node) for drawn in graphs if drawn for run in drawn.runs for node in run
    ]
    scale = min(BAND_WIDTH, MOST_NODE_HEIGHT / max(powers, default=1.0))
    return [
        _rows(flow, drawn, scale, style) if flow.shown and drawn and drawn.runs else []
        for flow, drawn in zip(found, graphs, strict=True)
    ]


def _rows(flow: GearFlow, drawn: Graph, scale: float, style: Style) -> list[FlowLayout]:
    """A gear as narrow as the page: with names in more lines, or in several rows."""
    room, side = style.width - 2 * WIDE_MARGIN, flow.shown
    assert side is not None  # noqa: S101 - who asks knows
    ways = [
        partial(layout, scale=scale, texts=FlowTexts(flow, side, style, short))
        for short in NAME_WIDTHS
    ]
    for way in ways:
        whole = way(drawn)
        if whole.width <= room:
            return [whole]
    cut = (rows(drawn, room, way) for way in ways)
    return min(cut, key=lambda own: (max(one.width for one in own) > room, len(own)))


def _all(results: Results, gears: Sequence[FlowGear], style: Style) -> Iterator[Figure]:
    """Several gears with their names."""
    name = title(results.case, style.text("power flow"))
    room = style.width - 2 * WIDE_MARGIN
    yield from sheets(list(gear_blocks(gears, room, style)), name, "", key, room, style)


def _alone(results: Results, gear: FlowGear, style: Style) -> Iterator[Figure]:
    """A gear by itself, whose name is in the title."""
    subject = style.text("power flow")
    name = title(results.case, f"{subject}, {gear_title(gear.flow.gear, style)}")
    room = style.width - 2 * WIDE_MARGIN
    of_name = min(title_width(name), TITLE_WIDTH, room) if style.titled else 0.0
    wide = max(min(LEAST_FLOW_WIDTH, room), of_name, gear.wide)
    blocks = row_blocks(gear, wide) or [FlowBlock([], wide, 0.0, 0.0, nothing)]
    yield from sheets(blocks, name, heading(gear.flow, wide, style), key, wide, style)


def key(shown: Sequence[FlowGear], style: Style) -> list[Meaning]:
    """What colours mean, of those that the picture has."""
    drawn = [(one.titles, row) for one in shown if one.titles for row in one.rows]
    pairs = [(said, line.band) for said, row in drawn for line in row.lines]
    loops = [said.is_doubtful(band) for said, band in pairs if band.loop is not None]
    lost = any(box.cell.lost for _, row in drawn for box in row.boxes)
    pieces = [
        said.is_mild(node) for said, row in drawn for node in row.graph.place if said.is_open(node)
    ]
    loop = loop_colour(style)
    by_convention = "divided by convention, turns as one piece"
    mild = "divided within friction, turns as one piece"
    mild_look = {"facecolor": style.paper, "edgecolor": style.ink, "hatch": MILD_HATCH}
    doubtful = "circulates, may not be in the metal"
    return [
        (drawn, "power", {"facecolor": style.power}),
        (False in pieces, by_convention, hatched_look(style.power, style)),
        (True in pieces, mild, {**mild_look, "width": 0.5}),
        (lost, "lost", {"facecolor": style.lost}),
        (False in loops, "circulates", {"facecolor": loop}),
        (True in loops, doubtful, hatched_look(loop, style)),
    ]
