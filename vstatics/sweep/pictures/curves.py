"""Plot of results of a sweep over a varied number: a curve for each gear or other number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.groups import filled
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.tables.written_results import GEAR, GEAR_NUMBER, WrittenSweep
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.ends import LineEnd, beside, height_of, width_of
from vstatics.pictures.drawing.head import sheet_head
from vstatics.pictures.drawing.labels import height, ticks, widest, wrapped
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
"""Smallest height of a panel. [pt]"""
CURVES_SCALE_WIDTH, CURVES_SCALE_HEIGHT = 58.0, 40.0
"""Width and height of the scales of a panel. [pt]"""
PANEL_GAP = 14.0
"""Vertical distance between panels. [pt]"""
CURVE_NAME_WIDTH = 110.0
"""Width to which names of curves are wrapped. [pt]"""
CURVES_ROOM = 0.05
"""Space above and below the curves, relative to the range of values. [-]"""
MOST_CURVES = 12
"""Largest number of curves in a panel; of more curves, an even selection is drawn."""
MOST_PANELS = 6
"""Largest number of panels, unless the user names columns."""


class Curve(NamedTuple):
    """Curve of a panel; NaN where there is no value."""

    names: tuple[str, ...]
    """Names of the curve, several if curves coincide."""
    x: Floats
    y: Floats
    look: Look

    @property
    def name(self) -> str:
        """Names of the curve as a single text; of four or more names, only the first and the last.

        >>> Curve(tuple("abcd"), np.zeros(1), np.zeros(1), {}).name
        'a … d'
        """
        first, *others = self.names
        return ", ".join(self.names) if len(others) < 2 else f"{first} … {others[-1]}"


def draw(sweep: WrittenSweep, style: Style, selected: DrawnColumns) -> list[Canvas]:
    """Draw a panel of curves for each column of a sweep, stacked on pages.

    Raises
    ------
    CaseError
        If a column does not exist, or nothing can be drawn.
    """
    by = selected.by or _column_of_curves(sweep, selected)
    x = axis(sweep, selected.x, [by], "--x")
    names = list(selected.y) or results_of(sweep, [x, by])[:MOST_PANELS]
    if not names:
        raise CaseError("E433", "the sweep has no column to draw apart from its varied numbers")
    every = parts(sweep, selected._replace(by=by), (x,))
    places = np.linspace(0, len(every) - 1, min(len(every), MOST_CURVES)).round().astype(int)
    shown = [every[place] for place in places]
    across = numbers(sweep, x)
    panels = [_curves(numbers(sweep, name), across, shown, style) for name in names]
    if not any(np.isfinite(curve.y).any() for panel in panels for curve in panel):
        raise CaseError("E433", "no row of the sweep has a number to draw")
    if not np.isfinite(across).any():
        raise CaseError("E433", f"no row of the sweep has {x}, so there is nothing to draw")
    more = style.text("lines are drawn, of")
    note = f"{len(shown)} {more} {len(every)}" * (len(shown) < len(every))
    scale = _scale(across)
    head = sheet_head(", ".join(names), note, [], style.width - 2 * MARGIN, style)
    ends = [_line_ends(panel) for panel in panels]
    highs = [max(CURVES_HEIGHT, height_of(labels)) + PANEL_GAP for labels in ends]
    wide = style.width - CURVES_SCALE_WIDTH - max(map(width_of, ends)) - MARGIN
    room = style.height - head.high - MARGIN - CURVES_SCALE_HEIGHT
    figures = []
    for some in filled(range(len(highs)), room, highs.__getitem__):
        low = CURVES_SCALE_HEIGHT
        up = low + sum(highs[place] for place in some)
        pen = head.over((style.width, up), MARGIN, style)
        for place in reversed(some):
            corner, size = (CURVES_SCALE_WIDTH, low), (wide, highs[place] - PANEL_GAP)
            below = x * (place == some[-1])
            gears = sweep.gear_names if names[place] == GEAR_NUMBER else {}
            _draw(pen.panel(corner, size, scale), panels[place], names[place], below, gears)
            low += highs[place]
        figures.append(pen.canvas)
    return figures


def _column_of_curves(sweep: WrittenSweep, selected: DrawnColumns) -> str:
    """Return the column that distinguishes curves: by default the only other varied number."""
    if sweep.gears:
        return ""
    left = running(sweep, [selected.x])
    return left[0] if selected.x and len(left) == 1 and selected.x in running(sweep) else ""


def _curves(
    column: Floats, across: Floats, shown: Sequence[DrawnRows], style: Style
) -> list[Curve]:
    """Return the curves of a panel. Coinciding curves become a single curve with all names."""
    curves: list[Curve] = []
    for part in shown:
        rows = np.array(part.rows)[np.argsort(across[part.rows], kind="stable")]
        x, y = across[rows], column[rows]
        same = next((place for place, curve in enumerate(curves) if _coincide(curve, x, y)), None)
        if same is None:
            look = {"color": style.colour(len(curves)), "linestyle": style.dash(len(curves))}
            curves.append(Curve((part.name,), x, y, look))
        else:
            curves[same] = curves[same]._replace(names=(*curves[same].names, part.name))
    return curves


def _coincide(curve: Curve, x: Floats, y: Floats) -> bool:
    size = np.nanmax(np.abs(y), initial=0.0)
    return np.array_equal(curve.x, x) and np.allclose(
        curve.y, y, rtol=0, atol=SAME_CURVE * size, equal_nan=True
    )


def _scale(values: Floats) -> AxisScale:
    """Return the scale for values, with space at both ends, also if all values are equal."""
    known = values[np.isfinite(values)]
    if not known.size:
        return AxisScale(0.0, 1.0)
    low, high = float(known.min()), float(known.max())
    room = CURVES_ROOM * (high - low) or CURVES_ROOM * abs(high) or 1.0
    return AxisScale(low - room, high + room)


def _line_ends(curves: Sequence[Curve]) -> list[LineEnd]:
    scale = _scale(np.concatenate([curve.y for curve in curves]))
    labels = []
    for curve in curves:
        known = curve.y[np.isfinite(curve.y)]
        if curve.name and known.size:
            part = (float(known[-1]) - scale.low) / (scale.high - scale.low)
            labels.append(LineEnd(part, (wrapped(curve.name, CURVE_NAME_WIDTH),), (curve.look,)))
    return labels


def _draw(
    pen: Pen, curves: Sequence[Curve], name: str, below: str, gears: Mapping[float, str]
) -> None:
    """Draw a panel. `below` is the name of the horizontal axis, or empty."""
    pen = pen._replace(y=_scale(np.concatenate([curve.y for curve in curves])))
    (wide, high), style = pen.size, pen.style
    across = ticks(pen.x.low, pen.x.high, max(int(wide / 50), 2))
    up = ticks(pen.y.low, pen.y.high, max(int(high / (2 * height(""))), 2))
    up = [tick for tick in up if name != GEAR_NUMBER or tick.is_integer()]
    pen.scale("bottom", across, None if below else [], grid=True)
    texts, heading = [gears.get(tick, "") for tick in up], GEAR
    if not gears or widest(texts) > CURVES_SCALE_WIDTH / 2:
        texts, heading = tick_texts(up), name
    pen.scale("left", up, texts, grid=True)
    pen.frame()
    for curve in curves:
        line = _stepped(curve) if name == GEAR_NUMBER else (curve.x, curve.y)
        pen.plot(*line, title=f"{curve.name} {name}".strip(), **curve.look)
        isolated = _isolated(curve.y)
        look = {"color": style.ink, "marker": "o", "markersize": 2.5, "linestyle": ""}
        if isolated.any():
            places = zip(curve.x[isolated].tolist(), curve.y[isolated].tolist(), strict=True)
            pen.line(*((pen.across(x), pen.up(y)) for x, y in places), **{**curve.look, **look})
    pen.name("left", wrapped(heading, high), widest(texts) + 18)
    if below:
        pen.name("bottom", below, 26)
    beside(pen, "right", _line_ends(curves))


def _stepped(curve: Curve) -> tuple[Floats, Floats]:
    """Return a stepped curve, for a horizontal axis that only has whole numbers."""
    middles = np.repeat((curve.x[1:] + curve.x[:-1]) / 2, 2)
    return np.concatenate([curve.x[:1], middles, curve.x[-1:]]), np.repeat(curve.y, 2)


def _isolated(values: Floats) -> Booleans:
    """Return a mask of points without a neighbour, which a line would not show."""
    exists = np.isfinite(values)
    before, after = np.append([False], exists[:-1]), np.append(exists[1:], [False])
    isolated: Booleans = exists & ~before & ~after
    return isolated
