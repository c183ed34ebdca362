"""Histograms of the numbers of a sweep or of samples, with a panel for each column.

Lines show the mean and the quantiles that `vstatics simulate --samples` prints.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.groups import filled
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.written_results import WrittenSweep
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.head import headed, sheet_head
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, ticks, widest, wrapped
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style, number
from vstatics.sweep.pictures.columns import DrawnColumns, numbers, results_of, rows_by
from vstatics.sweep.results.statistics import PARTS, Statistics, statistics

HISTOGRAM_SIZE = (132.0, 84.0)
"""Smallest width of a panel with the scale, and height without the scale. [pt]"""
HISTOGRAM_GAP = 10.0
"""Distance between neighbouring panels. [pt]"""
MOST_HISTOGRAM_BARS = 30
"""Largest number of bars in a panel."""
MOST_HISTOGRAMS = 24
"""Largest number of panels, unless the user names columns."""


class Histogram(NamedTuple):
    """Histogram of the numbers of a column."""

    name: str
    statistics: Statistics
    edges: Floats
    """Edges of the bars, shape (bars + 1,)."""
    counts: Sequence[int]


def histogram(name: str, values: Floats) -> Histogram:
    """Count the values of a column in bars of equal width. NumPy chooses the number of bars.

    >>> bars = histogram("x", np.array([0.0, 1.0, 1.0, 2.0, 2.0, 2.0]))
    >>> bars.edges.tolist(), bars.counts
    ([0.0, 0.5, 1.0, 1.5, 2.0], [1, 0, 2, 3])
    """
    edges = np.histogram_bin_edges(values, "auto")
    bars = min(len(edges) - 1, MOST_HISTOGRAM_BARS)
    counts, edges = np.histogram(values, bars)
    return Histogram(name, statistics(values), edges, counts.tolist())


def draw(sweep: WrittenSweep, style: Style, selected: DrawnColumns) -> list[Canvas]:
    """Draw a histogram for each column of a sweep.

    Raises
    ------
    CaseError
        If a column does not exist, or nothing can be drawn.
    """
    every = list(_histograms(sweep, selected))
    if not every:
        raise CaseError("E433", "no column of the sweep has different numbers to draw")
    shown = every if selected.y else every[:MOST_HISTOGRAMS]
    words = widest(word for item in shown for word in item.name.split(" "))
    least = max(HISTOGRAM_SIZE[0], words) + HISTOGRAM_GAP
    across = max(1, int((style.width - 2 * MARGIN + HISTOGRAM_GAP) // least))
    rows = [shown[at : at + across] for at in range(0, len(shown), across)]
    title = style.text("Histograms")
    note = style.text("{count} variant|{count} variants", count=len(set(sweep.variants)))
    if len(shown) < len(every):
        note += f"; {style.text('columns')}: {len(shown)} / {len(every)}"
    figures, wide = [], (style.width - 2 * MARGIN + HISTOGRAM_GAP) / across
    quantiles = ", ".join(f"{100 * part:g}" for part in PARTS)
    key = [
        (True, "mean", _mean(style)),
        (True, style.text("{parts} % are below", parts=quantiles), _quantile(style)),
    ]
    head = sheet_head(title, note, key, style.width - 2 * MARGIN, style).high
    highs = [_high(row, wide) for row in rows]
    room = style.height - head - 1.5 * MARGIN
    for page in filled(range(len(highs)), room, highs.__getitem__):
        top = sum(highs[place] for place in page) + MARGIN / 2
        pen = headed(title, note, key, (style.width, top), style)
        for place in page:
            low = top - highs[place]
            for column, item in enumerate(rows[place]):
                _draw(pen.panel((MARGIN + column * wide, low), (wide, highs[place])), item)
            top = low
        figures.append(pen.canvas)
    return figures


def _histograms(sweep: WrittenSweep, selected: DrawnColumns) -> Iterator[Histogram]:
    """Yield histograms of results, then of varied numbers; a constant column only if named."""
    names = list(selected.y) or [*results_of(sweep, [selected.by]), *sweep.varied]
    for name in names:
        column = numbers(sweep, name)
        for part in rows_by(sweep, selected):
            values = column[list(part.rows)]
            values = values[np.isfinite(values)]
            if len(values) and (selected.y or statistics(values).deviation > 0):
                yield histogram(", ".join(filter(None, (name, part.name))), values)


def _mean(style: Style) -> Look:
    return {"color": style.engaged, "width": 1.2}


def _quantile(style: Style) -> Look:
    return {"color": style.ink, "width": 0.9, "linestyle": (0, (3, 2))}


def _head(item: Histogram, wide: float) -> str:
    return wrapped(item.name, wide - HISTOGRAM_GAP)


def _high(row: Sequence[Histogram], wide: float) -> float:
    names = max(height(_head(item, wide)) for item in row)
    return names + HISTOGRAM_SIZE[1] + 3 * LINE_HEIGHT * SIZE


def _draw(pen: Pen, item: Histogram) -> None:
    style, whole = pen.style, pen.size[0]
    upward = AxisScale(0.0, max(item.counts) * 1.05)
    up = [value for value in ticks(upward.low, upward.high, 4) if value == round(value)]
    left = widest(tick_texts(up)) + SIZE
    wide = whole - left - HISTOGRAM_GAP
    low, top = 1.6 * LINE_HEIGHT * SIZE, HISTOGRAM_SIZE[1]
    x, y = pen.corner
    low_edge, high_edge = float(item.edges[0]), float(item.edges[-1])
    gap = 0.02 * (high_edge - low_edge)
    across = AxisScale(low_edge - gap, high_edge + gap)
    panel = pen.panel((x + left, y + low), (wide, top), across, upward)
    panel = panel.within("panel", name=item.name)
    numbers_across = ticks(across.low, across.high, 4)
    while len(numbers_across) > 2 and _crowded(numbers_across, panel):
        numbers_across = numbers_across[::2]
    panel.scale("bottom", numbers_across)
    panel.scale("left", up, grid=True)
    for (begin, end), count in zip(pairwise(item.edges.tolist()), item.counts, strict=True):
        bar = panel.within(
            "bar", **{"from": f"{begin:.9g}", "to": f"{end:.9g}", "count": str(count)}
        )
        place = panel.across(begin), 0.0
        size = panel.across(end) - panel.across(begin), panel.up(count)
        title = f"{item.name}: {number(begin)} … {number(end)}: {count}"
        face: Look = {"facecolor": style.power, "edgecolor": style.paper, "width": 0.5}
        bar.box(place, size, title=title, **face)
    panel.frame("left", "bottom")
    for part, value in zip(PARTS, item.statistics.quantiles, strict=True):
        at = panel.across(value)
        title = f"{100 * part:g} %: {number(value)}"
        panel.line((at, 0.0), (at, top), title=title, **_quantile(style))
    mean = panel.across(item.statistics.mean)
    panel.line((mean, 0.0), (mean, top), title=number(item.statistics.mean), **_mean(style))
    pen.text(0.0, low + top + 5, _head(item, whole), va="bottom", bold=False)


def _crowded(values: Sequence[float], pen: Pen) -> bool:
    step = abs(pen.across(values[1]) - pen.across(values[0]))
    return math.isfinite(step) and widest(tick_texts(values)) + SIZE / 2 > step
