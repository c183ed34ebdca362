"""Parts of the page that several sections have: figures, and what is shown of one gear."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from urllib.parse import quote

from vstatics.report.drawn import Drawn
from vstatics.tables.html import Markup, scrolled, tag


def figure(name: str, picture: Markup) -> Markup:
    """A picture with its name."""
    return tag("figure", tag("figcaption", name), scrolled(picture, name))


def figures(drawn: Drawn, name: str) -> Iterator[Markup]:
    """A picture with its name, in as many parts as it has, or why there is none."""
    if drawn.why:
        yield tag("p", f"{name}: not drawn. {drawn.why}")
    for number, sheet in enumerate(drawn.sheets, 1):
        several = f", {number} of {len(drawn.sheets)}" if len(drawn.sheets) > 1 else ""
        yield figure(f"{name}{several}", sheet)


def chooser(section: str, gears: Iterable[str]) -> Markup:
    """Links to choose a gear by; without a script all gears show.

    Parameters
    ----------
    section : str
        What stands before the name of a gear in the addresses of a section.
    """
    links = (tag("a", gear, href=f"#{address(section, gear)}", data_choose=gear) for gear in gears)
    return tag("nav", "Gear: ", *links, class_="chooser", aria_label="Gear")


def of_gear(section: str, gear: str, shown: Sequence[Markup]) -> Markup:
    """What is shown where a gear is chosen."""
    return tag("div", *shown, id=address(section, gear), data_gear=gear)


def address(section: str, gear: str) -> str:
    """The name of a gear as the end of an address, which has no blanks."""
    return f"{section}={quote(gear, safe='')}"
