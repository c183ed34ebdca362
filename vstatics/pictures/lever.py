"""Lever diagrams: a row for each gear, a column for each lever, speeds across.

A mechanism is a lever: a point for each link, its speed linear along the lever. In a set
of planets all speeds against the carrier are proportional to one another. So a lever with
the carrier at 0 and each wheel at its relative speed has the speeds of all its links on
one straight line (lever analogy, Benford and Leising 1981).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.elements.drawing import parts_of
from vstatics.elements.group import group_of
from vstatics.elements.kinds import Planetary
from vstatics.elements.lower import DrawnPart
from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import HOUSING, Mechanism, Transmission
from vstatics.pictures import labels, lever_marks
from vstatics.pictures.labels import LEADER, Label, Panel
from vstatics.pictures.lever_marks import MARGIN, mark_of
from vstatics.pictures.state import PictureState, state_of
from vstatics.pictures.style import TITLE, Style, number
from vstatics.pictures.words import fault, gear_title, title
from vstatics.statics.results import Results
from vstatics.statics.status import CONFLICT, TIED_UP

WIDE = 110.0
"""Of the speeds of a lever. [pt]"""
LEAST = 62.0
"""Height of a lever at least. [pt]"""
LONGEST = 110.0
"""Names are wrapped to this width. [pt]"""
VALUES = LEADER + 32.0
"""Width of the numbers beside a lever. [pt]"""


class LeverNode(NamedTuple):
    """A point of a lever."""

    member: str
    """What the link is in the element, or nothing."""
    link: int
    """0 is the housing."""
    position: float
    """Along the lever: the carrier, or third link, at 0, the second link at 1. [-]"""


class Lever(NamedTuple):
    """A mechanism, or planets that mesh with one another and their wheels."""

    name: str
    nodes: tuple[LeverNode, ...]
    """In the order of their positions."""

    @property
    def ends(self) -> tuple[float, float]:
        """The positions of the first and the last node [-]."""
        return self.nodes[0].position, self.nodes[-1].position


def levers(case: Transmission) -> list[Lever]:
    """The levers of a case, in the order of its elements and mechanisms.

    Planets that mesh with one another make one lever with all their wheels, so a
    Ravigneaux set is a lever of four links. A link that is held for good has none.

    Examples
    --------
    >>> from vstatics import Gear
    >>> [lever] = levers(Transmission(3, [], [Mechanism(1, 2, 3, ratio=-2.5)], [Gear()]))
    >>> [(node.link, node.position) for node in lever.nodes]
    [(1, -2.5), (3, 0.0), (2, 1.0)]
    """
    drawn = [lever for part in parts_of(case) for lever in _of_part(part)]
    return [lever for lever in drawn if sum(node.link != HOUSING for node in lever.nodes) > 1]


def _of_part(part: DrawnPart) -> Iterator[Lever]:
    element = part.element
    if element is None or not isinstance(element.shape, Planetary):
        for lowered in part.lowered:
            members = lowered.members if element is not None else ("", "", "")
            yield _of_mechanism(lowered.mechanism, members)
        return
    group = group_of(element)
    trains = [train for train in group.trains if len(group.wheels_of(train)) > 1]
    for count, train in enumerate(trains, 1):
        wheels = group.wheels_of(train)
        unit = group.relative(wheels[-1], train)
        nodes = [
            LeverNode(wheel.member, wheel.link, float(group.relative(wheel, train) / unit))
            for wheel in wheels
        ]
        name = part.name if len(trains) == 1 else f"{part.name}, {count}"
        yield _sorted(name, [*nodes, LeverNode("carrier", group.carrier, 0.0)])


def _of_mechanism(mechanism: Mechanism, members: tuple[str, str, str]) -> Lever:
    """Positions u, 1 and 0: then w_first - w_third = u (w_second - w_third)."""
    places = zip(members, mechanism.links, (mechanism.ratio, 1.0, 0.0), strict=True)
    return _sorted(mechanism.name, [LeverNode(*place) for place in places])


def _sorted(name: str, nodes: list[LeverNode]) -> Lever:
    return Lever(name, tuple(sorted(nodes, key=lambda node: node.position)))


class _Page(NamedTuple):
    """What all levers of a figure share, and where they stand; lengths in points."""

    case: Transmission
    states: Sequence[PictureState]
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


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw the levers of a case in all gears, or in some.

    Raises
    ------
    CaseError
        If there is no mechanism of two links or more.
    """
    numbers = gears or range(1, len(results.case.gears) + 1)
    page = _page(results.case, [state_of(results, number) for number in numbers], style)
    wide = page.columns[-1]
    subject = style.text(
        "speeds over the input speed, on levers", "скорости по отношению к входной, на рычагах"
    )
    head = labels.wrapped(title(page.case, subject), wide - 2 * MARGIN, TITLE)
    note = labels.wrapped(_elements_text(page), wide - 2 * MARGIN)
    tops = [
        labels.wrapped(lever.name, left + WIDE)
        for lever, left in zip(page.levers, page.lefts, strict=True)
    ]
    above = labels.height(head, TITLE) + 2 * MARGIN + max(map(labels.height, tops))
    below = 2 * MARGIN + labels.height(note) + lever_marks.legend_height(style, wide)
    high = above + len(page.states) * page.up + below
    figure = labels.figure(wide, high)
    whole = labels.panel(figure, 0, 0, wide, high)
    whole.axes.set_axis_off()
    whole.write(wide / 2, high - MARGIN, head, ha="center", va="top", fontsize=TITLE)
    whole.write(MARGIN, MARGIN, note, va="bottom")
    lever_marks.legend(whole, style, labels.height(note) + MARGIN)
    for left, start, top in zip(page.lefts, page.columns, tops, strict=False):
        whole.write(start + left + WIDE / 2, high - above, top, ha="center", va="bottom")
    for row, state in enumerate(page.states):
        middle = high - above - (row + 0.5) * page.up
        whole.write(MARGIN, middle, page.heads[row], va="center")
        for place, left in enumerate(page.lefts):
            start, bottom = page.columns[place] + left, middle - page.high / 2
            _draw_lever(labels.panel(figure, start, bottom, WIDE, page.high), page, place, state)
    return figure


