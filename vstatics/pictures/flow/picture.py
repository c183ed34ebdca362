"""Picture of the power flow in a gear: bands as wide as their power, with losses and loops."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
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
from vstatics.pictures.flow.texts import FlowTexts, heading
from vstatics.pictures.flow.titles import titles

BAND_WIDTH = 30.0
"""Width of a band that transmits the input power. [pt]"""
MOST_NODE_HEIGHT = 90.0
"""Largest height of a node. [pt]"""
LEAST_FLOW_WIDTH = 330.0
"""Smallest width of a figure without margins. [pt]"""
TITLE_WIDTH = 450.0
"""Width up to which a title is not wrapped. [pt]"""
NAME_WIDTHS = (SHORT_NAME, 60.0, 44.0)
"""Widths to which names of nodes are wrapped; smaller widths for gears wider than the page. [pt]"""


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Canvas]]:
    """Yield the pages with the power flow of each list of gears, in a common scale.

    Power runs from left to right, and bands are as wide as their power. Losses leave downwards, and
    recirculating power returns below. Losses are included if the gear has a flow with losses. Among
    several gears, a gear without branches is a line of text.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> [[page]] = each(solve(Transmission(3, [], mechanisms, [Gear()])), Style(), [()])
    >>> [text for text in page.texts if ": " in text][-1]
    'recirculating power 1.000: 100.0% of the power in'
    """
    every = flows(results)
    numbers = [gears or range(1, len(every) + 1) for gears in shown]
    chosen = sorted({number for selected in numbers for number in selected})
    placings = placed([every[number - 1] for number in chosen], style)
    gear_of: dict[int, FlowGear] = {}
    for number, placing in zip(chosen, placings, strict=True):
        flow, said = every[number - 1], None
        if flow.shown is not None:
            said = titles(FlowTexts(flow, flow.shown, style), results.gear_at(number - 1))
        gear_of[number] = FlowGear(number, flow, placing, said)
    for selected in numbers:
        gears = [gear_of[number] for number in selected]
        if len(gears) == 1:
            yield list(_alone(results, gears[0], style))
            continue
        room = style.width - 2 * WIDE_MARGIN
        name = title(results.case, style.text("power flow"))
        yield list(sheets(list(gear_blocks(gears, room, style)), name, "", room, style))


def placed(gear_flows: Sequence[GearFlow], style: Style) -> list[list[FlowLayout]]:
    """Return the rows of each gear in a common scale; without a power flow, a gear has no rows."""
    graphs = [graph(flow.shown) if flow.shown is not None else None for flow in gear_flows]
    powers = [
        drawn.through(node) for drawn in graphs if drawn for run in drawn.runs for node in run
    ]
    scale = min(BAND_WIDTH, MOST_NODE_HEIGHT / max(powers, default=1.0))
    return [
        _rows(flow, drawn, scale, style) if flow.shown and drawn and drawn.runs else []
        for flow, drawn in zip(gear_flows, graphs, strict=True)
    ]


def _rows(flow: GearFlow, drawn: Graph, scale: float, style: Style) -> list[FlowLayout]:
    """Return the rows of a gear; names are wrapped to smaller widths to avoid a further row."""
    room, side = style.width - 2 * WIDE_MARGIN, flow.shown
    assert side is not None  # noqa: S101 - gears without power were sorted out
    tried: dict[tuple[bool, int], list[FlowLayout]] = {}
    for short in NAME_WIDTHS:
        texts = FlowTexts(flow, side, style, short)
        cut = rows(drawn, room, partial(layout, scale=scale, texts=texts))
        tried.setdefault((max(row.width for row in cut) > room, len(cut)), cut)
        if (False, 1) in tried:
            break
    return tried[min(tried)]


def _alone(results: Results, gear: FlowGear, style: Style) -> Iterator[Canvas]:
    """Yield the pages of a single gear, which is named in the title."""
    subject = style.text("power flow")
    name = title(results.case, f"{subject}, {gear_title(gear.flow.gear, style)}")
    room = style.width - 2 * WIDE_MARGIN
    of_name = min(title_width(name), TITLE_WIDTH, room) if style.titled else 0.0
    wide = max(min(LEAST_FLOW_WIDTH, room), of_name, gear.wide)
    blocks = row_blocks(gear, wide) or [FlowBlock([], wide, 0.0, 0.0, nothing)]
    yield from sheets(blocks, name, heading(gear.flow, wide, style), wide, style)
