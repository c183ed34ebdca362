"""Pictures of sweeps: maps over two varied numbers, curves over one, and histograms.

`map`, `curves` and `histogram` each draw columns of a sweep. `columns` selects columns that the
user does not name, and `plotting` is the Python interface.

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
from vstatics.sweep.pictures.columns import DrawnColumns, with_units

if TYPE_CHECKING:
    from vstatics.core.tables.written_results import WrittenSweep
    from vstatics.pictures.drawing.canvas import Canvas
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style

COLUMNS: Mapping[str, Sequence[str]] = {
    "map": ("x", "y", "z", "by"),
    "curves": ("x", "y", "by"),
    "histogram": ("y", "by"),
}
"""Options by which the user can name columns, for each kind of picture."""


def render_sweep(
    sweep: WrittenSweep, kind: str, form: Format, style: Style, selected: DrawnColumns
) -> list[bytes]:
    """Draw a picture of a sweep, and return the pages as files.

    Parameters
    ----------
    sweep : WrittenSweep
    kind : {"map", "curves", "histogram"}
    form : str
        Format of the files.
    style : Style
    selected : DrawnColumns
        Columns that the user names; the other columns are selected from the sweep.

    Raises
    ------
    CaseError
        If a column does not exist, nothing can be drawn, or matplotlib is not installed.
    """
    drawn = sweep_pages(sweep, kind, style, selected)
    from vstatics.pictures.drawing.files import files_of

    return files_of(drawn, form, f"sweep: {kind}")


def sweep_pages(
    sweep: WrittenSweep, kind: str, style: Style, selected: DrawnColumns
) -> list[Canvas]:
    """Draw the pages of a picture of a sweep; parameters as in `render_sweep`."""
    require("plot", "a picture")
    from vstatics.pictures import module_of

    if not sweep.variants:
        message = (
            "the sweep has no row, so there is nothing to draw: expected a sweep with variants"
        )
        raise CaseError("E433", f"{message} that its --where leaves")
    return list(module_of(kind).draw(sweep, style, with_units(sweep, selected)))
