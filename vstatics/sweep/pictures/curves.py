"""Curves: columns over one varied number, a line for each gear or each value of another column."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.tables.written_results import GEAR_NUMBER, WrittenSweep
from vstatics.pictures.drawing.ends import LineEnd, beside, height_of, width_of
from vstatics.pictures.drawing.head import sheet_head
from vstatics.pictures.drawing.labels import height, ticks, widest, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, Style
from vstatics.pictures.drawing.tolerances import SAME_CURVE
from vstatics.sweep.pictures.columns import (
    DrawnColumns,
    DrawnRows,
    axis,
    numbers,
    parts,
    results_of,
    running,
)

CURVES_HEIGHT = 130.0
"""Of a panel, at least. [pt]"""
CURVES_SCALE_WIDTH, CURVES_SCALE_HEIGHT = 58.0, 40.0
"""For the scales. [pt]"""
PANEL_GAP = 14.0
"""Between panels. [pt]"""
CURVE_NAME_WIDTH = 110.0
"""Names of lines are wrapped to it. [pt]"""
CURVES_ROOM = 0.05
"""Over and below the lines, as a part of their range."""
MOST_CURVES = 12
"""Lines of a panel; of more values as many are drawn, evenly chosen."""
MOST_PANELS = 6
"""So many columns are drawn where none is named."""


class Curve(NamedTuple):
    """A line: NaN where there is no operation."""

    names: tuple[str, ...]
    """Of all that coincide."""
    x: Floats
    y: Floats
    look: Look

    @property
    def name(self) -> str:
        """All names; of many the first and the last.

        >>> Curve(tuple("abcd"), np.zeros(1), np.zeros(1), {}).name
        'a … d'
        """
        first, *others = self.names
        return ", ".join(self.names) if len(others) < 2 else f"{first} … {others[-1]}"


def draw(sweep: WrittenSweep, style: Style, asked: DrawnColumns) -> list[Figure]:
    """Draw a panel for each column, below one another.

    Raises
    ------
    CaseError
        If a column is none, or there is nothing to draw.
    """
    by = asked.by or _tells_lines(sweep, asked)
    x = axis(sweep, asked.x, [by], "--x")
    names = list(asked.y) or results_of(sweep, [x, by])[:MOST_PANELS]
    if not names:
        raise CaseError("E433", "the sweep has no column beside its varied numbers to draw")
    every = parts(sweep, asked._replace(by=by), (x,))
    places = np.linspace(0, len(every) - 1, min(len(every), MOST_CURVES)).round().astype(int)
    shown = [every[place] for place in places]
    across = numbers(sweep, x)
    panels = [_curves(numbers(sweep, name), across, shown, style) for name in names]
    if not any(np.isfinite(one.y).any() for panel in panels for one in panel):
        raise CaseError("E433", "no row of the sweep has a number to draw")
    more = style.text("lines are drawn, of")
    note = f"{len(shown)} {more} {len(every)}" * (len(shown) < len(every))
    known = across[np.isfinite(across)]
    scale = AxisScale(*_apart(float(known.min()), float(known.max())))
    head = sheet_head(", ".join(names), note, [], style.width - 2 * MARGIN, style)
    ends = [_line_ends(panel) for panel in panels]
    highs = [max(CURVES_HEIGHT, height_of(one)) + PANEL_GAP for one in ends]
    wide = style.width - CURVES_SCALE_WIDTH - max(map(width_of, ends)) - MARGIN
    room = style.height - head.high - MARGIN - CURVES_SCALE_HEIGHT
    figures = []
    for some in _together(highs, room):
        low = CURVES_SCALE_HEIGHT
        up = low + sum(highs[place] for place in some)
        pen = head.over((style.width, up), MARGIN, style)
        for place in reversed(some):
            corner, size = (CURVES_SCALE_WIDTH, low), (wide, highs[place] - PANEL_GAP)
            below = x * (place == some[-1])
            _draw(pen.panel(corner, size, scale), panels[place], names[place], below)
            low += highs[place]
        figures.append(pen.figure)
    return figures


def _together(highs: Sequence[float], room: float) -> list[list[int]]:
    """Panels that fit a page together, by their heights.

    >>> _together([2.0, 2.0, 2.0], 5.0)
    [[0, 1], [2]]
    """
    found: list[list[int]] = [[]]
    for place, high in enumerate(highs):
        if found[-1] and sum(highs[one] for one in found[-1]) + high > room:
            found.append([])
        found[-1].append(place)
    return found


def _tells_lines(sweep: WrittenSweep, asked: DrawnColumns) -> str:
    """The column by which rows are parted to lines where none is named: the other varied number."""
    if sweep.gears:
        return ""
    left = running(sweep, [asked.x])
    return left[0] if asked.x and len(left) == 1 and asked.x in running(sweep) else ""


def _curves(
    column: Floats, across: Floats, shown: Sequence[DrawnRows], style: Style
) -> list[Curve]:
    """The lines of a panel; those that coincide are one with all names."""
    found: list[Curve] = []
    for part in shown:
        rows = np.array(part.rows)[np.argsort(across[part.rows], kind="stable")]
        x, y = across[rows], column[rows]
        same = next((place for place, one in enumerate(found) if _coincide(one, x, y)), None)
        if same is None:
            look = {"color": style.colour(len(found)), "linestyle": style.dash(len(found))}
            found.append(Curve((part.name,), x, y, look))
        else:
            found[same] = found[same]._replace(names=(*found[same].names, part.name))
    return found


def _coincide(one: Curve, x: Floats, y: Floats) -> bool:
    size = np.nanmax(np.abs(y), initial=0.0)
    return np.array_equal(one.x, x) and np.allclose(
        one.y, y, rtol=0, atol=SAME_CURVE * size, equal_nan=True
    )


def _apart(low: float, high: float) -> tuple[float, float]:
    """The ends of a scale, apart where all values are one."""
    room = CURVES_ROOM * (high - low) or CURVES_ROOM * abs(high) or 1.0
    return low - room, high + room


def _range(curves: Sequence[Curve]) -> tuple[float, float]:
    every = np.concatenate([one.y[np.isfinite(one.y)] for one in curves])
    return _apart(float(every.min()), float(every.max())) if every.size else (0.0, 1.0)


def _line_ends(curves: Sequence[Curve]) -> list[LineEnd]:
    """The names of lines, where each leaves its panel."""
    low, high = _range(curves)
    found = []
    for one in curves:
        known = one.y[np.isfinite(one.y)]
        if one.name and known.size:
            part = (float(known[-1]) - low) / (high - low)
            found.append(LineEnd(part, (wrapped(one.name, CURVE_NAME_WIDTH),), (one.look,)))
    return found


def _draw(pen: Pen, curves: Sequence[Curve], name: str, below: str) -> None:
    """A panel; the lowest one has the numbers and the name of what is across."""
    pen = pen._replace(y=AxisScale(*_range(curves)))
    (wide, high), style = pen.size, pen.style
    across = ticks(pen.x.low, pen.x.high, max(int(wide / 50), 2))
    up = ticks(pen.y.low, pen.y.high, max(int(high / (2 * height(""))), 2))
    pen.scale("bottom", across, None if below else [], grid=True)
    pen.scale("left", up, grid=True)
    pen.frame()
    for one in curves:
        line = _stepped(one) if name == GEAR_NUMBER else (one.x, one.y)
        pen.plot(*line, title=f"{one.name} {name}".strip(), **one.look)
        alone = _alone(one.y)
        look = {"color": style.ink, "marker": "o", "markersize": 2.5, "linestyle": ""}
        if alone.any():
            places = zip(one.x[alone].tolist(), one.y[alone].tolist(), strict=True)
            pen.line(*((pen.across(x), pen.up(y)) for x, y in places), **{**one.look, **look})
    pen.name("left", wrapped(name, high), widest(tick_texts(up)) + 18)
    if below:
        pen.name("bottom", below, 26)
    beside(pen, "right", _line_ends(curves))


def _stepped(one: Curve) -> tuple[Floats, Floats]:
    """A line that stays at each value up to the middle between two, as there is no gear 2.4."""
    middles = np.repeat((one.x[1:] + one.x[:-1]) / 2, 2)
    return np.concatenate([one.x[:1], middles, one.x[-1:]]), np.repeat(one.y, 2)


def _alone(values: Floats) -> Booleans:
    """Points without a neighbour, of which no line would be seen."""
    there = np.isfinite(values)
    before, after = np.append([False], there[:-1]), np.append(there[1:], [False])
    alone: Booleans = there & ~before & ~after
    return alone
