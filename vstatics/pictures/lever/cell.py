"""One lever in one gear: its line, torques at its points, speeds to the side; lengths in points."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import Inks, arrow, box, coil, ground, mark_of, plates
from vstatics.pictures.lever.places import (
    BESIDE_LEVER,
    GROUND_WIDTH,
    LeverCell,
    LeverPage,
    LeverRow,
    link_name,
)
from vstatics.pictures.lever.routes import LeverRoute
from vstatics.pictures.sheet.labels import Paper, width, wrapped
from vstatics.pictures.sheet.style import SIZE, Style, number
from vstatics.pictures.sheet.svg import halo, told


class LeverSheet(NamedTuple):
    """What all levers of a figure share."""

    paper: Paper
    inks: Inks
    style: Style
    page: LeverPage
    speeds: tuple[float, float]
    """The least and the largest one. [-]"""
    per_torque: float
    """Length of an arrow. [pt]"""


class LeverView(NamedTuple):
    """A lever in a gear, and where it stands in a figure."""

    sheet: LeverSheet
    gear: LeverGear
    place: int
    """Of the lever, from the left."""
    bottom: float
    """Its foot."""
    same: str | None
    """The gear before that shows the same; numbers are left out then."""

    @property
    def cell(self) -> LeverCell:
        """The lever."""
        return self.sheet.page.cells[self.place]

    @property
    def is_loaded(self) -> bool:
        """Whether it carries torque; else it is pale."""
        return self.gear.is_loaded(self.place)

    @property
    def ink(self) -> str:
        """Of texts."""
        return self.sheet.style.ink if self.is_loaded else self.sheet.style.soft

    def torque(self, node: int) -> float:
        """On a point; a shaft has none of its own [-]."""
        return self.gear.torques[self.place][node] if self.cell.lever.devices else 0.0

    def speed(self, node: int) -> float:
        """Of a point [-]."""
        return self.gear.state.speeds[self.cell.lever.nodes[node].link]

    def across(self, speed: float) -> float:
        """Where a speed is."""
        (start, end), (low, high) = self.cell.speeds, self.sheet.speeds
        return start + (speed - low) / (high - low) * (end - start)


def draw_lever(view: LeverView, name: str, top: float) -> None:
    """A lever with its points, its name below a height."""
    cell, style = view.cell, view.sheet.style
    if name:
        where = {"va": "top", "color": view.ink, "gid": told(_shape(view))}
        view.sheet.paper.write(cell.left, top - 2, name, **where)
    if len(cell.rows) > 1:
        _draw_line(view)
    for node, row in cell.rows.items():
        _draw_point(view, node, row)
        if (view.place, node) in view.gear.grounds:
            _draw_ground(view, row, view.gear.grounds[view.place, node])
        _write(view, node, row)
    tips = [(view.across(view.speed(node)), row.at + view.bottom) for node, row in _points(view)]
    if cell.lever.devices and cell.lever.ratio is None and all(math.isfinite(x) for x, _ in tips):
        view.sheet.inks.line(*tips, colour=style.soft, width=0.9)


def _points(view: LeverView) -> list[tuple[int, LeverRow]]:
    return sorted(view.cell.rows.items(), key=lambda point: point[1].at)


def lever_names(
    page: LeverPage, gear: LeverGear, same: dict[int, str], style: Style, end: float
) -> list[str]:
    """What stands over each lever in a gear, in lines that end before the next lever."""
    ends = [*(cell.left - BESIDE_LEVER for cell in page.cells[1:]), end]
    found: list[str] = []
    for place, (cell, right) in enumerate(zip(page.cells, ends, strict=True)):
        said = [cell.lever.name]
        if gear.is_one_piece(place):
            said.append(style.text("one piece", "как одно целое"))
        if place in same:
            said.append(style.text(f"as in gear {same[place]}", f"как на передаче {same[place]}"))
        found.append(wrapped(", ".join(said), right - cell.left))
    return found


def _shape(view: LeverView) -> str:
    """Where the points of a lever are."""
    lever, case, text = view.cell.lever, view.sheet.page.case, view.sheet.style.text
    places = (
        f"{link_name(case, node.link, view.sheet.style)} {number(node.position)}"
        for node in lever.nodes
    )
    return f"{lever.name}: {text('lever', 'рычаг')}, {', '.join(places)}"


def _look(link: int, style: Style) -> tuple[str, Any]:
    """Colour and dash of a link."""
    return (style.colour(link - 1), style.dash(link - 1)) if link else (style.ink, "solid")


def _draw_line(view: LeverView) -> None:
    """The line of a lever, with those of rest and of the input's speed beside it."""
    cell, inks, style = view.cell, view.sheet.inks, view.sheet.style
    heights = [row.at + view.bottom for row in cell.rows.values()]
    low, high = min(heights), max(heights)
    for speed, dash in ((0.0, "solid"), (1.0, (0, (1, 2)))):
        x = view.across(speed)
        inks.line((x, low - 4), (x, high + 4), colour=style.faint, width=0.8, dash=dash)
    colour = style.ink if view.is_loaded else style.faint
    if cell.lever.ratio is None:
        inks.line((cell.at, low), (cell.at, high), colour=colour, width=2.0)
        return
    text, middle = number(cell.lever.ratio), cell.middle + view.bottom
    inks.line((cell.at, low), (cell.at, middle - 0.8 * SIZE), colour=colour)
    inks.line((cell.at, middle + 0.8 * SIZE), (cell.at, high), colour=colour)
    box(inks, (cell.at, middle), (width(text) + 4, 1.6 * SIZE), colour)
    view.sheet.paper.write(cell.at, middle, text, ha="center", va="center", color=view.ink)


