"""Figures as files: SVG and PNG of a page each, PDF of all; settings of matplotlib for a while."""

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
"""Of PNG. [1/inch]"""

ALONE = threading.RLock()
"""Held while settings of matplotlib are changed: they are those of all threads."""

# nothing that differs from run to run: the same case gives the same bytes
_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


@contextmanager
def settings_of(style: Style) -> Iterator[None]:
    """The settings of a style for a while; the user's own would move texts.

    Another thread that draws waits: it would draw with them, and leave them as they are here.
    """
    import matplotlib as mpl

    with ALONE, mpl.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")  # a box stands for it
        mpl.rcdefaults()
        mpl.rcParams.update(style.settings)
        yield


def files_of(figures: Sequence[Figure], form: Format, style: Style, title: str) -> list[bytes]:
    """Pages as files, all of them in one PDF; the same figures give the same bytes.

    Parameters
    ----------
    title : str
        What they show, for those who do not see it.
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
    """A figure as a file, with the mark of a further page; as `files_of` else."""
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