def _page(case: Transmission, states: Sequence[PictureState], style: Style) -> _Page:
    drawn = levers(case)
    if not drawn:
        raise CaseError([Problem("the case has no mechanism to draw as a lever")])
    names = [[_node_text(case, node, style) for node in lever.nodes] for lever in drawn]
    lefts = [max(map(labels.width, some)) + LEADER for some in names]
    heads = [_gear_text(case, state, style) for state in states]
    labelled = max(sum(labels.height(name) + labels.GAP for name in some) for some in names)
    high = max(labelled, LEAST)
    up = max(high, *map(labels.height, heads)) + 2 * MARGIN
    return _Page(case, states, style, drawn, names, lefts, _limits(states, drawn), heads, high, up)


def _limits(states: Sequence[PictureState], drawn: Sequence[Lever]) -> tuple[float, float]:
    """Ends of the speeds, the same for all levers, so that lengths can be compared."""
    links = {node.link for lever in drawn for node in lever.nodes}
    speeds = [state.speeds[link] for state in states for link in links]
    reached = [speed for speed in speeds if math.isfinite(speed)] + [0.0, 1.0]
    room = 0.07 * (max(reached) - min(reached))
    return min(reached) - room, max(reached) + room


def _link_name(case: Transmission, link: int, style: Style) -> str:
    return case.link_name(link) if link else style.text("housing", "корпус")


def _node_text(case: Transmission, node: LeverNode, style: Style) -> str:
    """The link of a node, with what it is in the element if its name does not tell."""
    name = _link_name(case, node.link, style)
    if node.member and node.member.lower() not in name.lower():
        name = f"{node.member.replace('_', ' ')}: {name}"
    return labels.wrapped(name, LONGEST)


def _gear_text(case: Transmission, state: PictureState, style: Style) -> str:
    """Name, ratio and engaged elements of a gear, in lines."""
    gear = state.gear
    faults = [fault(one, style) for one in state.faults if one in (CONFLICT, TIED_UP)]
    lines = [gear_title(gear.name, style), *(faults or [f"i = {number(state.ratio)}"])[:1]]
    lines.append(", ".join(case.shift_elements[one - 1].name for one in gear.engaged))
    lines += [
        f"{case.link_name(link)} = {case.speed_text(speed)}" for link, speed in gear.speeds.items()
    ]
    return "\n".join(labels.wrapped(line, LONGEST) for line in lines if line)


def _elements_text(page: _Page) -> str:
    """What each shift element that is engaged in one of the gears joins."""
    case = page.case
    said = []
    for engaged in sorted({one for state in page.states for one in state.gear.engaged}):
        element = case.shift_elements[engaged - 1]
        ends = [_link_name(case, link, page.style) for link in element[:2]]
        said.append(f"{element.name}: {' – '.join(ends)}")
    return ";  ".join(said)


def _draw_lever(panel: Panel, page: _Page, place: int, state: PictureState) -> None:
    """A lever in a gear: bars from the line of rest to the speeds, names and numbers beside."""
    axes, style, lever, speeds = panel.axes, page.style, page.levers[place], state.speeds
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
        mark = mark_of(node.link, state, style)
        axes.axhline(node.position, color=style.faint, linewidth=0.4)
        axes.plot([0, speed], [node.position] * 2, color=mark.colour, linewidth=2.5)
        if mark.marker:
            at_tip: dict[str, Any] = {"color": mark.colour, "markersize": 6, "zorder": 4}
            axes.plot([speed], [node.position], mark.marker, **at_tip)
        left.append(Label(at, name, mark.colour))
        right.append(Label(at, number(speed), mark.colour))
    panel.beside("left", left)
    panel.beside("right", right)
