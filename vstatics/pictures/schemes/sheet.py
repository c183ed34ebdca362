"""What all schemes draw alike: paper, title, wires, ends, clutches, brakes and springs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import HOUSING
from vstatics.pictures.labels import Point
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, PlacedTap, Tap
from vstatics.pictures.schemes.pen import LINE, SIZE, Pen, Window, width_of, wrapped
from vstatics.pictures.schemes.placing import Placement
from vstatics.pictures.schemes.scheme import Device, Scheme, SchemeState, scheme_state
from vstatics.pictures.state import state_of
from vstatics.pictures.style import Style
from vstatics.pictures.words import fault, gear_title
from vstatics.statics.results import Results

TERMINAL = 30.0
"""Length of an arrow at an end of the picture. [pt]"""
HEIGHT = 1.25 * SIZE
"""Of a line of text. [pt]"""
MARGIN = 14.0
BAND = 26.0
"""From the last track to the housing: there is room for a brake. [pt]"""
BESIDE = 14.0
"""From a brake to its name. [pt]"""
PLATE = 9.0
"""Half the length of a plate. [pt]"""
SPLIT = {"freewheel": 6.0, "dog_clutch": 4.0, "spring": 9.0}
"""Half the length along the line, where it is not that of plates. [pt]"""
_OF_NO_GEAR = SchemeState()


class Sheet(NamedTuple):
    """A figure with a scheme at its place, in a state."""

    pen: Pen
    placement: Placement
    scheme: Scheme
    state: SchemeState

    def color(self, index: int) -> str:
        """Of a device."""
        style = self.pen.style
        if index in self.state.engaged:
            return style.engaged
        return style.faint if index in self.state.idle else style.ink

    def wire_color(self, link: int) -> str:
        """Of a link."""
        style = self.pen.style
        return style.faint if link in self.state.idle_links else style.ink

    def taps(self, index: int) -> list[PlacedTap]:
        """Where wires meet a device."""
        return [tap for tap in self.placement.row.taps if tap.item == index]


def sheet_of(
    results: Results, scheme: Scheme, placement: Placement, style: Style, gears: Sequence[int]
) -> Sheet:
    """A figure with room for everything, its title and its wires; a gear by its number from 1.

    Raises
    ------
    CaseError
        If there are several gears.
    """
    if len(gears) > 1:
        raise CaseError([Problem("the picture of a scheme shows one gear at a time")])
    state, title = SchemeState(), results.case.name
    if gears:
        shown = state_of(results, gears[0])
        state = scheme_state(scheme, shown)
        texts = [gear_title(shown.gear.name, style), *(fault(one, style) for one in shown.faults)]
        title = ", ".join([title, *texts] if title else texts)
    return wired(scheme, placement, style, title=title, state=state)


def wired(  # noqa: PLR0913 - what is drawn, and how
    scheme: Scheme,
    placement: Placement,
    style: Style,
    *,
    title: str = "",
    state: SchemeState = _OF_NO_GEAR,
    within: Window | None = None,
) -> Sheet:
    """A sheet with its title, its wires and the names of its ends; by itself or within another."""
    low, high = extent(scheme, placement, title)
    sheet = Sheet(Pen(low, high, style, within), placement, scheme, state)
    at = low[0] + MARGIN, high[1] - 1.4 * HEIGHT
    sheet.pen.text(at, title, color=style.ink, size=SIZE + 2, across="left", bold=True)
    _wires(sheet)
    _ends(sheet)
    return sheet


def extent(scheme: Scheme, placement: Placement, title: str = "") -> tuple[Point, Point]:
    """The lower left and the upper right corner of a picture with room for everything."""
    names = {
        "left": [width_of(scheme.name(wire)) for wire in placement.from_left],
        "right": [width_of(scheme.name(wire)) for wire in placement.to_right],
    }
    left = -TERMINAL - 4 - max(names["left"], default=-TERMINAL) - MARGIN
    right = placement.row.width + TERMINAL + 4 + max(names["right"], default=-TERMINAL) + MARGIN
    right = max(right, left + 2 * MARGIN + width_of(title, SIZE + 2, bold=True))
    sides = {tap.side for tap in placement.row.taps if tap.reach in {"edge", "pass"}}
    low = placement.edge(BELOW) - (BAND + 14 if BELOW in sides else 0)
    high = placement.edge(ABOVE) + (BAND + 14 if ABOVE in sides else 0)
    high += 2.6 * HEIGHT * bool(title)
    return (left, low), (right, high)


def _wires(sheet: Sheet) -> None:
    """Tracks, taps, bridges over crossings, dots at joints, names."""
    pen, placement, row = sheet.pen, sheet.placement, sheet.placement.row
    for track, (low, high) in row.spans.items():
        y = placement.y(track)
        pen.line((low, y), (high, y), color=sheet.wire_color(track[0]))
    for x, y, _, _ in placement.crossings():
        pen.line((x, y - 4), (x, y + 4), color=pen.style.paper, width=6, zorder=3.5)
    for x, low, high, wire in placement.verticals():
        pen.line((x, low), (x, high), color=sheet.wire_color(wire), zorder=3.6)
    for at, wire in placement.joints():
        pen.dot(at, sheet.wire_color(wire))
    for wire, at in placement.labels.items():
        name = sheet.scheme.name(wire)
        pen.blank(at, width_of(name) + 4, HEIGHT)
        pen.text(at, name, color=sheet.wire_color(wire))


def _ends(sheet: Sheet) -> None:
    """Arrows of the ports, with the names of their links."""
    pen, placement = sheet.pen, sheet.placement
    named: set[int] = set()
    ends = [(wire, -1, 0.0) for wire in placement.from_left]
    ends += [(wire, 1, placement.row.width) for wire in placement.to_right]
    for wire, way, x in ends:
        y = placement.y(placement.end_of(wire))
        own = [port for port in sheet.scheme.ports if port.link == wire]
        ports = [port for port in own if (port.role == "input") == (way < 0)]
        is_used = not ports or any(port not in sheet.state.idle_ports for port in ports)
        color = sheet.wire_color(wire) if is_used else pen.style.faint
        end = x + way * TERMINAL
        pen.line((x, y), (end, y), color=color)
        if ports:
            pen.arrow((x - 6 if way < 0 else end, y), 1, color)
        if ports and all(port.role == "given" for port in ports):
            pen.arrow((x + 4, y), -1, color)  # power may come or go
        if wire not in named:
            across = "left" if way > 0 else "right"
            at = end + 4 * way, y
            pen.text(at, sheet.scheme.name(wire), color=sheet.wire_color(wire), across=across)
        named.add(wire)


def brake_width(device: Device) -> float:
    """Of a brake, a support or a spring in the row, with its name."""
    if not device.is_coupling:
        return 24.0
    return width_of(wrapped(device.name), bold=True) + BESIDE + 18


def clutch_item(index: int, device: Device, sides: tuple[int, ...]) -> Item:
    """A clutch or a spring, whose wires may come from these sides."""
    width = max(width_of(wrapped(device.name), bold=True) + 14, 34.0)
    one, other = device.members.values()
    variants = [
        [Tap(left, a, 0.0), Tap(right, b, width)]
        for left, right in ((one, other), (other, one))
        for a in sides
        for b in sides
    ]
    return Item(index, [width] * len(variants), variants)


def coupling(pen: Pen, kind: str, ends: tuple[Point, Point], color: str, *, closed: bool) -> None:
    """A shift element or a spring on a level or upright line, from its first link to its second."""
    start, end = ends
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    length = abs(end[0] - start[0]) + abs(end[1] - start[1])
    dx, dy = (end[0] - start[0]) / length, (end[1] - start[1]) / length

    def at(forward: float, across: float) -> Point:
        return middle[0] + forward * dx - across * dy, middle[1] + forward * dy + across * dx

    half = SPLIT.get(kind, 3.0)
    pen.line(start, at(-half, 0), color=color)
    pen.line(at(half, 0), end, color=color)
    if kind == "spring":
        turns = [(half * (step / 4 - 1), 6.0 * (1, -1)[step % 2]) for step in range(1, 8)]
        pen.line(at(-half, 0), *(at(*turn) for turn in turns), at(half, 0), color=color)
        return
    if kind == "freewheel":
        fill = color if closed else pen.style.paper
        pen.shape([at(-half, 6), at(-half, -6), at(half, 0)], fill=fill, edge=color)
        pen.line(at(half, 7), at(half, -7), color=color, width=2.0)
        return
    if closed:
        corners = [at(-half, PLATE), at(half, PLATE), at(half, -PLATE), at(-half, -PLATE)]
        pen.shape(corners, fill=color, edge=color)
    for place in (-half, half):
        pen.line(at(place, PLATE), at(place, -PLATE), color=color, width=2 * LINE)
    if kind == "dog_clutch":
        for side, places in ((-half, (-7.0, 0.0, 7.0)), (half, (-3.5, 3.5))):
            for across in places:  # teeth of the one between teeth of the other
                pen.line(at(side, across), at(-side / 3, across), color=color)


def draw_clutch(sheet: Sheet, index: int) -> None:
    """A clutch or a spring between two links, its name below."""
    device, color = sheet.scheme.devices[index], sheet.color(index)
    closed = index in sheet.state.engaged
    first, second = sorted(sheet.taps(index), key=lambda tap: tap.wire != device.members["first"])
    coupling(sheet.pen, device.kind, ((first.x, 0.0), (second.x, 0.0)), color, closed=closed)
    at = (first.x + second.x) / 2, -13
    sheet.pen.text(at, wrapped(device.name), color=color, up="top", bold=closed)


def draw_brake(sheet: Sheet, index: int) -> None:
    """A brake, a freewheel, a spring or a support at the housing, its name beside it."""
    device, color = sheet.scheme.devices[index], sheet.color(index)
    tap = next(tap for tap in sheet.taps(index) if tap.reach != "row")
    start = sheet.placement.edge(tap.side)
    ends = (tap.x, start), (tap.x, start + tap.side * BAND)
    sheet.pen.ground(ends[1], tap.side, color)
    if not device.is_coupling:
        sheet.pen.line(*ends, color=color)
        return
    closed = index in sheet.state.engaged
    way = ends[::-1] if device.members["first"] == HOUSING else ends
    coupling(sheet.pen, device.kind, (way[0], way[1]), color, closed=closed)
    at = tap.x + BESIDE, (ends[0][1] + ends[1][1]) / 2
    sheet.pen.text(at, wrapped(device.name), color=color, across="left", bold=closed)


def draw_devices(sheet: Sheet, draw_mechanism: Callable[[Sheet, int], None]) -> None:
    """All devices, each by its index."""
    for index, device in enumerate(sheet.scheme.devices):
        if device.is_on_housing:
            draw_brake(sheet, index)
        elif device.is_coupling:
            draw_clutch(sheet, index)
        else:
            draw_mechanism(sheet, index)
