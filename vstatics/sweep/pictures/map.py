"""Map of a sweep: contours of a column versus two varied numbers, or regions of the best gear."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.paths import in_quotes
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.written_results import GEAR, WrittenSweep
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.head import Meaning, NameInKey
from vstatics.pictures.drawing.style import Style, number
from vstatics.sweep.pictures.best_gear import gear_regions, refined
from vstatics.sweep.pictures.columns import (
    DrawnColumns,
    axis,
    numbers,
    parts,
    results_of,
    running,
)
from vstatics.sweep.pictures.contours import contour_levels, even_levels, grid_of
from vstatics.sweep.pictures.map_sheet import (
    MapSheet,
    Surface,
    limit_look,
    map_pages,
    paint_levels,
    paint_regions,
    shade,
)
from vstatics.sweep.pictures.overlays import Overlay, overlay_of

Names = tuple[str, str, str]
"""Names of the columns of the horizontal axis, the vertical axis and the values."""


def draw(sweep: WrittenSweep, style: Style, selected: DrawnColumns) -> list[Canvas]:
    """Draw a map of each gear or value of a column, all with equal levels, or of the best gear.

    Raises
    ------
    CaseError
        If a column does not exist, or nothing can be drawn.
    """
    options = selected.of_map
    if options.best_gear and not (sweep.gears and selected.by in ("", GEAR)):
        message = "best gears need a row for each gear: expected a sweep written with --by gear"
        raise CaseError("E436", f"{message}, and no other --by")
    names = _columns(sweep, selected)
    overlay = overlay_of(options, names[:2])
    sheet = (_best_gears if options.best_gear else _contours)(sweep, style, selected, names)
    surfaces = sheet.surfaces
    if not any(np.isfinite(surface.z).any() for surface in surfaces):
        raise CaseError("E433", f"no row of the sweep has {names[2]}, so there is nothing to draw")
    if not any(_has_area(surface.z) for surface in surfaces):
        message = f"the rows with {names[2]} span no area, so there are no contours to draw"
        raise CaseError("E433", message)
    x, y = sheet.scales
    overlays = [
        overlay.within(
            (x.low, y.low), (x.high, y.high), _gear_of(sweep, surface, overlay, names[2])
        )
        for surface in surfaces
    ]
    shown = len({tuple(point) for each in overlays for point in each.points.tolist()})
    hidden = len({tuple(point) for point in overlay.points.tolist()}) - shown
    words = "not drawn: {count} operating point|not drawn: {count} operating points"
    why = style.text("outside the map or in another gear")
    notes = [f"{style.text(words, count=hidden)} {why}"] * bool(hidden)
    values = np.concatenate([surface.z[np.isfinite(surface.z)] for surface in surfaces])
    low, high = values.min(), values.max()
    if sheet.levels and not any(low <= level <= high for level in sheet.levels):
        words = "no level is between {low} and {high}"
        notes.append(style.text(words, low=number(low), high=number(high)))
    return map_pages(sheet, names[:2], overlays, "; ".join(notes), style)


def _has_area(values: Floats) -> bool:
    """Return whether three corners of any cell of a grid have values, shape (y, x)."""
    exists = np.isfinite(values).astype(int)
    corners = exists[1:, 1:] + exists[1:, :-1] + exists[:-1, 1:] + exists[:-1, :-1]
    return bool((corners >= 3).any())


def _columns(sweep: WrittenSweep, selected: DrawnColumns) -> Names:
    """Return the columns of the axes and of the values.

    Raises
    ------
    CaseError
    """
    upward = next(iter(selected.y), "")
    left = running(sweep, [upward, selected.by], axes=2)
    x = selected.x or (left[0] if len(left) == 2 - bool(upward) else "")
    x = axis(sweep, x, [upward, selected.by], "--x", axes=2)
    y = axis(sweep, upward, [x, selected.by], "--y", axes=2)
    results = results_of(sweep, [x, y, selected.by])
    is_efficient = selected.of_map.best_gear and "efficiency" in results
    z = selected.z or ("efficiency" if is_efficient else next(iter(results), ""))
    if not z:
        raise CaseError("E433", "the sweep has no column to draw apart from its varied numbers")
    return x, y, z


def _contours(sweep: WrittenSweep, style: Style, selected: DrawnColumns, names: Names) -> MapSheet:
    x, y, z = names
    surfaces = []
    for part in parts(sweep, selected, (x, y)):
        grid = grid_of(*(numbers(sweep, name)[part.rows] for name in names))
        statuses = ", ".join(dict.fromkeys(sweep.status[row] for row in part.rows))
        surfaces.append(Surface(part.name, *grid, f"{style.text('no number')}: {statuses}"))
    values = np.concatenate([surface.z[np.isfinite(surface.z)] for surface in surfaces])
    levels = _levels(values, selected.of_map.levels)
    ends = any(0 < np.isfinite(surface.z).mean() < 1 for surface in surfaces)
    meanings: list[Meaning] = [(ends, "limit of operation", limit_look(style))]
    paint = partial(paint_levels, levels=levels)
    constant = f" = {number(values[0])}" if values.size and not levels else ""
    return MapSheet(f"{z}{constant}: {x}, {y}", surfaces, paint, meanings, levels, z)


def _levels(values: Floats, wanted: int | Sequence[float] | None) -> Sequence[float]:
    if not values.size or isinstance(wanted, Sequence):
        return wanted if isinstance(wanted, Sequence) else ()
    if wanted is None:
        return contour_levels(values)
    return even_levels(float(values.min()), float(values.max()), wanted)


def _best_gears(
    sweep: WrittenSweep, style: Style, selected: DrawnColumns, names: Names
) -> MapSheet:
    x, y, z = (numbers(sweep, name) for name in names)
    every = parts(sweep, selected, names[:2])
    known = np.isfinite(x) & np.isfinite(y)
    places, place = np.unique(np.column_stack([x, y])[known], axis=0, return_inverse=True)
    place_of = np.full(len(x), -1)
    place_of[known] = place.ravel()
    grids = []
    for part in every:
        rows = np.array(part.rows)[known[part.rows]]
        values = np.full(len(places), np.nan)
        values[place_of[rows]] = z[rows]
        if np.isfinite(values).any():
            grids.append((part.name, grid_of(places[:, 0], places[:, 1], values)))
    if not grids:
        return MapSheet("", [], partial(paint_levels, levels=()), [])
    xs, ys, fine = refined(*grids[0][1][:2], np.array([grid[2] for _, grid in grids]))
    regions = gear_regions([name for name, _ in grids], fine)
    best = Surface("", xs, ys, regions[0].lead, "")
    colours = {
        region.gear: shade(place, len(regions) - 1, style) for place, region in enumerate(regions)
    }
    ends = bool(np.isnan(best.z).any())
    meanings: list[Meaning] = [
        *(
            (True, NameInKey(gear), {"facecolor": colour, "edgecolor": style.ink, "width": 0.6})
            for gear, colour in colours.items()
        ),
        (ends, "limit of operation", limit_look(style)),
    ]
    title = style.text("Gear with the largest {z}", z=names[2])
    paint = partial(paint_regions, regions=regions, colours=colours)
    return MapSheet(f"{title}: {names[0]}, {names[1]}", [best], paint, meanings)


def _gear_of(sweep: WrittenSweep, surface: Surface, points: Overlay, z: str) -> str:
    """Return the gear whose values a map shows, from the rows or column name; "" for several."""
    if surface.name in sweep.gears:
        return surface.name
    gears = [(gear, f"{name}]") for gear in points.gears for name in (gear, in_quotes(gear))]
    ends = ((gear, (f"[{end}", f",{end}")) for gear, end in gears)
    return next((gear for gear, end in ends if z.endswith(end)), "")
