"""Parts of the page that several sections have: figures, and what is shown of one gear."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from urllib.parse import quote

from vstatics.core.tables.grid import NOTHING
from vstatics.core.tables.html import Markup, scrolled, tag, terms
from vstatics.core.texts import tr
from vstatics.page.report.page_pictures import Drawn
from vstatics.page.report.sheets import MOST_SHEETS, left_out, with_room


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


def in_gear(picture: str, gear: str) -> str:
    """What a picture of a gear is called.

    >>> in_gear("Power flow", "R")
    'Power flow, gear R'
    """
    return tr("{picture}, gear {gear}", picture=tr(picture), gear=gear)


def conventions(said: Mapping[str, str]) -> Markup:
    """The conventions of results; what is null in JSON is a dash on a page.

    >>> conventions({"null": "does not exist"})
    '<dl><dt>-</dt><dd>does not exist</dd></dl>'
    """
    names = (NOTHING if name == "null" else tr(name.replace("_", " ")) for name in said)
    return terms(zip(names, map(tr, said.values()), strict=True))


def chooser(gears: Iterable[str]) -> Markup:
    """Links to choose a gear by, for all that is shown of one; without a script all gears show."""
    links = (gear_link(gear) for gear in gears)
    status = tag("span", role="status", class_="unseen")
    return tag("nav", tr("Gear"), *links, status, class_="chooser", aria_label=tr("Gear"))


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


SCREEN, PAPER = "screen", "paper"
"""Classes of what stays on the screen, and of what stands on paper in its place."""


def on_paper(drawn: Drawn, name: str, *, most: int = MOST_SHEETS) -> Markup:
    """A picture that is printed only, up to so many sheets."""
    kept = drawn._replace(sheets=drawn.sheets[:most])
    shown = [*figures(kept, name, captioned=False, scrolls=False)]
    rest = len(drawn.sheets) - len(kept.sheets)
    if rest:
        said = tr("{count} more sheet with --all.|{count} more sheets with --all.", count=rest)
        shown.append(tag("p", said, class_="note"))
    return tag("div", *shown, class_=PAPER)


def side_by_side(gears: Sequence[str], drawn: Sequence[Drawn]) -> Markup:
    """Small pictures of gears that are printed only, as far as they have room."""
    count = with_room(drawn)
    shown = (
        part
        for gear, one in zip(gears[:count], drawn, strict=False)
        for part in figures(one, tr("Gear {gear}", gear=gear), scrolls=False)
    )
    return tag("div", *shown, *left_out(gears[count:]), class_=f"{PAPER} side-by-side")


def on_screen(shown: Iterable[Markup]) -> Markup:
    """What is not printed."""
    return tag("div", *shown, class_=SCREEN)


def address(section: str, gear: str) -> str:
    """The name of a gear as the end of an address, which has no blanks."""
    return f"{section}={quote(gear, safe='')}"
