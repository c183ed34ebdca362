"""Pages with the power flow of several gears, side by side if possible."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise, starmap
from operator import attrgetter
from typing import NamedTuple

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.groups import filled
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.head import Meaning, SheetHead, sheet_head
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.drawing.pages import pages_of
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import WIDE_MARGIN, Style
from vstatics.pictures.drawing.words import gear_title
from vstatics.pictures.flow.chain import ChainLine, chain_line, is_chain
from vstatics.pictures.flow.graph import graph
from vstatics.pictures.flow.places import FlowLayout
from vstatics.pictures.flow.signs import MILD_HATCH, FlowView, hatched_look, loop_colour
from vstatics.pictures.flow.texts import heading
from vstatics.pictures.flow.titles import FlowTitles

FLOW_GEAR_GAP = 20.0
"""Distance between neighbouring gears. [pt]"""
CHAIN_LINE_GAP = 6.0
"""Distance between gears that are drawn as lines of text. [pt]"""
LINE_START = 10.0
"""Distance from the name of a gear to the line of text. [pt]"""
LEAST_BLOCK_WIDTH = 190.0
"""Smallest width of a gear next to other gears, sufficient for the line below the name. [pt]"""
BELOW_TEXT = 8.0
"""Distance between a text about the whole figure and the drawing below. [pt]"""


class FlowGear(NamedTuple):
    """Gear with the layout of the power flow."""

    number: int
    """Number of the gear, from 1."""
    flow: GearFlow
    rows: Sequence[FlowLayout]
    """Rows from top to bottom; empty for a gear without power flow."""
    titles: FlowTitles | None

    @property
    def wide(self) -> float:
        """Width of the widest row [pt]."""
        return max((row.width for row in self.rows), default=0.0)


class FlowBlock(NamedTuple):
    """Block of a page: a gear with the heading, or a further row of the gear."""

    shown: Sequence[FlowGear]
    """Gears drawn in the block, which determine the entries of the key."""
    wide: float
    """Width of the block. [pt]"""
    high: float
    gap: float
    """Smallest distance to the next block. [pt]"""
    draw: Callable[[Pen, float, float], None]
    """Function that draws the block at a given upper left corner."""
    is_rest: bool = False
    """True for the second and further rows of a gear."""


def sheets(
    blocks: Sequence[FlowBlock], name: str, note: str, room: float, style: Style
) -> Iterator[Canvas]:
    """Yield pages with title, note and key; `room` is the width without margins [pt]."""

    def head_of(shelves: Sequence[Sequence[FlowBlock]]) -> SheetHead:
        shown = [gear for shelf in shelves for block in shelf for gear in block.shown]
        return sheet_head(name, note, _key(shown, style), room, style)

    shelves = filled(blocks, room, attrgetter("wide"), FLOW_GEAR_GAP)
    left_over = style.height - head_of([blocks]).high - BELOW_TEXT - 2 * WIDE_MARGIN
    for page in pages_of(_together(shelves), left_over, _all_high):
        wide = max(room, *(block.wide for shelf in page for block in shelf))
        high = _all_high(page) + BELOW_TEXT + WIDE_MARGIN
        pen = head_of(page).over((wide + 2 * WIDE_MARGIN, high), WIDE_MARGIN, style)
        top = high - BELOW_TEXT
        for shelf, following in zip(page, [*page[1:], page[-1]], strict=True):
            left = WIDE_MARGIN
            for block in shelf:
                block.draw(pen, left, top)
                left += block.wide + FLOW_GEAR_GAP
            top -= _high(shelf) + _gap(shelf, following)
        yield pen.canvas


def _key(shown: Sequence[FlowGear], style: Style) -> list[Meaning]:
    """Return the entries of the key for the colours in the picture."""
    drawn = [(gear.titles, row) for gear in shown if gear.titles for row in gear.rows]
    pairs = [(said, line.band) for said, row in drawn for line in row.lines]
    loops = [said.is_doubtful(band) for said, band in pairs if band.loop is not None]
    lost = any(box.cell.lost for _, row in drawn for box in row.boxes)
    pieces = [
        said.is_mild(node) for said, row in drawn for node in row.graph.place if said.is_open(node)
    ]
    loop = loop_colour(style)
    by_convention = "divided by convention, locked up"
    mild = "divided within friction, locked up"
    mild_look = {"facecolor": style.paper, "edgecolor": style.ink, "hatch": MILD_HATCH}
    doubtful = "recirculating power, may be an artefact of the model"
    return [
        (drawn, "power", {"facecolor": style.power}),
        (False in pieces, by_convention, hatched_look(style.power, style)),
        (True in pieces, mild, {**mild_look, "width": 0.5}),
        (lost, "lost", {"facecolor": style.lost}),
        (False in loops, "recirculating power", {"facecolor": loop}),
        (True in loops, doubtful, hatched_look(loop, style)),
    ]


def _high(shelf: Sequence[FlowBlock]) -> float:
    return max(block.high for block in shelf)


def _gap(shelf: Sequence[FlowBlock], following: Sequence[FlowBlock]) -> float:
    return max(block.gap for block in (*shelf, *following))


def _together(shelves: Iterable[list[FlowBlock]]) -> list[list[list[FlowBlock]]]:
    """Return each shelf together with the shelves of further rows of the gear."""
    groups: list[list[list[FlowBlock]]] = []
    for shelf in shelves:
        if shelf[0].is_rest:
            groups[-1].append(shelf)
        else:
            groups.append([shelf])
    return groups


def _all_high(page: Sequence[Sequence[FlowBlock]]) -> float:
    return sum(map(_high, page)) + sum(starmap(_gap, pairwise(page)))


def gear_blocks(gears: Sequence[FlowGear], room: float, style: Style) -> Iterator[FlowBlock]:
    """Yield a block for each of several gears, headed by the name of the gear."""
    names = [gear_title(gear.flow.gear, style) for gear in gears]
    start = LINE_START + max(width(name, bold=True) for name in names)
    for gear, name in zip(gears, names, strict=True):
        side = gear.flow.shown
        drawn = graph(side) if side is not None and gear.rows else None
        if drawn is not None and gear.titles is not None and is_chain(gear.flow, drawn):
            yield _line_block(chain_line(drawn, gear.titles, room - start), name, start, room)
        else:
            least = LEAST_BLOCK_WIDTH if len(gear.rows) < 2 else room
            wide = max(least, gear.wide)
            text = heading(gear.flow, wide, style)
            rows = row_blocks(gear, wide)
            yield _under_heading(name, text, wide, gear, rows[:1])
            yield from (row._replace(is_rest=True) for row in rows[1:])


def row_blocks(gear: FlowGear, wide: float) -> list[FlowBlock]:
    """Return a block for each row of a gear."""
    return [
        FlowBlock([gear], wide, row.height, FLOW_GEAR_GAP, partial(_draw_row, gear, number))
        for number, row in enumerate(gear.rows)
    ]


def _draw_row(gear: FlowGear, number: int, pen: Pen, left: float, top: float) -> None:
    assert gear.titles is not None  # noqa: S101 - a gear with rows has power
    group = pen.within(
        "row",
        of=f"{gear.number}.{number}",
        at=f"{round(left, 1):g} {round(pen.canvas.size[1] - top, 1):g}",
    )
    FlowView(group, left, top, gear.titles).draw(gear.rows[number])


def nothing(_pen: Pen, _left: float, _top: float) -> None:
    """Draw nothing, as the block of a gear without a picture."""


def _under_heading(
    name: str, text: str, wide: float, gear: FlowGear, rows: Sequence[FlowBlock]
) -> FlowBlock:
    """Return the block of a gear: name, remarks, and the first row, if any."""
    below = height(name) + height(text) + BELOW_TEXT * len(rows)

    def draw(pen: Pen, left: float, top: float) -> None:
        pen.text(left, top, name, va="top", bold=True)
        pen.text(left, top - height(name), text, va="top", color=pen.style.soft)
        for row in rows:
            row.draw(pen, left, top - below)

    high = below + sum(row.high for row in rows)
    return FlowBlock([gear], wide, high, FLOW_GEAR_GAP, draw)


def _line_block(line: ChainLine, name: str, start: float, room: float) -> FlowBlock:
    def draw(pen: Pen, left: float, top: float) -> None:
        pen.text(left, top, name, va="top", bold=True)
        line.draw(pen, left + start, top)

    return FlowBlock([], room, line.high, CHAIN_LINE_GAP, draw)
