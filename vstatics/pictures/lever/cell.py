"""Drawing of a lever in the state of a gear, with torques and speeds; lengths in points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.labels import shortened, width, wrapped
from vstatics.pictures.drawing.style import SIZE, Style, number
from vstatics.pictures.drawing.words import quantity, word
from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.joined import LeverRoute
from vstatics.pictures.lever.marks import (
    MARK_SIZE,
    SIGNS,
    LeverSheet,
    arrow,
    box,
    cut,
    freewheel,
    ground,
    kind_of,
    mark_of,
)
from vstatics.pictures.lever.places import (
    BESIDE_LEVER,
    FREEWHEEL_WIDTH,
    GROUND_WIDTH,
    LeverPage,
    any_freewheel,
    link_name,
)
from vstatics.pictures.lever.routes import BESIDE_SIGN, LeverRow, middle_of
from vstatics.pictures.lever.view import LeverView


def draw_lever(view: LeverView, name: str, top: float) -> None:
    """Draw a lever with all points, below the name at the height `top` [pt]."""
    cell = view.cell
    if name:
        said, where = _shape(view), (cell.left, top - 2)
        view.sheet.pen.text(*where, name, va="top", color=view.ink, title=said)
    if len(cell.rows) > 1:
        _draw_line(view)
    for node, row in cell.rows.items():
        _draw_point(view, node, row)
        if (view.place, node) in view.gear.grounds:
            _draw_ground(view, row, view.gear.grounds[view.place, node])
        _write(view, node, row)
    points = sorted(cell.rows.items(), key=lambda point: point[1].at)
    tips = [(view.across(view.speed(node)), row.at + view.bottom) for node, row in points]
    if cell.lever.devices and cell.lever.ratio is None and all(math.isfinite(x) for x, _ in tips):
        view.sheet.line(*tips, colour=view.style.soft, width=0.9)


def lever_names(
    page: LeverPage, gear: LeverGear, same: dict[int, str], style: Style, end: float
) -> list[str]:
    """Return the text above each lever of a gear, wrapped so that texts do not overlap."""
    ends = [
        after.left - BESIDE_LEVER if after and after.band == cell.band else end
        for cell, after in zip(page.cells, [*page.cells[1:], None], strict=True)
    ]
    names: list[str] = []
    for place, (cell, right) in enumerate(zip(page.cells, ends, strict=True)):
        said = [cell.lever.name]
        if gear.is_one_piece(place):
            said.append(style.text("locked up"))
        if place in same:
            said.append(style.text("as in gear {gear}", gear=same[place]))
        names.append(wrapped(", ".join(said), right - cell.left))
    return names


def _shape(view: LeverView) -> str:
    """Return the tooltip of a lever: the names and positions of the points."""
    lever, style = view.cell.lever, view.style
    places = (
        f"{link_name(view.sheet.page.case, node.link, style)} {number(node.position)}"
        for node in lever.nodes
    )
    return f"{lever.name}: {style.text('lever')}, {', '.join(places)}"


def _look(link: int, style: Style, *, is_way: bool) -> dict[str, Any]:
    colour, dash = (style.colour(link - 1), style.dash(link - 1)) if link else (style.ink, "solid")
    return {"colour": colour if is_way else style.faint, "dash": dash}


def _draw_line(view: LeverView) -> None:
    cell, sheet, style = view.cell, view.sheet, view.style
    heights = [row.at + view.bottom for row in cell.rows.values()]
    low, high = min(heights), max(heights)
    for speed, dash in ((0.0, "solid"), (1.0, (0, (1, 2)))):
        x = view.across(speed)
        sheet.line((x, low - 4), (x, high + 4), colour=style.faint, width=0.8, dash=dash)
    colour = style.ink if view.is_loaded else style.faint
    if cell.lever.ratio is None:
        sheet.line((cell.at, low), (cell.at, high), colour=colour, width=2.0)
        return
    text = number(cell.lever.ratio)
    if math.isnan(cell.lever.ratio):
        first, *_, second = (view.speed(node) for node in range(len(cell.lever.nodes)))
        text = f"x = {number(second / first if first else math.nan)}"
    middle = middle_of(cell.rows) + view.bottom
    sheet.line((cell.at, low), (cell.at, middle - 0.8 * SIZE), colour=colour)
    sheet.line((cell.at, middle + 0.8 * SIZE), (cell.at, high), colour=colour)
    box(sheet, (cell.at, middle), (width(text) + 4, 1.6 * SIZE), colour)
    sheet.pen.text(cell.at, middle, text, ha="center", va="center", color=view.ink)


def _draw_point(view: LeverView, node: int, row: LeverRow) -> None:
    """Draw the line of a link, bent to the point on the lever, with torque and speed."""
    cell, sheet, gear = view.cell, view.sheet, view.gear
    link, y, at = cell.lever.nodes[node].link, row.y + view.bottom, row.at + view.bottom
    is_way = view.is_loaded or gear.is_way(link, view.place, view.place)
    look, end = _look(link, view.style, is_way=is_way), cell.speeds[1]
    left = (cell.left, y), (cell.at - BESIDE_LEVER, y), (cell.at, at)
    sheet.line(*left, (end, at), (end + BESIDE_LEVER, y), (cell.right, y), **look)
    mark = mark_of(link, gear.state, stands=gear.stands(link))
    others = (abs(other_row.at - row.at) for other, other_row in cell.rows.items() if other != node)
    is_over = mark == "out" and min(others, default=MARK_SIZE) < MARK_SIZE
    sheet.point((cell.at, at), mark, view.ink, is_over=is_over)
    speed, torque = view.speed(node), view.torque(node)
    if cell.lever.devices and math.isfinite(speed) and speed != 0:
        tips = (view.across(0.0), at), (view.across(speed), at)
        sheet.line(*tips, colour=look["colour"], width=3.2)
    if view.same is None and math.isfinite(torque) and torque != 0:
        arrow(sheet, (cell.at - BESIDE_LEVER, y), torque * sheet.per_torque)


def _write(view: LeverView, node: int, row: LeverRow) -> None:
    cell, pen, y = view.cell, view.sheet.pen, row.y + view.bottom
    speed, torque, point = view.speed(node), view.torque(node), view.cell.lever.nodes[node]
    name = link_name(view.sheet.page.case, point.link, view.style)
    member = word(point.member, view.style)
    said = f"{cell.lever.name} {member}".strip() + f": {name}" if cell.lever.name else name
    said += f", {quantity('speed', speed, view.style)}"
    if cell.lever.devices:
        said += f", {quantity('torque', torque, view.style)}"
    where: Look = {"va": "bottom", "color": view.ink, "linespacing": 1.1}
    pen.text(cell.left, y + 3.5, row.name, title=said, **where)
    if view.same is None:
        if torque != 0:
            at = cell.at - BESIDE_LEVER, y - 4.5
            pen.text(*at, number(torque), ha="right", va="top")
        shown = "0" if speed == 0 else number(speed)
        pen.text(cell.right, y + 1.5, shown, ha="right", va="bottom", color=view.ink)


def _draw_ground(view: LeverView, row: LeverRow, names: Sequence[str]) -> None:
    """Draw the support of a held point, with the names of the brakes or a freewheel symbol."""
    style, x, y = view.style, view.cell.at + BESIDE_LEVER + 3, row.at + view.bottom
    if any_freewheel(view.sheet.page.case, names):
        freewheel(view.sheet, (x + 1, y))
        x += FREEWHEEL_WIDTH
    ground(view.sheet, (x, y), style.engaged if names else style.ink)
    if names:
        said, left = _carried(view.gear, names, style), x + GROUND_WIDTH - 8
        # the speed to the right of the names is 0
        shown = shortened(", ".join(names), view.cell.right - SIZE - left)
        look: Look = {"va": "bottom", "color": style.engaged, "over": True}
        view.sheet.pen.text(left, y + 1.5, shown, title=said, **look)


def _carried(gear: LeverGear, names: Sequence[str], style: Style) -> str:
    loaded = (name for name in names if name in gear.carried)
    return ", ".join(f"{name}: {quantity('torque', gear.carried[name], style)}" for name in loaded)


def draw_route(
    sheet: LeverSheet, gear: LeverGear, route: LeverRoute, band: int, bottom: float
) -> None:
    """Draw the line of a link, clutch or spring between levers, in one row of levers.

    Parameters
    ----------
    band : int
        Index of the row.
    bottom : float
        Height of the foot of the row. [pt]
    """
    style, tie = sheet.pen.style, route.tie
    if tie.name:
        is_slack = not tie.is_spring and gear.is_slack(tie.name)
        colour = style.faint if is_slack else style.soft if tie.is_spring else style.engaged
        look: dict[str, Any] = {"colour": colour, "width": 1.4}
    else:
        is_way = gear.is_way(tie.link, tie.ends[0][0], tie.ends[1][0])
        look = _look(tie.link, style, is_way=is_way)
    for place, (on, points) in enumerate(route.pieces, 1):
        if on == band:
            places = [(x, y + bottom) for x, y in points]
            sheet.line(*places, **look)
            if place > 1:
                cut(sheet, (places[0][0] + 1, places[0][1]), look["colour"])
            if place < len(route.pieces):
                cut(sheet, places[-1], look["colour"])
    if route.sign is not None and route.sign[0] == band:
        x, y = route.sign[1]
        _draw_sign(sheet, gear, route, (x, y + bottom))


def _draw_sign(sheet: LeverSheet, gear: LeverGear, route: LeverRoute, at: Point) -> None:
    style, tie, upright, (x, y) = sheet.pen.style, route.tie, route.is_upright, at
    SIGNS[kind_of(sheet.page.case, tie)](sheet, at, upright=upright)
    said, ink = _carried(gear, [tie.name], style), style.ink if tie.is_spring else style.engaged
    where = (x + BESIDE_SIGN, y) if upright else (x, y + 6.5)
    look: Look = {"va": "center"} if upright else {"ha": "center", "va": "bottom", "over": True}
    sheet.pen.text(*where, tie.name, title=said, color=ink, **look)
