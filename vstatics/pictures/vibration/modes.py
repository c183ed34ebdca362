"""The natural modes of a gear: shapes over its links, and where the energy is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from matplotlib.figure import Figure

from vstatics.pictures.sheet.head import BELOW, headed
from vstatics.pictures.sheet.labels import LINE_HEIGHT, height, widest, wrapped
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import LONG_NAME, MARGIN, Style, number
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.pictures.vibration.link_row import (
    AmplitudeBand,
    Axis,
    breadth,
    draw_legend,
    draw_links,
    draw_shape,
    row_height,
    springs,
)
from vstatics.pictures.vibration.links import ModeLinks, mode_links
from vstatics.pictures.vibration.shown_modes import modes_of, why_none
from vstatics.statics.results import Results
from vstatics.tables.numbers import certain

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes, Mode

FULL_BAR = 64.0
"""Length of a bar of 100 %. [pt]"""
BAR_HEIGHT = 6.0
"""[pt]"""
PERCENT_WIDTH = 30.0
"""For the number behind a bar. [pt]"""
BAR_GAP = 6.0
"""From a name to its bar, from a bar to its number. [pt]"""
SHARE_BAR_WIDTH = FULL_BAR + BAR_GAP + PERCENT_WIDTH
"""From the start of a bar to its right. [pt]"""
MOST_BARS = 5
"""So many bars at most, and one for the rest."""
LEAST_SHARE = 0.01
"""Smaller shares are among the rest."""
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
            shares_height(self.elastic),
            shares_height(self.kinetic),
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
    return [_figure(results, [page], style) for part in parts for page in _on_pages(part)]


def _part(results: Results, gear: int, found: GearModes, style: Style) -> _GearModesPart:
    """What is drawn of a gear."""
    head = gear_title(found.name, style)
    if not found.modes:
        return _GearModesPart(head, why_none(found, style), None, [])
    links = mode_links(results, gear, found)
    marks = {name: str(place) for place, name in enumerate(springs(links), 1)}
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
        largest_shares(mode.elastic, marks, {}, style),
        largest_shares(mode.kinetic, {}, colours, style),
    )


def _columns(parts: Sequence[_GearModesPart]) -> _ModeColumns:
    rows = [row for part in parts for row in part.rows]
    count = max((len(part.links.names) for part in parts if part.links), default=0)
    shapes = breadth(count)
    return _ModeColumns(
        widest(row.said for row in rows),
        shapes,
        shapes / max(count, 1),
        max([SHARE_BAR_WIDTH, *(shares_width(row.elastic) for row in rows)]),
        max([SHARE_BAR_WIDTH, *(shares_width(row.kinetic) for row in rows)]),
    )


def _head_high(part: _GearModesPart, columns: _ModeColumns) -> float:
    """Height of what stands above the first mode of a gear [pt]."""
    across = columns.right - 2 * MARGIN
    texts = height("") + NOTE_GAP + height(wrapped(part.note, across))
    return texts + (row_height(part.links, columns.pitch) + MODE_GAP if part.links else 0.0)


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
    axis = Axis(pen, columns.left, columns.pitch)
    draw_links(axis, y + MODE_GAP, part.links)
    ends = right - columns.kinetic - MODE_GAP, right
    headings = (
        style.text("elastic energy", "энергия упругих звеньев"),
        style.text("kinetic energy", "кинетическая энергия"),
    )
    for end, text, marks in zip(ends, headings, (True, False), strict=True):
        start = end - SHARE_BAR_WIDTH
        pen.text(start, y + MODE_GAP, text, va="bottom", color=style.soft)
        draw_legend(pen, start, y + MODE_GAP + 2 * height(""), elastic=marks)
    for row in part.rows:
        pen.text(MARGIN, y, row.said, **BELOW)
        high = min(row.high, SHAPE_HEIGHT)
        band = AmplitudeBand(y - high / 2, high / 2 - 3)
        draw_shape(axis, band, part.links, row.mode.shape)
        for end, shares in zip(ends, (row.elastic, row.kinetic), strict=True):
            draw_shares(pen, end, y, shares)
        y -= row.high + MODE_GAP


class Share(NamedTuple):
    """A bar."""

    name: str
    part: float
    """Of the energy. [-]"""
    colour: str


def largest_shares(
    shares: Mapping[str, float], marks: Mapping[str, str], colours: Mapping[str, str], style: Style
) -> list[Share]:
    """The largest shares of a mode, and what is left.

    Parameters
    ----------
    marks : mapping of str to str
        What stands before some of the names.
    colours : mapping of str to str
        Of some of the names.

    Examples
    --------
    >>> shares = {"engine": 0.99, "wheel": 0.008, "disc": 0.002}
    >>> [one[:2] for one in largest_shares(shares, {"engine": "1"}, {}, Style())]
    [('1 engine', 0.99), ('others', 0.01)]
    """
    order = sorted(shares, key=lambda name: -certain(shares[name]))
    shown = [name for name in order if certain(shares[name]) >= LEAST_SHARE]
    if len(shown) > MOST_BARS + 1:
        shown = shown[:MOST_BARS]
    found = []
    for name in shown:
        said = f"{marks[name]} {name}" if name in marks else name
        colour = colours.get(name, style.soft)
        found.append(Share(wrapped(said, LONG_NAME), shares[name], colour))
    rest = round(sum(shares.values()) - sum(one.part for one in found), 9)
    if rest >= LEAST_SHARE / 2:
        found.append(Share(style.text("others", "прочие"), rest, style.soft))
    return found


def shares_height(shares: Sequence[Share]) -> float:
    """Of the bars, one below another [pt]."""
    return sum(height(one.name) for one in shares)


def shares_width(shares: Sequence[Share]) -> float:
    """Of the bars with their names and numbers [pt]."""
    return widest(one.name for one in shares) + BAR_GAP + SHARE_BAR_WIDTH


def draw_shares(pen: Pen, right: float, top: float, shares: Sequence[Share]) -> None:
    """Bars that end before an abscissa, from an ordinate downwards [pt]."""
    start, y = right - SHARE_BAR_WIDTH, top
    for one in shares:
        middle = y - height(one.name) / 2
        at, spaced = (start - BAR_GAP, middle), LINE_HEIGHT
        pen.text(*at, one.name, ha="right", va="center", linespacing=spaced)
        length, percent = FULL_BAR * one.part, f"{100 * one.part:.0f}%"
        bar = (start, middle - BAR_HEIGHT / 2), (length, BAR_HEIGHT)
        pen.box(*bar, facecolor=one.colour, title=f"{one.name}: {percent}")
        pen.text(start + length + BAR_GAP, middle, percent, va="center")
        y -= height(one.name)
