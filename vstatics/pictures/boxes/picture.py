"""Found boxes at a glance: mean loss over the largest torque, and stick diagrams."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.extras import require
from vstatics.model.transmission import Transmission
from vstatics.pictures import Format, settings_of, written
from vstatics.pictures.boxes.points import LEFT, box_chart, draw_points, draw_words
from vstatics.pictures.schemes.bare import BareStick, bare_stick
from vstatics.pictures.schemes.pen import Window
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.labels import Paper, Point
from vstatics.pictures.sheet.style import SIZE, Style
from vstatics.summary.contrast import letters
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox, drawn_boxes

A4_WIDTH = 595.0
"""Of the page: A4. [pt]"""
BOXES_MARGIN = 26.0
HIGH, ALONE = 210.0, 340.0
"""Of the axes, over diagrams or alone. [pt]"""
BOXES_SCALE_HEIGHT = 34.0
"""For the scale. [pt]"""
FAMILIES_WIDTH = 118.0
"""For the families. [pt]"""
BOXES_HEAD_HEIGHT = 40.0
"""For what stands over the axes. [pt]"""
LINE, SMALL = 11.0, 6.5
"""From line to line; the letters below the name of a diagram. [pt]"""
MOST_DRAWN_DIAGRAMS = 8
"""So many diagrams have room on a page."""
COLUMNS = 2
DIAGRAM_GAP = 18.0
"""Between diagrams. [pt]"""
LARGEST_DIAGRAM_SCALE = 0.62
"""Scale of a diagram, at most."""
DIAGRAM_LETTERS = 1.5
"""Size of letters in a diagram over what they would have."""


def render_boxes(listing: BoxListing, form: Format, style: Style) -> bytes:
    """The picture of found boxes as a file.

    Raises
    ------
    CaseError
        If there is no box, or matplotlib is not installed.
    ReadError
        If the case of one that is drawn is none.
    """
    require("plot", "a picture")
    with settings_of(style):
        figure = draw_boxes(listing, style, drawn_boxes(listing, MOST_DRAWN_DIAGRAMS))
    return written(figure, form, style, "found boxes")


def render_points(listing: BoxListing, drawn: Sequence[ListedBox]) -> bytes:
    """The points alone as SVG, for a page that has the diagrams of these boxes elsewhere."""
    style = Style(titled=False)
    with settings_of(style):
        figure = _paper(listing, drawn, 0.0, ALONE, style)
    return written(figure, "svg", style, "found boxes")


def draw_boxes(listing: BoxListing, style: Style, drawn: Sequence[ListedBox]) -> Figure:
    """Points of all boxes over the diagrams of some.

    Raises
    ------
    CaseError
        If there is no box.
    """
    if not drawn:
        raise CaseError([Problem("no box was found, so there is nothing to draw")])
    room = (A4_WIDTH - 2 * BOXES_MARGIN - (COLUMNS - 1) * DIAGRAM_GAP) / COLUMNS
    cases = [box.transmission() for box in drawn]
    sticks = [bare_stick(case, style, is_small=True) for case in cases]
    scale = min(LARGEST_DIAGRAM_SCALE, *(room / stick.size[0] for stick in sticks))
    captions = [_caption(*both, room, style) for both in zip(drawn, cases, strict=True)]
    rows = _rows(sticks, captions, scale)
    figure = _paper(listing, drawn, sum(rows) + DIAGRAM_GAP * len(rows), HIGH, style)
    top = sum(rows) + DIAGRAM_GAP * (len(rows) - 1) + BOXES_MARGIN
    for number, high in enumerate(rows):
        for column in range(COLUMNS):
            place = number * COLUMNS + column
            if place < len(drawn):
                at = BOXES_MARGIN + column * (room + DIAGRAM_GAP), top
                below = _write(figure, at, captions[place], style)
                size = sticks[place].size[0] * scale, sticks[place].size[1] * scale
                corner = at[0] + (room - size[0]) / 2, below - size[1]
                sticks[place].drawn(within=Window(figure, corner, size, DIAGRAM_LETTERS))
        top -= high + DIAGRAM_GAP
    return figure


def _paper(
    listing: BoxListing, drawn: Sequence[ListedBox], below: float, high: float, style: Style
) -> Figure:
    """The points in axes so high, on a page with so much room below them [pt]."""
    low = BOXES_MARGIN + below + BOXES_SCALE_HEIGHT
    figure = labels.figure(A4_WIDTH, low + high + BOXES_HEAD_HEIGHT + BOXES_MARGIN)
    wide = A4_WIDTH - 2 * BOXES_MARGIN - LEFT - FAMILIES_WIDTH
    chart = box_chart(Paper(figure), (BOXES_MARGIN + LEFT, low), (wide, high), listing)
    has_more = draw_points(chart, listing, drawn, style)
    draw_words(chart, listing, drawn, style, has_more=has_more)
    return figure


Caption = list[str]
"""Lines, of which the first is a heading."""


def _rows(sticks: Sequence[BareStick], captions: Sequence[Caption], scale: float) -> list[float]:
    """Heights of the rows of diagrams [pt]."""
    heights = [
        stick.size[1] * scale + LINE * len(lines)
        for stick, lines in zip(sticks, captions, strict=True)
    ]
    return [max(heights[at : at + COLUMNS]) for at in range(0, len(heights), COLUMNS)]


def _caption(box: ListedBox, case: Transmission, room: float, style: Style) -> Caption:
    """What stands over a diagram."""
    names = [element.name for element in case.shift_elements]
    called = zip(letters(len(names)), names, strict=True)
    lines = [
        _figures(box, style),
        ", ".join(f"{letter} {name}" for letter, name in called),
    ]
    wrapped = [line for text in lines for line in labels.wrapped(text, room, SMALL).split("\n")]
    return [f"{box.number}   {style.text('family', 'семейство')} {box.family}", *wrapped]


def _figures(box: ListedBox, style: Style) -> str:
    """The figures of a box in a line."""
    said = (
        (style.text("loss", "потери"), f"{100 * box.loss:.2f} %"),
        (style.text("torque", "момент"), f"{box.torque:.2f}"),
        (style.text("planets", "сателлиты"), f"{box.planet_speed:.2f}"),
        (style.text("slip", "скольжение"), f"{box.slip:.2f}"),
        (style.text("brakes", "тормоза"), f"{box.brakes}"),
        (style.text("clutches", "муфты"), f"{box.clutches}"),
    )
    return ", ".join(f"{name} {number}".replace("nan", "–") for name, number in said)


def _write(figure: Figure, at: Point, lines: Caption, style: Style) -> float:
    """Write a caption; where it ends [pt]."""
    wide, high = (labels.POINTS_PER_INCH * length for length in figure.get_size_inches())
    (x, y), (title, *others) = at, lines
    figure.text(x / wide, y / high, title, fontsize=SIZE, weight="bold", ha="left", va="top")
    for line in others:
        y -= LINE
        place = x / wide, y / high
        figure.text(*place, line, color=style.soft, fontsize=SMALL, ha="left", va="top")
    return y - LINE
