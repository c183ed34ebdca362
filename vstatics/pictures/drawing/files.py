"""Conversion of figures to files: an SVG or PNG for each page, or a PDF with all pages."""

from __future__ import annotations

import io
import threading
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
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

# Without dates and versions, equal cases give equal bytes.
_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


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
        if form == "pdf":
            return [_pdf(figures)]
        return [
            written(figure, form, style, title, number) for number, figure in enumerate(figures, 1)
        ]


def _pdf(figures: Sequence[Figure]) -> bytes:
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    with PdfPages(file, metadata=_METADATA["pdf"]) as pages_of_file:
        for figure in figures:
            figure.savefig(pages_of_file, format="pdf")
    return file.getvalue()


def written(figure: Figure, form: Format, style: Style, title: str, number: int = 1) -> bytes:
    """Return a figure as a file, with the mark of a further page; see `files_of`."""
    with settings_of(style):
        if form == "pdf":
            return _pdf([figure])
        if form == "svg":
            from vstatics.pictures.drawing.svg import written_as_svg

            return written_as_svg(figure, title, style, number)
        file = io.BytesIO()
        mark = {PAGE_KEY: str(number)} if number > 1 else {}
        figure.savefig(file, format=form, dpi=DPI, metadata={**_METADATA[form], **mark})
        return file.getvalue()
