"""Pictures of sweeps in Python, shown in a notebook or saved to a file."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from vstatics.core.arguments import naming, refusing
from vstatics.core.errors import spoken
from vstatics.core.extras import higher, require
from vstatics.core.jobs.input_files import TABLE_BYTES, read_file
from vstatics.core.jobs.page_files import replace_pages
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest
from vstatics.core.tables.written_results import GEAR, WrittenSweep
from vstatics.core.texts import Language
from vstatics.pictures import misplaced
from vstatics.pictures.drawing.lengths import checked_width
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.plotting import format_of_picture
from vstatics.sweep.pictures import COLUMNS, render_sweep, sweep_pages
from vstatics.sweep.pictures.columns import DrawnColumns, drawn_columns, numbers, with_units
from vstatics.sweep.pictures.map_options import MapOptions, checked_levels, operating_points

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class SweepPicture:
    """Picture of a sweep, which a notebook shows as SVG."""

    def __init__(
        self, sweep: WrittenSweep, kind: str, style: Style, selected: DrawnColumns
    ) -> None:
        """Store the sweep and the settings; showing or saving draws the picture."""
        self._sweep, self._kind, self._style, self._selected = sweep, kind, style, selected

    def __repr__(self) -> str:
        """Return the kind of picture and the number of rows."""
        return f"<SweepPicture {self._kind} of {len(self._sweep.variants)} rows>"

    def _repr_svg_(self) -> str:
        [drawn, *_] = render_sweep(self._sweep, self._kind, "svg", self._style, self._selected)
        return drawn.decode()

    @property
    def figure(self) -> Figure:
        """Picture as a matplotlib figure, which can be changed."""
        from vstatics.pictures.drawing.files import figures_of

        return figures_of(sweep_pages(self._sweep, self._kind, self._style, self._selected))[0]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture to a file: SVG, PNG or PDF by the suffix.

        Raises
        ------
        ValueError
            If the suffix is not known.
        """
        form, style = format_of_picture(path), self._style._replace(height=PAGE_HEIGHT)
        drawn = render_sweep(self._sweep, self._kind, form, style, self._selected)
        replace_pages(os.fspath(path), drawn)


@refusing()
@naming
def plot_sweep(  # noqa: PLR0913 - as on the command line
    sweep: WrittenSweep,
    kind: str = "curves",
    *,
    x: str = "",
    y: str | Sequence[str] = (),
    z: str = "",
    by: str = "",
    levels: int | Sequence[float] | None = None,
    duty: str | os.PathLike[str] = "",
    limits: Transmission | None = None,
    best_gear: bool = False,
    width: float = PAGE_WIDTH / POINTS_PER_MILLIMETRE,
    dark: bool = False,
    lang: Language = "en",
) -> SweepPicture:
    """Draw curves, a map or histograms of a sweep.

    Parameters
    ----------
    sweep : WrittenSweep
    kind : {"curves", "map", "histogram"}
        Curves versus a varied number, contours versus two, or how often values occur.
    x : str, optional
        Column of the horizontal axis.
    y : str or sequence of str, optional
        Columns of curves or histograms, or the column of the vertical axis of a map.
    z : str, optional
        Column of the contours.
    by : str, optional
        Column that distinguishes curves or panels: each of its values has its own.
    levels : int or sequence of float, optional
        Approximate number of levels of a map, or the levels in ascending order.
    duty : path-like, optional
        CSV file of a duty cycle, whose operating points are drawn on a map over ``load.speed`` and
        ``load.torque``.
    limits : Transmission, optional
        Case whose vehicle has the full-load curve to draw on a map over ``load.speed`` and
        ``load.torque``.
    best_gear : bool, optional
        True for a map of the gear with the largest efficiency; the sweep needs a row for each gear.
    width : float, optional
        Width of the page, 80 to 1200. [mm]
    dark : bool, optional
        Whether to draw light lines on a dark background.
    lang : {"en", "ru"}, optional
        Language of axes and titles.

    Returns
    -------
    SweepPicture
        Picture that a notebook shows as SVG; ``save`` writes a file, ``figure`` is the figure of
        matplotlib.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or a column does not exist.
    ValueError
        If the kind or language does not exist, the kind does not use a column, or the width is out
        of range.

    Examples
    --------
    >>> columns = {"u": [1.0, 2.0], "eta": [0.9, 0.8]}
    >>> sweep = WrittenSweep([0, 1], ["ok", "ok"], columns, ("u",))
    >>> plot_sweep(sweep, "curves", y="eta")._repr_svg_()[:5]
    '<?xml'
    """
    require("plot", "a picture")
    if kind not in COLUMNS:
        expected = f"; expected one of {', '.join(COLUMNS)}"
        hint = nearest(kind, COLUMNS) or expected
        raise ValueError(f"there is no picture {kind!r} of a sweep{hint}")
    selected = with_units(sweep, drawn_columns(x, (y,) if isinstance(y, str) else y, z, by))
    _check(sweep, kind, selected)
    of_map = {"levels": levels, "duty": duty, "limits": limits, "best_gear": best_gear}
    for option, why in misplaced(kind, of_map):
        raise ValueError(f"`{option}`: {why}")
    selected = selected._replace(
        of_map=MapOptions(
            checked_levels(levels),
            best_gear,
            operating_points(read_file(duty, TABLE_BYTES), os.fspath(duty)) if duty else (),
            higher("full_load_curves")(limits) if limits else (),
        )
    )
    style = Style(lang, dark, width=checked_width(width), height=math.inf)
    return SweepPicture(sweep, kind, style, selected)


def _check(sweep: WrittenSweep, kind: str, selected: DrawnColumns) -> None:
    """Check that the named columns exist and are used by the kind of picture.

    Raises
    ------
    CaseError
        If a column does not exist.
    ValueError
        If the kind of picture does not use a column.
    """
    for option in COLUMNS["map"]:  # a map uses all column options
        given = getattr(selected, option)
        if given and option not in COLUMNS[kind]:
            takes = spoken([f"`{name}`" for name in COLUMNS[kind]])
            raise ValueError(f"plot of kind {kind!r}: `{option}` is not for it; it takes {takes}")
        for name in (given,) if isinstance(given, str) else given:
            if name and not (option == "by" and name == GEAR and sweep.gears):
                numbers(sweep, name)
