"""Pictures of a case for an HTML page, or the reasons why they cannot be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

from vstatics.core.annexes import picture_kinds
from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup
from vstatics.core.texts import spoken, tr
from vstatics.pictures import of_each_choice, pages
from vstatics.pictures.drawing.style import PAGE_HEIGHT, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.paged.inline import for_paper, inline
from vstatics.pictures.runs import PicturedRun

if TYPE_CHECKING:
    from xml.etree import ElementTree as ET

PRINTED_WIDTH = 182.0
"""Width between the margins of an A4 page, equal to the width in the style sheet. [mm]"""
COLUMN_GAP = 4.0
"""Gap between two pictures side by side. [mm]"""
PAGE = Style(titled=False, width=PRINTED_WIDTH * POINTS_PER_MILLIMETRE, height=PAGE_HEIGHT)
HALF = PAGE._replace(width=(PRINTED_WIDTH - COLUMN_GAP) / 2 * POINTS_PER_MILLIMETRE)


class Drawn(NamedTuple):
    """A picture, or the reason why no picture is drawn."""

    kind: str
    sheets: Sequence[Markup]
    """SVG elements of the picture, several for a picture on several sheets."""
    why: str = ""

    @property
    def printed(self) -> Drawn:
        """The picture without tooltips, which paper does not show."""
        return self._replace(sheets=[*map(for_paper, self.sheets)])


class Draw(Protocol):
    """Function that draws a picture for a page, now or later."""

    def __call__(
        self, kind: str, gears: Sequence[int] = (), motion: PicturedRun | None = None
    ) -> Drawn:
        """Return a picture of a kind, for gears by number from 1, or with a simulated run."""


def bare_stick(draw: Draw, motion: PicturedRun) -> Drawn:
    """Return the stick diagram of a simulated run, or its structure if no diagram is possible."""
    stick = draw("stick", motion=motion)
    return stick if stick.sheets else draw("structure", motion=motion)


def name_of(kind: str) -> str:
    """Return the name of a kind of picture in the language of the page."""
    return tr(picture_kinds()[kind].title)


def of_each(
    results: Results, kind: str, shown: Sequence[Sequence[int]], style: Style = PAGE
) -> list[Drawn]:
    """Draw a picture for each list of gears, or give the reason why a picture is missing."""
    try:
        drawn = of_each_choice(results, kind, in_spoken(style), shown)
    except CaseError:  # pictures of other gears can succeed
        return [picture_of(results, kind, gears, style=style) for gears in shown]
    end = tr(", small") * (style is HALF)
    is_repeated = any(len(gears) == 1 for gears in shown)
    labels = (f"{_label(results, kind, gears)}{end}" for gears in shown)
    return [
        Drawn(
            kind,
            _inlined(
                svgs, _own(kind, gears, style), label, repeats=is_repeated and len(gears) != 1
            ),
        )
        for gears, svgs, label in zip(shown, drawn, labels, strict=True)
    ]


def in_spoken(style: Style) -> Style:
    """Return a style whose texts are in the language of the page."""
    return style._replace(language=spoken())


def _own(kind: str, gears: Sequence[int], style: Style) -> str:
    """Return a prefix for the ids of a picture, which differs between the pictures of a page."""
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
    """Draw a picture of a case, for gears by number from 1, or with a simulated run."""
    try:
        svgs = pages(results, kind, "svg", in_spoken(style), gears, motion=motion)
    except CaseError as error:
        return Drawn(kind, [], " ".join(str(error).split()))
    prefix, label = _own(kind, gears, style), _label(results, kind, gears)
    if motion is not None:
        prefix, label = f"run-{prefix}", tr("{picture}, run", picture=label)
    return Drawn(kind, _inlined(svgs, prefix, label))


def _inlined(
    svgs: Sequence[bytes | ET.Element], prefix: str, label: str, *, repeats: bool | None = None
) -> list[Markup]:
    """Embed the sheets of a picture. Further sheets have a number in the prefix."""
    return [
        inline(svg, f"{prefix}-{n}" if n else prefix, label, repeats=repeats)
        for n, svg in enumerate(svgs)
    ]
