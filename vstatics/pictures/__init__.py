"""Pictures of a result: the kinds of pictures, and drawing to SVG, PNG or PDF.

The functions take results, a kind of picture and a style, and return the bytes of a file.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> from vstatics.pictures.drawing.style import Style
>>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
>>> render(solve(case), "plan", "svg", Style())[:5]
b'<?xml'
>>> picture(solve(case), "plan", Style()).texts[0].get_text()
'Generalised kinematic plan'

`drawing` contains what all pictures share. `flow`, `lever`, `schemes` and `plan` each draw a kind
of picture, `paged` embeds pictures in HTML pages, `pair` puts two cases on one sheet, and `cli`
contains the command `vstatics plot`. Other annexes draw their own results.

The record of each annex declares its kinds of pictures. A kind is a function
``draw(results, style, gears)`` in a module that is imported only for drawing, because matplotlib is
an extra. The function returns pages no larger than the style allows. Kinds that show a simulated
run also take the run as ``motion``. Kinds that calculate something common to all gears have a
function ``each(results, style, shown)`` instead, which returns the pages of several lists of gears.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any

from vstatics.core.annexes import PictureKind, module, picture_kinds, picture_options
from vstatics.core.errors import spoken
from vstatics.core.extras import require

if TYPE_CHECKING:
    from xml.etree import ElementTree as ET

    from matplotlib.figure import Figure

    from vstatics.core.statics.results import Results
    from vstatics.pictures.drawing.canvas import Canvas
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style
    from vstatics.pictures.runs import PicturedRun


def drawn_kinds() -> Mapping[str, PictureKind]:
    """Return the kinds of pictures of a case. Kinds that show other documents are left out."""
    return {kind: record for kind, record in picture_kinds().items() if not record.plots}


def module_of(kind: str) -> ModuleType:
    """Import the module that draws a kind of picture."""
    return module(picture_kinds()[kind].module)


def kinds_of_runs() -> list[str]:
    """Return the kinds of pictures that can show a run. Kinds that require a run are first."""
    kinds = [kind for kind, record in drawn_kinds().items() if "motion" in record.options]
    return sorted(kinds, key=lambda kind: picture_kinds()[kind].shows != "run")


def misplaced(kind: str, given: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    """Yield each given option that does not apply to a kind of picture, with the reason.

    >>> [*misplaced("plan", {"merge": True, "wheels": False})]
    [('merge', 'only levers can be merged')]
    """
    record, few = picture_kinds()[kind], picture_options()
    for name, value in given.items():
        if value in (None, False, "", ()):
            continue
        if name in record.refused:
            yield name, record.refused[name]
        elif name in few and name not in record.options:
            owners = [kind for kind, other in picture_kinds().items() if name in other.options]
            kinds = kinds_of_runs() if name == "motion" else owners
            yield name, few[name].format(kinds=spoken(kinds))


def picture(
    results: Results,
    kind: str,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
) -> Figure:
    """Draw a picture of the results of a case on a single page, as a matplotlib figure.

    Parameters
    ----------
    kind : str
        Key of `drawn_kinds`.
    gears : sequence of int, optional
        Numbers of the gears to show, from 1; empty for all.
    motion : PicturedRun, optional
        Simulated run of the case, for kinds of pictures that can show a run.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or the case has nothing to draw.
    """
    from vstatics.pictures.drawing.files import figures_of

    [pages] = drawn_pages(results, kind, style._replace(height=math.inf), [gears], motion)
    [figure] = figures_of(pages)
    return figure


def drawn_pages(  # noqa: PLR0913, PLR0917 - arguments of a picture
    results: Results,
    kind: str,
    style: Style,
    shown: Sequence[Sequence[int]],
    motion: PicturedRun | None = None,
    others: Sequence[tuple[Results, PicturedRun]] = (),
) -> list[list[Canvas]]:
    """Draw the pages for each list of gears in `shown`. Scales also cover the runs in `others`."""
    from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE

    require("plot", "a picture")
    drawing = module_of(kind)
    record = picture_kinds()[kind]
    style = style._replace(width=max(style.width, record.least_width * POINTS_PER_MILLIMETRE))
    run: tuple[Any, ...] = ()
    if "motion" in record.options:
        run = (motion, others) if record.shows == "run" else (motion,)
    if hasattr(drawing, "each"):
        return list(drawing.each(results, style, shown))
    return [[*drawing.draw(results, style, gears, *run)] for gears in shown]


def render(  # noqa: PLR0913 - arguments of a picture
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
) -> bytes:
    """Draw a picture on a single page as a file; parameters and errors as in `picture`."""
    style = style._replace(height=math.inf)
    [file] = pages(results, kind, form, style, gears, motion=motion)
    return file


def pages(  # noqa: PLR0913 - arguments of a picture
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
    others: Sequence[tuple[Results, PicturedRun]] = (),
) -> list[bytes]:
    """Draw a picture as a file for each page, or as a PDF; parameters as in `picture`.

    The scales of the run `motion` also cover the runs in `others`, so that pictures can be
    compared.
    """
    from vstatics.pictures.drawing.files import files_of

    [drawn] = drawn_pages(results, kind, style, [gears], motion, others)
    return files_of(drawn, form, _alternative(results, kind, style, gears))


def of_each_choice(
    results: Results, kind: str, style: Style, shown: Sequence[Sequence[int]]
) -> list[list[ET.Element]]:
    """Draw the pages for each list of gears in `shown` as SVG elements without title.

    Other parameters as in `picture`.
    """
    from vstatics.pictures.drawing.svg import svg_of

    return [
        [svg_of(page, "", number) for number, page in enumerate(pages_of_gears, 1)]
        for pages_of_gears in drawn_pages(results, kind, style, shown)
    ]


def _alternative(results: Results, kind: str, style: Style, gears: Sequence[int]) -> str:
    """Return the alternative text of a picture, for readers who cannot see pictures."""
    from vstatics.pictures.drawing.words import gear_title, title

    names = (gear_title(results.case.gears[number - 1].name, style) for number in gears)
    return title(results.case, ", ".join([style.text(picture_kinds()[kind].title), *names]))
