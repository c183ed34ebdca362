"""Pages of the stick diagram of a gearbox with several axes, without a gear or in gears."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.head import sheet_head
from vstatics.pictures.drawing.style import WIDE_MARGIN, Style
from vstatics.pictures.schemes.axes.drawn.links import AxesSheet, draw_ends, draw_links
from vstatics.pictures.schemes.axes.drawn.marks import draw_station
from vstatics.pictures.schemes.axes.drawn.wheels import draw_pair
from vstatics.pictures.schemes.axes.fitting import placed
from vstatics.pictures.schemes.axes.letters.extent import AxesLetters
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.wires import crossings, link_lines, wheel_crossings
from vstatics.pictures.schemes.captions import told_of
from vstatics.pictures.schemes.coaxial.drawn.lines import wires_of
from vstatics.pictures.schemes.coaxial.picture import crossings_told, order_told
from vstatics.pictures.schemes.planetary import sections_of
from vstatics.pictures.schemes.scheme import Scheme
from vstatics.pictures.schemes.shift_element_symbols import meanings


def figures(
    results: Results,
    scheme: Scheme,
    axes: ParallelAxes,
    style: Style,
    shown: Iterable[Sequence[int]],
) -> Iterator[list[Canvas]]:
    """Yield the pages without a gear, or of gears by number from 1, with equal positions.

    Raises
    ------
    CaseError
        If a figure has several gears.
    """
    placing = placed(scheme, axes, sections_of(scheme, results.case, style), style)
    remarks = _remarks(placing, style)
    letters = AxesLetters.of(placing, scheme)
    low, high = letters.extent(placing)
    for gears in shown:
        subject = style.text("stick diagram")
        caption = told_of(results, scheme, style, gears, subject=subject)
        size = style.width, (high[1] - low[1]) / placing.letters
        head = sheet_head(
            ", ".join([caption.name, *remarks]),
            "",
            meanings(caption.state, style),
            size[0] - 2 * WIDE_MARGIN,
            style,
        )
        pen = head.over(size, WIDE_MARGIN * bool(head.high), style)._replace(size=size)
        pen = pen.fitted(low, high)._replace(letters=placing.letters)
        sheet = AxesSheet(pen, scheme, caption.state, caption.titles, placing, letters)
        draw_links(sheet)
        for number, station in enumerate(placing.board.stations):
            (draw_pair if station.kind == "pair" else draw_station)(sheet, number)
        draw_ends(sheet)
        yield [sheet.pen.canvas]


def _remarks(placing: AxesPlaces, style: Style) -> list[str]:
    layouts = [station.layout for station in placing.board.stations if station.layout is not None]
    lines = link_lines(placing)
    count = len(crossings(lines)) + wheel_crossings(placing, lines)
    count += sum(len(wires_of(layout).crossings) for layout in layouts)
    orders = [text for layout in layouts for text in order_told(layout, style)]
    return [*crossings_told(count, style), *dict.fromkeys(orders)]
