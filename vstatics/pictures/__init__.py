"""Pictures of a result: which there are, and how one becomes SVG, PNG or PDF.

A result, a kind of picture and a style go in; the bytes of a file come out.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> from vstatics.pictures.drawing.style import Style
>>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
>>> render(solve(case), "plan", "svg", Style())[:5]
b'<?xml'
>>> picture(solve(case), "plan", Style()).texts[0].get_text()
'Generalised kinematic plan'

`drawing` is what all share. `flow`, `lever`, `schemes` and `plan` have kinds of pictures, `paged`
has pictures within pages of HTML, and `cli` the command `vstatics plot`; other annexes have the
pictures of their results. Records of annexes declare the kinds. A kind is a function
``draw(results, style, gears)`` in a module that is imported when its picture is drawn: matplotlib
is an extra. `pair` puts two cases on one sheet.
It gives pages, each no larger than the style says. Kinds that show a run take its motion, too.
Where gears have something in common it is ``each(results, style, shown)``, which makes this once
for the pages of several lists of gears.
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
    from matplotlib.figure import Figure

    from vstatics.core.statics.results import Results
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style
    from vstatics.pictures.runs import PicturedRun


def drawn_kinds() -> Mapping[str, PictureKind]:
    """Return the kinds of pictures of a case, in order; those of other documents are left out."""
    return {kind: own for kind, own in picture_kinds().items() if not own.plots}


def module_of(kind: str) -> ModuleType:
    """Import the module that draws a kind of picture."""
    return module(picture_kinds()[kind].module)


def kinds_of_runs() -> list[str]:
    """Return the kinds that can show a run; the kind that shows nothing else is first."""
    found = [kind for kind, own in drawn_kinds().items() if "motion" in own.options]
    return sorted(found, key=lambda kind: picture_kinds()[kind].shows != "run")


def misplaced(kind: str, given: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    """Options that a kind of picture has not, and why.

    >>> [*misplaced("plan", {"merge": True, "wheels": False})]
    [('merge', 'only levers can be merged')]
    """
    own, few = picture_kinds()[kind], picture_options()
    for name, value in given.items():
        if value in (None, False, "", ()):
            continue
        if name in own.refused:
            yield name, own.refused[name]
        elif name in few and name not in own.options:
            having = [kind for kind, other in picture_kinds().items() if name in other.options]
            kinds = kinds_of_runs() if name == "motion" else having
            yield name, few[name].format(kinds=spoken(kinds))


def picture(
    results: Results,
    kind: str,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
) -> Figure:
    """A picture of the results of one case on one page, as a figure of matplotlib.

    Parameters
    ----------
    kind : str
        One of `drawn_kinds`.
    gears : sequence of int, optional
        Numbers of the only gears that are to be shown, from 1.
    motion : Motion, optional
        A run of the case, for the kinds that can show it.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or the case has nothing that could be drawn.
    """
    [[one]] = drawn_pages(results, kind, style._replace(height=math.inf), [gears], motion)
    return one


def drawn_pages(  # noqa: PLR0913, PLR0917 - what is drawn, and how
    results: Results,
    kind: str,
    style: Style,
    shown: Sequence[Sequence[int]],
    motion: PicturedRun | None = None,
    others: Sequence[tuple[Results, PicturedRun]] = (),
) -> list[list[Figure]]:
    """The pages of each list of gears; a run has room for others in its scales."""
    from vstatics.pictures.drawing.files import settings_of
    from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE

    require("plot", "a picture")
    drawing = module_of(kind)
    least = picture_kinds()[kind].least_width * POINTS_PER_MILLIMETRE
    style = style._replace(width=max(style.width, least))
    with settings_of(style):
        if hasattr(drawing, "each"):
            return list(drawing.each(results, style, shown))
        return [drawing.draw(results, style, gears, *_run(kind, motion, others)) for gears in shown]


def render(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
) -> bytes:
    """A picture of a result on one page as a file; parameters and errors as of `picture`."""
    from vstatics.pictures.drawing.files import written

    figure = picture(results, kind, style, gears, motion=motion)
    return written(figure, form, style, _alternative(results, kind, style, gears))


def pages(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: PicturedRun | None = None,
    others: Sequence[tuple[Results, PicturedRun]] = (),
) -> list[bytes]:
    """A picture of a result as files: a page each, all in one PDF; as `picture` else.

    That of a run has scales with room for other runs.
    """
    from vstatics.pictures.drawing.files import files_of

    [figures] = drawn_pages(results, kind, style, [gears], motion, others)
    return files_of(figures, form, style, _alternative(results, kind, style, gears))


def of_each_gear(
    results: Results, kind: str, style: Style, gears: Sequence[int]
) -> list[list[bytes]]:
    """The pages of each gear as SVG, in their order; parameters and errors as of `picture`."""
    from vstatics.pictures.drawing.files import files_of

    shown = [(number,) for number in gears]
    titles = (_alternative(results, kind, style, gears) for gears in shown)
    return [
        files_of(figures, "svg", style, title)
        for title, figures in zip(titles, drawn_pages(results, kind, style, shown), strict=True)
    ]


def _run(
    kind: str, motion: PicturedRun | None, others: Sequence[tuple[Results, PicturedRun]]
) -> tuple[Any, ...]:
    """The run, for a picture that can show one, and others for one that has scales."""
    own = picture_kinds()[kind]
    if "motion" not in own.options:
        return ()
    return (motion, others) if own.shows == "run" else (motion,)


def _alternative(results: Results, kind: str, style: Style, gears: Sequence[int]) -> str:
    """What a picture shows, for those who do not see it."""
    from vstatics.pictures.drawing.words import gear_title, title

    names = (gear_title(results.case.gears[number - 1].name, style) for number in gears)
    return title(results.case, ", ".join([style.text(picture_kinds()[kind].title), *names]))
