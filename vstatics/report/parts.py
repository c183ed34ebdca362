"""Parts of the page that several sections have: figures, and what is shown of one gear."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from urllib.parse import quote

from vstatics.report.page_pictures import Drawn
from vstatics.tables.html import Markup, scrolled, tag


def figure(name: str, picture: Markup, *, captioned: bool = True) -> Markup:
    """A picture with its name.

    Parameters
    ----------
    captioned : bool
        False where headings say the name.
    """
    caption = [tag("figcaption", name)] * captioned
    return tag("figure", *caption, scrolled(picture, name))


def figures(drawn: Drawn, name: str, *, captioned: bool = True) -> Iterator[Markup]:
    """A picture with its name, in as many parts as it has, or why there is none."""
    if drawn.why:
        yield tag("p", f"{name}: not drawn. {drawn.why}")
    for number, sheet in enumerate(drawn.sheets, 1):
        several = f", {number} of {len(drawn.sheets)}" if len(drawn.sheets) > 1 else ""
        yield figure(f"{name}{several}", sheet, captioned=captioned)


def chooser(gears: Iterable[str]) -> Markup:
    """Links to choose a gear by, for all that is shown of one; without a script all gears show."""
    links = (gear_link(gear) for gear in gears)
    status = tag("span", role="status", class_="unseen")
    return tag("nav", "Gear", *links, status, class_="chooser", aria_label="Gear")


def gear_link(gear: str, text: str = "") -> Markup:
    """A link that chooses a gear.

    >>> gear_link("R")
    '<a href="#gear=R" data-choose="R">R</a>'
    """
    return tag("a", text or gear, href=f"#{address('gear', gear)}", data_choose=gear)


def of_gear(section: str, gear: str, shown: Sequence[Markup]) -> Markup:
    """What a section shows of a gear, below its name.

    Parameters
    ----------
    section : str
        What stands before the name of the gear in the address of this part.
    """
    head = tag("h3", f"Gear {gear}")
    return tag("div", head, *shown, id=address(section, gear), data_gear=gear)


def address(section: str, gear: str) -> str:
    """The name of a gear as the end of an address, which has no blanks."""
    return f"{section}={quote(gear, safe='')}"
