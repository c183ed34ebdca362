"""Lever diagrams: sets as levers side by side, joined at their common links, gear by gear.

What is in them follows Benford and Leising (1981): points at true distances, lines between
levers for links that are on both, grounds for brakes, ties for clutches, torques as forces.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError
from vstatics.pictures.lever.cell import LeverView, draw_lever, draw_route, lever_names
from vstatics.pictures.lever.gear import LeverGear, in_gear
from vstatics.pictures.lever.key import key_of
from vstatics.pictures.lever.marks import LeverSheet
from vstatics.pictures.lever.places import ARROW, LeverPage, LeverRoute, page_of, routes
from vstatics.pictures.sheet.labels import Span, height, title_width, width, wrapped
from vstatics.pictures.sheet.pen import blank
from vstatics.pictures.sheet.style import TITLE, WIDE_MARGIN, Style, number
from vstatics.pictures.sheet.words import fault, gear_title, title
from vstatics.statics.results import Results
from vstatics.tables.numbers import typeset

LEVER_NAME_HEIGHT = 20.0
"""Height of the names of levers, each in a line, and of what stands above them. [pt]"""
NARROWEST_FIGURE = 320.0
"""Of a figure, for its title. [pt]"""


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
        yield [_figure(page, [in_gear(results, one, page.levers) for one in numbers], style)]


class LeverBlock(NamedTuple):
    """A gear of a figure; lengths in points."""

    head: str
    """What stands over it, in lines."""
    gear: LeverGear
    routes: Sequence[LeverRoute]
    low: float
    high: float
    """What it takes of the height, from the foot of the levers."""
    same: dict[int, str]
    """Levers that are as in a gear before: its name."""
    names: Sequence[str]
    """What stands over each lever, in lines."""

    @property
    def over(self) -> float:
        """Height of the names of levers, and of what stands above them."""
        return LEVER_NAME_HEIGHT + max(map(height, self.names)) - height("")

    @property
    def above(self) -> float:
        """Height of what stands over it."""
        return height(self.head) if self.head else 0.0

    @property
    def size(self) -> float:
        """Its whole height."""
        return self.above + self.over + self.high - self.low + WIDE_MARGIN


def _figure(page: LeverPage, gears: Sequence[LeverGear], style: Style) -> Figure:
    wide = max(page.width, NARROWEST_FIGURE) + WIDE_MARGIN
    blocks = list(_blocks(page, gears, wide, style))
    speeds, per_torque = _scales(page, gears)
    key = key_of(page.levers, gears, style, wide, per_torque)
    subject = style.text("levers", "рычаги")
    if len(gears) == 1:
        subject += f", {gear_title(gears[0].state.gear.name, style)}"
    head = title(page.case, subject) if style.titled else ""
    head = wrapped(head, wide - 2 * WIDE_MARGIN, title_width)
    above = WIDE_MARGIN + (height(head, TITLE) + WIDE_MARGIN / 2 if head else 0.0)
    high = above + sum(one.size for one in blocks) + key.height + 1.5 * WIDE_MARGIN
    sheet = LeverSheet(blank(wide, high, style), page, speeds, per_torque, {}, {})
    sheet.pen.text(WIDE_MARGIN, high - WIDE_MARGIN, head, va="top", size=TITLE, bold=True)
    top = high - above
    for block in blocks:
        _draw_block(sheet, block, top)
        top -= block.size
    key.put(sheet)
    sheet.put()
    return sheet.pen.figure


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
) -> Iterator[LeverBlock]:
    """Each gear with its lines; what a gear before has already is named."""
    seen: dict[object, str] = {}
    for gear in gears:
        name, text = gear.state.gear.name, _gear_text(page, gear, style)
        if len(gears) > 1:  # a single one is called in the title
            text = f"{gear_title(name, style)}: {text}"
        elif not style.titled:
            text = ""
        found = routes(page, gear.ties)
        heights = [*page.extent, *(y for one in found for _, y in one.points)]
        same: dict[int, str] = {}
        for place, lever in enumerate(page.levers):
            shown = place, gear.shown(place, lever)
            if lever.devices and shown in seen:
                same[place] = seen[shown]
            seen.setdefault(shown, name)
        head = wrapped(text, wide - 2 * WIDE_MARGIN, partial(width, bold=True))
        names = lever_names(page, gear, same, style, wide - WIDE_MARGIN)
        yield LeverBlock(head, gear, found, min(heights), max(heights), same, names)


def _draw_block(sheet: LeverSheet, block: LeverBlock, top: float) -> None:
    sheet.pen.text(WIDE_MARGIN, top, block.head, va="top", bold=True)
    below = top - block.above
    bottom = below - block.over - block.high
    for place, name in enumerate(block.names):
        view = LeverView(sheet, block.gear, place, bottom, block.same.get(place))
        draw_lever(view, name, below)
    for route in block.routes:
        draw_route(sheet, block.gear, route, bottom)


def _gear_text(page: LeverPage, gear: LeverGear, style: Style) -> str:
    """Ratio and engaged elements of a gear, and speeds that are given."""
    state, case = gear.state, page.case
    said = [f"i = {number(state.ratio)}"] if math.isfinite(state.ratio) else []
    said += [fault(one, style) for one in state.faults[:1]]
    said.append(", ".join(case.shift_elements[one - 1].name for one in state.gear.engaged))
    for link, speed in state.gear.speeds.items():
        said.append(f"{case.link_name(link)} = {typeset(case.speed_text(speed))}")
    return "; ".join(filter(None, said))
