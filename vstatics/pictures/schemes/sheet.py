"""What all schemes draw alike: paper, title, wires, ends, clutches, brakes and springs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import permutations
from typing import Any

from vstatics.model.transmission import HOUSING
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, PlacedTap, Tap
from vstatics.pictures.schemes.glyphs import lines_of
from vstatics.pictures.schemes.ink import ARROW, FURTHER, SchemeInk, centred, draw_arrow
from vstatics.pictures.schemes.placing import Placement
from vstatics.pictures.schemes.scheme import Device, Scheme, SchemePort, SchemeState
from vstatics.pictures.schemes.signs import (
    PACK,
    Coupled,
    draw_coupled,
)
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.schemes.wires import wire_lines
from vstatics.pictures.sheet.labels import Point, widest, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import SIZE, WIDE_MARGIN

HEIGHT = 1.3 * SIZE
"""Of a line of text. [pt]"""
BAND = 26.0
"""From the last track to the housing: there is room for a brake. [pt]"""
BRAKE_NAME_GAP = 14.0
"""From a brake to its name. [pt]"""
AXIS = 6.0
"""From the last track below to the axis. [pt]"""

DrawDevice = Callable[["Sheet", int], None]
"""Draws a mechanism or an element by its index."""


@dataclass(frozen=True)
class Sheet(SchemeInk):
    """A figure with a scheme at its place, in a state."""

    placement: Placement

    def text(self, at: Point, text: str, **look: Any) -> None:
        """Text over any line, by its middle."""
        centred(self.pen, at, text, **look)

    def taps(self, index: int) -> list[PlacedTap]:
        """Where wires meet a device."""
        return [tap for tap in self.placement.row.taps if tap.item == index]


def wired(  # noqa: PLR0913 - what is drawn, and how
    scheme: Scheme,
    placement: Placement,
    draw: DrawDevice,
    state: SchemeState,
    *,
    titles: Titles,
    within: Pen,
) -> None:
    """All of a scheme at a place of a figure."""
    pen = within.fitted(*extent(scheme, placement))
    sheet = Sheet(pen, scheme, state, titles, placement)
    _wires(sheet)
    _ends(sheet)
    for index, device in enumerate(scheme.devices):
        (_draw_coupling if device.is_coupling else draw)(sheet, index)


def extent(scheme: Scheme, placement: Placement) -> tuple[Point, Point]:
    """The lower left and the upper right corner of a picture with room for all but its head."""
    before, behind = (
        ARROW + 4 + widest(map(scheme.name, wires)) + WIDE_MARGIN
        for wires in (placement.from_left, placement.to_right)
    )
    sides = {tap.side for tap in placement.row.taps if tap.reach == "edge"}
    low = placement.edge(BELOW) - (BAND + 14 if BELOW in sides else AXIS + HEIGHT)
    high = placement.edge(ABOVE) + (BAND + 14 if ABOVE in sides else HEIGHT)
    return (-before, low), (placement.row.width + behind, high)


def _wires(sheet: Sheet) -> None:
    """Each link as one path, or two if torque passes parts of it; dots, its name."""
    pen, placement = sheet.pen, sheet.placement
    lines = wire_lines(placement, sheet.scheme, sheet.state)
    for wire, own in lines.items():
        look: Look = {"title": sheet.titles.links.get(wire, ""), "zorder": 3}
        for color, pieces in ((pen.style.faint, own.pale), (pen.style.ink, own.loaded)):
            pen.lines(pieces, color=color, solid_capstyle="projecting", **look)
    joints = placement.joints()
    look = {"width": 4.6, "zorder": 6, "solid_capstyle": "round", "snap": False}
    for color, there in ((pen.style.faint, False), (pen.style.ink, True)):
        dots = [at for at, wire in joints if (at in lines[wire].points) == there]
        pen.lines([((x, y), (x + 0.1, y)) for x, y in dots], color=color, **look)
    for wire, at in placement.labels.items():
        sheet.text(at, sheet.scheme.name(wire), color=sheet.name_color(wire))


def _ends(sheet: Sheet) -> None:
    """Arrows of the ports, with the names of their links."""
    placement = sheet.placement
    named: set[int] = set()
    sides = (placement.from_left, -1, 0.0), (placement.to_right, 1, placement.row.width)
    for wires, way, x in sides:
        ports = [port for port in sheet.scheme.ports if port.is_left == (way < 0)]
        for wire in wires:
            own = [port for port in ports if port.link == wire]
            at = x, placement.y(placement.end_of(wire))
            _end(sheet, own, at, way)
            if wire not in named or any(port.is_further for port in own):
                name = (at[0] + way * (ARROW + 4), at[1]), sheet.scheme.name(wire)
                ha = "left" if way > 0 else "right"
                sheet.text(*name, color=sheet.name_color(wire), ha=ha)
            named.add(wire)


def _end(sheet: Sheet, ports: Sequence[SchemePort], at: Point, way: int) -> None:
    """The line that leaves the picture, with its arrow: where power goes, as far as is known."""
    color, (x, y) = sheet.end_color(ports), at
    if any(port.is_further for port in ports):
        sheet.pen.line(at, (x + way * ARROW, y), color=color, zorder=3, linestyle=FURTHER)
    else:
        draw_arrow(sheet.pen, at, (way, 0.0), sheet.ways(ports), color)


def coupling_item(index: int, device: Device) -> Item:
    """A shift element, a spring or a support with its name."""
    name = width(lines_of(device.name), bold=True)
    if device.is_on_housing:
        (link,) = device.links
        variants = [[Tap(link, 0, 12.0, "edge")]]
        wide = 24.0 if device.kind == "held" else name + BRAKE_NAME_GAP + 18
    else:
        wide = max(name + 14, 34.0)
        variants = [
            [Tap(left, 0, 0.0), Tap(right, 0, wide)]
            for left, right in permutations(device.members.values())
        ]
    return Item(index, [wide] * len(variants), variants)


def _draw_coupling(sheet: Sheet, index: int) -> None:
    """A clutch or a spring between two links, its name below; at the housing, beside it."""
    device, taps = sheet.scheme.devices[index], sheet.taps(index)
    closed, text, side = index in sheet.state.engaged, lines_of(device.name), 0
    first = device.members.get("first")
    look: Look = {"color": sheet.text_color(index), "bold": closed}
    if device.is_on_housing:
        tap = next(tap for tap in taps if tap.reach != "row")
        side, start = tap.side, sheet.placement.edge(tap.side)
        ends = (tap.x, start), (tap.x, start + side * BAND)
        at = tap.x + BRAKE_NAME_GAP, start + side * (BAND - PACK)
        look["ha"] = "left"
    else:
        one, other = sorted(taps, key=lambda tap: tap.wire != first)
        ends = (one.x, 0.0), (other.x, 0.0)
        at = (one.x + other.x) / 2, -13
        look["va"] = "top"
    rod, said = sheet.rod_color(index), sheet.said(index)
    drawn = device.sign, *ends, sheet.color(index), closed, rod, side, said, first == HOUSING
    draw_coupled(sheet.pen, Coupled(*drawn))
    if device.kind != "held":
        sheet.text(at, text, **look)
