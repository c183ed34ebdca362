"""Parts of a page: sections, figures, the part of a gear, and the parts of annexes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol
from urllib.parse import quote

from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup, scrolled, tag
from vstatics.core.texts import tr
from vstatics.pictures.paged.drawn import Draw, Drawn
from vstatics.pictures.runs import PicturedRun

SCREEN, PAPER = "screen", "paper"
"""Classes of what stays on the screen, and of what stands on paper in its place."""


class Part(NamedTuple):
    """A section of a page."""

    name: str
    shown: Sequence[Markup]
    is_printed: bool = True


class PartRequest(NamedTuple):
    """The case, and the look, of a section that an annex provides."""

    results: Results
    draw: Draw
    gears: Sequence[int] = ()
    """Numbers of the only gears that are shown; all if it is empty."""
    motion: PicturedRun | None = None
    """A run of the case."""
    in_full: bool = True
    """Whether all of it is printed."""
    has_pictures: bool = True
    """Whether anything can be drawn."""
    has_marks: bool = False
    """Whether the page has scripts, for which numbers say what they are."""

    def shows(self, gear: int) -> bool:
        """Whether something is shown of a gear, by its number."""
        return not self.gears or gear in self.gears


class PagePart(Protocol):
    """A section that an annex provides, ready to be shown."""

    @property
    def without(self) -> str:
        """Why it is left out, if it is."""

    @property
    def drawn(self) -> Collection[str]:
        """Kinds of pictures of the whole case that need not stand elsewhere, too."""

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """Yield all of it, numbers with so many digits after the point."""


def figure(name: str, picture: Markup, *, captioned: bool = True, scrolls: bool = True) -> Markup:
    """A picture with its name.

    Parameters
    ----------
    captioned : bool
        False where headings say the name.
    scrolls : bool
        False on paper.
    """
    caption = [tag("figcaption", name)] * captioned
    return tag("figure", *caption, scrolled(picture, name) if scrolls else picture)


def figures(
    drawn: Drawn, name: str, *, captioned: bool = True, scrolls: bool = True
) -> Iterator[Markup]:
    """A picture with its name, in as many parts as it has, or why there is none."""
    if drawn.why:
        yield tag("p", tr("{name}: not drawn. {why}", name=name, why=drawn.why))
    for number, sheet in enumerate(drawn.sheets, 1):
        several = len(drawn.sheets)
        if several > 1:
            part = tr("{name}, {number} of {several}", name=name, number=number, several=several)
        else:
            part = name
        yield figure(part, sheet, captioned=captioned, scrolls=scrolls)


def gear_link(gear: str, text: str = "") -> Markup:
    """A link that chooses a gear.

    >>> gear_link("R")
    '<a href="#gear=R" data-choose="R">R</a>'
    """
    return tag("a", text or gear, href=f"#{address('gear', gear)}", data_choose=gear)


def of_gear(section: str, gear: str, shown: Sequence[Markup], *, is_printed: bool = True) -> Markup:
    """What a section shows of a gear, below its name.

    Parameters
    ----------
    section : str
        What stands before the name of the gear in the address of this part.
    is_printed : bool
        False for what stays on the screen.
    """
    head = tag("h3", tr("Gear {gear}", gear=gear))
    look = False if is_printed else SCREEN
    return tag("div", head, *shown, id=address(section, gear), data_gear=gear, class_=look)


def on_screen(shown: Iterable[Markup]) -> Markup:
    """What is not printed."""
    return tag("div", *shown, class_=SCREEN)


def address(section: str, gear: str) -> str:
    """The name of a gear as the end of an address, which has no blanks."""
    return f"{section}={quote(gear, safe='')}"


def line_of(facts: Iterable[tuple[str, str]]) -> Markup:
    """Figures in a line, each below its name."""
    shown = (tag("div", tag("dt", name), tag("dd", said)) for name, said in facts)
    return tag("dl", *shown, class_="overview")
