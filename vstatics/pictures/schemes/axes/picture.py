"""The stick diagram of a box with several axes: its figures, of no gear and of each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product

from matplotlib.figure import Figure

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.labels import device_labels
from vstatics.pictures.schemes.axes.link_names import fixed_names
from vstatics.pictures.schemes.axes.marks import draw_station
from vstatics.pictures.schemes.axes.obstacles import Rectangle, obstacles
from vstatics.pictures.schemes.axes.places import AxesPlaces, places
from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.row_sections import RowSection, row_sections
from vstatics.pictures.schemes.axes.rows import axis_rows
from vstatics.pictures.schemes.axes.search import arranged, passing
from vstatics.pictures.schemes.axes.sheet import (
    AxesSheet,
    draw_ends,
    draw_links,
)
from vstatics.pictures.schemes.axes.stations import stations_of
from vstatics.pictures.schemes.axes.wheels import draw_pair
from vstatics.pictures.schemes.axes.wires import crossings, link_lines
from vstatics.pictures.schemes.coaxial.drawn.lines import crossings_of
from vstatics.pictures.schemes.coaxial.fitting import CLOSEST
from vstatics.pictures.schemes.coaxial.picture import crossings_told, order_told
from vstatics.pictures.schemes.planetary import sections_of
from vstatics.pictures.schemes.scheme import Scheme
from vstatics.pictures.schemes.sets import HalfSection
from vstatics.pictures.schemes.signs import meanings
from vstatics.pictures.schemes.told import told_of
from vstatics.pictures.sheet.head import sheet_head
from vstatics.pictures.sheet.labels import Point
from vstatics.pictures.sheet.style import WIDE_MARGIN, Style
from vstatics.statics.results import Results

GAPS = (16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 2.0)
"""Between stations: the largest with which all fits into the width. [pt]"""
PARTS = (1.0, 0.92, 0.85, 0.78, 0.72, 0.66, 0.6, 0.55, 0.5, 0.45, 0.4, 0.36, 0.32)
"""Sizes of all but letters: the largest with which all fits into the width."""
LETTERS, FEW_LETTERS = 12, 5
"""Longer names are broken at blanks; where room is short, at all blanks."""


def figures(
    results: Results,
    scheme: Scheme,
    axes: ParallelAxes,
    style: Style,
    shown: Iterable[Sequence[int]],
) -> Iterator[list[Figure]]:
    """Figures of no gear or of one by its number from 1, everything at the same places.

    Raises
    ------
    CaseError
        If one is of several gears.
    """
    found = placed(scheme, axes, sections_of(scheme, results.case, style), style)
    remarks = _remarks(found, style)
    labels = device_labels(found, fixed_names(found, scheme))
    for gears in shown:
        subject = style.text("stick diagram", "кинематическая схема")
        told = told_of(results, scheme, style, gears, subject=subject)
        low, high = extent(found, scheme)
        size = style.width, (high[1] - low[1]) / found.letters
        head = sheet_head(
            ", ".join([told.name, *remarks]),
            "",
            meanings(told.state, style),
            size[0] - 2 * WIDE_MARGIN,
            style,
        )
        pen = head.over(size, WIDE_MARGIN * bool(head.high), style)._replace(size=size)
        pen = pen.fitted(low, high)._replace(letters=found.letters)
        sheet = AxesSheet(pen, scheme, told.state, told.titles, found, labels)
        draw_links(sheet)
        for number, station in enumerate(found.board.stations):
            (draw_pair if station.kind == "pair" else draw_station)(sheet, number)
        draw_ends(sheet)
        yield [sheet.pen.figure]


def _remarks(found: AxesPlaces, style: Style) -> list[str]:
    """What the title says besides."""
    layouts = [one.layout for one in found.board.stations if one.layout is not None]
    count = len(crossings(link_lines(found))) + sum(map(crossings_of, layouts))
    orders = [text for layout in layouts for text in order_told(layout, style)]
    return [*crossings_told(count, style), *dict.fromkeys(orders)]


def placed(
    scheme: Scheme, axes: ParallelAxes, sections: Mapping[int, HalfSection], style: Style
) -> AxesPlaces:
    """Where everything stands in the width of a page."""
    inner = list(row_sections(scheme, axes, sections, is_ordered=style.ordered))
    chosen = _chosen(scheme, axes, inner)
    if chosen is None:  # something would lead through a half-section
        inner, chosen = [], _chosen(scheme, axes, [])
    assert chosen is not None  # noqa: S101 - nothing leads through none
    small = [(False, part) for part in PARTS if not inner or part * CLOSEST >= 1]
    small += [(True, part) for part in PARTS * bool(inner)]
    for (is_small, part), letters in product(small, (LETTERS, FEW_LETTERS)):
        layouts = [one.laid_out(1 / part, letters, is_small=is_small) for one in inner]
        own = stations_of(scheme, axes, style, letters, layouts)
        rows = axis_rows(axes, own, 1 / part)
        for gap in GAPS:
            board = AxesBoard(axes, rows, own, scheme.ports, gap)
            found = places(board, chosen)._replace(letters=1 / part)
            if part * max(found.xs) > style.width:
                continue
            low, high = extent(found, scheme)
            if part * (high[0] - low[0]) <= style.width:
                return found
    return found


def _chosen(scheme: Scheme, axes: ParallelAxes, inner: Sequence[RowSection]) -> StationOrder | None:
    """The order of the stations; None if something would lead through a half-section."""
    stations = stations_of(scheme, axes, Style(), sections=[one.laid_out() for one in inner])
    found = arranged(AxesBoard(axes, axis_rows(axes, stations), stations, scheme.ports))
    for one, x in zip(stations, found.xs, strict=True):
        if one.layout is not None and any(passing(found, one, x)):
            return None
    return found.chosen


def extent(found: AxesPlaces, scheme: Scheme) -> tuple[Point, Point]:
    """The lower left and the upper right corner with room for all but the head [pt]."""
    names = fixed_names(found, scheme)
    labels = [one.box for own in device_labels(found, names).values() for one in own]
    boxes = [*names, *labels, *(one.box for one in obstacles(found))]
    for link, span in found.spans.items():
        for height in (span.height, -span.height):
            y = found.y(found.axis_of(link), height)
            boxes.append(Rectangle(span.left - 8, y, span.right + 8, y))
    lefts, lows, rights, highs = zip(*boxes, strict=True)
    margin = WIDE_MARGIN
    return (min(lefts) - margin, min(lows) - margin), (max(rights) + margin, max(highs) + margin)
