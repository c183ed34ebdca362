"""Written sweeps as pictures: contours over two varied numbers, lines over one, histograms.

The columns of a sweep and the names of axes go in (`columns` picks what is not named), a figure
comes out; `map`, `curves` and `histogram` draw one kind each, `plotting` is for Python.

>>> from vstatics.pictures.drawing.style import Style
>>> from vstatics.core.tables.written_results import WrittenSweep
>>> columns = {"u": [1.0, 2.0], "eta": [0.9, 0.8]}
>>> [drawn] = render_sweep(WrittenSweep([0, 1], ["ok", "ok"], columns, ("u",)), "curves", "svg",
...                      Style(), DrawnColumns())
>>> drawn[:5]
b'<?xml'
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from vstatics.core.errors import CaseError
from vstatics.core.extras import require
from vstatics.sweep.pictures.columns import DrawnColumns

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from vstatics.core.tables.written_results import WrittenSweep
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style

COLUMNS: Mapping[str, Sequence[str]] = {
    "map": ("x", "y", "z", "by"),
    "curves": ("x", "y", "by"),
    "histogram": ("y", "by"),
}
"""By kind: which columns may be named."""


def render_sweep(
    sweep: WrittenSweep, kind: str, form: Format, style: Style, asked: DrawnColumns
) -> list[bytes]:
    """The pages of a picture of a sweep as files.

    Parameters
    ----------
    kind : {"map", "curves", "histogram"}
    asked : DrawnColumns
        The columns that are drawn, as far as they are named.

    Raises
    ------
    CaseError
        If there is no such column, nothing to draw, or matplotlib is not installed.
    """
    figures = sweep_figures(sweep, kind, style, asked)
    from vstatics.pictures.drawing.files import files_of

    return files_of(figures, form, style, f"sweep: {kind}")


def sweep_figures(
    sweep: WrittenSweep, kind: str, style: Style, asked: DrawnColumns
) -> list[Figure]:
    """The pages as figures of matplotlib; parameters and errors as of `render_sweep`."""
    require("plot", "a picture")
    from vstatics.pictures import module_of
    from vstatics.pictures.drawing.files import settings_of

    if not sweep.variants:
        message = "the sweep has no row, so there is nothing to draw: expected one with variants"
        raise CaseError("E433", f"{message} that its --where leaves")
    with settings_of(style):
        return list(module_of(kind).draw(sweep, style, asked))
