"""Drawing of the stations (components) on a single axis, from clutches to differentials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.pen import LINE_WIDTH
from vstatics.pictures.drawing.style import SMALL
from vstatics.pictures.schemes.axes.drawn.links import AxesSheet
from vstatics.pictures.schemes.axes.letters.obstacles import BOX, BRAKE_HEIGHT
from vstatics.pictures.schemes.axes.stations import CAGE, Station, box_note, note_half
from vstatics.pictures.schemes.axes.wires import sign_height
from vstatics.pictures.schemes.coaxial.drawn.lines import wires_of
from vstatics.pictures.schemes.coaxial.picture import draw_parts
from vstatics.pictures.schemes.coaxial.rooms import ends_of
from vstatics.pictures.schemes.gear_glyphs import ground
from vstatics.pictures.schemes.ink import SchemeInk
from vstatics.pictures.schemes.scheme import RATIO_SIGN


def draw_station(sheet: AxesSheet, number: int) -> None:
    """Draw a station on a single axis, with the names."""
    station = sheet.placing.board.stations[number]
    draw = {
        "coupling": _coupling,
        "box": _box,
        "brake": _brake,
        "differential": _differential,
        "set": _set,
        "section": _section,
    }
    draw[station.kind](sheet, number, station)


def _ends(sheet: AxesSheet, index: int) -> dict[int, float]:
    return {
        contact.link: contact.x for contact in sheet.placing.contacts if contact.device == index
    }


def _coupling(sheet: AxesSheet, _number: int, station: Station) -> None:
    axis, placing = station.axes[0], sheet.placing
    for index in station.devices:
        members, xs = sheet.scheme.devices[index].members, _ends(sheet, index)
        y = placing.y(axis, sign_height(placing, index))
        sheet.draw_sign(index, (xs[members["first"]], y), (xs[members["second"]], y))
        sheet.name(index)


def _brake(sheet: AxesSheet, number: int, station: Station) -> None:
    (index,), axis, placing = station.devices, station.axes[0], sheet.placing
    x, low = placing.xs[number], sign_height(placing, index)
    ends = (x, placing.y(axis, low)), (x, placing.y(axis, low + BRAKE_HEIGHT))
    sheet.draw_sign(index, *ends, placing.board.rows.sides[axis])
    sheet.name(index)


def _box(sheet: AxesSheet, number: int, station: Station) -> None:
    (index,), axis, placing = station.devices, station.axes[0], sheet.placing
    device_sheet, x = sheet.of_device(index), placing.xs[number]
    y = placing.y(axis, sign_height(placing, index))
    pen, color = device_sheet.pen, sheet.color(index)
    look: Look = {"facecolor": pen.style.paper, "edgecolor": color, "zorder": 4}
    edge = (x - station.half, y - BOX), (2 * station.half, 2 * BOX)
    pen.box(*edge, width=LINE_WIDTH, title=sheet.said(index), **look)
    note = box_note(sheet.scheme.devices[index], pen.style)
    if note_half(note) * placing.letters > station.half:
        note = note.removeprefix(RATIO_SIGN)
    device_sheet.text((x, y), note, size=SMALL, color=sheet.text_color(index), over=False)
    device, up = sheet.scheme.devices[index], placing.board.rows.sides[axis]
    # The labels of a spring are the coefficients of links in its twist.
    for member, label in device.labels.items():
        at = _ends(sheet, index)[device.members[member]] + 2.0, y - up * (BOX + 5.0)
        device_sheet.text(at, typeset(label), size=SMALL, ha="left")
    sheet.name(index)


def _differential(sheet: AxesSheet, number: int, station: Station) -> None:
    """Draw the differential case with the pinions, and the side gears of the two shafts."""
    (index,), axis, placing = station.devices, station.axes[0], sheet.placing
    pen, x, y = sheet.of_device(index).pen, placing.xs[number], placing.y(axis, 0.0)
    color = sheet.color(index)
    look: Look = {"facecolor": pen.style.paper, "edgecolor": color, "zorder": 4}
    corner = (x - CAGE, y - CAGE)
    pen.box(corner, (2 * CAGE, 2 * CAGE), width=LINE_WIDTH, title=sheet.said(index), **look)
    shaft, cone = [(CAGE, 0), (9, 0)], [(5, -3), (9, -6), (9, 6), (5, 3)]
    lines = [
        [(x + dx * out - dy * up, y + dy * out + dx * up) for out, up in line]
        for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1))
        for line in (shaft, cone)
    ]
    pen.lines(lines, color=color, zorder=4.5)
    sheet.name(index)


def _set(sheet: AxesSheet, number: int, station: Station) -> None:
    (index,), placing = station.devices, sheet.placing
    glyph = station.glyphs[placing.chosen.ways[number]]
    at, side = placing.in_set(number, glyph), placing.board.rows.sides[station.axes[0]]
    strokes: list[tuple[float, Sequence[Point]]] = [
        (stroke.width, [at(*point) for point in stroke.points]) for stroke in glyph.strokes
    ]
    for tap in glyph.taps:
        if not tap.wire:
            end = tap.side * (glyph.half + 5)
            lines = [(at(tap.x, tap.y), at(tap.x, end)), *ground(at(tap.x, end), tap.side * side)]
            strokes += [(LINE_WIDTH, line) for line in lines]
    sheet.draw_strokes(index, strokes)
    sheet.name(index)


def _section(sheet: AxesSheet, number: int, station: Station) -> None:
    layout, placing, axis = station.layout, sheet.placing, station.axes[0]
    assert layout is not None  # noqa: S101 - a half-section has a layout
    left, right = ends_of(layout)
    corner = (
        placing.xs[number] - (left + right) / 2,
        placing.y(axis, 0.0) - layout.places.axis,
    )
    scheme = layout.coaxial.scheme
    idle = {port for port in scheme.ports if not _goes_on(sheet, port.link, station)}
    state = replace(sheet.state, idle_ports=idle)
    pen = sheet.pen.panel(corner, sheet.pen.size)
    draw_parts(SchemeInk(pen, scheme, state, sheet.titles, axis=axis + 1), layout, wires_of(layout))


def _goes_on(sheet: AxesSheet, link: int, station: Station) -> bool:
    """Return True if a link carries torque between a half-section and other stations."""
    others = set(range(len(sheet.scheme.devices))) - set(station.devices)
    ports = {port.link for port in sheet.scheme.ports}
    return (link in ports and sheet.is_used(-1, link)) or any(
        sheet.is_used(index, link) for index in others
    )