def _draw_point(view: LeverView, node: int, row: LeverRow) -> None:
    """The line of a link across the cell, bent to its point, with its torque and its speed."""
    cell, inks, style = view.cell, view.sheet.inks, view.sheet.style
    link, y, at = cell.lever.nodes[node].link, row.y + view.bottom, row.at + view.bottom
    colour, dash = _look(link, style)
    is_way = view.is_loaded or view.gear.is_way(link, view.place, view.place)
    colour = colour if is_way else style.faint
    end = cell.speeds[1]
    left = (cell.left, y), (cell.at - BESIDE_LEVER, y), (cell.at, at)
    right = (end, at), (end + BESIDE_LEVER, y), (cell.right, y)
    inks.line(*left, *right, colour=colour, dash=dash)
    mark = mark_of(link, view.gear.state, stands=view.gear.stands(link))
    inks.point((cell.at, at), mark, view.ink)
    speed, torque = view.speed(node), view.torque(node)
    if cell.lever.devices and math.isfinite(speed) and speed != 0:
        inks.line((view.across(0.0), at), (view.across(speed), at), colour=colour, width=3.2)
    if view.same is None and math.isfinite(torque) and torque != 0:
        arrow(inks, (cell.at - BESIDE_LEVER, y), torque * view.sheet.per_torque, style.ink)


def _write(view: LeverView, node: int, row: LeverRow) -> None:
    """The name of a point, its torque below, its speed at the right."""
    cell, paper, y = view.cell, view.sheet.paper, row.y + view.bottom
    speed, torque = view.speed(node), view.torque(node)
    told_by_name = {"gid": told(_told(view, node)), "linespacing": 1.1, "color": view.ink}
    paper.write(cell.left, y + 2.5, row.name, va="bottom", **told_by_name)
    if view.same is not None:
        return
    if torque != 0:
        paper.write(cell.at - BESIDE_LEVER, y - 4.5, number(torque), ha="right", va="top")
    text = "0" if speed == 0 else number(speed)
    paper.write(cell.right, y + 1.5, text, ha="right", va="bottom", color=view.ink)


def _told(view: LeverView, node: int) -> str:
    """What a point says of itself."""
    lever, text = view.cell.lever, view.sheet.style.text
    point = lever.nodes[node]
    name = link_name(view.sheet.page.case, point.link, view.sheet.style)
    said = [f"{lever.name} {point.member}".strip() + f": {name}" if lever.name else name]
    said.append(f"{text('speed', 'скорость')} {number(view.speed(node))}")
    if lever.devices:
        said.append(f"{text('torque', 'момент')} {number(view.torque(node))}")
    return ", ".join(said)


def _draw_ground(view: LeverView, row: LeverRow, name: str) -> None:
    """What holds a point, with the names of its brakes."""
    style, x, y = view.sheet.style, view.cell.at + BESIDE_LEVER + 3, row.at + view.bottom
    ground(view.sheet.inks, (x, y), style.engaged if name else style.ink)
    if name:
        how = {
            "va": "bottom",
            "color": style.engaged,
            **halo(style, _carried(view.gear, name, style)),
        }
        view.sheet.paper.write(x + GROUND_WIDTH - 8, y + 1.5, name, **how)


def _carried(gear: LeverGear, names: str, style: Style) -> str:
    """What shift elements at one place are loaded with."""
    said = [
        f"{name}: {style.text('torque', 'момент')} {number(torque)}"
        for name, torque in gear.carried.items()
        if name in names.split(", ")
    ]
    return ", ".join(said)


def draw_route(sheet: LeverSheet, gear: LeverGear, route: LeverRoute, bottom: float) -> None:
    """The line of a link, a clutch or a spring between levers."""
    style, one = sheet.style, route.tie
    places = [(x, y + bottom) for x, y in route.points]
    if not one.name:
        colour, dash = _look(one.link, style)
        is_way = gear.is_way(one.link, one.ends[0][0], one.ends[1][0])
        colour = colour if is_way else style.faint
        sheet.inks.line(*places, colour=colour, dash=dash)
        return
    is_slack = not one.is_spring and gear.is_slack(one.name)
    line = style.faint if is_slack else style.soft if one.is_spring else style.engaged
    sheet.inks.line(*places, colour=line, width=1.4)
    x, y = route.sign[0], route.sign[1] + bottom
    (coil if one.is_spring else plates)(sheet.inks, (x, y), style)
    colour = style.ink if one.is_spring else style.engaged
    sheet.paper.write(
        x,
        y + 6.5,
        one.name,
        ha="center",
        va="bottom",
        color=colour,
        **halo(style, _carried(gear, one.name, style)),
    )
