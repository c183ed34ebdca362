"""Pictures of two cases on one sheet, below each other or side by side."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.annexes import picture_kinds
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import require
from vstatics.core.statics.results import Results
from vstatics.pictures import drawn_pages, module_of
from vstatics.pictures.drawing.files import Format, files_of

if TYPE_CHECKING:
    from vstatics.pictures.drawing.canvas import Canvas
    from vstatics.pictures.drawing.style import Style
    from vstatics.pictures.runs import PicturedRun

LETTERS = "AB"
BESIDE = ("efficiency",)
"""Kinds of pictures drawn side by side if they are little higher at half the width."""
AS_HIGH = 1.1
"""Largest height at half width, relative to full width, of pictures drawn side by side. [-]"""


class PairedCase(NamedTuple):
    """Case that is drawn together with a second case."""

    name: str
    """Name of the file of the case."""
    results: Results
    gears: Sequence[int] = ()
    motion: PicturedRun | None = None


def pair_pages(both: Sequence[PairedCase], kind: str, form: Format, style: Style) -> list[bytes]:
    """Draw a picture of two cases, as a file for each page.

    Raises
    ------
    ReadError
        If matplotlib is not installed, or a case has nothing to draw.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.pictures.drawing.style import Style
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5, 0.98)], [Gear()])
    >>> both = [PairedCase(name, solve(case)) for name in ("one.yaml", "other.yaml")]
    >>> [drawn] = pair_pages(both, "efficiency", "svg", Style())
    >>> drawn.count(b'class="panel"')
    2
    """
    require("plot", "a picture")
    title = f"{style.text(picture_kinds()[kind].title)}: {', '.join(case.name for case in both)}"
    return files_of(list(_sheets(both, kind, style)), form, title)


def _sheets(both: Sequence[PairedCase], kind: str, style: Style) -> Iterator[Canvas]:
    from vstatics.pictures.drawing.join import LETTER_HEIGHT, LetteredPicture, joined

    def lettered(width: float, height: float) -> list[list[LetteredPicture]]:
        sized = style._replace(width=width, height=height)
        drawn = [_drawn(both, place, kind, sized) for place in range(len(both))]
        return [
            [LetteredPicture(letter, case.name, figure) for figure in figures]
            for letter, case, figures in zip(LETTERS, both, drawn, strict=True)
        ]

    if kind in BESIDE:
        halves = lettered(style.width / 2, math.inf)
        whole = [figure for figures in lettered(style.width, math.inf) for figure in figures]
        high = AS_HIGH * max(figure.size[1] for figure in whole)
        if all(len(figures) == 1 and figures[0].size[1] <= high for figures in halves):
            parts = [figure for figures in halves for figure in figures]
            yield joined(parts, style, side_by_side=True)
            return
    half = style.height / 2 - LETTER_HEIGHT  # each of two pictures on a page has half its height
    for pages in zip_longest(*lettered(style.width, half)):
        present = [page for page in pages if page]
        if sum(page.size[1] for page in present) <= style.height:
            yield joined(present, style)
        else:
            yield from (joined([page], style) for page in present)


def _drawn(both: Sequence[PairedCase], place: int, kind: str, style: Style) -> list[Canvas]:
    """Draw the pages of a case, with scales that also cover the other case.

    Raises
    ------
    ReadError
        If the case has nothing to draw.
    """
    case, others = both[place], [other for at, other in enumerate(both) if at != place]
    try:
        if picture_kinds()[kind].alike:
            results = [other.results for other in others]
            figures: list[Canvas] = module_of(kind).draw(case.results, style, case.gears, results)
            return figures
        runs = [(other.results, other.motion) for other in others if other.motion]
        [pages] = drawn_pages(case.results, kind, style, [case.gears], case.motion, runs)
    except CaseError as error:
        raise ReadError([problem.in_file(case.name) for problem in error.problems]) from None
    return pages
