"""Pages of lever diagrams: in each gear, levers side by side, joined at common links.

The diagrams follow Benford and Leising (1981): points at true distances, lines between levers for
common links, supports for brakes, ties for clutches, and torques as forces.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.labels import Span, height, title_width, wrapped
from vstatics.pictures.drawing.pages import pages_of
from vstatics.pictures.drawing.pen import blank
from vstatics.pictures.drawing.style import TITLE, WIDE_MARGIN, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.pictures.lever.cell import draw_lever, draw_route, lever_names
from vstatics.pictures.lever.gear import LeverGear, in_gear
from vstatics.pictures.lever.head import GearHead, gear_head
from vstatics.pictures.lever.joined import LeverRoute, routes
from vstatics.pictures.lever.key import LeverKey, key_of
from vstatics.pictures.lever.marks import LeverSheet
from vstatics.pictures.lever.places import ARROW, LeverPage, page_of
from vstatics.pictures.lever.view import LeverView

LEVER_NAME_HEIGHT = 12.0
"""Height of a line with the names of levers. [pt]"""
BELOW_LEVERS = 6.0
"""Space below a row of levers. [pt]"""
NARROWEST_FIGURE = 320.0
"""Smallest width of a page, sufficient for the title. [pt]"""


class LeverBlock(NamedTuple):
    """Row of levers in a gear, with the heading; lengths in points."""

    head: GearHead | None
    """Heading of the gear, only for the first row."""
    gear: LeverGear
    routes: Sequence[LeverRoute]
    band: int
    """Index of the row of levers."""
    low: float
    high: float
    """Heights of the lowest and highest point of the row, above the foot of the levers. [pt]"""
    same: dict[int, str]
    """Name of an earlier gear with an equal picture of a lever, by the index of the lever."""
    names: dict[int, str]
    """Text above a lever, wrapped into lines, by the index of the lever."""

    @property
    def over(self) -> float:
        """Height of the texts above the levers [pt]."""
        return LEVER_NAME_HEIGHT + max(map(height, self.names.values())) - height("")

    @property
    def above(self) -> float:
        """Height of the heading with the gap below [pt]."""
        return self.head.high if self.head else 0.0

    @property
    def size(self) -> float:
        """Total height of the row [pt]."""
        return self.above + self.over + self.high - self.low + BELOW_LEVERS


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Canvas]]:
    """Yield the pages of levers for each list of gears. Levers have fixed positions.

    Raises
    ------
    CaseError
        If no mechanism has two links or more.
    """
    page = page_of(results.case, style)
    if page is None:
        raise CaseError("E403", "the case has no mechanism to draw as a lever")
    for gears in shown:
        numbers = gears or range(1, len(results.case.gears) + 1)
        yield _pages(page, [in_gear(results, number, page.levers) for number in numbers], style)


class LeverPaper(NamedTuple):
    """Properties that the pages of a picture share; lengths in points."""

    page: LeverPage
    style: Style
    wide: float
    head: str
    """Title, wrapped into lines."""
    speeds: Span
    per_torque: float

    @property
    def above(self) -> float:
        """Height of the title with margins [pt]."""
        title_high = height(self.head, TITLE) + WIDE_MARGIN / 2 if self.head else 0.0
        return WIDE_MARGIN + title_high

    def key(self, gears: Sequence[LeverGear]) -> LeverKey:
        """Return the key for the symbols in gears."""
        return key_of(self.page, gears, self.style, self.wide, self.per_torque)

    def figure(self, blocks: Sequence[LeverBlock]) -> Canvas:
        """Return a page with rows of levers, from top to bottom."""
        key = self.key([block.gear for block in blocks])
        high = self.above + _all_high(blocks) + key.height + WIDE_MARGIN
        pen = blank(self.wide, high, self.style)
        sheet = LeverSheet(pen, self.page, self.speeds, self.per_torque, {}, {})
        pen.text(WIDE_MARGIN, high - WIDE_MARGIN, self.head, va="top", size=TITLE, bold=True)
        top = high - self.above
        for block in blocks:
            _draw_block(sheet, block, top)
            top -= block.size
        key.put(sheet)
        sheet.put()
        return pen.canvas


def _pages(page: LeverPage, gears: Sequence[LeverGear], style: Style) -> list[Canvas]:
    """Return the pages of all gears. The rows of a gear are on the same page if possible."""
    wide = style.width if len(gears) > 1 else page.width + WIDE_MARGIN
    wide = min(max(wide, NARROWEST_FIGURE), style.width)
    wide = max(wide, page.width + WIDE_MARGIN)  # a single lever can be wider than the page
    subject = style.text("levers")
    if len(gears) == 1:
        subject += f", {gear_title(gears[0].state.gear.name, style)}"
    head = title(page.case, subject) if style.titled else ""
    head = wrapped(head, wide - 2 * WIDE_MARGIN, title_width)
    paper = LeverPaper(page, style, wide, head, *_scales(page, gears))
    room = style.height - paper.above - paper.key(gears).height - WIDE_MARGIN
    sheets = pages_of(_blocks(page, gears, wide, style), room, _all_high)
    return [*map(paper.figure, sheets)]


def _all_high(blocks: Sequence[LeverBlock]) -> float:
    return sum(block.size for block in blocks)


def _scales(page: LeverPage, gears: Sequence[LeverGear]) -> tuple[Span, float]:
    links = {node.link for lever in page.levers for node in lever.nodes}
    speeds = [gear.state.speeds[link] for gear in gears for link in links]
    reached = [speed for speed in speeds if math.isfinite(speed)] + [0.0, 1.0]
    torques = [abs(torque) for gear in gears for some in gear.torques for torque in some]
    largest = max([0.1, *filter(math.isfinite, torques)])
    return (min(reached), max(reached)), ARROW / largest


def _blocks(
    page: LeverPage, gears: Sequence[LeverGear], wide: float, style: Style
) -> Iterator[list[LeverBlock]]:
    """Yield the rows of levers of each gear; equal levers refer to the earlier gear."""
    seen: dict[object, str] = {}
    for gear in gears:
        name = gear.state.gear.name
        lines_of_ties = routes(page, gear.ties)
        same: dict[int, str] = {}
        for place, lever in enumerate(page.levers):
            shown = place, gear.shown(place, lever)
            if lever.devices and shown in seen:
                same[place] = seen[shown]
            seen.setdefault(shown, name)
        head = gear_head(page.case, gear, wide - 2 * WIDE_MARGIN, style, is_alone=len(gears) == 1)
        names = lever_names(page, gear, same, style, wide - WIDE_MARGIN)
        rows = []
        for band, places in enumerate(page.bands):
            pieces = [piece for route in lines_of_ties for piece in route.pieces]
            lines = [y for on, points in pieces if on == band for _, y in points]
            heights = [*page.extent(band), *lines]
            here = {place: names[place] for place in places}
            rows.append(
                LeverBlock(
                    None if band else head,
                    gear,
                    lines_of_ties,
                    band,
                    min(heights),
                    max(heights),
                    same,
                    here,
                )
            )
        yield rows


def _draw_block(sheet: LeverSheet, block: LeverBlock, top: float) -> None:
    if block.head:
        block.head.draw(sheet.pen, WIDE_MARGIN, top)
    below = top - block.above
    bottom = below - block.over - block.high
    for place, name in block.names.items():
        view = LeverView(sheet, block.gear, place, bottom, block.same.get(place))
        draw_lever(view, name, below)
    for route in block.routes:
        draw_route(sheet, block.gear, route, block.band, bottom)
