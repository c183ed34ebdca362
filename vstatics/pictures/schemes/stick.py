"""The stick diagram: the half of the transmission above its axis, wheels as lines of teeth.

Elements stand side by side in the order of the case. Shafts run below them, near the
axis, drums above them; brakes reach to the housing at the top.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.elements.drawing import drawing_of
from vstatics.elements.group import group_of
from vstatics.elements.kinds import Planetary
from vstatics.errors import CaseError, Problem
from vstatics.pictures.schemes.board import GAP, Board
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, Tap
from vstatics.pictures.schemes.glyphs import Glyph
from vstatics.pictures.schemes.pairs import pair_glyphs
from vstatics.pictures.schemes.pen import SMALL, width_of, wrapped
from vstatics.pictures.schemes.placing import Placement, placed
from vstatics.pictures.schemes.scheme import Device, Scheme, scheme_of
from vstatics.pictures.schemes.search import arranged
from vstatics.pictures.schemes.sets import set_glyphs
from vstatics.pictures.schemes.sheet import (
    HEIGHT,
    TERMINAL,
    Sheet,
    brake_width,
    clutch_item,
    draw_devices,
    sheet_of,
)
from vstatics.pictures.schemes.structure import box_item, draw_box, named_on_tracks
from vstatics.pictures.style import Style
from vstatics.pictures.words import word
from vstatics.statics.results import Results

LEAST_HALF = 36.0
"""Half the height of the row, at least. [pt]"""
BRIDGE = 6.0
"""Width of a wall that joins a shaft to a drum. [pt]"""
BESIDE = 7.0
"""From the name of an element to its drawing. [pt]"""
CLOSE = 9.0
"""Between what stands in the row of a small diagram. [pt]"""


class StickLayout(NamedTuple):
    """The elements with the ways in which they can be drawn, and where all stands."""

    placement: Placement
    glyphs: Mapping[int, list[Glyph]]

    def glyph(self, index: int) -> Glyph:
        """How an element is drawn."""
        return self.glyphs[index][self.placement.arrangement.variants[index]]


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """The stick diagram of a case that is made of elements.

    In the picture of a gear what is engaged is marked, what is idle is pale.

    Raises
    ------
    CaseError
        If the case has mechanisms only: what their wheels are is not known.
    """
    case = results.case
    drawing = drawing_of(case)
    if drawing is None or not drawing.elements:
        message = (
            "a stick diagram needs elements with their kinds (docs/elements.md); "
            "this case has mechanisms only: take the picture `structure`, or find teeth for it "
            "(vstatics synth teeth CASE --write FILE)"
        )
        raise CaseError([Problem(message)])
    scheme = scheme_of(case)
    layout = place(scheme, style)
    sheet = sheet_of(results, scheme, layout.placement, style, gears)
    if all(_is_coaxial(device) for device in scheme.devices):
        axis(sheet)
    draw_devices(sheet, partial(draw_mechanism, layout))
    return sheet.pen.figure


def place(
    scheme: Scheme,
    style: Style,
    glyphs: Mapping[int, list[Glyph]] | None = None,
    *,
    is_small: bool = False,
    is_quick: bool = False,
) -> StickLayout:
    """Where everything stands in the picture; the same for all gears of a case.

    Parameters
    ----------
    glyphs : mapping of int to list of Glyph, optional
        All ways to draw what is no box, by its index; those of the elements if not given.
    is_small : bool
        It stands beside others: it is narrow, and links have no names but those at the ends.
    is_quick : bool
        It is one of many; elements stand in any order.
    """
    if glyphs is None:
        glyphs = {
            index: glyphs_of(device)
            for index, device in enumerate(scheme.devices)
            if device.element is not None and not device.is_on_housing
        }
    items = [
        _element_item(index, device, glyphs[index], style, None if is_quick else index)
        if index in glyphs
        else _item(index, device, style)
        for index, device in enumerate(scheme.devices)
    ]
    wires = range(1, len(scheme.links) + 1)
    for wire in wires:
        wall = [Tap(wire, ABOVE, BRIDGE / 2), Tap(wire, BELOW, BRIDGE / 2)]
        items.append(Item(len(items), [BRIDGE], [wall], bridge=wire))
    board = Board(items, wires, *scheme.ends, CLOSE if is_small else GAP)
    arrangement = arranged(board, is_free=False, is_quick=is_quick)
    half = max([LEAST_HALF, *(glyph.half + 8 for ways in glyphs.values() for glyph in ways)])
    names = {} if is_small else named_on_tracks(scheme)
    return StickLayout(placed(board, arrangement, half, names), glyphs)


def glyphs_of(device: Device) -> list[Glyph]:
    """All ways in which an element can be drawn."""
    element = device.element
    if element is None:
        return []
    if isinstance(element.shape, Planetary):
        return set_glyphs(group_of(element))
    return pair_glyphs(element)


def _is_coaxial(device: Device) -> bool:
    """Whether all its links turn about one axis, as far as is told."""
    element = device.element
    return element is None or isinstance(element.shape, Planetary) or device.kind == "held"


def axis(sheet: Sheet) -> None:
    """The line about which all turns."""
    y = sheet.placement.edge(BELOW) + 4
    ends = (-TERMINAL, y), (sheet.placement.row.width + TERMINAL, y)
    dashes = (0, (12, 3, 2, 3))
    sheet.pen.line(*ends, color=sheet.pen.style.faint, width=0.8, linestyle=dashes)


def _names(device: Device, style: Style) -> tuple[str, str]:
    """The name of an element, and its kind if that cannot be seen from its planets."""
    element = device.element
    is_set = element is None or isinstance(element.shape, Planetary)
    return wrapped(device.name), "" if is_set else word(device.kind, style)


def _element_item(
    index: int, device: Device, glyphs: list[Glyph], style: Style, rank: int | None
) -> Item:
    name, kind = _names(device, style)
    label = max(width_of(name, bold=True), width_of(kind, SMALL)) + BESIDE
    variants = [[tap._replace(x=tap.x + label) for tap in glyph.taps] for glyph in glyphs]
    return Item(index, [glyph.width + label for glyph in glyphs], variants, rank=rank)


def _item(index: int, device: Device, style: Style) -> Item:
    """A shift element, a support, a spring, or a mechanism that is given as such."""
    if device.is_on_housing:
        (link,) = device.links
        drum = [Tap(link, ABOVE, 12.0, "edge")]
        shaft = [Tap(link, BELOW, 12.0), Tap(link, ABOVE, 12.0, "pass")]
        return Item(index, [brake_width(device)] * 2, [drum, shaft])
    if device.is_coupling:
        return clutch_item(index, device, (ABOVE, BELOW))
    return replace(box_item(index, device, (ABOVE, BELOW), style), rank=index)


def draw_mechanism(layout: StickLayout, sheet: Sheet, index: int) -> None:
    """An element with its name; a box, where its wheels are not known."""
    if index not in layout.glyphs:
        draw_box(sheet, index)
        return
    pen, color, placement = sheet.pen, sheet.color(index), sheet.placement
    device, glyph = sheet.scheme.devices[index], layout.glyph(index)
    left = placement.row.lefts[index]
    start = left + placement.row.widths[index] - glyph.width
    for stroke in glyph.strokes:
        points = [(start + x, y) for x, y in stroke.points]
        style = (0, (2.5, 1.5)) if stroke.dashed else "-"
        pen.line(*points, color=color, width=stroke.width, zorder=4, linestyle=style)
    for tap in sheet.taps(index):
        if tap.reach == "none":
            end = tap.x, tap.side * (placement.half + 4)
            pen.line((tap.x, tap.y), end, color=color)
            pen.ground(end, tap.side, color)
    name, kind = _names(device, pen.style)
    x, y = start - BESIDE, placement.half - 2
    pen.text((x, y), name, color=color, across="right", up="top", bold=True)
    y -= HEIGHT * (name.count("\n") + 1)
    pen.text((x, y), kind, color=color, size=SMALL, across="right", up="top")
