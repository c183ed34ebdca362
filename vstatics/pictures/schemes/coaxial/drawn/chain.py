"""A row of couplings one behind the other on the axis."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from vstatics.pictures.schemes.coaxial.chains import CoaxialChain
from vstatics.pictures.schemes.coaxial.drawn.ports import draw_end
from vstatics.pictures.schemes.coaxial.rooms import PORT_NAME, pair_name
from vstatics.pictures.schemes.glyphs import lines_of
from vstatics.pictures.schemes.ink import ARROW, SchemeInk, centred
from vstatics.pictures.schemes.scheme import Scheme
from vstatics.pictures.schemes.signs import Coupled, draw_coupled, half_of
from vstatics.pictures.sheet.labels import Point, height, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import WIDE_MARGIN

NAME_LETTERS = 11
"""Longer names are broken at blanks."""
CHAIN_GAP = 8.0
"""Between names. [pt]"""
ABOVE_SIGN, BELOW_SIGN = 12.0, 11.0
"""From the axis to names of devices above their signs and of links below. [pt]"""
LEAST_PITCH = 32.0
"""From sign to sign. [pt]"""


def _device_name(scheme: Scheme, index: int) -> str:
    device = scheme.devices[index]
    return pair_name(device, NAME_LETTERS)


def _link_name(scheme: Scheme, link: int) -> str:
    return lines_of(scheme.name(link), NAME_LETTERS)


def places_of(scheme: Scheme, chain: CoaxialChain) -> list[float]:
    """Where its signs stand along the axis [pt]."""
    names = [width(_device_name(scheme, index)) for index in chain.devices]
    between = [width(_link_name(scheme, link)) for link in chain.links[1:-1]]
    pitch = max([LEAST_PITCH, *(long + CHAIN_GAP for long in between)])
    found = [max(names[0], LEAST_PITCH) / 2]
    for one, other in pairwise(names):
        found.append(found[-1] + max(pitch, (one + other) / 2 + CHAIN_GAP))
    return found


def chain_extent(scheme: Scheme, chain: CoaxialChain) -> tuple[Point, Point]:
    """The lower left and the upper right corner of a row [pt]."""
    at = places_of(scheme, chain)
    sides = [
        ARROW + PORT_NAME + 1 + width(scheme.name(link)) + WIDE_MARGIN
        for link in (chain.links[0], chain.links[-1])
    ]
    last = max(width(_device_name(scheme, chain.devices[-1])), LEAST_PITCH) / 2
    above = max(height(_device_name(scheme, index)) for index in chain.devices)
    below = max((height(_link_name(scheme, one)) for one in chain.links[1:-1]), default=0.0)
    return (-sides[0], -BELOW_SIGN - below - 3), (at[-1] + last + sides[1], ABOVE_SIGN + above + 3)


def draw_chain(ink: SchemeInk, chain: CoaxialChain) -> None:
    """Signs on the axis with their names above, links with theirs below."""
    scheme, at = ink.scheme, places_of(ink.scheme, chain)
    half = [half_of(scheme.devices[index].sign) for index in chain.devices]
    end = at[-1] + max(width(_device_name(scheme, chain.devices[-1])), LEAST_PITCH) / 2
    starts = [0.0, *(x + by for x, by in zip(at, half, strict=True))]
    ends = [*(x - by for x, by in zip(at, half, strict=True)), end]
    for link, left, right in zip(chain.links, starts, ends, strict=True):
        is_used = all(_carries(ink, index) for index in _beside(chain, link))
        color = ink.pen.style.ink if is_used else ink.pen.style.faint
        title, pen = ink.titles.links.get(link, ""), ink.of_link(scheme.name(link))
        pen.line((left, 0.0), (right, 0.0), color=color, kind="wire", title=title, zorder=3)
        if link in chain.links[1:-1]:
            name = (left + right) / 2, -BELOW_SIGN
            centred(pen, name, _link_name(scheme, link), va="top", color=ink.name_color(link))
    for index, x, by in zip(chain.devices, at, half, strict=True):
        device, closed = scheme.devices[index], index in ink.state.engaged
        before = chain.links[: list(chain.devices).index(index) + 1]
        way = 1 if next(iter(device.members.values())) in before else -1
        colors = ink.color(index), closed, ink.rod_color(index), 0, ink.said(index)
        pen = ink.of_device(index).pen
        draw_coupled(pen, Coupled(device.sign, (x - way * by, 0.0), (x + way * by, 0.0), *colors))
        look: Look = {"color": ink.text_color(index), "bold": closed, "va": "bottom"}
        centred(pen, (x, ABOVE_SIGN), _device_name(scheme, index), **look)
    draw_end(ink, chain.links[0], (0.0, 0.0), -1.0)
    draw_end(ink, chain.links[-1], (end, 0.0), 1.0)


def _beside(chain: CoaxialChain, link: int) -> Iterator[int]:
    """The devices of a chain that a link joins."""
    place = list(chain.links).index(link)
    yield from chain.devices[max(place - 1, 0) : place + 1]


def _carries(ink: SchemeInk, index: int) -> bool:
    return ink.state.loaded is None or bool(ink.state.loaded[index])
