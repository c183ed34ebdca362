"""HTML that several sections of the page of a case use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from vstatics.core.tables.grid import NOTHING
from vstatics.core.tables.html import Markup, tag, terms
from vstatics.core.texts import tr
from vstatics.page.report.sheets import MOST_SHEETS, left_out, with_room
from vstatics.pictures.paged.drawn import Drawn, name_of
from vstatics.pictures.paged.parts import PAPER, figures, gear_link


def in_gear(kind: str, gear: str) -> str:
    """Return the caption of a picture of a gear.

    >>> in_gear("flow", "R")
    'Power flow, gear R'
    """
    return tr("{picture}, gear {gear}", picture=name_of(kind), gear=gear)


def conventions(said: Mapping[str, str]) -> Markup:
    """Return the conventions of results as a list. JSON `null` is a dash, as in tables.

    >>> conventions({"null": "does not exist"})
    '<dl><dt>-</dt><dd>does not exist</dd></dl>'
    """
    names = (NOTHING if name == "null" else tr(name.replace("_", " ")) for name in said)
    return terms(zip(names, map(tr, said.values()), strict=True))


def chooser(gears: Iterable[str]) -> Markup:
    """Return links that choose a gear; without scripts all gears are shown."""
    links = (gear_link(gear) for gear in gears)
    status = tag("span", role="status", class_="unseen")
    return tag("nav", tr("Gear"), *links, status, class_="chooser", aria_label=tr("Gear"))


def on_paper(drawn: Drawn, name: str, *, most: int = MOST_SHEETS) -> Markup:
    """Return a picture for print only, with at most `most` of its sheets."""
    first_sheets = drawn._replace(sheets=drawn.sheets[:most]).printed
    shown = [*figures(first_sheets, name, captioned=False, scrolls=False)]
    omitted = len(drawn.sheets) - len(first_sheets.sheets)
    if omitted:
        text = tr("{count} more sheet with --all.|{count} more sheets with --all.", count=omitted)
        shown.append(tag("p", text, class_="note"))
    return tag("div", *shown, class_=PAPER)


def side_by_side(gears: Sequence[str], drawn: Sequence[Drawn]) -> Markup:
    """Return small pictures of gears for print only, as many as the paper holds."""
    count = with_room(drawn)
    shown = (
        part
        for gear, picture in zip(gears[:count], drawn, strict=False)
        for part in figures(picture.printed, tr("Gear {gear}", gear=gear), scrolls=False)
    )
    return tag("div", *shown, *left_out(gears[count:]), class_=f"{PAPER} side-by-side")
