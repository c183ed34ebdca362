"""Conversion of canvases to files: an SVG or PNG for each page, or a PDF with all pages."""

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

    from vstatics.pictures.drawing.canvas import Canvas

Format = Literal["svg", "png", "pdf"]
FORMATS: tuple[Format, ...] = get_args(Format)

DPI = 200
"""Resolution of PNG. [1/inch]"""

ALONE = threading.RLock()
"""Lock held while settings of matplotlib are changed, because all threads share the settings."""


@contextmanager
def settings_of(style: Style) -> Iterator[None]:
    """Temporarily replace the user's settings of matplotlib by the settings of a style.

    Other threads wait before they draw, because all threads share the settings.
    """
    import matplotlib as mpl

    with ALONE, mpl.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings(
            "ignore", message="Glyph .* missing"
        )  # a missing letter is drawn as a box
        mpl.rcdefaults()
        mpl.rcParams.update(style.settings)
        yield


def files_of(pages: Sequence[Canvas], form: Format, title: str) -> list[bytes]:
    """Return a file for each page, or a single PDF. Equal pages give equal bytes.

    Parameters
    ----------
    title : str
        Alternative text.
    """
    if form == "svg":
        from vstatics.pictures.drawing.svg import written_as_svg

        return [written_as_svg(page, title, number) for number, page in enumerate(pages, 1)]
    figures = figures_of(pages)
    with settings_of(pages[0].style):
        return [_pdf(figures)] if form == "pdf" else [*map(_png, figures, count(1))]


def figures_of(pages: Sequence[Canvas]) -> list[Figure]:
    """Return a matplotlib figure for each page, drawn with the settings of the style."""
    from vstatics.pictures.drawing.figures import figure_of

    with settings_of(pages[0].style):
        return [*map(figure_of, pages)]


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
