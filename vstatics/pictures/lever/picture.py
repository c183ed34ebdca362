"""Lever diagrams: sets as levers side by side, joined at their common links, gear by gear.

What is in them follows Benford and Leising (1981): points at true distances, lines between
levers for links that are on both, grounds for brakes, ties for clutches, torques as forces.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.labels import Span, height, title_width, wrapped
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
"""Height of the names of levers, each in a line, and of what stands above them. [pt]"""
BELOW_LEVERS = 6.0
"""Below a row of levers. [pt]"""
NARROWEST_FIGURE = 320.0
"""Of a figure, for its title. [pt]"""


class LeverBlock(NamedTuple):
    """A row of levers in a gear; lengths in points."""

    head: GearHead | None
    """What stands over it, if it is the first of its gear."""
    gear: LeverGear
    routes: Sequence[LeverRoute]
    band: int
    """Which row of levers it is."""
    low: float
    high: float
    """What it takes of the height, from the foot of the levers."""
    same: dict[int, str]
    """Levers that are as in a gear before: its name."""
    names: dict[int, str]
    """What stands over each lever, in lines."""

    @property
    def over(self) -> float:
        """Height of the names of levers, and of what stands above them."""
        return LEVER_NAME_HEIGHT + max(map(height, self.names.values())) - height("")

    @property
    def above(self) -> float:
        """Height of what stands over it."""
        return self.head.high if self.head else 0.0

    @property
    def size(self) -> float:
        """Its whole height."""
        return self.above + self.over + self.high - self.low + BELOW_LEVERS


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """The levers of a case in all gears, or in some; at the same places in each figure.

    Raises
    ------
    CaseError
        If there is no mechanism of two links or more.
    """
    page = page_of(results.case, style)
    if page is None:
        raise CaseError("E403", "the case has no mechanism to draw as a lever")
    for gears in shown:
        numbers = gears or range(1, len(results.case.gears) + 1)
        yield _pages(page, [in_gear(results, one, page.levers) for one in numbers], style)


class LeverPaper(NamedTuple):
    """What the pages of a picture share; lengths in points."""

    page: LeverPage
    style: Style
    wide: float
    head: str
    """In lines."""
    speeds: Span
    per_torque: float

    @property
    def above(self) -> float:
        """Height of the title with what is around it."""
        title_high = height(self.head, TITLE) + WIDE_MARGIN / 2 if self.head else 0.0
        return WIDE_MARGIN + title_high

    def key(self, gears: Sequence[LeverGear]) -> LeverKey:
        """The signs of some gears."""
        return key_of(self.page, gears, self.style, self.wide, self.per_torque)

    def figure(self, blocks: Sequence[LeverBlock]) -> Figure:
        """A page with some rows of levers, one below the other."""
        key = self.key([block.gear for block in blocks])
        high = self.above + sum(one.size for one in blocks) + key.height + WIDE_MARGIN
        pen = blank(self.wide, high, self.style)
        sheet = LeverSheet(pen, self.page, self.speeds, self.per_torque, {}, {})
        pen.text(WIDE_MARGIN, high - WIDE_MARGIN, self.head, va="top", size=TITLE, bold=True)
        top = high - self.above
        for block in blocks:
            _draw_block(sheet, block, top)
            top -= block.size
        key.put(sheet)
        sheet.put()
        return pen.figure


def _pages(page: LeverPage, gears: Sequence[LeverGear], style: Style) -> list[Figure]:
    """The rows of levers of all gears; those of a gear are on one page where they fit one."""
    wide = style.width if len(gears) > 1 else page.width + WIDE_MARGIN
    wide = min(max(wide, NARROWEST_FIGURE), style.width)
    wide = max(wide, page.width + WIDE_MARGIN)  # of one lever that has no room in a narrow page
    subject = style.text("levers")
    if len(gears) == 1:
        subject += f", {gear_title(gears[0].state.gear.name, style)}"
    head = title(page.case, subject) if style.titled else ""
    head = wrapped(head, wide - 2 * WIDE_MARGIN, title_width)
    paper = LeverPaper(page, style, wide, head, *_scales(page, gears))
    room = style.height - paper.above - paper.key(gears).height - WIDE_MARGIN
    sheets: list[list[LeverBlock]] = [[]]
    for own in _blocks(page, gears, wide, style):
        left = room - sum(block.size for block in sheets[-1])
        if sheets[-1] and left < sum(block.size for block in own) <= room:
            sheets.append([])
        for block in own:
            if sheets[-1] and sum(one.size for one in (*sheets[-1], block)) > room:
                sheets.append([])
            sheets[-1].append(block)
    return [paper.figure(blocks) for blocks in sheets]


def _scales(page: LeverPage, gears: Sequence[LeverGear]) -> tuple[Span, float]:
    """Ends of the speeds, and length of a torque, for all levers, so that they can be compared."""
    links = {node.link for lever in page.levers for node in lever.nodes}
    speeds = [gear.state.speeds[link] for gear in gears for link in links]
    reached = [speed for speed in speeds if math.isfinite(speed)] + [0.0, 1.0]
    torques = [abs(one) for gear in gears for some in gear.torques for one in some]
    largest = max([0.1, *filter(math.isfinite, torques)])
    return (min(reached), max(reached)), ARROW / largest


def _blocks(
    page: LeverPage, gears: Sequence[LeverGear], wide: float, style: Style
) -> Iterator[list[LeverBlock]]:
    """Each gear with its rows of levers; what a gear before has already is named."""
    seen: dict[object, str] = {}
    for gear in gears:
        name = gear.state.gear.name
        found = routes(page, gear.ties)
        same: dict[int, str] = {}
        for place, lever in enumerate(page.levers):
            shown = place, gear.shown(place, lever)
            if lever.devices and shown in seen:
                same[place] = seen[shown]
            seen.setdefault(shown, name)
        head = gear_head(page.case, gear, wide - 2 * WIDE_MARGIN, style, is_alone=len(gears) == 1)
        names = lever_names(page, gear, same, style, wide - WIDE_MARGIN)
        own = []
        for band, places in enumerate(page.bands):
            lines = [y for route in found for on, (_, y) in route.points if on == band]
            heights = [*page.extent(band), *lines]
            here = {place: names[place] for place in places}
            own.append(
                LeverBlock(
                    None if band else head,
                    gear,
                    found,
                    band,
                    min(heights),
                    max(heights),
                    same,
                    here,
                )
            )
        yield own


def _draw_block(sheet: LeverSheet, block: LeverBlock, top: float) -> None:
    if block.head:
        block.head.draw(sheet.pen, WIDE_MARGIN, top)
    below = top - block.above
    bottom = below - block.over - block.high
    for place, name in block.names.items():
        view = LeverView(sheet, block.gear, place, bottom, block.same.get(place))
        draw_lever(view, name, below)
    for route in block.routes:
        draw_route(sheet, block.gear, route, {block.band: bottom})
