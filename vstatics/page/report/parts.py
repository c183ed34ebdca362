"""Parts of the page of a case that several sections have."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from vstatics.core.tables.grid import NOTHING
from vstatics.core.tables.html import Markup, tag, terms
from vstatics.core.texts import tr
from vstatics.page.report.sheets import MOST_SHEETS, left_out, with_room
from vstatics.pictures.paged.drawn import Drawn, name_of
from vstatics.pictures.paged.parts import PAPER, figures, gear_link


def in_gear(kind: str, gear: str) -> str:
    """Return the name of a picture of a gear.

    >>> in_gear("flow", "R")
    'Power flow, gear R'
    """
    return tr("{picture}, gear {gear}", picture=name_of(kind), gear=gear)


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
