"""Room on paper: what of many pictures is printed, so that a case has ten sheets at most."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from vstatics.core.tables.html import Markup, tag
from vstatics.core.texts import tr
from vstatics.pictures.drawing.style import PAGE_HEIGHT
from vstatics.pictures.paged.drawn import HALF, PAGE, Drawn

MOST_SHEETS = 10
"""Of paper, for a case."""
STICK_ROOM = 1.7
"""Of small stick diagrams. [sheets]"""
FLOW_SHEETS = 5
"""Of power flow where a case has nothing else; each of the next takes some."""
LESS_BESIDE = 2
"""Sheets that each section of an annex takes from those of power flow."""
CAPTION = 22.0
"""Height of a caption with its margins. [pt]"""
_SIZE = re.compile(r'viewbox="0 0 ([\d.]+) ([\d.]+)"', re.IGNORECASE)


def size_of(sheet: Markup) -> tuple[float, float]:
    """Width and height of a picture [pt].

    >>> size_of(Markup('<svg viewBox="0 0 482 300.5">'))
    (482.0, 300.5)
    """
    found = _SIZE.search(sheet)
    return (float(found[1]), float(found[2])) if found else (0.0, 0.0)


def with_room(pictures: Sequence[Drawn], sheets: float = STICK_ROOM) -> int:
    """So many of some small pictures have room on so many sheets; two stand side by side.

    >>> low, high = (Drawn("stick", [Markup(f'<svg viewBox="0 0 200 {h}">')]) for h in (60, 340))
    >>> with_room([low] * 20), with_room([high] * 20)
    (20, 6)
    """
    rows: list[float] = []
    is_open = False
    for number, one in enumerate(pictures):
        sizes = [size_of(sheet) for sheet in one.sheets] or [(0.0, 0.0)]
        wide, high = map(max, zip(*sizes, strict=True))
        high *= min(1.0, PAGE.width / max(wide, 1.0))  # one that is wider is drawn smaller
        is_small = wide <= HALF.width
        if is_small and is_open:
            rows[-1] = max(rows[-1], high + CAPTION)
            is_open = False
        else:
            rows.append(len(sizes) * (high + CAPTION))
            is_open = is_small
        if sum(rows) > sheets * PAGE_HEIGHT:
            return number - (number % 2 if is_small else 0)
    return len(pictures)


def flow_sheets(others: int) -> int:
    """Return the number of printed sheets of power flow where annexes have so many sections."""
    return FLOW_SHEETS - LESS_BESIDE * others


def left_out(names: Sequence[str]) -> Iterator[Markup]:
    """What says that pictures of gears are not printed."""
    if names:
        said = tr(
            "Not printed: diagram of gear {gears}; --all prints all of them.|"
            "Not printed: diagrams of gears {gears}; --all prints all of them.",
            gears=", ".join(names),
            count=len(names),
        )
        yield tag("p", said, class_="note")
