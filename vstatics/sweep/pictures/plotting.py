"""A picture of a sweep for those who work in Python: shown in a notebook, or saved."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from vstatics.core.arguments import naming, refusing
from vstatics.core.errors import spoken
from vstatics.core.extras import require
from vstatics.core.jobs.page_files import replace_pages
from vstatics.core.suggestions import nearest
from vstatics.core.tables.written_results import GEAR, WrittenSweep
from vstatics.core.texts import Language
from vstatics.pictures.drawing.lengths import checked_width
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.plotting import format_of_picture
from vstatics.sweep.pictures import COLUMNS, render_sweep, sweep_figures
from vstatics.sweep.pictures.columns import DrawnColumns, numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class SweepPicture:
    """A picture of a sweep; a notebook shows it as SVG."""

    def __init__(self, sweep: WrittenSweep, kind: str, style: Style, asked: DrawnColumns) -> None:
        """Keep what is to be drawn; it is drawn when it is shown or saved."""
        self._sweep, self._kind, self._style, self._asked = sweep, kind, style, asked

    def __repr__(self) -> str:
        """What it shows."""
        return f"<SweepPicture {self._kind} of {len(self._sweep.variants)} rows>"

    def _repr_svg_(self) -> str:
        [drawn, *_] = render_sweep(self._sweep, self._kind, "svg", self._style, self._asked)
        return drawn.decode()

    @property
    def figure(self) -> Figure:
        """The figure of matplotlib, to be changed."""
        return sweep_figures(self._sweep, self._kind, self._style, self._asked)[0]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, as a `Picture`.

        Raises
        ------
        ValueError
            For another suffix.
        """
        form, style = format_of_picture(path), self._style._replace(height=PAGE_HEIGHT)
        drawn = render_sweep(self._sweep, self._kind, form, style, self._asked)
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
    width: float = PAGE_WIDTH / POINTS_PER_MILLIMETRE,
    dark: bool = False,
    lang: Language = "en",
) -> SweepPicture:
    """A picture of a sweep.

    Parameters
    ----------
    sweep : WrittenSweep
    kind : {"curves", "map", "histogram"}
        Columns over one varied number, contours over two, or how often numbers occur.
    x, z, by : str, optional
        Columns: of the lower axis, of contours, and what has a line or a panel for each value.
    y : str or sequence of str, optional
        Columns: of lines or histograms; of a map its upright axis.
    width : float, optional
        Of a page, 80 to 1200. [mm]
    dark : bool, optional
        Light on dark.
    lang : {"en", "ru"}, optional
        Of axes and titles.

    Returns
    -------
    SweepPicture
        Shown as SVG by a notebook; ``save`` writes it to a file, ``figure`` is for matplotlib.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or there is no such column.
    ValueError
        If there is no such kind or language, a column is not for the kind, or no page is so wide.

    Examples
    --------
    >>> columns = {"u": [1.0, 2.0], "eta": [0.9, 0.8]}
    >>> made = WrittenSweep([0, 1], ["ok", "ok"], columns, ("u",))
    >>> plot_sweep(made, "curves", y="eta")._repr_svg_()[:5]
    '<?xml'
    """
    require("plot", "a picture")
    if kind not in COLUMNS:
        expected = f"; expected one of {', '.join(COLUMNS)}"
        hint = nearest(kind, COLUMNS) or expected
        raise ValueError(f"there is no picture {kind!r} of a sweep{hint}")
    asked = DrawnColumns(x, (y,) if isinstance(y, str) else tuple(y), z, by)
    _check(sweep, kind, asked)
    style = Style(lang, dark, width=checked_width(width), height=math.inf)
    return SweepPicture(sweep, kind, style, asked)


def _check(sweep: WrittenSweep, kind: str, asked: DrawnColumns) -> None:
    """Refuse columns that there are not, or that the kind does not show.

    Raises
    ------
    CaseError
    ValueError
    """
    for option, given in asked._asdict().items():
        if given and option not in COLUMNS[kind]:
            takes = spoken([f"`{one}`" for one in COLUMNS[kind]])
            raise ValueError(f"plot of kind {kind!r}: `{option}` is not for it; it takes {takes}")
        for name in (given,) if isinstance(given, str) else given:
            if name and not (option == "by" and name == GEAR and sweep.gears):
                numbers(sweep, name)
