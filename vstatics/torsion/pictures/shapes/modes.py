"""Picture of the natural modes of a gear: shapes over the links, and shares of energy."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.groups import filled
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.head import BELOW, SheetHead, sheet_head
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

LEAST_PAGE = 300.0
"""Least width of a picture; on narrower pages, the picture is wider than the page. [pt]"""
LEAST_MODE_HEIGHT = 58.0
"""Smallest height of a mode shape. [pt]"""
SHAPE_HEIGHT = 84.0
"""Largest height of a mode shape. [pt]"""
MODE_GAP = 14.0
"""Vertical gap between modes, and gap between columns. [pt]"""
BETWEEN_SHARES = 5.0
"""Vertical gap between the bars of elastic and of kinetic energy. [pt]"""
NO_BREAK = "\N{NO-BREAK SPACE}"
PART_GAP = "    "
"""Spaces between the items in the caption of a mode."""
SAID_GAP = 3.0
"""Gap below the caption of a mode. [pt]"""
NOTE_GAP = 4.0
"""Gap between the note on a gear and the row of links. [pt]"""
AMPLITUDE_SCALE_WIDTH = 16.0
"""Width of the numbers on the scale of amplitudes. [pt]"""
ELASTIC = "elastic energy"
KINETIC = "kinetic energy"
"""Titles of the bars of elastic and kinetic energy."""
GEAR_GAP = 30.0
"""Gap between gears. [pt]"""


class _ModeRow(NamedTuple):
    """Mode with its caption, and with bars to the right of its shape."""

    mode: Mode
    said: Sequence[str]
    """Items of the caption."""
    elastic: list[Share]
    kinetic: list[Share]


class _GearModesPart(NamedTuple):
    """Gear with all or some of its modes, or with a note why it has no modes."""

    head: str
    note: str
    links: ModeLinks | None
    rows: Sequence[_ModeRow]


class _ModeColumns(NamedTuple):
    """Widths in points that all gears of a figure share."""

    shapes: float
    """Width of mode shapes."""
    pitch: float
    """Distance between neighbouring links."""
    elastic: float
    """Width of the bars of elastic energy."""
    kinetic: float
    """Width of the bars of kinetic energy."""
    stacked: bool
    """True if the bars of kinetic energy are below the bars of elastic energy."""
    named: float
    """Width of the title of the bars of elastic energy."""

    @property
    def left(self) -> float:
        """Left end of the shapes."""
        return MARGIN + AMPLITUDE_SCALE_WIDTH

    @property
    def ends(self) -> tuple[float, float]:
        """Right ends of the bars of elastic energy, and of kinetic energy."""
        first = self.left + self.shapes + MODE_GAP
        if self.stacked:
            return (first + max(self.elastic, self.kinetic),) * 2
        return first + self.elastic, first + self.elastic + MODE_GAP + self.kinetic

    @property
    def right(self) -> float:
        """Width of a figure."""
        return self.ends[1] + MARGIN

    def caption(self, row: _ModeRow) -> str:
        """Return the caption of a mode, wrapped if the title of bars leaves too little width."""
        line = PART_GAP.join(row.said)
        if self._fits_beside_title(line):
            return line
        parts = " ".join(part.replace(" ", NO_BREAK) for part in row.said)
        return _spaced(wrapped(parts, self.right - 2 * MARGIN, lambda text: width(_spaced(text))))

    def _fits_beside_title(self, line: str) -> bool:
        return width(line) <= self.ends[0] - self.named - MODE_GAP - MARGIN

    def drop(self, row: _ModeRow) -> float:
        """Return the distance from the top of a mode to its bars."""
        is_beside = self._fits_beside_title(PART_GAP.join(row.said))
        return 0.0 if is_beside else self.caption_height(row)

    def caption_height(self, row: _ModeRow) -> float:
        """Return the height of a caption, including the gap below."""
        return height(self.caption(row)) + SAID_GAP

    def high(self, row: _ModeRow) -> float:
        """Return the height of a mode, including the gap below."""
        bars = [shares_height(shares) for shares in (row.elastic, row.kinetic)]
        if self.stacked:
            right = sum(bars) + 2 * height("") + BETWEEN_SHARES
        else:
            right = max(bars) + height("") + SAID_GAP
        left = self.caption_height(row) + LEAST_MODE_HEIGHT
        return max(left, self.drop(row) + right) + MODE_GAP


def _spaced(parts: str) -> str:
    return parts.replace(" ", PART_GAP).replace(NO_BREAK, " ")


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Canvas]:
    """Draw the natural modes of gears in a column, on one or more pages.

    By default a single page of unspecified height shows only the first gear.

    Raises
    ------
    CaseError
        If scipy is not installed, or these gears have no natural frequency.
    """
    is_one = math.isinf(style.height)
    numbers = gears or ((1,) if is_one else range(1, len(results.case.gears) + 1))
    by_gear = modes_of(results, numbers)
    parts = [_part(results, *gear, style) for gear in zip(numbers, by_gear, strict=True)]
    if is_one:
        return [_figure(results, parts, style)]
    pages = (page for part in parts for page in _on_pages(results, part, style))
    return [_figure(results, [page], style) for page in pages]


def _part(results: Results, gear: int, modes: GearModes, style: Style) -> _GearModesPart:
    head = gear_title(modes.name, style)
    if not modes.modes:
        return _GearModesPart(head, why_none(modes, style), None, [])
    links = mode_links(results, gear, modes)
    marks = {name: str(place) for place, name in enumerate(springs(links), 1)}
    note = style.text("amplitudes of links, the largest is 1")
    for names, english in (
        (links.resting, "at rest"),
        (links.idle, "without load"),
    ):
        if names:
            note += f"; {style.text(english)}: {', '.join(names)}"
    colours = {
        name: style.colour(link - 1) for name, link in zip(links.names, links.numbers, strict=True)
    }
    rows = [
        _row(place, mode, modes, (marks, colours), style)
        for place, mode in enumerate(modes.modes, 1)
    ]
    return _GearModesPart(head, note, links, rows)


def _row(
    place: int,
    mode: Mode,
    modes: GearModes,
    marked: tuple[dict[str, str], dict[str, str]],
    style: Style,
) -> _ModeRow:
    marks, colours = marked
    caption = [
        style.text("mode {place}", place=place),
        f"{number(mode.frequency)} {style.text('Hz')}",
        f"{number(mode.omega)} {style.text('rad/s')}",
    ]
    if modes.damped and math.isfinite(mode.damping_ratio):
        caption.append(f"{style.text('damping')} {mode.damping_ratio:.4f}")
    return _ModeRow(
        mode,
        caption,
        largest_shares(mode.elastic, marks, {}, style),
        largest_shares(mode.kinetic, {}, colours, style),
    )


def _columns(parts: Sequence[_GearModesPart], style: Style) -> _ModeColumns:
    """Choose the widths: bars side by side if the links have room, otherwise stacked."""
    rows = [row for part in parts for row in part.rows]
    links = [part.links for part in parts if part.links]
    captions = widest(PART_GAP.join(row.said) for row in rows) - AMPLITUDE_SCALE_WIDTH
    count = max((len(row.names) for row in links), default=1)
    elastic, kinetic = (
        max([width(style.text(english)), SHARE_BAR_WIDTH, *map(shares_width, shares)])
        for english, shares in (
            (ELASTIC, [row.elastic for row in rows]),
            (KINETIC, [row.kinetic for row in rows]),
        )
    )
    # the caption of a mode can extend to the title of the bars
    named = width(style.text(ELASTIC))
    captions -= elastic - named
    whole = max([captions, *map(whole_width, links)])
    least = max([captions, *map(least_width, links)])
    left = max(style.width, LEAST_PAGE) - 2 * MARGIN - AMPLITUDE_SCALE_WIDTH - MODE_GAP
    shapes_beside = left - elastic - MODE_GAP - kinetic
    stacked = shapes_beside < least
    shapes = min(whole, left - max(elastic, kinetic) if stacked else shapes_beside)
    return _ModeColumns(shapes, shapes / count, elastic, kinetic, stacked, named)


def _height_above_modes(part: _GearModesPart, columns: _ModeColumns) -> float:
    across = columns.right - 2 * MARGIN
    texts = height("") + NOTE_GAP + height(wrapped(part.note, across))
    return texts + (row_height(part.links, columns.pitch) + MODE_GAP if part.links else 0.0)


def _high(part: _GearModesPart, columns: _ModeColumns) -> float:
    return _height_above_modes(part, columns) + sum(map(columns.high, part.rows))


def _on_pages(results: Results, part: _GearModesPart, style: Style) -> Iterator[_GearModesPart]:
    """Divide the modes of a gear into groups that fit on a page each."""
    columns = _columns([part], style)
    room = style.height - _page_head(results, columns.right, style).high - 3 * MARGIN
    room -= _height_above_modes(part, columns)
    pages = filled(part.rows, room + MODE_GAP, columns.high)
    yield from (part._replace(rows=page) for page in pages)


def _page_head(results: Results, wide: float, style: Style) -> SheetHead:
    name = title(results.case, style.text("natural modes"))
    return sheet_head(name, "", [], wide - 2 * MARGIN, style)


def _figure(results: Results, parts: Sequence[_GearModesPart], style: Style) -> Canvas:
    columns = _columns(parts, style)
    wide = columns.right
    high = sum(_high(part, columns) for part in parts) + GEAR_GAP * (len(parts) - 1) - MODE_GAP
    head = _page_head(results, wide, style)
    pen = head.over((wide, high + 2 * MARGIN), MARGIN, style)
    pen, top = pen._replace(size=(wide, high)), high + MARGIN
    for part in parts:
        _draw_gear(pen, top, part, columns)
        top -= _high(part, columns) + GEAR_GAP
    return pen.canvas


def _draw_gear(pen: Pen, top: float, part: _GearModesPart, columns: _ModeColumns) -> None:
    style, right = pen.style, columns.right - MARGIN
    pen.text(MARGIN, top, part.head, va="top", bold=True)
    note = wrapped(part.note, right - MARGIN)
    pen.text(MARGIN, top - height(""), note, color=style.soft, **BELOW)
    if part.links is None:
        return
    y = top - _height_above_modes(part, columns)
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
    pen, style = axis.pen, axis.pen.style
    pen.text(MARGIN, top, columns.caption(row), **BELOW)
    caption = columns.caption_height(row)
    high = min(columns.high(row) - MODE_GAP - caption, SHAPE_HEIGHT)
    band = AmplitudeBand(top - caption - high / 2, high / 2 - 3)
    draw_shape(axis, band, links, row.mode.shape)
    y = top - columns.drop(row)
    both = (row.elastic, row.kinetic)
    for end, bar_title, shares in zip(columns.ends, (ELASTIC, KINETIC), both, strict=True):
        pen.text(end, y, style.text(bar_title), va="top", ha="right", color=style.soft)
        draw_shares(pen, end, y - height("") - SAID_GAP, shares)
        if columns.stacked:
            y -= height("") + shares_height(shares) + BETWEEN_SHARES
