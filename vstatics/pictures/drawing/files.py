"""Conversion of figures to files: an SVG or PNG for each page, or a PDF with all pages."""

from __future__ import annotations

import io
import threading
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import count
from typing import TYPE_CHECKING, Any, Literal, get_args

from vstatics.core.jobs.page_files import PAGE_KEY
from vstatics.pictures.drawing.style import Style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Format = Literal["svg", "png", "pdf"]
FORMATS: tuple[Format, ...] = get_args(Format)

DPI = 200
"""Resolution of PNG. [1/inch]"""

ALONE = threading.RLock()
"""Lock that a thread holds while it changes the settings of matplotlib, which threads share."""


@contextmanager
def settings_of(style: Style) -> Iterator[None]:
    """Apply the settings of a style in matplotlib temporarily, instead of user settings.

    Other threads that draw must wait meanwhile, because all threads share the settings.
    """
    import matplotlib as mpl

    with ALONE, mpl.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")  # a box is drawn instead
        mpl.rcdefaults()
        mpl.rcParams.update(style.settings)
        yield


def files_of(figures: Sequence[Figure], form: Format, style: Style, title: str) -> list[bytes]:
    """Return pages as files, all in a single PDF; equal figures give equal bytes.

    Parameters
    ----------
    title : str
        Alternative text.
    """
    with settings_of(style):
        if form == "svg":
            from vstatics.pictures.drawing.svg import written_as_svg

            return [
                written_as_svg(figure, title, style, number)
                for number, figure in enumerate(figures, 1)
            ]
        return [_pdf(figures)] if form == "pdf" else [*map(_png, figures, count(1))]


def written(figure: Figure, form: Format, style: Style, title: str) -> bytes:
    """Return a figure as a file; see `files_of`."""
    [file] = files_of([figure], form, style, title)
    return file


# Without dates and versions, equal cases give equal bytes.


def _pdf(figures: Sequence[Figure]) -> bytes:
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    without: dict[Any, Any] = {"CreationDate": None, "Creator": None, "Producer": None}
    with PdfPages(file, metadata=without) as pages_of_file:
        for figure in figures:
            figure.savefig(pages_of_file, format="pdf")
    return file.getvalue()


def _png(figure: Figure, number: int) -> bytes:
    file = io.BytesIO()
    mark = {PAGE_KEY: str(number)} if number > 1 else {}
    figure.savefig(file, format="png", dpi=DPI, metadata={"Software": None, **mark})
    return file.getvalue()
