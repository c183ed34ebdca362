"""The natural modes of a gear: shapes over its links, and where the energy is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from matplotlib.figure import Figure

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.head import BELOW, sheet_head
from vstatics.pictures.drawing.labels import height, widest, width, wrapped
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import MARGIN, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.torsion.pictures.shapes.link_row import (
    AmplitudeBand,
    Axis,
    draw_legend,
    draw_links,
    draw_shape,
    least_width,
    row_height,
    springs,
    whole_width,
)
from vstatics.torsion.pictures.shapes.links import ModeLinks, mode_links
from vstatics.torsion.pictures.shapes.shares import (
    SHARE_BAR_WIDTH,
    Share,
    draw_shares,
    largest_shares,
    shares_height,
    shares_width,
)
from vstatics.torsion.pictures.shown_modes import modes_of, why_none

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes, Mode

LEAST_MODE_HEIGHT = 58.0
"""Height of a shape at least. [pt]"""
SHAPE_HEIGHT = 84.0
"""Height of a shape at most. [pt]"""
MODE_GAP = 14.0
"""Modes, and columns. [pt]"""
BETWEEN_SHARES = 5.0
"""Between the bars of two energies that stand below one another. [pt]"""
NO_BREAK = "\N{NO-BREAK SPACE}"
PART_GAP = "    "
"""Between the parts of what is said."""
SAID_GAP = 3.0
"""Below what is said over a shape. [pt]"""
NOTE_GAP = 4.0
"""Between the note on a gear and its links. [pt]"""
AMPLITUDE_SCALE_WIDTH = 16.0
"""For the ends of the scale of amplitudes. [pt]"""
ELASTIC = "elastic energy"
KINETIC = "kinetic energy"
"""What the bars are."""
GEAR_GAP = 30.0
"""Between gears. [pt]"""


class _ModeRow(NamedTuple):
    """A mode, with the bars beside its shape."""

    mode: Mode
    said: Sequence[str]
    """Parts of a line."""
    elastic: list[Share]
    kinetic: list[Share]


class _GearModesPart(NamedTuple):
    """A gear, or some modes of it; without modes its reason."""

    head: str
    note: str
    links: ModeLinks | None
    rows: Sequence[_ModeRow]


class _ModeColumns(NamedTuple):
    """Widths that all gears of a figure share, in points."""

    shapes: float
    pitch: float
    """From link to link."""
    elastic: float
    kinetic: float
    stacked: bool
    """Whether bars of kinetic energy stand below those of elastic energy."""
    named: float
    """Of what the bars of elastic energy are called."""

    @property
    def left(self) -> float:
        """Where the shapes begin."""
        return MARGIN + AMPLITUDE_SCALE_WIDTH

    @property
    def ends(self) -> tuple[float, float]:
        """Where the bars of elastic and of kinetic energy end."""
        first = self.left + self.shapes + MODE_GAP
        if self.stacked:
            return (first + max(self.elastic, self.kinetic),) * 2
        return first + self.elastic, first + self.elastic + MODE_GAP + self.kinetic

    @property
    def right(self) -> float:
        """The width of a figure."""
        return self.ends[1] + MARGIN

    def said(self, row: _ModeRow) -> str:
        """What is said of a mode: a line up to what its bars are called, else above them."""
        line = PART_GAP.join(row.said)
        if self._stands_beside(line):
            return line
        parts = " ".join(part.replace(" ", NO_BREAK) for part in row.said)
        return _spaced(wrapped(parts, self.right - 2 * MARGIN, lambda one: width(_spaced(one))))

    def _stands_beside(self, line: str) -> bool:
        return width(line) <= self.ends[0] - self.named - MODE_GAP - MARGIN

    def drop(self, row: _ModeRow) -> float:
        """Of the bars below what is said, if that has no room beside what they are called."""
        is_beside = self._stands_beside(PART_GAP.join(row.said))
        return 0.0 if is_beside else self.said_height(row)

    def said_height(self, row: _ModeRow) -> float:
        """Of what is said over a shape."""
        return height(self.said(row)) + SAID_GAP

    def high(self, row: _ModeRow) -> float:
        """Of a mode with the gap below it."""
        bars = [shares_height(one) for one in (row.elastic, row.kinetic)]
        if self.stacked:
            right = sum(bars) + 2 * height("") + BETWEEN_SHARES
        else:
            right = max(bars) + height("") + SAID_GAP
        left = self.said_height(row) + LEAST_MODE_HEIGHT
        return max(left, self.drop(row) + right) + MODE_GAP


def _spaced(parts: str) -> str:
    """Parts with their gaps between them."""
    return parts.replace(" ", PART_GAP).replace(NO_BREAK, " ")


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """Draw the natural modes of gears one below another, on pages.

    On one page of any height it is the first gear, where none is told.

    Raises
    ------
    CaseError
        If scipy is not installed, or these gears have no natural frequency.
    """
    is_one = math.isinf(style.height)
    numbers = gears or ((1,) if is_one else range(1, len(results.case.gears) + 1))
    found = modes_of(results, numbers)
    parts = [_part(results, *one, style) for one in zip(numbers, found, strict=True)]
    if is_one:
        return [_figure(results, parts, style)]
    pages = (page for part in parts for page in _on_pages(results, part, style))
    return [_figure(results, [page], style) for page in pages]


def _part(results: Results, gear: int, found: GearModes, style: Style) -> _GearModesPart:
    """What is drawn of a gear."""
    head = gear_title(found.name, style)
    if not found.modes:
        return _GearModesPart(head, why_none(found, style), None, [])
    links = mode_links(results, gear, found)
    marks = {name: str(place) for place, name in enumerate(springs(links), 1)}
    note = style.text("amplitudes of links, the largest is 1")
    for those, english in (
        (links.resting, "these stand"),
        (links.idle, "without load"),
    ):
        if those:
            note += f"; {style.text(english)}: {', '.join(those)}"
    colours = {
        name: style.colour(link - 1) for name, link in zip(links.names, links.numbers, strict=True)
    }
    rows = [
        _row(place, mode, found, (marks, colours), style)
        for place, mode in enumerate(found.modes, 1)
    ]
    return _GearModesPart(head, note, links, rows)


def _row(
    place: int,
    mode: Mode,
    found: GearModes,
    marked: tuple[dict[str, str], dict[str, str]],
    style: Style,
) -> _ModeRow:
    """A mode; springs have marks, links their colours."""
    marks, colours = marked
    said = [
        style.text("mode {place}", place=place),
        f"{number(mode.frequency)} {style.text('Hz')}",
        f"{number(mode.omega)} {style.text('rad/s')}",
    ]
    if found.damped and math.isfinite(mode.damping_ratio):
        said.append(f"{style.text('damping')} {mode.damping_ratio:.4f}")
    return _ModeRow(
        mode,
        said,
        largest_shares(mode.elastic, marks, {}, style),
        largest_shares(mode.kinetic, {}, colours, style),
    )


def _columns(parts: Sequence[_GearModesPart], style: Style) -> _ModeColumns:
    """Bars beside one another if links have room besides, else below one another."""
    rows = [row for part in parts for row in part.rows]
    links = [part.links for part in parts if part.links]
    said = widest(PART_GAP.join(row.said) for row in rows) - AMPLITUDE_SCALE_WIDTH
    count = max((len(one.names) for one in links), default=1)
    elastic, kinetic = (
        max([width(style.text(said)), SHARE_BAR_WIDTH, *map(shares_width, shares)])
        for said, shares in (
            (ELASTIC, [row.elastic for row in rows]),
            (KINETIC, [row.kinetic for row in rows]),
        )
    )
    # What is said of a mode may stand above its bars, up to what these are called.
    named = width(style.text(ELASTIC))
    said -= elastic - named
    whole = max([said, *map(whole_width, links)])
    least = max([said, *map(least_width, links)])
    left = style.width - 2 * MARGIN - AMPLITUDE_SCALE_WIDTH - MODE_GAP
    beside = left - elastic - MODE_GAP - kinetic
    stacked = beside < least
    shapes = min(whole, left - max(elastic, kinetic) if stacked else beside)
    return _ModeColumns(shapes, shapes / count, elastic, kinetic, stacked, named)


def _head_high(part: _GearModesPart, columns: _ModeColumns) -> float:
    """Height of what stands above the first mode of a gear [pt]."""
    across = columns.right - 2 * MARGIN
    texts = height("") + NOTE_GAP + height(wrapped(part.note, across))
    return texts + (row_height(part.links, columns.pitch) + MODE_GAP if part.links else 0.0)


def _high(part: _GearModesPart, columns: _ModeColumns) -> float:
    return _head_high(part, columns) + sum(map(columns.high, part.rows))


def _on_pages(results: Results, part: _GearModesPart, style: Style) -> Iterator[_GearModesPart]:
    """The modes of a gear in parts of which each fits a page."""
    columns = _columns([part], style)
    room = style.height - _page_head(results, columns.right, style) - 3 * MARGIN
    room -= _head_high(part, columns)
    page: list[_ModeRow] = []
    for row in part.rows:
        if page and sum(map(columns.high, [*page, row])) - MODE_GAP > room:
            yield part._replace(rows=page)
            page = []
        page.append(row)
    yield part._replace(rows=page)


def _page_head(results: Results, wide: float, style: Style) -> float:
    """Height of the title [pt]."""
    return sheet_head(_title(results, style), "", [], wide - 2 * MARGIN, style).high


def _title(results: Results, style: Style) -> str:
    return title(results.case, style.text("natural modes"))


def _figure(results: Results, parts: Sequence[_GearModesPart], style: Style) -> Figure:
    """Gears one below another."""
    columns = _columns(parts, style)
    wide = columns.right
    high = sum(_high(part, columns) for part in parts) + GEAR_GAP * (len(parts) - 1) - MODE_GAP
    head = sheet_head(_title(results, style), "", [], wide - 2 * MARGIN, style)
    pen = head.over((wide, high + 2 * MARGIN), MARGIN, style)
    pen, top = pen._replace(size=(wide, high)), high + MARGIN
    for part in parts:
        _draw_gear(pen, top, part, columns)
        top -= _high(part, columns) + GEAR_GAP
    return pen.figure


def _draw_gear(pen: Pen, top: float, part: _GearModesPart, columns: _ModeColumns) -> None:
    """The row of links, and the modes below it."""
    style, right = pen.style, columns.right - MARGIN
    pen.text(MARGIN, top, part.head, va="top", bold=True)
    note = wrapped(part.note, right - MARGIN)
    pen.text(MARGIN, top - height(""), note, color=style.soft, **BELOW)
    if part.links is None:
        return
    y = top - _head_high(part, columns)
    axis = Axis(pen, columns.left, columns.pitch)
    draw_links(axis, y + MODE_GAP, part.links)
    above = 2 + 2 * columns.stacked
    for end, lines, elastic in zip(columns.ends, (2, above), (True, False), strict=True):
        draw_legend(pen, end, y + MODE_GAP + lines * height(""), elastic=elastic)
    for row in part.rows:
        _draw_mode(axis, y, part.links, row, columns)
        y -= columns.high(row)


def _draw_mode(
    axis: Axis, top: float, links: ModeLinks, row: _ModeRow, columns: _ModeColumns
) -> None:
    """A mode below an ordinate [pt]: what is said, its shape, its bars."""
    pen, style = axis.pen, axis.pen.style
    pen.text(MARGIN, top, columns.said(row), **BELOW)
    said = columns.said_height(row)
    high = min(columns.high(row) - MODE_GAP - said, SHAPE_HEIGHT)
    band = AmplitudeBand(top - said - high / 2, high / 2 - 3)
    draw_shape(axis, band, links, row.mode.shape)
    y = top - columns.drop(row)
    both = (row.elastic, row.kinetic)
    for end, called, shares in zip(columns.ends, (ELASTIC, KINETIC), both, strict=True):
        pen.text(end, y, style.text(called), va="top", ha="right", color=style.soft)
        draw_shares(pen, end, y - height("") - SAID_GAP, shares)
        if columns.stacked:
            y -= height("") + shares_height(shares) + BETWEEN_SHARES
