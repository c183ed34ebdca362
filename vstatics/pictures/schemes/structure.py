"""The structure of a transmission: mechanisms as boxes, links as wires, shift elements between.

This is the form of figure 5b of the source: it serves every case, drawn or not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from matplotlib.figure import Figure

from vstatics.model.transmission import HOUSING
from vstatics.pictures.schemes.board import Board
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, Reach, Tap
from vstatics.pictures.schemes.glyphs import HATCH_WIDTH, ground, hatching, lines_of
from vstatics.pictures.schemes.placing import Placement, placed
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text, scheme_of
from vstatics.pictures.schemes.search import arranged
from vstatics.pictures.schemes.sheet import HEIGHT, Sheet, coupling_item, figures
from vstatics.pictures.sheet.labels import Segment, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import corners
from vstatics.pictures.sheet.style import SMALL, Style
from vstatics.pictures.sheet.words import word
from vstatics.statics.results import Results
from vstatics.tables.numbers import typeset

HALF_BOX = 30.0
"""Half the height of a box. [pt]"""
BOX_NAME_LETTERS = 18
"""The names of boxes are broken at. [letters]"""


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """Mechanisms, links, clutches and brakes, and how they are joined; in the same places in each.

    In the picture of a gear what is engaged is marked, and what turns as one piece; what
    carries no torque is pale.

    Source: figure 5b.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> [[figure]] = each(solve(case), Style(), [()])
    >>> sorted(text.get_text() for text in figure.texts)
    ['1', '2', '3', 'D1', 'Structure', 'T1', 'first', 'second', 'third', 'u = −2']
    """
    scheme, subject = scheme_of(results.case), style.text("structure", "структура")
    drawn = scheme, place(scheme, style), style, draw_box
    yield from figures(results, *drawn, shown=shown, subject=subject)


def place(scheme: Scheme, style: Style) -> Placement:
    """Where everything stands in the picture; the same for all gears of a case."""
    items = [row_item(index, one, (0,), style) for index, one in enumerate(scheme.devices)]
    board = Board(items, range(1, len(scheme.links) + 1), *scheme.ends)
    return placed(board, arranged(board, is_free=True), HALF_BOX, named_on_tracks(scheme))


def named_on_tracks(scheme: Scheme) -> dict[int, float]:
    """Widths of the names of links that reach no end of the picture [pt]."""
    from_left, to_right = scheme.ends
    return {
        link: width(name)
        for link, name in enumerate(scheme.links, 1)
        if link not in from_left and link not in to_right
    }


def row_item(index: int, device: Device, sides: Sequence[int], style: Style) -> Item:
    """A coupling, or a mechanism as a box with its members at the top and at the bottom.

    Parameters
    ----------
    sides : sequence of int
        From which its wires may come; 0 is that where they run.
    """
    if device.is_coupling:
        return coupling_item(index, device, sides)
    slot = max(width(member_text(device, one, style), SMALL) for one in device.members) + 9
    name = width(lines_of(device.name, BOX_NAME_LETTERS), bold=True)
    inner = max(name, width(word(device.kind, style), SMALL), 60.0) + 10
    variants: list[list[Tap]] = [[]]
    for member, link in device.members.items():
        own = (ABOVE, BELOW) if link == HOUSING else sides
        reach: Reach = "none" if link == HOUSING else "row"
        variants = [
            [*variant, Tap(link, side, 0.0, reach, member, HALF_BOX)]
            for variant in variants
            for side in own
        ]
    return Item(index, [inner] * len(variants), variants, slot=slot)


def member_text(device: Device, member: str, style: Style) -> str:
    """What stands in a box beside the wire of a member."""
    return typeset(device.labels[member]) if member in device.labels else word(member, style)


def draw_box(sheet: Sheet, index: int) -> None:
    """A mechanism with its name, a note and its members; hatched if it turns as one piece."""
    device, said = sheet.scheme.devices[index], sheet.titles.devices.get(index, "")
    pen, color, style = sheet.pen, sheet.color(index), sheet.pen.style
    left = sheet.placement.row.lefts[index]
    right = left + sheet.placement.row.widths[index]
    edges = corners(left, -HALF_BOX, right, HALF_BOX)
    is_piece = index in sheet.state.pieces
    look: Look = {"facecolor": style.paper, "edgecolor": color, "joinstyle": "round"}
    pen.area(*edges, width=1.8, title=said, zorder=4, **look)
    if is_piece:
        lines = hatching(edges[0], edges[2])
        pen.lines(lines, color=style.soft, width=HATCH_WIDTH, zorder=5)
    names = lines_of(device.name, BOX_NAME_LETTERS).split("\n")
    middle, y = (left + right) / 2, HEIGHT * len(names) / 2
    look = {"color": sheet.text_color(index), "over": is_piece}
    for line in names:
        sheet.text((middle, y), line, bold=True, **look)
        y -= 0.95 * HEIGHT
    is_bare = device.kind == "mechanism"
    note = ratio_text(device.ratio) if is_bare else word(device.kind, style)
    sheet.text((middle, y), note, size=SMALL, **look)
    grounds: list[Segment] = []
    for tap in sheet.taps(index):
        text = member_text(device, tap.label, style)
        sheet.text((tap.x, tap.side * (HALF_BOX - 8)), text, size=SMALL, **look)
        if tap.reach == "none":
            end = tap.x, tap.side * (HALF_BOX + 8)
            grounds += [((tap.x, tap.side * HALF_BOX), end), *ground(end, tap.side)]
    pen.lines(grounds, color=color, title=said, zorder=3)
