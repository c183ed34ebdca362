"""The natural modes of a gear: shapes over its links, and where the energy is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from matplotlib.figure import Figure

from vstatics.pictures.sheet.head import BELOW, headed
from vstatics.pictures.sheet.labels import height, widest, wrapped
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import MARGIN, Style, number
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.pictures.vibration import link_row
from vstatics.pictures.vibration import shares as mode_shares
from vstatics.pictures.vibration.links import ModeLinks, mode_links
from vstatics.pictures.vibration.shares import Share
from vstatics.pictures.vibration.shown_modes import modes_of, why_none
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes, Mode

LEAST_MODE_HEIGHT = 58.0
"""Height of a mode at least. [pt]"""
SHAPE_HEIGHT = 84.0
"""Height of a shape at most. [pt]"""
MODE_GAP = 14.0
"""Modes, and columns. [pt]"""
NOTE_GAP = 4.0
"""Between the note on a gear and its links. [pt]"""
AMPLITUDE_SCALE_WIDTH = 16.0
"""For the ends of the scale of amplitudes. [pt]"""
GEAR_GAP = 30.0
"""Between gears. [pt]"""
TALLEST_ON_SHEET = 1.38
"""Height over width of what fits a printed page."""


class _ModeRow(NamedTuple):
    """A mode, with the texts and bars beside its shape."""

    mode: Mode
    said: str
    elastic: list[Share]
    kinetic: list[Share]

    @property
    def high(self) -> float:
        """[pt]."""
        return max(
            LEAST_MODE_HEIGHT,
            mode_shares.height(self.elastic),
            mode_shares.height(self.kinetic),
            height(self.said),
        )


class _GearModesPart(NamedTuple):
    """A gear, or some modes of it; without modes its reason."""

    head: str
    note: str
    links: ModeLinks | None
    rows: Sequence[_ModeRow]


class _ModeColumns(NamedTuple):
    """Widths that all gears of a figure share, in points."""

    said: float
    shapes: float
    pitch: float
    """From link to link."""
    elastic: float
    kinetic: float

    @property
    def left(self) -> float:
        """Where the shapes begin."""
        return MARGIN + self.said + MODE_GAP + AMPLITUDE_SCALE_WIDTH

    @property
    def right(self) -> float:
        """Where the last bars end: the width of a figure."""
        return self.left + self.shapes + self.elastic + self.kinetic + 2 * MODE_GAP + MARGIN


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw the natural modes of the first gear, or of others, one below another.

    Raises
    ------
    CaseError
        If scipy is not installed, or these gears have no natural frequency.
    """
    numbers = gears or (1,)
    found = modes_of(results, numbers)
    parts = [_part(results, *one, style) for one in zip(numbers, found, strict=True)]
    return _figure(results, parts, style)


def sheets(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """The same of all gears, or some, in figures that fit a printed page each."""
    numbers = gears or range(1, len(results.case.gears) + 1)
    figures = []
    for one in zip(numbers, modes_of(results, numbers), strict=True):
        part = _part(results, *one, style)
        figures += [_figure(results, [page], style) for page in _on_pages(part)]
    return figures


def _part(results: Results, gear: int, found: GearModes, style: Style) -> _GearModesPart:
    """What is drawn of a gear."""
    head = gear_title(found.name, style)
    if not found.modes:
        return _GearModesPart(head, why_none(found, style), None, [])
    links = mode_links(results, gear, found)
    marks = {name: str(place) for place, name in enumerate(link_row.springs(links), 1)}
    note = style.text("amplitudes of links, the largest is 1", "амплитуды звеньев, наибольшая 1")
    for those, english, russian in (
        (links.resting, "these stand", "неподвижны"),
        (links.idle, "without load", "без нагрузки"),
    ):
        if those:
            note += f"; {style.text(english, russian)}: {', '.join(those)}"
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
    lines = [
        style.text(f"mode {place}", f"форма {place}"),
        f"{number(mode.frequency)} {style.text('Hz', 'Гц')}",
        f"{number(mode.omega)} {style.text('rad/s', 'рад/с')}",
    ]
    if found.damped and math.isfinite(mode.damping_ratio):
        lines.append(f"{style.text('damping', 'затухание')} {mode.damping_ratio:.4f}")
    return _ModeRow(
        mode,
        "\n".join(lines),
        mode_shares.largest(mode.elastic, marks, {}, style),
        mode_shares.largest(mode.kinetic, {}, colours, style),
    )


def _columns(parts: Sequence[_GearModesPart]) -> _ModeColumns:
    rows = [row for part in parts for row in part.rows]
    count = max((len(part.links.names) for part in parts if part.links), default=0)
    shapes = link_row.breadth(count)
    return _ModeColumns(
        widest(row.said for row in rows),
        shapes,
        shapes / max(count, 1),
        max([mode_shares.SHARE_BAR_WIDTH, *(mode_shares.width(row.elastic) for row in rows)]),
        max([mode_shares.SHARE_BAR_WIDTH, *(mode_shares.width(row.kinetic) for row in rows)]),
    )


def _head_high(part: _GearModesPart, columns: _ModeColumns) -> float:
    """Height of what stands above the first mode of a gear [pt]."""
    across = columns.right - 2 * MARGIN
    texts = height("") + NOTE_GAP + height(wrapped(part.note, across))
    return texts + (link_row.height(part.links, columns.pitch) + MODE_GAP if part.links else 0.0)


def _high(part: _GearModesPart, columns: _ModeColumns) -> float:
    rows = sum(row.high + MODE_GAP for row in part.rows)
    return _head_high(part, columns) + rows


def _on_pages(part: _GearModesPart) -> Iterator[_GearModesPart]:
    """The modes of a gear in parts of which each fits a printed page."""
    columns = _columns([part])
    room = TALLEST_ON_SHEET * columns.right - _head_high(part, columns) - 5 * MARGIN
    page: list[_ModeRow] = []
    for row in part.rows:
        if page and sum(one.high + MODE_GAP for one in [*page, row]) > room:
            yield part._replace(rows=page)
            page = []
        page.append(row)
    yield part._replace(rows=page)


def _figure(results: Results, parts: Sequence[_GearModesPart], style: Style) -> Figure:
    """Gears one below another."""
    columns = _columns(parts)
    wide, subject = columns.right, style.text("natural modes", "собственные формы")
    high = sum(_high(part, columns) for part in parts) + GEAR_GAP * (len(parts) - 1)
    pen = headed(title(results.case, subject), "", [], (wide, high + 2 * MARGIN), style)
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
    axis = link_row.Axis(pen, columns.left, columns.pitch)
    link_row.draw_links(axis, y + MODE_GAP, part.links)
    ends = right - columns.kinetic - MODE_GAP, right
    headings = (
        style.text("elastic energy", "энергия упругих звеньев"),
        style.text("kinetic energy", "кинетическая энергия"),
    )
    for end, text, marks in zip(ends, headings, (True, False), strict=True):
        start = end - mode_shares.SHARE_BAR_WIDTH
        pen.text(start, y + MODE_GAP, text, va="bottom", color=style.soft)
        link_row.draw_legend(pen, start, y + MODE_GAP + 2 * height(""), elastic=marks)
    for row in part.rows:
        pen.text(MARGIN, y, row.said, **BELOW)
        high = min(row.high, SHAPE_HEIGHT)
        band = link_row.AmplitudeBand(y - high / 2, high / 2 - 3)
        link_row.draw(axis, band, part.links, row.mode.shape)
        for end, shares in zip(ends, (row.elastic, row.kinetic), strict=True):
            mode_shares.draw(pen, end, y, shares)
        y -= row.high + MODE_GAP
