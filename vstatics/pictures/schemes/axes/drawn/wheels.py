"""Drawing of gear pairs, with both gears in a common plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.schemes.axes.drawn.links import AxesSheet
from vstatics.pictures.schemes.axes.letters.obstacles import CONE, CONE_RIM
from vstatics.pictures.schemes.axes.recognition import FAR
from vstatics.pictures.schemes.axes.stations import WHEEL
from vstatics.pictures.schemes.gear_glyphs import MESH, TOOTH


def draw_pair(sheet: AxesSheet, number: int) -> None:
    """Draw both gears of a pair, an idler or chain between the gears, and the name of the pair."""
    placing, station = sheet.placing, sheet.placing.board.stations[number]
    index = station.devices[0]
    device_sheet = sheet.of_device(index)
    first, _, second = placing.board.radii[number]
    ys = [placing.y(axis, 0.0) for axis in station.axes]
    toward = 1 if ys[1] > ys[0] else -1
    for place, radius in enumerate((first, second)):
        _wheel(device_sheet, number, place, radius, toward if not place else -toward)
    _between(device_sheet, number, ys, toward)
    sheet.name(index)


def _wheel(sheet: AxesSheet, number: int, place: int, radius: float, toward: int) -> None:
    """Draw a gear: teeth at both edges, and the half of the web on the far side of the axis."""
    placing, station = sheet.placing, sheet.placing.board.stations[number]
    index, x, axis, link = (
        station.devices[0],
        placing.xs[number],
        station.axes[place],
        station.links[place],
    )
    joint, device = station.joint, sheet.scheme.devices[index]
    pen = sheet.pen.within("wheel", mechanism=device.name, link=sheet.scheme.name(link))
    color, said = sheet.line_color(index, link), sheet.said(index)
    y, side, span = placing.y(axis, 0.0), placing.board.rows.sides[axis], placing.spans[link]
    hub = span.height if span.level >= 0 else placing.bases[axis] + 2
    inner = y - side * hub
    off = placing.board.webs(number, placing.chosen.ways[number])[place]
    radius += MESH * bool(off)
    lines: list[Sequence[Point]] = [((x + off, inner), (x + off, y - side * radius))]
    if off:  # the web of an internal gear is drawn beside its teeth, so that it passes the pinion
        lines.append(((x + off, y + side * (radius - MESH)), (x + off, y + side * radius)))
    pen.lines(lines, color=color, zorder=3.2, title=said, solid_capstyle="butt")
    if joint is not None and joint.kind == "bevel_pair":
        _cone(replace(sheet, pen=pen), number, place, radius)
        return
    slant = CONE if joint is not None and joint.kind == "worm" else 0.0
    slant *= -1 if place else 1
    rims: list[Sequence[Point]] = []
    for way in (-1, 1):
        rim, tilt = y + way * radius, way * slant * toward
        left, right = min(x - WHEEL, x + off), max(x + WHEEL, x + off)
        rims.append(((left, rim - tilt), (right, rim + tilt)))
    pen.lines(rims, color=color, width=2.2 * TOOTH, zorder=3.5, title=said)


def _cone(sheet: AxesSheet, number: int, place: int, radius: float) -> None:
    """Draw a bevel gear: the pinion as a full cone, the crown gear with a toothed edge.

    The pinion is narrow at its free end.
    """
    placing, station = sheet.placing, sheet.placing.board.stations[number]
    index, x, link = station.devices[0], placing.xs[number], station.links[place]
    radii = placing.board.radii[number][::2]
    pinion = min((0, 1), key=lambda place_in_pair: radii[place_in_pair])
    span, y = placing.spans[station.links[pinion]], placing.y(station.axes[place], 0.0)
    is_pinion, free = place == pinion, 1 if x - span.left >= span.right - x else -1
    wide = -CONE * free * (1 if is_pinion else -1)
    deep = radius if is_pinion else min(radius, CONE_RIM)
    teeth: list[Sequence[Point]] = []
    edges: list[Sequence[Point]] = []
    for way in (-1, 1):
        ends = [(x + by * WHEEL, y + way * (radius + by * wide)) for by in (-1, 1)]
        back = [(at, y + way * (radius - deep)) for at, _ in reversed(ends)]
        teeth.append(ends)
        edges += [[ends[1], *back, ends[0]]]
    color, said = sheet.line_color(index, link), sheet.said(index)
    sheet.pen.lines(teeth, color=color, width=2.2 * TOOTH, zorder=3.5, title=said)
    sheet.pen.lines(edges, color=color, zorder=3.4, title=said)


def _between(sheet: AxesSheet, number: int, ys: Sequence[float], toward: int) -> None:
    """Draw an idler, a chain, or a dashed line between two gears that are drawn apart."""
    placing, station = sheet.placing, sheet.placing.board.stations[number]
    pen, color, x = sheet.pen, sheet.color(station.devices[0]), placing.xs[number]
    first, radius, second = placing.board.radii[number]
    low, high = sorted((ys[0] + toward * first, ys[1] - toward * second))
    if station.joint is not None and station.joint.kind in FAR:
        ends = ys[0] - toward * first, ys[1] + toward * second
        lines = [((x + by, ends[0]), (x + by, ends[1])) for by in (-2.5, 2.5)]
        pen.lines(lines, color=color, width=0.9, linestyle=(0, (3, 1.5)), zorder=2.9)
    elif high - low > 2 * radius + MESH:
        look: Look = {"linestyle": (0, (4, 2.5)), "zorder": 2.5}
        pen.line((x, low), (x, high), color=color, width=0.8, **look)
    elif radius:
        middle = (low + high) / 2
        edges = [((x - WHEEL, middle + by), (x + WHEEL, middle + by)) for by in (-radius, radius)]
        pen.lines(edges, color=color, width=2.2 * TOOTH, zorder=3.5)
        pen.line((x, middle - radius), (x, middle + radius), color=color, zorder=3.2)
        pen.line((x - WHEEL - 2, middle), (x + WHEEL + 2, middle), color=color, zorder=3.2)
