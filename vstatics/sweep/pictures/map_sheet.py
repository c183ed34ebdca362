"""Sheets of maps: panels with common scales, filled with bands or regions, and a colour bar."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from contourpy import contour_generator

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.canvas import Canvas, Look, Outline, Point
from vstatics.pictures.drawing.head import Meaning, SheetHead, sheet_head
from vstatics.pictures.drawing.labels import (
    Segment,
    bold_width,
    height,
    ticks,
    widest,
    width,
    wrapped,
)
from vstatics.pictures.drawing.line_styles import mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, SMALL_NUMBER, Style
from vstatics.sweep.pictures.best_gear import GearRegion, deepest
from vstatics.sweep.pictures.overlays import Overlay, full_load_look, point_look

MAP_SIZE = (300.0, 230.0)
"""Largest width and height of a panel. [pt]"""
LEAST_MAP_WIDTH = 90.0
"""Width below which panels do not stand side by side. [pt]"""
MAPS_SIDE_BY_SIDE = 2
MAP_SCALE_WIDTH, MAP_SCALE_HEIGHT = 58.0, 44.0
"""Width and height of the scales of a panel. [pt]"""
MAP_HEAD_HEIGHT = 22.0
"""Height of the line with the name of the gear above a panel. [pt]"""
BAR_WIDTH, BAR_NAME_WIDTH = 10.0, 22.0
"""Width of the colour bar, and of the vertical name of the bar. [pt]"""
PLACES_TRIED = 48
"""Number of positions along a contour that are tried for the label."""
Box = tuple[float, float, float, float]
"""Left, lower, right and upper end of a label. [pt]"""


class Surface(NamedTuple):
    """Values of a column on a grid; NaN where there is no value."""

    name: str
    x: Floats
    y: Floats
    z: Floats
    """Values, shape (y, x)."""
    instead: str
    """Text to write instead of a map that has no number at all."""


class MapSheet(NamedTuple):
    """Panels of a map with common scales."""

    title: str
    surfaces: Sequence[Surface]
    paint: Callable[[Pen, Surface], None]
    """Function that draws the values of a surface into a panel."""
    meanings: Sequence[Meaning]
    levels: Sequence[float] = ()
    """Levels of the colour bar; empty without a bar."""
    bar: str = ""
    """Name of the colour bar."""

    @property
    def scales(self) -> tuple[AxisScale, AxisScale]:
        """Common scales of the axes of all panels."""
        x, y = zip(*(surface[1:3] for surface in self.surfaces), strict=True)
        return _scale_of(x), _scale_of(y)

    @property
    def bar_texts(self) -> Sequence[str]:
        """Texts of the numbers at the colour bar."""
        return tick_texts(self.levels)

    @property
    def bar_room(self) -> float:
        """Width of the colour bar with the texts [pt]; 0 without a colour bar."""
        texts = self.bar_texts
        return (BAR_WIDTH + 5 + widest(texts) + BAR_NAME_WIDTH + MARGIN) * bool(texts)


def map_pages(
    sheet: MapSheet, names: tuple[str, str], overlays: Sequence[Overlay], note: str, style: Style
) -> list[Canvas]:
    """Draw the panels of a map on pages, with common scales.

    Parameters
    ----------
    sheet : MapSheet
    names : tuple of str
        Names of the horizontal and the vertical axis.
    overlays : sequence of Overlay
        Operating points and full-load curves of each panel.
    note : str
        Text below the title.
    """
    surfaces = sheet.surfaces
    room, scales = style.width - MARGIN - sheet.bar_room, MAP_SCALE_WIDTH + MARGIN
    fitting = max(1, int(room // (LEAST_MAP_WIDTH + scales)))
    columns = min(len(surfaces), MAPS_SIDE_BY_SIDE, fitting)
    wide = min(MAP_SIZE[0], room / columns - scales)
    size = wide, wide * MAP_SIZE[1] / MAP_SIZE[0]
    heads = [wrapped(surface.name, wide, bold_width) for surface in surfaces]
    lines = max(map(height, heads)) - height("")
    up = (MAP_HEAD_HEIGHT + lines) * bool(heads[0]) + size[1] + MAP_SCALE_HEIGHT
    pitch = MAP_SCALE_WIDTH + wide + MARGIN
    across = columns * pitch + MARGIN + sheet.bar_room
    head = _head(sheet, overlays, note, across, style)
    most = columns * int(min(max(1, (style.height - head.high - MARGIN) // up), len(surfaces)))
    pages = []
    for start in range(0, len(surfaces), most):
        shown = range(start, min(start + most, len(surfaces)))
        rows = math.ceil(len(shown) / columns)
        pen = head.over((across, rows * up), MARGIN, style)
        for place, number in enumerate(shown):
            row, column = divmod(place, columns)
            corner = column * pitch + MAP_SCALE_WIDTH, (rows - 1 - row) * up + MAP_SCALE_HEIGHT
            panel = pen.panel(corner, size, *sheet.scales)
            _draw_panel(panel, sheet, surfaces[number], names)
            panel.text(0, size[1] + 8, heads[number], va="bottom", bold=True)
            overlays[number].draw(panel)
        bar = columns * pitch, (rows - 1) * up + MAP_SCALE_HEIGHT
        _draw_bar(pen.panel(bar, (BAR_WIDTH, size[1])), sheet)
        pages.append(pen.canvas)
    return pages


def _head(
    sheet: MapSheet, overlays: Sequence[Overlay], note: str, across: float, style: Style
) -> SheetHead:
    points, limits = ([getattr(each, name) for each in overlays] for name in ("gears", "limits"))
    meanings = [
        *sheet.meanings,
        (any(limits), "full load", full_load_look(style)),
        (any(points), "operating point", point_look(style)),
    ]
    return sheet_head(sheet.title, note, meanings, across - 2 * MARGIN, style)


def _scale_of(axes: Sequence[Floats]) -> AxisScale:
    values = np.concatenate(axes)
    return AxisScale(float(values.min()), float(values.max()))


def shade(place: int, last: int, style: Style) -> str:
    """Return the colour of a band or region, from light for index 0 to dark for the last index."""
    return mixed(style.power, style.paper, 0.1 + 0.9 * place / max(last, 1))


def _draw_panel(pen: Pen, sheet: MapSheet, surface: Surface, names: tuple[str, str]) -> None:
    (wide, high), style = pen.size, pen.style
    sheet.paint(pen, surface)
    exists = np.isfinite(surface.z)
    if not exists.all():
        pen.lines([*_ends(pen, surface)], **limit_look(style))
    _scales(pen, names)
    if not exists.any():
        pen.text(wide / 2, high / 2, surface.instead, over=True, ha="center", va="center")


def _ends(pen: Pen, surface: Surface) -> Iterator[Segment]:
    """Yield the border of the area with values, except along the edge of the panel."""
    contours = _contours_of(surface.z, *_places_of(pen, surface))
    for points, offsets in zip(*contours.filled(-math.inf, math.inf), strict=True):
        for start, end in pairwise(offsets):
            for (x, y), (next_x, next_y) in pairwise(points[start:end].tolist()):
                on_edge = (x == next_x and x in (0.0, pen.size[0])) or (
                    y == next_y and y in (0.0, pen.size[1])
                )
                if not on_edge:
                    yield (x, y), (next_x, next_y)


def _places_of(pen: Pen, surface: Surface) -> tuple[Floats, Floats]:
    """Return the positions in a panel of the columns and rows of a grid [pt]."""
    (wide, high), x, y = pen.size, pen.x, pen.y
    across: Floats = (surface.x - x.low) / (x.high - x.low) * wide
    up: Floats = (surface.y - y.low) / (y.high - y.low) * high
    return across, up


def _contours_of(values: Floats, across: Floats, up: Floats) -> Any:
    return contour_generator(across, up, np.ma.masked_invalid(values), fill_type="OuterOffset")


def paint_levels(pen: Pen, surface: Surface, levels: Sequence[float]) -> None:
    """Fill the bands between levels, and draw and label the contours."""
    contours = _contours_of(surface.z, *_places_of(pen, surface))
    edges = [-math.inf, *levels, math.inf]
    for place, (low, up) in enumerate(pairwise(edges)):
        _fill(pen, contours.filled(low, up), shade(place, len(levels), pen.style))
    taken: list[Box] = []
    for level, text in zip(levels, tick_texts(levels), strict=True):
        lines = contours.lines(level)
        title = f"{surface.name} {text}".strip()
        for piece in lines:
            pen.line(*piece.tolist(), width=0.7, color=pen.style.ink, title=title)
        _label(pen, lines, text, taken)


def paint_regions(
    pen: Pen, surface: Surface, regions: Sequence[GearRegion], colours: Mapping[str, str]
) -> None:
    """Fill the region of each gear, draw the border, and write the name of the gear inside."""
    places = _places_of(pen, surface)
    for region in regions:
        group = pen.within("gear", gear=region.gear)
        contours = _contours_of(region.lead, *places)
        _fill(group, contours.filled(0.0, math.inf), colours[region.gear])
        for piece in contours.lines(0.0):
            group.line(*piece.tolist(), width=1.0, color=pen.style.ink, zorder=0.3)
        row, column = deepest(region.lead > 0)
        at = float(places[0][column]), float(places[1][row])
        half = bold_width(region.gear) / 2
        x = min(max(at[0], half + 2), pen.size[0] - half - 2)
        y = min(max(at[1], SIZE / 2 + 2), pen.size[1] - SIZE / 2 - 2)
        if half < x:  # otherwise there is no room for the name, which is only in the key
            look: Look = {"ha": "center", "va": "center_baseline"}
            group.text(x, y, region.gear, bold=True, over=True, **look)


def limit_look(style: Style) -> Look:
    """Return the style of the border of the area with values."""
    return {"color": style.lost, "width": 1.8}


def _fill(pen: Pen, filled: tuple[Sequence[Any], Sequence[Any]], colour: str) -> None:
    """Fill the polygons of a band between two levels, without the holes."""
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
    taken: list[Box],
) -> None:
    """Label a contour on the longest line, near the middle, clear of other labels.

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
    """Yield positions of a label to try along lines, first the middle of the longest line."""
    for piece in sorted(lines, key=lambda line: -_along(line)[-1]):
        along = _along(piece)
        places = np.linspace(0.0, along[-1], PLACES_TRIED + 1)
        for at in sorted(places, key=lambda distance: abs(distance - along[-1] / 2)):
            yield float(np.interp(at, along, piece[:, 0])), float(np.interp(at, along, piece[:, 1]))


def _along(piece: Floats) -> Floats:
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


def _draw_bar(pen: Pen, sheet: MapSheet) -> None:
    levels, texts = sheet.levels, sheet.bar_texts
    if not levels:
        return
    (wide, high), style = pen.size, pen.style
    group = pen.within("colorbar", levels=" ".join(f"{level:.12g}" for level in levels))
    band = high / (len(levels) + 1)
    for place in range(len(levels) + 1):
        colour = shade(place, len(levels), style)
        group.box((0.0, place * band), (wide, band), facecolor=colour, edgecolor="none")
    group.frame()
    every = math.ceil(height("") / band)
    for place in range(0, len(levels), every):
        y = (place + 1) * band
        group.line((0.0, y), (wide + 2, y), width=0.7, color=style.ink)
        group.text(wide + 5, y, texts[place], va="center_baseline")
    group.name("right", sheet.bar, 5 + widest(texts) + BAR_NAME_WIDTH / 2)
