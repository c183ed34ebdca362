"""Pages of found gearboxes: diagram of mean loss versus largest torque, and stick diagrams."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.summary.contrast import letters
from vstatics.core.texts import Language
from vstatics.pictures.drawing.canvas import Canvas, Point
from vstatics.pictures.drawing.files import Format, files_of
from vstatics.pictures.drawing.labels import height, wrapped
from vstatics.pictures.drawing.pen import Pen, blank
from vstatics.pictures.drawing.style import MARGIN, SIZE, SMALL_NUMBER, Style, number
from vstatics.pictures.drawing.svg import written_as_svg
from vstatics.pictures.schemes.bare import BareStick, bare_stick
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox, drawn_boxes
from vstatics.synthesis.pictures.points import (
    POINTS_SCALE_WIDTH,
    draw_points,
    families_width,
    points_words,
    torque_name,
)

POINTS_HEIGHT, POINTS_HEIGHT_ALONE = 170.0, 300.0
"""Height of the diagram with points, above stick diagrams and without stick diagrams. [pt]"""
BOXES_SCALE_HEIGHT = 34.0
"""Height of the numbers and name of the horizontal axis below the points. [pt]"""
CAPTION_LINE_HEIGHT = 11.0
"""Distance between lines of a caption. [pt]"""
MOST_DRAWN_DIAGRAMS = 8
"""Largest number of stick diagrams in a picture."""
DIAGRAMS_SIDE_BY_SIDE = 2
DIAGRAM_GAP = 16.0
"""Distance between stick diagrams. [pt]"""
LARGEST_DIAGRAM_SCALE = 0.62
"""Largest scale of a stick diagram, drawn size to full size. [-]"""


class BoxCell(NamedTuple):
    """Stick diagram of a gearbox with heading and caption; lengths in points."""

    heading: str
    caption: Sequence[str]
    stick: BareStick
    part: float
    """Scale of the stick diagram, drawn size to full size. [-]"""

    @property
    def size(self) -> Point:
        """Width and height with heading and caption."""
        wide, high = (self.part * length for length in self.stick.size)
        return wide, high + CAPTION_LINE_HEIGHT * (1 + len(self.caption)) + DIAGRAM_GAP

    def draw(self, page: Pen, x: float, top: float, room: float) -> None:
        """Draw the cell below (x, top) in points, with the diagram centred in the width `room`."""
        page.text(x, top, self.heading, bold=True, va="top")
        y = top
        for line in self.caption:
            y -= CAPTION_LINE_HEIGHT
            page.text(x, y, line, color=page.style.soft, va="top")
        wide, high = (self.part * length for length in self.stick.size)
        corner = x + (room - wide) / 2, y - CAPTION_LINE_HEIGHT - high
        pen = page.panel(corner, (wide, high))
        self.stick.draw(pen._replace(letters=SMALL_NUMBER / (SIZE * self.part)))


def render_boxes(listing: BoxListing, form: Format, style: Style) -> list[bytes]:
    """Draw found gearboxes, and return the pages of the picture in a file format.

    Raises
    ------
    CaseError
        If the list is empty, or matplotlib is not installed.
    ReadError
        If the case of a drawn gearbox is not valid.
    """
    require("plot", "a picture")
    drawn = draw_boxes(listing, style, drawn_boxes(listing, MOST_DRAWN_DIAGRAMS))
    return files_of(drawn, form, "found boxes")


def render_points(
    listing: BoxListing, drawn: Sequence[ListedBox], language: Language = "en"
) -> bytes:
    """Draw only the diagram with points as SVG, for an HTML page that shows the stick diagrams."""
    style = Style(language, titled=False)
    page = _page(listing, drawn, 0.0, POINTS_HEIGHT_ALONE, style).canvas
    return written_as_svg(page, "found boxes")


def draw_boxes(listing: BoxListing, style: Style, drawn: Sequence[ListedBox]) -> list[Canvas]:
    """Draw the points of all gearboxes above the stick diagrams of some, on several pages.

    Raises
    ------
    CaseError
        If the list is empty.
    """
    if not drawn:
        raise CaseError("E009", "no gearbox was found, so there is nothing to draw")
    count = DIAGRAMS_SIDE_BY_SIDE
    room = (style.width - 2 * MARGIN - (count - 1) * DIAGRAM_GAP) / count
    cells = [_cell(box, room, style) for box in drawn]
    rows = [cells[at : at + count] for at in range(0, len(cells), count)]
    high = [max(cell.size[1] for cell in row) for row in rows]
    over = _page(listing, drawn, 0.0, POINTS_HEIGHT, style).canvas.size[1]
    figures: list[Canvas] = []
    while rows:
        above = 2 * MARGIN if figures else over
        fit = sum(total + above <= style.height for total in accumulate(high)) or int(bool(figures))
        below = sum(high[:fit])
        page = (
            blank(style.width, below + 2 * MARGIN, style)
            if figures
            else _page(listing, drawn, below, POINTS_HEIGHT, style)
        )
        top = below + MARGIN
        for row, tall in zip(rows[:fit], high[:fit], strict=True):
            for column, cell in enumerate(row):
                cell.draw(page, MARGIN + column * (room + DIAGRAM_GAP), top, room)
            top -= tall
        figures.append(page.canvas)
        rows, high = rows[fit:], high[fit:]
    return figures


def _cell(box: ListedBox, room: float, style: Style) -> BoxCell:
    case = box.transmission()
    stick = bare_stick(case, style, is_small=True)
    part = min(LARGEST_DIAGRAM_SCALE, room / stick.size[0])
    heading = f"{box.number}   {style.text('family')} {box.family}"
    return BoxCell(heading, _caption(box, case, room, style), stick, part)


def _page(
    listing: BoxListing, drawn: Sequence[ListedBox], below: float, high: float, style: Style
) -> Pen:
    """Draw the points in axes of a height, on a page with room for diagrams below [pt]."""
    families = families_width(listing, drawn, style)
    wide = style.width - 2 * MARGIN - POINTS_SCALE_WIDTH - families
    low = MARGIN + below + BOXES_SCALE_HEIGHT + height(torque_name(wide, style)) - height("")
    words = points_words(listing, style.width - 2 * MARGIN, style, has_more=True)
    page = blank(style.width, low + high + words.high + MARGIN, style)
    pen = page.panel((MARGIN + POINTS_SCALE_WIDTH, low), (wide, high))
    draw_points(pen, listing, drawn)
    return page


def _caption(box: ListedBox, case: Transmission, room: float, style: Style) -> list[str]:
    names = [element.name for element in case.shift_elements]
    named_letters = zip(letters(len(names)), names, strict=True)
    ratios = {name: gear.ratio for name, gear in box.gears.items()}
    ratio_texts = [f"{name}: {number(ratio)}" for name, ratio in ratios.items()]
    forward = [ratio for ratio in ratios.values() if ratio > 0]
    spread = [f"{style.text('spread')} {number(max(forward) / min(forward))}"] * (len(forward) > 1)
    figures = (
        (style.text("loss"), f"{100 * box.loss:.2f} %"),
        (style.text("torque"), f"{box.torque:.2f}"),
        (style.text("planets"), f"{box.planet_speed:.2f}"),
        (style.text("slip"), f"{box.slip:.2f}"),
        (style.text("brakes"), f"{box.brakes}"),
        (style.text("clutches"), f"{box.clutches}"),
    )
    texts = (
        "; ".join([", ".join(ratio_texts), *spread]),
        ", ".join(f"{name} {value}".replace("nan", "–") for name, value in figures),
        ", ".join(map(" ".join, named_letters)),
    )
    return [line for text in texts for line in wrapped(text, room).split("\n")]
