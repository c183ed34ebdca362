"""Row of components in series on the axis, before or after the gearbox."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.schemes.boxes import BoxText
from vstatics.pictures.schemes.coaxial.chains import CoaxialChain
from vstatics.pictures.schemes.coaxial.drawn.boxes import draw_chain_box
from vstatics.pictures.schemes.coaxial.drawn.ports import draw_end
from vstatics.pictures.schemes.coaxial.rooms import PORT_NAME, pair_name
from vstatics.pictures.schemes.gear_glyphs import lines_of
from vstatics.pictures.schemes.ink import ARROW, SchemeInk, centred
from vstatics.pictures.schemes.scheme import Scheme
from vstatics.pictures.schemes.shift_element_symbols import half_of

Texts = Mapping[int, BoxText]
"""Texts of boxes, by the index of the component in the scheme."""
CHAIN_NAME_LETTERS = 11
"""Number of letters above which a name is broken at a blank."""
CHAIN_NAME_GAP = 8.0
"""Distance between neighbouring names. [pt]"""
ABOVE_SIGN, BELOW_SIGN = 12.0, 11.0
"""Distances from the axis up to names of components, and down to names of links. [pt]"""
LEAST_PITCH = 32.0
"""Smallest distance between neighbouring symbols. [pt]"""


def _device_name(scheme: Scheme, index: int) -> str:
    device = scheme.devices[index]
    return pair_name(device, CHAIN_NAME_LETTERS)


def _link_name(scheme: Scheme, link: int) -> str:
    return lines_of(scheme.name(link), CHAIN_NAME_LETTERS)


def _sizes(scheme: Scheme, chain: CoaxialChain, texts: Texts) -> list[Point]:
    """Return for each symbol the width of the name or text, and the height above the axis [pt]."""
    sizes = []
    for index in chain.devices:
        if index in texts:
            wide, high = texts[index].on_line(scheme.devices[index], is_level=True)
            sizes.append((wide, high / 2))
        else:
            name = _device_name(scheme, index)
            sizes.append((width(name), ABOVE_SIGN + height(name)))
    return sizes


def places_of(scheme: Scheme, chain: CoaxialChain, texts: Texts) -> list[float]:
    """Return the position of each symbol along the axis [pt]."""
    names = [wide for wide, _ in _sizes(scheme, chain, texts)]
    between = [width(_link_name(scheme, link)) for link in chain.links[1:-1]]
    room = max((long + CHAIN_NAME_GAP for long in between), default=0.0)
    pitch = max(LEAST_PITCH, room)
    positions = [max(names[0], LEAST_PITCH) / 2]
    for left_width, right_width in pairwise(names):
        least = (left_width + right_width) / 2 + (room if texts else CHAIN_NAME_GAP)
        positions.append(positions[-1] + max(pitch, least))
    return positions


def chain_extent(scheme: Scheme, chain: CoaxialChain, texts: Texts) -> tuple[Point, Point]:
    """Return the lower left and the upper right corner of a row [pt]."""
    at, sizes = places_of(scheme, chain, texts), _sizes(scheme, chain, texts)
    sides = [
        ARROW + PORT_NAME + 1 + width(scheme.name(link)) + WIDE_MARGIN
        for link in (chain.links[0], chain.links[-1])
    ]
    last = max(sizes[-1][0], LEAST_PITCH) / 2
    above = max(high for _, high in sizes)
    below = max((height(_link_name(scheme, link)) for link in chain.links[1:-1]), default=0.0)
    low = max(BELOW_SIGN + below, above * bool(texts))
    return (-sides[0], -low - 3), (at[-1] + last + sides[1], above + 3)


def draw_chain(ink: SchemeInk, chain: CoaxialChain, texts: Texts) -> None:
    """Draw the symbols on the axis, with names of components above and of links below."""
    scheme, at = ink.scheme, places_of(ink.scheme, chain, texts)
    sizes = _sizes(scheme, chain, texts)
    half = [
        wide / 2 if index in texts else half_of(scheme.devices[index].sign)
        for index, (wide, _) in zip(chain.devices, sizes, strict=True)
    ]
    end = at[-1] + max(sizes[-1][0], LEAST_PITCH) / 2 + CHAIN_NAME_GAP * bool(texts)
    starts = [0.0, *(x + by for x, by in zip(at, half, strict=True))]
    ends = [*(x - by for x, by in zip(at, half, strict=True)), end]
    loaded = ink.state.loaded
    for place, (link, left, right) in enumerate(zip(chain.links, starts, ends, strict=True)):
        neighbours = chain.devices[max(place - 1, 0) : place + 1]
        is_used = loaded is None or all(loaded[index] for index in neighbours)
        color = ink.pen.style.ink if is_used else ink.pen.style.faint
        title, pen = ink.titles.links.get(link, ""), ink.of_link(scheme.name(link))
        pen.line((left, 0.0), (right, 0.0), color=color, kind="wire", title=title, zorder=3)
        if link in chain.links[1:-1]:
            name = (left + right) / 2, -BELOW_SIGN
            centred(pen, name, _link_name(scheme, link), va="top", color=ink.name_color(link))
    for place, (index, x, by) in enumerate(zip(chain.devices, at, half, strict=True)):
        if index in texts:
            draw_chain_box(ink, index, texts[index], (x, 0.0), chain.links[place : place + 2])
            continue
        first = next(iter(scheme.devices[index].members.values()))
        side = by if first in chain.links[: place + 1] else -by
        ink.draw_sign(index, (x - side, 0.0), (x + side, 0.0))
        ink.name_sign(index, (x, ABOVE_SIGN), _device_name(scheme, index), va="bottom")
    draw_end(ink, chain.links[0], (0.0, 0.0), -1.0)
    draw_end(ink, chain.links[-1], (end, 0.0), 1.0)
