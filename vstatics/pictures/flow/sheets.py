"""Pages of several gears: beside each other where there is room; plain chains as lines of text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise, starmap
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.flow.power_flow import GearFlow
from vstatics.pictures.flow.chain import ChainLine, chain_line, is_chain
from vstatics.pictures.flow.graph import graph
from vstatics.pictures.flow.places import FlowLayout
from vstatics.pictures.flow.signs import FlowView
from vstatics.pictures.flow.texts import heading
from vstatics.pictures.flow.titles import FlowTitles
from vstatics.pictures.sheet.head import Meaning, sheet_head
from vstatics.pictures.sheet.labels import height, width
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import WIDE_MARGIN, Style
from vstatics.pictures.sheet.words import gear_title

FLOW_GEAR_GAP = 20.0
"""Gears. [pt]"""
CHAIN_GAP = 6.0
"""Gears that are lines of text. [pt]"""
LINE_START = 10.0
"""From the name of a gear to its line. [pt]"""
LEAST_BLOCK_WIDTH = 190.0
"""Of a gear beside others, for the line below its name. [pt]"""
ROW_GAP = 10.0
"""Rows of a gear. [pt]"""
BELOW_TEXT = 8.0
"""Between a text of the whole figure and what follows. [pt]"""


class FlowGear(NamedTuple):
    """What is drawn of a gear."""

    flow: GearFlow
    rows: Sequence[FlowLayout]
    """Below one another; none where no power is drawn."""
    titles: FlowTitles | None

    @property
    def wide(self) -> float:
        """[pt]."""
        return max((row.width for row in self.rows), default=0.0)

    @property
    def high(self) -> float:
        """[pt]."""
        gaps = ROW_GAP * max(len(self.rows) - 1, 0)
        return sum(row.height for row in self.rows) + gaps

    def draw(self, pen: Pen, left: float, top: float) -> None:
        """From an upper left corner on [pt]."""
        for row in self.rows:
            assert self.titles is not None  # noqa: S101 - it has power, then
            FlowView(pen, left, top, self.titles).draw(row)
            top -= row.height + ROW_GAP


class FlowBlock(NamedTuple):
    """A gear among others, with what stands over it."""

    gear: FlowGear | None
    """None of one that is a line of text."""
    wide: float
    """[pt]"""
    high: float
    gap: float
    """Between it and another one at least [pt]."""
    draw: Callable[[Pen, float, float], None]
    """From an upper left corner on."""


def sheets(
    gears: Sequence[FlowGear],
    name: str,
    key: Callable[[Sequence[FlowGear], Style], Iterable[Meaning]],
    style: Style,
) -> Iterator[Figure]:
    """Pages with a title and a key of what is on them."""
    room = style.width - 2 * WIDE_MARGIN
    blocks = _blocks(gears, room, style)
    tallest = sheet_head(name, "", key(gears, style), room, style).high
    left_over = style.height - tallest - BELOW_TEXT - 2 * WIDE_MARGIN
    for page in _pages(_shelves(blocks, room), left_over):
        shown = [block.gear for shelf in page for block in shelf if block.gear]
        head = sheet_head(name, "", key(shown, style), room, style)
        wide = max(room, *(block.wide for shelf in page for block in shelf))
        gaps = sum(starmap(_gap, pairwise(page)))
        high = sum(map(_high, page)) + gaps + BELOW_TEXT + WIDE_MARGIN
        pen = head.over((wide + 2 * WIDE_MARGIN, high), WIDE_MARGIN, style)
        top = high - BELOW_TEXT
        for shelf, following in zip(page, [*page[1:], page[-1]], strict=True):
            left = WIDE_MARGIN
            for block in shelf:
                block.draw(pen, left, top)
                left += block.wide + FLOW_GEAR_GAP
            top -= _high(shelf) + _gap(shelf, following)
        yield pen.figure


def _high(shelf: Sequence[FlowBlock]) -> float:
    return max(block.high for block in shelf)


def _gap(shelf: Sequence[FlowBlock], following: Sequence[FlowBlock]) -> float:
    return max(block.gap for block in (*shelf, *following))


def _shelves(blocks: Iterable[FlowBlock], room: float) -> list[list[FlowBlock]]:
    """Gears beside each other as far as there is room."""
    found: list[list[FlowBlock]] = []
    taken = room
    for block in blocks:
        if taken + FLOW_GEAR_GAP + block.wide > room:
            found.append([])
            taken = -FLOW_GEAR_GAP
        found[-1].append(block)
        taken += FLOW_GEAR_GAP + block.wide
    return found


def _pages(shelves: Iterable[list[FlowBlock]], room: float) -> Iterator[list[list[FlowBlock]]]:
    """As many below one another as there is room for."""
    page: list[list[FlowBlock]] = []
    taken = 0.0
    for shelf in shelves:
        gap = _gap(page[-1], shelf) if page else 0.0
        if page and taken + gap + _high(shelf) > room:
            yield page
            page, taken, gap = [], 0.0, 0.0
        page.append(shelf)
        taken += gap + _high(shelf)
    yield page


def _blocks(gears: Sequence[FlowGear], room: float, style: Style) -> Iterator[FlowBlock]:
    names = [gear_title(gear.flow.gear, style) for gear in gears]
    start = LINE_START + max(width(name, bold=True) for name in names)
    for gear, name in zip(gears, names, strict=True):
        side = gear.flow.shown
        drawn = graph(side) if side is not None and gear.rows else None
        if drawn is not None and gear.titles is not None and is_chain(gear.flow, drawn):
            yield _line_block(chain_line(drawn, gear.titles, room - start), name, start, room)
        else:
            yield _band_block(gear, name, style)


def _line_block(line: ChainLine, name: str, start: float, room: float) -> FlowBlock:
    def draw(pen: Pen, left: float, top: float) -> None:
        pen.text(left, top, name, va="top", bold=True)
        line.draw(pen, left + start, top)

    return FlowBlock(None, room, line.high, CHAIN_GAP, draw)


def _band_block(gear: FlowGear, name: str, style: Style) -> FlowBlock:
    wide = max(LEAST_BLOCK_WIDTH, gear.wide)
    text = heading(gear.flow, wide, style)
    head = height(name) + height(text)
    body = (BELOW_TEXT + gear.high) * bool(gear.rows)

    def draw(pen: Pen, left: float, top: float) -> None:
        pen.text(left, top, name, va="top", bold=True)
        pen.text(left, top - height(name), text, va="top", color=pen.style.soft)
        gear.draw(pen, left, top - head - BELOW_TEXT)

    return FlowBlock(gear, wide, head + body, FLOW_GEAR_GAP, draw)
