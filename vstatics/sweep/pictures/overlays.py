"""Operating points and full-load curves drawn over a map."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.si_units import measured
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import Style
from vstatics.sweep.pictures.map_options import MapOptions

MOST_MARKS = 2000
"""Number of operating points above which points closer than `MARK_RASTER` are merged."""
MARK_RASTER = 2.0
"""Distance below which operating points are merged, if there are many. [pt]"""
_LOAD = re.compile(r"load\.(speed|torque) \[(.+)\]")


class Overlay(NamedTuple):
    """Operating points and full-load curves in the units of the axes of a map."""

    gears: Sequence[str] = ()
    """Gear of each operating point."""
    points: Floats = np.empty((0, 2))
    """Operating points, shape (points, 2)."""
    limits: Sequence[Floats] = ()
    """Full-load curves, each with shape (points, 2)."""

    def within(self, low: tuple[float, float], high: tuple[float, float], gear: str) -> Overlay:
        """Return the overlay with the operating points of a gear within a rectangle.

        An empty name selects the points of all gears; points without a gear belong to each gear.
        """
        inside = ((self.points >= low) & (self.points <= high)).all(axis=1)
        shown = inside & np.array([other in ("", gear) or not gear for other in self.gears], bool)
        gears = [self.gears[place] for place in np.flatnonzero(shown).tolist()]
        return self._replace(gears=gears, points=self.points[shown])

    def draw(self, pen: Pen) -> None:
        """Draw the full-load curves and a mark for each operating point into a panel."""
        for curve in self.limits:
            title = pen.style.text("full load")
            pen.plot(*curve.T, title=title, kind="limit", **full_load_look(pen.style))
        places = [(pen.across(float(x)), pen.up(float(y))) for x, y in self.points]
        raster = MARK_RASTER if len(places) > MOST_MARKS else 1e-9
        marks = {(x // raster, y // raster): number for number, (x, y) in enumerate(places)}
        for number in marks.values():
            x, y = (f"{value:.9g}" for value in self.points[number])
            group = pen.within("operating-point", x=x, y=y, gear=self.gears[number])
            group.line(places[number], title=f"{x}, {y}", zorder=4.0, **point_look(pen.style))


def point_look(style: Style) -> Look:
    """Return the style of the mark of an operating point."""
    mark = {"markerfacecolor": style.ink, "markeredgecolor": style.paper, "markeredgewidth": 0.6}
    return {"marker": "o", "markersize": 4.5, "linestyle": "none", **mark}


def full_load_look(style: Style) -> Look:
    """Return the style of a full-load curve."""
    return {"color": style.ink, "width": 2.0, "linestyle": (0, (5, 1.5))}


def overlay_of(options: MapOptions, axes: tuple[str, str]) -> Overlay:
    """Return operating points and full-load curves in the units of the axes of a map.

    Raises
    ------
    CaseError
        If the axes are not speed and torque at the input.
    """
    if not (options.points or options.limits):
        return Overlay()
    matches = map(_LOAD.fullmatch, axes)
    units = {match[1]: match[2] for match in matches if match}
    if len(units) < 2:
        raise CaseError(
            "E435",
            f"the axes of the map are {axes[0]} and {axes[1]}: expected load.speed and "
            "load.torque, over which operating points and full load can be drawn",
        )
    scales = (
        measured(f"1 {units['speed']}", "si_speed"),
        measured(f"1 {units['torque']}", "si_torque"),
    )
    order = [0, 1] if axes[0].startswith("load.speed") else [1, 0]
    points = np.array([point[1:] for point in options.points]).reshape(-1, 2)
    return Overlay(
        [point.gear for point in options.points],
        (points / scales)[:, order],
        [(np.array(curve) / scales)[:, order] for curve in options.limits],
    )
