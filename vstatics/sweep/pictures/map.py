"""Map of a sweep: contours of a column over two varied numbers, and the limit of operation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from contourpy import contour_generator
from matplotlib.tri import LinearTriInterpolator, Triangulation

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.numbers import typeset
from vstatics.core.tables.written_results import WrittenSweep
from vstatics.pictures.drawing.canvas import Canvas, Look, Outline, Point
from vstatics.pictures.drawing.head import sheet_head
from vstatics.pictures.drawing.labels import height, ticks, widest, width
from vstatics.pictures.drawing.line_styles import mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SMALL_NUMBER, Style
from vstatics.sweep.pictures.columns import (
    DrawnColumns,
    axis,
    numbers,
    parts,
    results_of,
    running,
)

MAP_SIZE = (300.0, 230.0)
"""Greatest width and height of a panel. [pt]"""
MAPS_SIDE_BY_SIDE = 2
MAP_SCALE_WIDTH, MAP_SCALE_HEIGHT = 58.0, 44.0
"""Width and height of the scales of a panel. [pt]"""
MAP_HEAD_HEIGHT = 22.0
"""Height of the name of the gear above a panel. [pt]"""
MAP_LEVELS = 9
"""Approximate number of contours."""
MOST_LEVELS = 16
"""Number of contours at equal steps, if `MAP_LEVELS` contours leave a crowded band."""
CROWDED_BAND = 0.35
"""Fraction of all values in one band above which levels follow quantiles, not equal steps."""
LEAST_BAND = 0.02
"""Smallest width of a band, as a fraction of the range of values."""
LEAST_FILLED = 0.5
"""Smallest fraction of filled places at which points count as a rectangular grid."""
GRID_OF_POINTS = 121
"""Number of interpolated values in each direction, for points that do not form a grid."""
PLACES_TRIED = 48
"""Number of places on a line that are tried for its label."""


class Surface(NamedTuple):
    """Values of a column on a grid, NaN for points without operation."""

    name: str
    x: Floats
    y: Floats
    z: Floats
    """Values of shape (y, x)."""
    instead: str
    """Text that replaces a surface without any number."""


def draw(sweep: WrittenSweep, style: Style, selected: DrawnColumns) -> list[Canvas]:
    """Draw a map for each gear or value of a column, all with equal levels.

    Raises
    ------
    CaseError
        If a column does not exist, or nothing can be drawn.
    """
    upward = next(iter(selected.y), "")
    left = running(sweep, [upward, selected.by])
    x = selected.x or (left[0] if len(left) == 2 - bool(upward) else "")
    x = axis(sweep, x, [upward, selected.by], "--x")
    y = axis(sweep, upward, [x, selected.by], "--y")
    z = selected.z or next(iter(results_of(sweep, [x, y, selected.by])), "")
    if not z:
        raise CaseError("E433", "the sweep has no column to draw apart from its varied numbers")
    surfaces = []
    for part in parts(sweep, selected, (x, y)):
        grid = _grid(*(numbers(sweep, name)[part.rows] for name in (x, y, z)))
        statuses = ", ".join(dict.fromkeys(sweep.status[row] for row in part.rows))
        surfaces.append(Surface(part.name, *grid, f"{style.text('no number')}: {statuses}"))
    values = np.concatenate([surface.z[np.isfinite(surface.z)] for surface in surfaces])
    if not values.size:
        raise CaseError("E433", f"no row of the sweep has {z}, so there is nothing to draw")
    levels = contour_levels(values)
    scales = _axis_scale(surfaces, "x"), _axis_scale(surfaces, "y")
    limits = any(0 < np.isfinite(surface.z).mean() < 1 for surface in surfaces)
    meanings = [(limits, "limit of operation", _limit_look(style))]

    columns = min(len(surfaces), MAPS_SIDE_BY_SIDE)
    wide = min(MAP_SIZE[0], (style.width - MARGIN) / columns - MAP_SCALE_WIDTH - MARGIN)
    size = wide, wide * MAP_SIZE[1] / MAP_SIZE[0]
    up = MAP_HEAD_HEIGHT * bool(surfaces[0].name) + size[1] + MAP_SCALE_HEIGHT
    pitch = MAP_SCALE_WIDTH + wide + MARGIN
    across = columns * pitch + MARGIN
    head = sheet_head(f"{z}: {x}, {y}", "", meanings, across - 2 * MARGIN, style)
    most = columns * int(min(max(1, (style.height - head.high - MARGIN) // up), len(surfaces)))
    figures = []
    for start in range(0, len(surfaces), most):
        shown = surfaces[start : start + most]
        rows = math.ceil(len(shown) / columns)
        pen = head.over((across, rows * up), MARGIN, style)
        for place, surface in enumerate(shown):
            row, column = divmod(place, columns)
            corner = column * pitch + MAP_SCALE_WIDTH, (rows - 1 - row) * up + MAP_SCALE_HEIGHT
            _draw(pen.panel(corner, size, *scales), surface, levels, (x, y))
        figures.append(pen.canvas)
    return figures


def _grid(x: Floats, y: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
    """Return points as the axes of a grid and the values on it, interpolated if necessary.

    Raises
    ------
    CaseError
        If the points lie on a line.
    """
    known = np.isfinite(x) & np.isfinite(y)
    x, y, z = x[known], y[known], z[known]
    xs, column = np.unique(x, return_inverse=True)
    ys, row = np.unique(y, return_inverse=True)
    if min(len(xs), len(ys)) < 2:
        raise CaseError("E434", "a map needs two numbers that vary: use --kind curves")
    if len(x) >= LEAST_FILLED * len(xs) * len(ys):
        table = np.full((len(ys), len(xs)), np.nan)
        table[row, column] = z
        return xs, ys, table
    xs, ys = (np.linspace(points.min(), points.max(), GRID_OF_POINTS) for points in (x, y))
    exists = np.isfinite(z)
    try:
        net = Triangulation(x[exists], y[exists])
        drawn = LinearTriInterpolator(net, z[exists])(*np.meshgrid(xs, ys))
    except (ValueError, RuntimeError):
        raise CaseError("E434", "the points of the sweep span no area to draw a map on") from None
    return xs, ys, np.ma.filled(drawn, np.nan)


def contour_levels(values: Floats) -> list[float]:
    """Return round levels: equal steps, or levels near quantiles if a step has most values.

    Quantiles show efficiencies from 0.9 to 0.97 even if an efficiency of 0.5 occurs in a corner.

    >>> contour_levels(np.linspace(0.0, 10.0, 101))
    [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]
    >>> contour_levels(1 - 0.5 * np.linspace(0.0, 1.0, 1001) ** 8)
    [0.8, 0.9, 0.98]
    """
    low, high = float(values.min()), float(values.max())
    for most in (MAP_LEVELS, MOST_LEVELS):
        even = [tick for tick in ticks(low, high, most + 1) if low < tick < high]
        between, _ = np.histogram(values, [-math.inf, *even, math.inf])
        if between.max() <= CROWDED_BAND * len(values):
            return even
    quantiles = np.quantile(values, np.linspace(0.0, 1.0, MAP_LEVELS + 2)).tolist()
    levels: list[float] = []
    for before, quantile, after in zip(quantiles, quantiles[1:], quantiles[2:], strict=False):
        gap = min(quantile - before, after - quantile)
        if gap > LEAST_BAND * (high - low):
            unit = 10.0 ** math.floor(math.log10(gap))
            step = max(digit * unit for digit in (1, 2, 5) if digit * unit <= gap)
            level = float(f"{round(quantile / step) * step:.12g}")
            if before < level < after and level not in levels:
                levels.append(level)
    return levels


def _axis_scale(surfaces: Sequence[Surface], name: str) -> AxisScale:
    values = np.concatenate([getattr(surface, name) for surface in surfaces])
    return AxisScale(float(values.min()), float(values.max()))


def _draw(pen: Pen, surface: Surface, levels: Sequence[float], names: tuple[str, str]) -> None:
    (wide, high), style = pen.size, pen.style
    xs, ys = (
        (values - scale.low) / (scale.high - scale.low) * length
        for values, scale, length in (
            (surface.x, pen.x, wide),
            (surface.y, pen.y, high),
        )
    )
    hidden = np.ma.masked_invalid(surface.z)
    contours: Any = contour_generator(xs, ys, hidden, fill_type="OuterOffset")
    edges = [-math.inf, *levels, math.inf]
    for place, (low, up) in enumerate(pairwise(edges)):
        colour = mixed(style.power, style.paper, 0.1 + 0.9 * place / max(len(levels), 1))
        _fill(pen, contours.filled(low, up), colour)
    taken: list[tuple[float, float, float, float]] = []
    for level in levels:
        text = typeset(f"{level:g}")
        lines = contours.lines(level)
        for piece in lines:
            places = [(float(x), float(y)) for x, y in piece]
            pen.line(*places, width=0.7, color=style.ink, title=f"{surface.name} {text}".strip())
        _label(pen, lines, text, taken)
    if hidden.mask is not np.ma.nomask and hidden.mask.any():
        bounds: Any = contour_generator(xs, ys, np.where(np.isfinite(surface.z), 1.0, 0.0))
        for piece in bounds.lines(0.5):
            pen.line(*((float(x), float(y)) for x, y in piece), **_limit_look(style))
    _scales(pen, names)
    pen.text(0, high + 8, surface.name, va="bottom", bold=True)
    if not np.isfinite(surface.z).any():
        pen.text(wide / 2, high / 2, surface.instead, ha="center", va="center")


def _limit_look(style: Style) -> Look:
    return {"color": style.lost, "width": 1.8}


def _fill(pen: Pen, filled: tuple[Sequence[Any], Sequence[Any]], colour: str) -> None:
    """Fill the polygons of a band between two levels, without their holes."""
    left, low = pen.corner
    for points, offsets in zip(*filled, strict=True):
        steps = np.full(len(points), "L")
        steps[offsets[:-1]] = "M"
        steps[offsets[1:] - 1] = "z"
        outline = Outline(points + np.array([left, low]), "".join(steps.tolist()))
        pen.fill(outline, facecolor=colour, edgecolor=colour, width=0.2, zorder=0.2)


def _label(
    pen: Pen,
    lines: Sequence[Floats],
    text: str,
    taken: list[tuple[float, float, float, float]],
) -> None:
    """Label a level on its longest line, near the middle, where the text covers no other label.

    A label at the edge of the panel is moved inward.
    """
    long, tall = width(text, SMALL_NUMBER) + 3, 1.2 * SMALL_NUMBER
    half, up = long / 2, tall / 2
    for at in _places(lines):
        x = min(max(at[0], half), pen.size[0] - half)
        y = min(max(at[1], up), pen.size[1] - up)
        box = x - half, y - up, x + half, y + up
        if not any(
            box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
            for other in taken
        ):
            taken.append(box)
            centred: Look = {"ha": "center", "va": "center_baseline"}
            pen.text(x, y, text, size=SMALL_NUMBER, over=True, **centred)
            return


def _places(lines: Sequence[Floats]) -> Iterator[Point]:
    """Yield possible points of labels along lines, first the middle of the longest line."""
    for piece in sorted(lines, key=lambda line: -_along(line)[-1]):
        along = _along(piece)
        places = np.linspace(0.0, along[-1], PLACES_TRIED + 1)
        for at in sorted(places, key=lambda distance: abs(distance - along[-1] / 2)):
            yield float(np.interp(at, along, piece[:, 0])), float(np.interp(at, along, piece[:, 1]))


def _along(piece: Floats) -> Floats:
    """Return the distance [pt] of each point from the start, along the line."""
    steps: Floats = np.hypot(*np.diff(piece, axis=0).T)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _scales(pen: Pen, names: tuple[str, str]) -> None:
    wide, high = pen.size
    across = ticks(pen.x.low, pen.x.high, max(int(wide / 50), 2))
    up = ticks(pen.y.low, pen.y.high, max(int(high / (3 * height(""))), 2))
    pen.scale("bottom", across)
    pen.scale("left", up)
    pen.frame()
    pen.name("bottom", names[0], 26)
    pen.name("left", names[1], widest(tick_texts(up)) + 16)
