"""Limits of printed pictures, so that the page of a case fits on ten sheets of paper."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from vstatics.core.tables.html import Markup, tag
from vstatics.core.texts import tr
from vstatics.pictures.drawing.style import PAGE_HEIGHT
from vstatics.pictures.paged.drawn import HALF, PAGE, Drawn

MOST_SHEETS = 10
"""Largest number of printed sheets for a case."""
STICK_ROOM = 1.7
"""Room on paper for small stick diagrams of all gears. [sheets]"""
FLOW_SHEETS = 5
"""Number of printed sheets of power flow on a page without sections of annexes."""
LESS_BESIDE = 2
"""Number of sheets of power flow that each section of an annex replaces."""
CAPTION = 22.0
"""Height of a caption including margins. [pt]"""
_SIZE = re.compile(r'viewbox="0 0 ([\d.]+) ([\d.]+)"', re.IGNORECASE)


def size_of(sheet: Markup) -> tuple[float, float]:
    """Return the width and height of a picture [pt].

    >>> size_of(Markup('<svg viewBox="0 0 482 300.5">'))
    (482.0, 300.5)
    """
    match = _SIZE.search(sheet)
    return (float(match[1]), float(match[2])) if match else (0.0, 0.0)


def with_room(pictures: Sequence[Drawn]) -> int:
    """Return the number of small pictures, two in a row, that fit on the sheets.

    >>> low, high = (Drawn("stick", [Markup(f'<svg viewBox="0 0 200 {h}">')]) for h in (60, 340))
    >>> with_room([low] * 20), with_room([high] * 20)
    (20, 6)
    """
    rows: list[float] = []
    is_open = False
    for number, picture in enumerate(pictures):
        sizes = [size_of(sheet) for sheet in picture.sheets] or [(0.0, 0.0)]
        wide, high = map(max, zip(*sizes, strict=True))
        # Pictures wider than the page are scaled down.
        high *= min(1.0, PAGE.width / max(wide, 1.0))
        is_small = wide <= HALF.width
        if is_small and is_open:
            rows[-1] = max(rows[-1], high + CAPTION)
            is_open = False
        else:
            rows.append(len(sizes) * (high + CAPTION))
            is_open = is_small
        if sum(rows) > STICK_ROOM * PAGE_HEIGHT:
            return number - (number % 2 if is_small else 0)
    return len(pictures)


def flow_sheets(others: int) -> int:
    """Return the number of power-flow sheets on a page with `others` sections of annexes."""
    return FLOW_SHEETS - LESS_BESIDE * others


def left_out(names: Sequence[str]) -> Iterator[Markup]:
    """Yield a note on gears whose pictures are not printed."""
    if names:
        note = tr(
            "Not printed: diagram of gear {gears}; --all prints all of them.|"
            "Not printed: diagrams of gears {gears}; --all prints all of them.",
            gears=", ".join(names),
            count=len(names),
        )
        yield tag("p", note, class_="note")
