"""Found boxes at a glance: mean loss over the largest torque, and stick diagrams."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from matplotlib.figure import Figure

from vstatics.errors import CaseError
from vstatics.extras import require
from vstatics.model.transmission import Transmission
from vstatics.pictures import Format, settings_of, written
from vstatics.pictures.boxes.points import POINTS_SCALE_WIDTH, draw_points
from vstatics.pictures.schemes.bare import bare_stick
from vstatics.pictures.sheet.labels import width, wrapped
from vstatics.pictures.sheet.pen import Pen, blank
from vstatics.pictures.sheet.style import SMALL_NUMBER, Style
from vstatics.pictures.sheet.words import term
from vstatics.summary.contrast import letters
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox, drawn_boxes

A4_WIDTH = 595.0
"""Of the page: A4. [pt]"""
BOXES_MARGIN = 26.0
POINTS_HEIGHT, POINTS_HEIGHT_ALONE = 210.0, 340.0
"""Of the axes, over diagrams or alone. [pt]"""
BOXES_SCALE_HEIGHT = 34.0
"""For the scale. [pt]"""
FAMILIES_WIDTH = 118.0
"""For the families. [pt]"""
BOXES_HEAD_HEIGHT = 40.0
"""For what stands over the axes. [pt]"""
CAPTION_LINE_HEIGHT = 11.0
"""From line to line. [pt]"""
MOST_DRAWN_DIAGRAMS = 8
"""So many diagrams have room on a page."""
DIAGRAMS_SIDE_BY_SIDE = 2
DIAGRAM_GAP = 18.0
"""Between diagrams. [pt]"""
LARGEST_DIAGRAM_SCALE = 0.62
"""Scale of a diagram, at most."""
DIAGRAM_LETTERS = 1.5
"""Size of letters in a diagram over what they would have."""


def render_boxes(listing: BoxListing, form: Format, style: Style) -> list[bytes]:
    """The pages of a picture of found boxes as files.

    Raises
    ------
    CaseError
        If there is no box, or matplotlib is not installed.
    ReadError
        If the case of one that is drawn is none.
    """
    require("plot", "a picture")
    with settings_of(style):
        figures = draw_boxes(listing, style, drawn_boxes(listing, MOST_DRAWN_DIAGRAMS))
    return [written(figure, form, style, "found boxes") for figure in figures]


def render_points(listing: BoxListing, drawn: Sequence[ListedBox]) -> bytes:
    """The points alone as SVG, for a page that has the diagrams of these boxes elsewhere."""
    style = Style(titled=False)
    with settings_of(style):
        figure = _page(listing, drawn, 0.0, POINTS_HEIGHT_ALONE, style).figure
    return written(figure, "svg", style, "found boxes")


def draw_boxes(listing: BoxListing, style: Style, drawn: Sequence[ListedBox]) -> list[Figure]:
    """Points of all boxes over the diagrams of some.

    Raises
    ------
    CaseError
        If there is no box.
    """
    if not drawn:
        raise CaseError("E009", "no box was found, so there is nothing to draw")
    count, gap = DIAGRAMS_SIDE_BY_SIDE, DIAGRAM_GAP
    room = (A4_WIDTH - 2 * BOXES_MARGIN - (count - 1) * gap) / count
    cases = [box.transmission() for box in drawn]
    sticks = [bare_stick(case, style, is_small=True) for case in cases]
    part = min(LARGEST_DIAGRAM_SCALE, *(room / stick.size[0] for stick in sticks))
    captions = [_caption(*both, room, style) for both in zip(drawn, cases, strict=True)]
    heights = [
        stick.size[1] * part + CAPTION_LINE_HEIGHT * (1 + len(lines))
        for stick, lines in zip(sticks, captions, strict=True)
    ]
    rows = [max(heights[at : at + count]) for at in range(0, len(heights), count)]
    page = _page(listing, drawn, sum(rows) + gap * len(rows), POINTS_HEIGHT, style)
    top = sum(rows) + gap * (len(rows) - 1) + BOXES_MARGIN
    for place, (box, stick, lines) in enumerate(zip(drawn, sticks, captions, strict=True)):
        row, column = divmod(place, count)
        x, y = BOXES_MARGIN + column * (room + gap), top - sum(rows[:row]) - gap * row
        family = f"{box.number}   {term('family', style)} {box.family}"
        page.text(x, y, family, bold=True, va="top")
        for line in lines:
            y -= CAPTION_LINE_HEIGHT
            page.text(x, y, line, color=style.soft, size=SMALL_NUMBER, va="top")
        wide, high = (part * length for length in stick.size)
        corner = x + (room - wide) / 2, y - CAPTION_LINE_HEIGHT - high
        stick.drawn(within=page.panel(corner, (wide, high))._replace(letters=DIAGRAM_LETTERS))
    return [page.figure]


def _page(
    listing: BoxListing, drawn: Sequence[ListedBox], below: float, high: float, style: Style
) -> Pen:
    """The points in axes so high, on a page with so much room below them [pt]."""
    low = BOXES_MARGIN + below + BOXES_SCALE_HEIGHT
    page = blank(A4_WIDTH, low + high + BOXES_HEAD_HEIGHT + BOXES_MARGIN, style)
    wide = A4_WIDTH - 2 * BOXES_MARGIN - POINTS_SCALE_WIDTH - FAMILIES_WIDTH
    draw_points(page.panel((BOXES_MARGIN + POINTS_SCALE_WIDTH, low), (wide, high)), listing, drawn)
    return page


def _caption(box: ListedBox, case: Transmission, room: float, style: Style) -> list[str]:
    """What stands over a diagram, below its heading: figures, and the names of its letters."""
    names = [element.name for element in case.shift_elements]
    called = zip(letters(len(names)), names, strict=True)
    figures = (
        (style.text("loss", "потери"), f"{100 * box.loss:.2f} %"),
        (term("torque", style), f"{box.torque:.2f}"),
        (style.text("planets", "сателлиты"), f"{box.planet_speed:.2f}"),
        (style.text("slip", "скольжение"), f"{box.slip:.2f}"),
        (style.text("brakes", "тормоза"), f"{box.brakes}"),
        (style.text("clutches", "муфты"), f"{box.clutches}"),
    )
    texts = (
        ", ".join(f"{name} {number}".replace("nan", "–") for name, number in figures),
        ", ".join(map(" ".join, called)),
    )
    measure = partial(width, size=SMALL_NUMBER)
    return [line for text in texts for line in wrapped(text, room, measure).split("\n")]
