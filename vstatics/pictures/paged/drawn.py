"""Pictures of a case as a page of HTML has them, or why they are not drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from vstatics.core.annexes import picture_kinds
from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup
from vstatics.core.texts import spoken, tr
from vstatics.pictures import of_each_gear, pages
from vstatics.pictures.drawing.style import PAGE_HEIGHT, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.paged.inline import inline
from vstatics.pictures.runs import PicturedRun

PRINTED_WIDTH = 182.0
"""Between the margins of A4, as the style sheet has them. [mm]"""
COLUMN_GAP = 4.0
"""Between two pictures side by side. [mm]"""
PAGE = Style(titled=False, width=PRINTED_WIDTH * POINTS_PER_MILLIMETRE, height=PAGE_HEIGHT)
HALF = PAGE._replace(width=(PRINTED_WIDTH - COLUMN_GAP) / 2 * POINTS_PER_MILLIMETRE)


class Drawn(NamedTuple):
    """A picture, or why there is none."""

    kind: str
    sheets: Sequence[Markup]
    """It may be too long for one."""
    why: str = ""


class Draw(Protocol):
    """Draws a picture for a page, or leaves a place for it."""

    def __call__(
        self, kind: str, gears: Sequence[int] = (), motion: PicturedRun | None = None
    ) -> Drawn:
        """Return a picture of a kind, of some gears by their numbers from 1, or of a run."""


def bare_stick(draw: Draw, motion: PicturedRun) -> Drawn:
    """Return the stick diagram of no gear, for a run; if it can't be drawn, the structure."""
    stick = draw("stick", motion=motion)
    return stick if stick.sheets else draw("structure", motion=motion)


def name_of(kind: str) -> str:
    """Return the name of a kind of picture in the language of the page."""
    return tr(picture_kinds()[kind].title)


def of_each(results: Results, kind: str, gears: Sequence[int], style: Style = PAGE) -> list[Drawn]:
    """A picture of each of some gears, or why one has none."""
    try:
        made = of_each_gear(results, kind, in_spoken(style), gears)
    except CaseError:  # of one of them, perhaps
        return [picture_of(results, kind, [number], style=style) for number in gears]
    end = tr(", small") * (style is HALF)
    labels = (f"{_label(results, kind, [number])}{end}" for number in gears)
    return [
        Drawn(kind, _inlined(svgs, _own(kind, [number], style), label))
        for number, svgs, label in zip(gears, made, labels, strict=True)
    ]


def in_spoken(style: Style) -> Style:
    """The same in the language of the page."""
    return style._replace(language=spoken())


def _own(kind: str, gears: Sequence[int], style: Style) -> str:
    """What ids of a picture begin with, unlike those of the others of a page."""
    return ".".join(["small"] * (style is HALF) + [kind, *map(str, gears)])


def _label(results: Results, kind: str, gears: Sequence[int]) -> str:
    names = [results.case.gears[number - 1].name for number in gears]
    if not names:
        return name_of(kind)
    return tr(
        "{picture}, gear {gears}|{picture}, gears {gears}",
        picture=name_of(kind),
        gears=", ".join(names),
        count=len(names),
    )


def picture_of(
    results: Results,
    kind: str,
    gears: Sequence[int] = (),
    motion: PicturedRun | None = None,
    style: Style = PAGE,
) -> Drawn:
    """A picture of a case, of some of its gears by their numbers from 1, or of a run."""
    try:
        made = pages(results, kind, "svg", in_spoken(style), gears, motion=motion)
    except CaseError as error:
        return Drawn(kind, [], " ".join(str(error).split()))
    own, label = _own(kind, gears, style), _label(results, kind, gears)
    if motion is not None:
        own, label = f"run-{own}", tr("{picture}, run", picture=label)
    return Drawn(kind, _inlined(made, own, label))


def _inlined(svgs: Sequence[bytes], own: str, label: str) -> list[Markup]:
    """Pages within HTML; the first has its own prefix, further ones have their numbers."""
    return [inline(svg, f"{own}-{n}" if n else own, label) for n, svg in enumerate(svgs)]
