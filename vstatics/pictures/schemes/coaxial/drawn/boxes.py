"""Boxes of components, drawn like gear sets or on lines between two links."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.pen import corners
from vstatics.pictures.schemes.boxes import GROUND, LINE, PAD, BoxSection, BoxText
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import Upright
from vstatics.pictures.schemes.gear_glyphs import HATCH_WIDTH, ground, hatching
from vstatics.pictures.schemes.ink import SchemeInk, centred
from vstatics.pictures.schemes.sets import wheel_taps

BOX_LINE = 1.8
"""Line width of the outline of a box. [pt]"""
Written = tuple[Point, str]
"""Position of the middle of a text, and the text."""


def draw_box(
    ink: SchemeInk,
    index: int,
    section: BoxSection,
    at: float,
    is_left: bool,  # noqa: FBT001 - side of the link
) -> None:
    """Draw a box like a gear set, with the supports of fixed members."""
    (left, right), half, letters = section.faces, section.half, section.letters
    taps = list(wheel_taps(section))
    members: list[Written] = [
        (
            (at + tap.x, tap.side * (half - letters * (PAD + LINE / 2))),
            section.text.members[tap.label],
        )
        for tap in taps
    ]
    way, half_side = (-1 if is_left else 1), letters * width(section.side) / 2
    x = at + (left if is_left else right) - way * (letters * PAD + half_side)
    members.append(((x, 0.0), section.side))
    _outlined(ink, index, ((at + left, -half), (at + right, half)))
    middle = at + (left + right) / 2
    members.append(((middle, -letters * LINE), section.text.note))
    _written(
        ink,
        index,
        section.text.name,
        (middle, letters * LINE * (section.text.lines + 1) / 2),
        members,
    )
    for tap in taps:
        if not tap.wire:
            edge, end = (at + tap.x, tap.side * half), (at + tap.x, tap.side * (half + GROUND / 2))
            support = [(edge, end), *ground(end, tap.side)]
            ink.of_link("housing").lines(support, color=ink.color(index), zorder=4.5)


def draw_pair_box(ink: SchemeInk, layout: CoaxialLayout, up: Upright, at: float) -> None:
    """Draw a box on the line between two links, with the names of members at the edges."""
    index, y = layout.device(up), layout.middle(up)
    text, device = layout.coaxial.texts[index], ink.scheme.devices[index]
    (wide, high), rise = layout.box_size(up), layout.letters * (LINE + PAD) / 2
    low, top = sorted(up.bars, key=layout.places.heights.__getitem__)
    members = [
        ((at, y + side * (high / 2 - rise)), text.at(bar.link, device))
        for bar, side in ((low, -1), (top, 1))
    ]
    _on_line(ink, index, text, (at, y), (wide, high), 0.0, members, layout.letters)


def draw_chain_box(
    ink: SchemeInk, index: int, text: BoxText, at: Point, links: Sequence[int]
) -> None:
    """Draw a box on a horizontal line between two links."""
    (x, y), device = at, ink.scheme.devices[index]
    wide, high = text.on_line(device, is_level=True)
    members = []
    for link, side in zip(links, (-1, 1), strict=True):
        name = text.at(link, device)
        inside = wide / 2 - PAD - width(name) / 2
        members.append(((x + side * inside, y - high / 2 + (LINE + PAD) / 2), name))
    _on_line(ink, index, text, at, (wide, high), LINE / 2, members, 1.0)


def _on_line(  # noqa: PLR0913, PLR0917 - texts and their positions
    ink: SchemeInk,
    index: int,
    text: BoxText,
    middle: Point,
    size: Point,
    shift: float,
    members: Sequence[Written],
    letters: float,
) -> None:
    """Draw a box on a line between two links, with the texts moved up by `shift` [pt]."""
    (x, y), (wide, high) = middle, size
    _outlined(ink, index, ((x - wide / 2, y - high / 2), (x + wide / 2, y + high / 2)))
    y += shift
    note = (x, y - letters * LINE * text.lines / 2), text.note
    _written(ink, index, text.name, (x, y + letters * LINE / 2), [note, *members])


def _outlined(ink: SchemeInk, index: int, ends: tuple[Point, Point]) -> None:
    pen, said = ink.of_device(index).pen, ink.said(index)
    look: Look = {"facecolor": pen.style.paper, "edgecolor": ink.color(index), "joinstyle": "round"}
    edges = corners(*ends[0], *ends[1])
    pen.area(*edges, width=BOX_LINE, title=said, zorder=4, **look)
    if index in ink.state.pieces:
        pen.lines(hatching(*ends), color=pen.style.soft, width=HATCH_WIDTH, zorder=5)


def _written(
    ink: SchemeInk, index: int, name: str, middle: Point, others: Sequence[Written]
) -> None:
    look: Look = {"color": ink.text_color(index), "over": index in ink.state.pieces}
    pen, (x, y) = ink.of_device(index).pen, middle
    lines = name.split("\n")
    step = LINE * pen.letters
    for place, line in enumerate(lines):
        at = x, y + step * ((len(lines) - 1) / 2 - place)
        centred(pen, at, line, bold=True, **look)
    for at, text in others:
        centred(pen, at, text, **look)
