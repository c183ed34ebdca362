"""Lever diagrams: sets as levers side by side, joined at their common links, gear by gear.

What is in them follows Benford and Leising (1981): points at true distances, lines between
levers for links that are on both, grounds for brakes, ties for clutches, torques as forces.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.pictures.lever.cell import LeverSheet, LeverView, draw_lever, draw_route, lever_names
from vstatics.pictures.lever.gear import LeverGear, in_gear
from vstatics.pictures.lever.key import LEVER_MARGIN, key_of
from vstatics.pictures.lever.marks import inks
from vstatics.pictures.lever.places import ARROW, LeverPage, page_of
from vstatics.pictures.lever.routes import LeverRoute, routes
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.labels import Paper
from vstatics.pictures.sheet.style import TITLE, Style, number
from vstatics.pictures.sheet.words import fault, gear_title, title
from vstatics.statics.results import Results
from vstatics.tables.numbers import typeset

LEVER_NAME_HEIGHT = 20.0
"""Height of the names of levers, each in a line, and of what stands above them. [pt]"""
NARROWEST_FIGURE = 320.0
"""Of a figure, for its title. [pt]"""


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw the levers of a case in all gears, or in some.

    Raises
    ------
    CaseError
        If there is no mechanism of two links or more.
    """
    page = _page(results, style)
    chosen = gears or range(1, len(results.case.gears) + 1)
    return _figure(page, [in_gear(results, one, page.levers) for one in chosen], style)


def of_each_gear(results: Results, style: Style) -> Iterator[Figure]:
    """A figure for each gear, with the levers at the same places; errors as of `draw`."""
    page = _page(results, style)
    for one in range(1, len(results.case.gears) + 1):
        yield _figure(page, [in_gear(results, one, page.levers)], style)


def _page(results: Results, style: Style) -> LeverPage:
    page = page_of(results.case, style, LEVER_MARGIN)
    if page is None:
        raise CaseError([Problem("the case has no mechanism to draw as a lever")])
    return page


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
        return LEVER_NAME_HEIGHT + max(map(labels.height, self.names)) - labels.height("")

    @property
    def above(self) -> float:
        """Height of what stands over it."""
        return labels.height(self.head) if self.head else 0.0

    @property
    def size(self) -> float:
        """Its whole height."""
        return self.above + self.over + self.high - self.low + LEVER_MARGIN


def _figure(page: LeverPage, gears: Sequence[LeverGear], style: Style) -> Figure:
    wide = _wide(page)
    blocks = list(_blocks(page, gears, _heads(page, gears, style), style))
    speeds, per_torque = _scales(page, gears)
    key = key_of(page.levers, gears, style, wide, per_torque)
    head = title(page.case, _subject(gears, style)) if style.titled else ""
    head = labels.wrapped(head, wide - 2 * LEVER_MARGIN, TITLE, bold=True)
    above = LEVER_MARGIN + (labels.height(head, TITLE) + LEVER_MARGIN / 2 if head else 0.0)
    high = above + sum(one.size for one in blocks) + key.height + 1.5 * LEVER_MARGIN
    figure = labels.figure(wide, high)
    sheet = LeverSheet(Paper(figure), inks(), style, page, speeds, per_torque)
    if head:
        how = {"va": "top", "fontsize": TITLE, "fontweight": "bold"}
        sheet.paper.write(LEVER_MARGIN, high - LEVER_MARGIN, head, **how)
    top = high - above
    for block in blocks:
        _draw_block(sheet, block, top)
        top -= block.size
    key.put(sheet.paper, sheet.inks)
    sheet.inks.put(sheet.paper)
    return figure


def _wide(page: LeverPage) -> float:
    """Width of a figure [pt]."""
    return max(page.width, NARROWEST_FIGURE) + LEVER_MARGIN


def _subject(gears: Sequence[LeverGear], style: Style) -> str:
    subject = style.text("levers", "рычаги")
    if len(gears) > 1:
        return subject
    return f"{subject}, {gear_title(gears[0].state.gear.name, style)}"


def _scales(page: LeverPage, gears: Sequence[LeverGear]) -> tuple[tuple[float, float], float]:
    """Ends of the speeds, and length of a torque, for all levers, so that they can be compared."""
    links = {node.link for lever in page.levers for node in lever.nodes}
    speeds = [gear.state.speeds[link] for gear in gears for link in links]
    reached = [speed for speed in speeds if math.isfinite(speed)] + [0.0, 1.0]
    torques = [abs(one) for gear in gears for some in gear.torques for one in some]
    largest = max([0.1, *filter(math.isfinite, torques)])
    return (min(reached), max(reached)), ARROW / largest


def _blocks(
    page: LeverPage, gears: Sequence[LeverGear], heads: Sequence[str], style: Style
) -> Iterator[LeverBlock]:
    """Each gear with its lines; what a gear before has already is named."""
    seen: dict[object, str] = {}
    for gear, text in zip(gears, heads, strict=True):
        found = routes(page, gear.ties)
        heights = [*page.extent, *(y for one in found for _, y in one.points)]
        same: dict[int, str] = {}
        for place, lever in enumerate(page.levers):
            shown = place, gear.shown(place, lever)
            if lever.devices and shown in seen:
                same[place] = seen[shown]
            seen.setdefault(shown, gear.state.gear.name)
        head = labels.wrapped(text, _wide(page) - 2 * LEVER_MARGIN, bold=True)
        names = lever_names(page, gear, same, style, _wide(page) - LEVER_MARGIN)
        yield LeverBlock(head, gear, found, min(heights), max(heights), same, names)


def _draw_block(sheet: LeverSheet, block: LeverBlock, top: float) -> None:
    if block.head:
        sheet.paper.write(LEVER_MARGIN, top, block.head, va="top", fontweight="bold")
    below = top - block.above
    bottom = below - block.over - block.high
    for place in range(len(sheet.page.cells)):
        view = LeverView(sheet, block.gear, place, bottom, block.same.get(place))
        draw_lever(view, block.names[place], below)
    for route in block.routes:
        draw_route(sheet, block.gear, route, bottom)


def _heads(page: LeverPage, gears: Sequence[LeverGear], style: Style) -> list[str]:
    """What stands over each gear; a single one is called in the title."""
    texts = [_gear_text(page, gear, style) for gear in gears]
    if len(gears) > 1:
        names = [gear_title(gear.state.gear.name, style) for gear in gears]
        return [f"{name}: {text}" for name, text in zip(names, texts, strict=True)]
    return texts if style.titled else [""]


def _gear_text(page: LeverPage, gear: LeverGear, style: Style) -> str:
    """Ratio and engaged elements of a gear, and speeds that are given."""
    state, case = gear.state, page.case
    said = [f"i = {number(state.ratio)}"] if math.isfinite(state.ratio) else []
    said += [fault(one, style) for one in state.faults[:1]]
    said.append(", ".join(case.shift_elements[one - 1].name for one in state.gear.engaged))
    for link, speed in state.gear.speeds.items():
        said.append(f"{case.link_name(link)} = {typeset(case.speed_text(speed))}")
    return "; ".join(filter(None, said))
