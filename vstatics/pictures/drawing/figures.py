"""Canvas as a figure of matplotlib, for PNG, PDF and changes by the user."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Affine2D, Bbox, TransformedBbox

from vstatics.pictures.drawing.canvas import (
    Canvas,
    CanvasArea,
    CanvasLine,
    CanvasText,
    Outline,
    PartMark,
)
from vstatics.pictures.drawing.metrics import POINTS_PER_INCH
from vstatics.pictures.drawing.svg import HALO

_CODES = {
    "M": Path.MOVETO,
    "L": Path.LINETO,
    "Q": Path.CURVE3,
    "C": Path.CURVE4,
    "z": Path.CLOSEPOLY,
}


def figure_of(canvas: Canvas) -> Figure:
    """Return a canvas as a figure. The ``gid`` of an artist is the SVG title and groups as JSON.

    >>> from vstatics.pictures.drawing.pen import blank
    >>> from vstatics.pictures.drawing.style import Style
    >>> pen = blank(144.0, 72.0, Style())
    >>> pen.text(1.0, 2.0, "sun")
    >>> figure = figure_of(pen.canvas)
    >>> figure.get_size_inches().tolist(), figure.texts[0].get_position()
    ([2.0, 1.0], (1.0, 2.0))
    """
    wide, high = (length / POINTS_PER_INCH for length in canvas.size)
    figure = Figure(figsize=(wide, high))
    for shape, place, mark in canvas.parts:
        inches = Affine2D().scale(place.part).translate(place.left, place.low)
        inches.scale(1 / POINTS_PER_INCH)
        points = inches + figure.dpi_scale_trans
        named: dict[str, Any] = {"transform": points, "zorder": shape.order, "gid": _said(mark)}
        match shape:
            case CanvasText():
                _write(figure, shape, canvas.style.paper, named)
            case CanvasLine():
                line = Line2D(shape.xs, shape.ys, **named | shape.look)
                figure.add_artist(line)
                if shape.clip is not None:
                    (left, low), size = shape.clip
                    line.set_clip_box(TransformedBbox(Bbox.from_bounds(left, low, *size), points))
            case CanvasArea(outline, look):
                figure.add_artist(_patch(outline, named | look))
    return figure


def _patch(outline: Outline, look: dict[str, Any]) -> Patch:
    points = np.asarray(outline.points)
    if outline.steps.replace("L", "") == "Mz":
        return Polygon(points, **look)
    return PathPatch(Path(points, [_CODES[step] for step in outline.steps]), **look)


def _write(figure: Figure, letters: CanvasText, paper: str, named: dict[str, Any]) -> None:
    named |= letters.look
    if letters.has_halo:
        named["path_effects"] = [withStroke(linewidth=HALO, foreground=paper)]
    figure.text(
        *letters.at,
        letters.text,
        fontsize=letters.size,
        weight="bold" if letters.is_bold else "normal",
        **named,
    )


def _said(mark: PartMark) -> str | None:
    said = {**mark._asdict(), "data": dict(mark.data)}
    return json.dumps(said, ensure_ascii=False) if mark.title or mark.kind or mark.groups else None
