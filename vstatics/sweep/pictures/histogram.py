"""Histograms: how often numbers of a written sweep, or of samples, fall into parts of their range.

A panel for each column, with its mean and the quantiles that `vstatics simulate --samples` tells.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.written_results import WrittenSweep
from vstatics.pictures.drawing.head import Meaning, headed, sheet_head
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, ticks, widest, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style, number
from vstatics.sweep.pictures.columns import DrawnColumns, numbers, results_of, rows_by
from vstatics.sweep.results.statistics import PARTS, Statistics, statistics

HISTOGRAM_SIZE = (132.0, 84.0)
"""Least width of a panel with its scale, and height without. [pt]"""
HISTOGRAM_GAP = 10.0
"""Between panels across. [pt]"""
MOST_BARS = 30
"""Of a panel."""
MOST_HISTOGRAMS = 24
"""So many columns are drawn where none is named."""


class Histogram(NamedTuple):
    """Counts of the numbers of a column."""

    name: str
    told: Statistics
    """Of its numbers."""
    edges: Floats
    """Of its bars, one more than these."""
    counts: Sequence[int]


def histogram(name: str, values: Floats) -> Histogram:
    """Bars of equal width over all numbers, as many as NumPy takes by itself, up to a bound.

    >>> made = histogram("x", np.array([0.0, 1.0, 1.0, 2.0, 2.0, 2.0]))
    >>> made.edges.tolist(), made.counts
    ([0.0, 0.5, 1.0, 1.5, 2.0], [1, 0, 2, 3])
    """
    edges = np.histogram_bin_edges(values, "auto")
    bars = min(len(edges) - 1, MOST_BARS)
    counts, edges = np.histogram(values, bars)
    return Histogram(name, statistics(values), edges, counts.tolist())


def draw(sweep: WrittenSweep, style: Style, asked: DrawnColumns) -> list[Figure]:
    """Draw a panel for each column.

    Raises
    ------
    CaseError
        If a column is none, or there is nothing to draw.
    """
    every = list(_histograms(sweep, asked))
    if not every:
        raise CaseError("E433", "no column of the sweep has different numbers to draw")
    shown = every if asked.y else every[:MOST_HISTOGRAMS]
    words = widest(word for one in shown for word in one.name.split(" "))
    least = max(HISTOGRAM_SIZE[0], words) + HISTOGRAM_GAP
    across = max(1, int((style.width - 2 * MARGIN + HISTOGRAM_GAP) // least))
    rows = [shown[at : at + across] for at in range(0, len(shown), across)]
    said = style.text("Histograms")
    note = f"{len(set(sweep.variants))} {style.text('variants')}"
    if len(shown) < len(every):
        note += f"; {style.text('columns')}: {len(shown)} / {len(every)}"
    figures, wide = [], (style.width - 2 * MARGIN + HISTOGRAM_GAP) / across
    head = sheet_head(said, note, _key(style), style.width - 2 * MARGIN, style).high
    for page in _pages(rows, wide, style.height - head - 1.5 * MARGIN):
        highs = [_high(row, wide) for row in page]
        pen = headed(said, note, _key(style), (style.width, sum(highs) + MARGIN / 2), style)
        top = sum(highs) + MARGIN / 2
        for row, high in zip(page, highs, strict=True):
            for place, one in enumerate(row):
                _draw(pen.panel((MARGIN + place * wide, top - high), (wide, high)), one)
            top -= high
        figures.append(pen.figure)
    return figures


def _histograms(sweep: WrittenSweep, asked: DrawnColumns) -> Iterator[Histogram]:
    """Those of results, then those of varied numbers; only of what is not the same throughout."""
    names = list(asked.y) or [*results_of(sweep, [asked.by]), *sweep.varied]
    for name in names:
        column = numbers(sweep, name)
        for part in rows_by(sweep, asked):
            values = column[list(part.rows)]
            values = values[np.isfinite(values)]
            if len(values) and (asked.y or statistics(values).deviation > 0):
                yield histogram(", ".join(filter(None, (name, part.name))), values)


def _key(style: Style) -> list[Meaning]:
    parts = ", ".join(f"{100 * part:g}" for part in PARTS)
    return [
        (True, "mean", _mean(style)),
        (True, style.text("{parts} % are below", parts=parts), _quantile(style)),
    ]


def _mean(style: Style) -> Look:
    return {"color": style.engaged, "width": 1.2}


def _quantile(style: Style) -> Look:
    return {"color": style.ink, "width": 0.9, "linestyle": (0, (3, 2))}


def _head(one: Histogram, wide: float) -> str:
    return wrapped(one.name, wide - HISTOGRAM_GAP)


def _high(row: Sequence[Histogram], wide: float) -> float:
    """A row with the names over its panels, and their scales [pt]."""
    names = max(height(_head(one, wide)) for one in row)
    return names + HISTOGRAM_SIZE[1] + 3 * LINE_HEIGHT * SIZE


def _pages(
    rows: Sequence[Sequence[Histogram]], wide: float, room: float
) -> Iterator[list[Sequence[Histogram]]]:
    """Rows that have room on a page [pt]."""
    page: list[Sequence[Histogram]] = []
    taken = 0.0
    for row in rows:
        high = _high(row, wide)
        if page and taken + high > room:
            yield page
            page, taken = [], 0.0
        page.append(row)
        taken += high
    yield page


def _draw(pen: Pen, one: Histogram) -> None:
    """A panel with its name, in all the room of a pen."""
    style, whole = pen.style, pen.size[0]
    up = ticks(0.0, max(one.counts) * 1.05, 4)
    up = [value for value in up if value == round(value)]
    left = widest(tick_texts(up)) + SIZE
    wide = whole - left - HISTOGRAM_GAP
    low, top = 1.6 * LINE_HEIGHT * SIZE, HISTOGRAM_SIZE[1]
    x, y = pen.corner
    across = AxisScale(*_apart(one.edges))
    own = pen.panel(
        (x + left, y + low), (wide, top), across, AxisScale(0.0, max(one.counts) * 1.05)
    )
    own = own.within("panel", name=one.name)
    numbers_across = ticks(across.low, across.high, 4)
    while len(numbers_across) > 2 and _crowded(numbers_across, own):
        numbers_across = numbers_across[::2]
    own.scale("bottom", numbers_across)
    own.scale("left", up, grid=True)
    for (begin, end), count in zip(pairwise(one.edges.tolist()), one.counts, strict=True):
        bar = own.within("bar", **{"from": f"{begin:.9g}", "to": f"{end:.9g}", "count": str(count)})
        place = own.across(begin), 0.0
        size = own.across(end) - own.across(begin), own.up(count)
        said = f"{one.name}: {number(begin)} … {number(end)}: {count}"
        face: Look = {"facecolor": style.power, "edgecolor": style.paper, "width": 0.5}
        bar.box(place, size, title=said, **face)
    own.frame("left", "bottom")
    for part, value in zip(PARTS, one.told.quantiles, strict=True):
        at = own.across(value)
        said = f"{100 * part:g} %: {number(value)}"
        own.line((at, 0.0), (at, top), title=said, **_quantile(style))
    mean = own.across(one.told.mean)
    own.line((mean, 0.0), (mean, top), title=number(one.told.mean), **_mean(style))
    pen.text(0.0, low + top + 5, _head(one, whole), va="bottom", bold=False)


def _apart(edges: Floats) -> tuple[float, float]:
    low, high = float(edges[0]), float(edges[-1])
    room = 0.02 * (high - low)
    return low - room, high + room


def _crowded(values: Sequence[float], pen: Pen) -> bool:
    """Whether numbers of a scale would touch one another."""
    step = abs(pen.across(values[1]) - pen.across(values[0]))
    return math.isfinite(step) and widest(tick_texts(values)) + SIZE / 2 > step
