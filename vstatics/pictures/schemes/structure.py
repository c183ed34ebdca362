"""The structure of a transmission: mechanisms as boxes, links as wires, shift elements between.

This is the form of figure 5b of the source: it serves every case, drawn or not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise

from matplotlib.figure import Figure

from vstatics.model.transmission import HOUSING
from vstatics.pictures.schemes.board import Board
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, Reach, Tap
from vstatics.pictures.schemes.glyphs import HATCH_WIDTH, ground, hatching, lines_of
from vstatics.pictures.schemes.ink import FURTHER
from vstatics.pictures.schemes.placing import Placement, placed
from vstatics.pictures.schemes.rows import SchemeRow, rows_of
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text, scheme_of
from vstatics.pictures.schemes.search import arranged
from vstatics.pictures.schemes.sheet import HEIGHT, Sheet, coupling_item, extent, wired
from vstatics.pictures.schemes.signs import meanings
from vstatics.pictures.schemes.told import SchemeTold, told_of
from vstatics.pictures.sheet.head import SheetHead, sheet_head
from vstatics.pictures.sheet.labels import Point, Segment, title_width, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import corners
from vstatics.pictures.sheet.style import WIDE_MARGIN, Style
from vstatics.pictures.sheet.words import word
from vstatics.statics.results import Results
from vstatics.tables.numbers import typeset

HALF_BOX = 30.0
"""Half the height of a box. [pt]"""
BOX_NAME_LETTERS = 18
"""The names of boxes are broken at. [letters]"""
LEAST_BOX = 40.0
"""The width of a box with a short name, without its margins. [pt]"""
BOX_GAP = 12.0
"""Between boxes, where nothing else is told. [pt]"""
ROW_GAP = 10.0
"""Between rows. [pt]"""


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
    scheme, subject = scheme_of(results.case), style.text("structure")
    made = rows(scheme, style)
    for gears in shown:
        told = told_of(results, scheme, style, gears, subject=subject)
        cuts = _pages(made, told, style)
        yield [_page(made[start:end], told, made, style) for start, end in cuts]


def rows(scheme: Scheme, style: Style) -> list[SchemeRow]:
    """What stands in each row; the same for all gears of a case.

    >>> from vstatics import Gear, Mechanism, Transmission
    >>> pairs = [Mechanism(link, link + 1, 0, -2) for link in range(1, 4)]
    >>> found = rows(scheme_of(Transmission(4, [], pairs, [Gear()])), Style(width=200))
    >>> [[device.name for device in row.scheme.devices] for row in found]
    [['D1'], ['D2'], ['D3']]
    >>> [(port.link, port.role) for port in found[1].scheme.ports]
    [(2, 'before'), (3, 'behind')]
    """
    return rows_of(scheme, partial(place, style=style), _wide, style.width)


def _wide(scheme: Scheme, placement: Placement) -> float:
    """The width of a row with what leaves it at both ends [pt]."""
    low, high = extent(scheme, placement)
    return high[0] - low[0]


def _size(row: SchemeRow) -> Point:
    low, high = extent(row.scheme, row.placement)
    return high[0] - low[0], high[1] - low[1]


def _head(told: SchemeTold, rows: Sequence[SchemeRow], style: Style) -> tuple[float, SheetHead]:
    """The width of the pages, and what stands over each."""
    least = title_width(told.name) + 2 * WIDE_MARGIN if style.titled else 0.0
    wide = max(*(_size(row)[0] for row in rows), min(least, style.width))
    look = {"color": style.ink, "linestyle": FURTHER}
    further = len(rows) > 1, "goes on in another row", look
    signs = [*meanings(told.state, style), further]
    return wide, sheet_head(told.name, told.note, signs, wide - 2 * WIDE_MARGIN, style)


def _pages(rows: Sequence[SchemeRow], told: SchemeTold, style: Style) -> list[tuple[int, int]]:
    """The first row of each page, and that after its last one."""
    _, head = _head(told, rows, style)
    cuts, high = [0], 0.0
    for number, row in enumerate(rows):
        own = _size(row)[1] + ROW_GAP
        if number > cuts[-1] and high + own > style.height - head.high - 2 * WIDE_MARGIN:
            cuts.append(number)
            high = 0.0
        high += own
    return list(pairwise([*cuts, len(rows)]))


def _page(
    shown: Sequence[SchemeRow], told: SchemeTold, rows: Sequence[SchemeRow], style: Style
) -> Figure:
    """Some rows, one below the other."""
    wide, head = _head(told, rows, style)
    y = sum(_size(row)[1] + ROW_GAP for row in shown) - ROW_GAP
    page = head.over((wide, y), WIDE_MARGIN * bool(head.high), style)
    for row in shown:
        size = _size(row)
        y -= size[1]
        wired(
            row.scheme,
            row.placement,
            draw_box,
            row.state(told.state),
            titles=row.titles(told.titles),
            within=page.panel((0.0, y), size),
        )
        y -= ROW_GAP
    return page.figure


def place(scheme: Scheme, style: Style) -> Placement:
    """Where everything stands in one row; the same for all gears of a case."""
    items = [row_item(index, one, style) for index, one in enumerate(scheme.devices)]
    board = Board(items, scheme.wires, *scheme.ends, gap=BOX_GAP)
    return placed(board, arranged(board), HALF_BOX, named_on_tracks(scheme))


def named_on_tracks(scheme: Scheme) -> dict[int, float]:
    """Widths of the names of links that reach no end of the picture [pt]."""
    at_ends = {link for own in scheme.ends for link in own}
    return {link: width(scheme.name(link)) for link in scheme.wires if link not in at_ends}


def row_item(index: int, device: Device, style: Style) -> Item:
    """A coupling, or a mechanism as a box with its members at the top and at the bottom."""
    if device.is_coupling:
        return coupling_item(index, device)
    slot = max(width(member_text(device, one, style)) for one in device.members) + 9
    name = width(lines_of(device.name, BOX_NAME_LETTERS), bold=True)
    inner = max(name, width(word(device.kind, style)), LEAST_BOX) + 10
    variants: list[list[Tap]] = [[]]
    for member, link in device.members.items():
        own = (ABOVE, BELOW) if link == HOUSING else (0,)
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
    device, said = sheet.scheme.devices[index], sheet.said(index)
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
    sheet.text((middle, y), note, **look)
    grounds: list[Segment] = []
    for tap in sheet.taps(index):
        text = member_text(device, tap.label, style)
        sheet.text((tap.x, tap.side * (HALF_BOX - 8)), text, **look)
        if tap.reach == "none":
            end = tap.x, tap.side * (HALF_BOX + 8)
            grounds += [((tap.x, tap.side * HALF_BOX), end), *ground(end, tap.side)]
    pen.lines(grounds, color=color, title=said, zorder=3)
