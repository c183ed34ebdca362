"""Lever diagrams: a row for each gear, a column for each lever, speeds across."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import HOUSING
from vstatics.pictures import labels, signs
from vstatics.pictures.labels import LEADER, Label, Panel
from vstatics.pictures.levers import Lever, Node, levers
from vstatics.pictures.signs import MARGIN, Joined
from vstatics.pictures.style import TITLE, Style, number

if TYPE_CHECKING:
    from vstatics.model.transmission import Transmission
    from vstatics.statics.results import Results

WIDE = 110.0
"""Of the speeds of a lever. [pt]"""
LEAST = 62.0
"""Height of a lever at least. [pt]"""
LONGEST = 110.0
"""Names are wrapped to this width. [pt]"""
VALUES = LEADER + 32.0
"""Width of the numbers beside a lever. [pt]"""


class _Page(NamedTuple):
    """What all levers of a figure share, and where they stand; lengths in points."""

    results: Results
    style: Style
    levers: Sequence[Lever]
    names: Sequence[Sequence[str]]
    """Of the nodes of each lever, in lines."""
    lefts: Sequence[float]
    """Width of the names of each lever."""
    limits: tuple[float, float]
    """Of the speeds. [-]"""
    heads: Sequence[str]
    """What stands before each row."""
    high: float
    """Of a lever."""
    up: float
    """Of a row."""

    @property
    def first(self) -> float:
        """Where the first lever begins with its names."""
        return max(map(labels.width, self.heads)) + 2 * MARGIN

    @property
    def columns(self) -> list[float]:
        """Where each lever begins, and the end of the last."""
        wide = [left + WIDE + VALUES + MARGIN for left in self.lefts]
        return list(accumulate(wide, initial=self.first))


def draw(results: Results, style: Style, gear: int | None) -> Figure:
    """Draw the levers of a case in all gears, or in one.

    Parameters
    ----------
    results : Results
        Of one case.
    style : Style
    gear : int, optional
        Number, from 1.

    Raises
    ------
    CaseError
        If there is no mechanism of two links or more.
    """
    case = results.with_freewheels_engaged
    gears = [gear] if gear else list(range(1, len(case.gears) + 1))
    page = _page(results, style, gears)
    wide = page.columns[-1]
    title = labels.wrapped(_title(case, style), wide - 2 * MARGIN, TITLE)
    note = labels.wrapped(_elements_text(case, gears, style), wide - 2 * MARGIN)
    tops = [
        labels.wrapped(lever.name, left + WIDE)
        for lever, left in zip(page.levers, page.lefts, strict=True)
    ]
    above = labels.height(title, TITLE) + 2 * MARGIN + max(map(labels.height, tops))
    below = 2 * MARGIN + labels.height(note) + signs.legend_height(style, wide)
    high = above + len(gears) * page.up + below
    figure = Figure(figsize=(wide / labels.POINTS, high / labels.POINTS))
    whole = labels.panel(figure, 0, 0, wide, high)
    whole.axes.set_axis_off()
    whole.write(wide / 2, high - MARGIN, title, ha="center", va="top", fontsize=TITLE)
    whole.write(MARGIN, MARGIN, note, va="bottom")
    signs.legend(whole, style, labels.height(note) + MARGIN)
    for left, start, top in zip(page.lefts, page.columns, tops, strict=False):
        whole.write(start + left + WIDE / 2, high - above, top, ha="center", va="bottom")
    for row, chosen in enumerate(gears):
        middle = high - above - (row + 0.5) * page.up
        whole.write(MARGIN, middle, page.heads[row], va="center")
        _row(figure, page, chosen, middle)
    return figure


def _page(results: Results, style: Style, gears: Sequence[int]) -> _Page:
    case = results.case
    drawn = levers(case)
    if not drawn:
        raise CaseError([Problem("the case has no mechanism to draw as a lever")])
    names = [[_node_text(case, node, style) for node in lever.nodes] for lever in drawn]
    lefts = [max(map(labels.width, some)) + LEADER for some in names]
    heads = [_gear_text(results, chosen, style) for chosen in gears]
    labelled = max(sum(labels.height(name) + labels.GAP for name in some) for some in names)
    high = max(labelled, LEAST)
    up = max(high, *map(labels.height, heads)) + 2 * MARGIN
    return _Page(
        results, style, drawn, names, lefts, _limits(results, drawn, gears), heads, high, up
    )


def _limits(results: Results, drawn: Sequence[Lever], gears: Sequence[int]) -> tuple[float, float]:
    """Ends of the speeds, the same for all levers, so that lengths can be compared."""
    links = {node.link for lever in drawn for node in lever.nodes if node.link != HOUSING}
    speeds = [float(results.speeds[chosen - 1, link - 1]) for chosen in gears for link in links]
    reached = [speed for speed in speeds if math.isfinite(speed)] + [0.0, 1.0]
    room = 0.07 * (max(reached) - min(reached))
    return min(reached) - room, max(reached) + room


def _row(figure: Figure, page: _Page, chosen: int, middle: float) -> None:
    """All levers in a gear."""
    joined = signs.joined(page.results.with_freewheels_engaged, chosen)
    bottom = middle - page.high / 2
    for place, left in enumerate(page.lefts):
        start = page.columns[place] + left
        _lever(labels.panel(figure, start, bottom, WIDE, page.high), page, place, chosen, joined)


def _title(case: Transmission, style: Style) -> str:
    what = style.text(
        "speeds over the input speed, on levers", "скорости по отношению к входной, на рычагах"
    )
    return f"{case.name}: {what}" if case.name else what.capitalize()


def _node_text(case: Transmission, node: Node, style: Style) -> str:
    """The link of a node, with what it is in the element if its name does not tell."""
    name = case.link_name(node.link) if node.link else style.text("housing", "корпус")
    if node.member and node.member.lower() not in name.lower():
        name = f"{node.member.replace('_', ' ')}: {name}"
    return labels.wrapped(name, LONGEST)


def _gear_text(results: Results, chosen: int, style: Style) -> str:
    """Name, ratio and engaged elements of a gear, in lines."""
    case = results.with_freewheels_engaged
    gear = case.gears[chosen - 1]
    lines = [style.text(f"gear {gear.name}", f"передача {gear.name}")]
    if results.conflict[chosen - 1]:
        lines.append(style.text("conflict of freewheels", "конфликт обгонных муфт"))
    elif results.tied_up[chosen - 1]:
        lines.append(style.text("tied up", "заперта"))
    else:
        lines.append(f"i = {number(float(results.ratio[chosen - 1]))}")
    lines.append(", ".join(case.shift_elements[one - 1].name for one in gear.engaged))
    lines += [f"{case.link_name(link)} = {speed:g}" for link, speed in gear.speeds.items()]
    return "\n".join(labels.wrapped(line, LONGEST) for line in lines if line)


def _elements_text(case: Transmission, gears: Sequence[int], style: Style) -> str:
    """What each shift element that is engaged in one of the gears joins."""
    used = {number for chosen in gears for number in case.gears[chosen - 1].engaged}
    housing = style.text("housing", "корпус")
    said = []
    for one in sorted(used):
        element = case.shift_elements[one - 1]
        ends = [case.link_name(link) if link else housing for link in element[:2]]
        said.append(f"{element.name}: {' – '.join(map(str, ends))}")
    return ";  ".join(said)


def _lever(panel: Panel, page: _Page, place: int, chosen: int, joined: Joined) -> None:
    """A lever in a gear: bars from the line of rest to the speeds, names and numbers beside."""
    axes, style, lever = panel.axes, page.style, page.levers[place]
    speeds = [0.0, *page.results.speeds[chosen - 1].tolist()]
    low, high = lever.ends
    room = 0.08 * (high - low)
    axes.set_xlim(*page.limits)
    axes.set_ylim(low - room, high + room)
    axes.set_axis_off()
    axes.axvline(1, color=style.faint, linewidth=0.9, linestyle="dotted")
    axes.plot([0, 0], [low, high], color=style.faint, linewidth=2.5)
    known = [node for node in lever.nodes if math.isfinite(speeds[node.link])]
    tips = [speeds[node.link] for node in known]
    axes.plot(tips, [node.position for node in known], color=style.ink, linewidth=1)
    left, right = [], []
    for node, name in zip(lever.nodes, page.names[place], strict=True):
        speed, at = speeds[node.link], panel.up(node.position)
        sign = signs.sign(page.results.case, chosen, node.link, joined, style)
        axes.axhline(node.position, color=style.faint, linewidth=0.4)
        axes.plot([0, speed], [node.position] * 2, color=sign.colour, linewidth=2.5)
        if sign.marker:
            at_tip: dict[str, Any] = {"color": sign.colour, "markersize": 6, "zorder": 4}
            axes.plot([speed], [node.position], sign.marker, **at_tip)
        left.append(Label(at, name, sign.colour))
        right.append(Label(at, number(speed), sign.colour))
    panel.beside("left", left)
    panel.beside("right", right)
