"""Building blocks of a page: sections, figures, parts about a gear, and sections of annexes."""

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
"""CSS classes of elements for the screen only, and for paper only."""


class Part(NamedTuple):
    """A section of a page."""

    name: str
    shown: Sequence[Markup]
    is_printed: bool = True


class PartRequest(NamedTuple):
    """Request for the section of an annex: results, drawing function, and the wanted contents."""

    results: Results
    draw: Draw
    gears: Sequence[int] = ()
    """Numbers of the gears to show; empty for all."""
    motion: PicturedRun | None = None
    """Simulated run of the case, if any."""
    in_full: bool = True
    """True if everything is printed on paper; False to print only the essential contents."""
    has_pictures: bool = True
    """Whether pictures can be drawn."""
    has_marks: bool = False
    """Whether numbers carry marks for scripts of the page."""

    def shows(self, gear: int) -> bool:
        """Check if the page shows a gear."""
        return not self.gears or gear in self.gears


class PagePart(Protocol):
    """Section of a page that an annex provides."""

    @property
    def without(self) -> str:
        """Reason why the section is left out; empty for a shown section."""

    @property
    def drawn(self) -> Collection[str]:
        """Kinds of pictures in the section, which other sections omit."""

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """Yield the contents. Numbers have `digits` decimals, or by default the usual number."""


def figure(name: str, picture: Markup, *, captioned: bool = True, scrolls: bool = True) -> Markup:
    """Return a picture with a caption.

    Parameters
    ----------
    captioned : bool
        Whether to add the caption; False if a heading already names the picture.
    scrolls : bool
        Whether a wide picture can be scrolled sideways; False on paper.
    """
    caption = [tag("figcaption", name)] * captioned
    return tag("figure", *caption, scrolled(picture, name) if scrolls else picture)


def figures(
    drawn: Drawn, name: str, *, captioned: bool = True, scrolls: bool = True
) -> Iterator[Markup]:
    """Yield the sheets of a picture with captions, or the reason for a missing picture."""
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
    """Return a link by which the reader of a page chooses a gear.

    >>> gear_link("R")
    '<a href="#gear=R" data-choose="R">R</a>'
    """
    return tag("a", text or gear, href=f"#{address('gear', gear)}", data_choose=gear)


def of_gear(section: str, gear: str, shown: Sequence[Markup], *, is_printed: bool = True) -> Markup:
    """Return the part of a section about a gear, with the name of the gear as heading.

    Parameters
    ----------
    section : str
        Prefix of the address of the part, before the name of the gear.
    is_printed : bool
        Whether to print the part.
    """
    head = tag("h3", tr("Gear {gear}", gear=gear))
    look = False if is_printed else SCREEN
    return tag("div", head, *shown, id=address(section, gear), data_gear=gear, class_=look)


def on_screen(shown: Iterable[Markup]) -> Markup:
    """Wrap HTML elements that are shown on screen but not on paper."""
    return tag("div", *shown, class_=SCREEN)


def address(section: str, gear: str) -> str:
    """Return the id of the part of a section about a gear, without blanks."""
    return f"{section}={quote(gear, safe='')}"


def line_of(facts: Iterable[tuple[str, str]]) -> Markup:
    """Return facts side by side, each value below the name of the fact."""
    shown = (tag("div", tag("dt", name), tag("dd", text)) for name, text in facts)
    return tag("dl", *shown, class_="overview")
