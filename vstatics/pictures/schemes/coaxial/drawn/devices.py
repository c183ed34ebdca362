"""Drawing of gear sets, shift elements, and connections to the housing in a half-section."""

from __future__ import annotations

from vstatics.pictures.drawing.style import SMALL
from vstatics.pictures.schemes.boxes import BoxSection
from vstatics.pictures.schemes.coaxial.drawn.boxes import draw_box, draw_pair_box
from vstatics.pictures.schemes.coaxial.drawn.ports import port_arrow
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import Upright
from vstatics.pictures.schemes.coaxial.rooms import (
    BRAKE_LENGTH,
    SET_NAME,
    middle_of,
    pair_name,
    top_name,
)
from vstatics.pictures.schemes.gear_glyphs import ground, teeth
from vstatics.pictures.schemes.ink import SchemeInk, centred
from vstatics.pictures.schemes.sets import planet_strokes, wheel_taps, wheel_texts

SIGN_NAME = 12.0
"""Distance from the middle of a shift element or shaft to the name. [pt]"""
TOP_NAME = 8.0
"""Distance from the housing to the name of a component at the housing. [pt]"""


def draw_devices(ink: SchemeInk, layout: CoaxialLayout) -> None:
    """Draw all components along the axis."""
    draw = {"set": _set, "pair": _pair, "top": _top}
    for up, at in zip(layout.uprights, layout.places.at, strict=True):
        if up.kind in draw:
            draw[up.kind](ink, layout, up, at)


def _set(ink: SchemeInk, layout: CoaxialLayout, up: Upright, at: float) -> None:
    index = layout.device(up)
    section, taps = layout.section(up), list(wheel_taps(layout.section(up)))
    if isinstance(section, BoxSection):
        draw_box(ink, index, section, at, any(up.left))
        return
    strokes = [*planet_strokes(section), *(teeth(tap.x, tap.y) for tap in taps)]
    ink.draw_strokes(
        index, ((stroke.width, [(at + x, y) for x, y in stroke.points]) for stroke in strokes)
    )
    pen, look = ink.of_device(index).pen, {"color": ink.text_color(index)}
    for (x, y), va, text in wheel_texts(section, taps):
        centred(pen, (at + x, y), text, size=SMALL, ha="left", va=va, over=True, **look)
    name = at + middle_of(section), layout.places.axis - SET_NAME
    centred(pen, name, layout.device_name(index), bold=True, va="top", **look)


def _pair(ink: SchemeInk, layout: CoaxialLayout, up: Upright, at: float) -> None:
    index, heights = layout.device(up), layout.places.heights
    if index in layout.coaxial.texts:
        draw_pair_box(ink, layout, up, at)
        return
    device, middle = ink.scheme.devices[index], layout.middle(up)
    first = up.bars[0].link == next(iter(device.members.values()))
    is_low = first == (heights[up.bars[0]] < heights[up.bars[1]])
    side = layout.half(up) * (1 if is_low else -1)
    ink.draw_sign(index, (at, middle - side), (at, middle + side))
    name = pair_name(device, layout.line_letters)
    ink.name_sign(index, (at + SIGN_NAME, middle), name, ha="left")


def _top(ink: SchemeInk, layout: CoaxialLayout, up: Upright, at: float) -> None:
    """Draw a brake, a support, a fixed member, or a link that passes through the housing."""
    meaning, roof = layout.coaxial.tops[up.index], layout.places.housing
    ends, name_at = ((at, roof - BRAKE_LENGTH), (at, roof)), (at, roof + TOP_NAME)
    if meaning.port:
        port_arrow(ink, meaning.port, ends[0], (0.0, 1.0))
        centred(ink.pen, name_at, top_name(layout, up), va="bottom")
        return
    if meaning.device < 0:
        lines = [ends, *ground((at, roof), 1)]
        ink.of_link("housing").lines(lines, color=ink.pen.style.ink, zorder=4.5)
        return
    index = meaning.device
    ink.draw_sign(index, *ends, 1)
    ink.name_sign(index, name_at, top_name(layout, up), va="bottom")
