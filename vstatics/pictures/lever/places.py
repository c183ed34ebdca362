"""Positions of levers and texts, in rows no wider than the page; lengths in points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import inf
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.pictures.drawing.labels import Span, height, spread, widest, width, wrapped
from vstatics.pictures.drawing.pages import divided
from vstatics.pictures.drawing.style import SHORT_NAME, WIDE_MARGIN, Style
from vstatics.pictures.drawing.tolerances import LEAST_POINT_DISTANCE
from vstatics.pictures.drawing.words import word
from vstatics.pictures.lever.gear import brakes_of, joins, spots_of
from vstatics.pictures.lever.order import every, heights, ordered
from vstatics.pictures.lever.points import Lever, held_for_good, levers, shafts
from vstatics.pictures.lever.routes import UNDER, LeverRow, gaps_of

ARROW = 26.0
"""Length of the arrow for the largest torque. [pt]"""
SPEEDS = 32.0
"""Width of the area next to a lever in which speeds are drawn. [pt]"""
NUMBER_WIDTH = 30.0
"""Width reserved for a number. [pt]"""
BESIDE_LEVER = 6.0
"""Distance between a lever and the horizontal lines of the points. [pt]"""
LEAST, MOST = 62.0, 84.0
"""Smallest and largest height of levers with three points. [pt]"""
MOST_FOR_POINT = 22.0
"""Largest height per point of levers with many points. [pt]"""
GROUND_WIDTH, FREEWHEEL_WIDTH = 14.0, 9.0
"""Widths of the symbol of a support, and of a freewheel before the support. [pt]"""
COST_OF_ROW, COST_OF_CUT = 1e6, 1e3
"""Costs of a row of levers, and of each line that it cuts, relative to a full row. [-]"""
BRAKE_NAME_WIDTH = 40.0
"""Width reserved for the name of a brake; longer names reach towards the speed or are cut. [pt]"""


class LeverCell(NamedTuple):
    """Lever with the texts and lines of the points, and the horizontal position."""

    lever: Lever
    rows: dict[int, LeverRow]
    """Horizontal line of each point except the housing of a gear pair, by index of the point."""
    left: float
    at: float
    """Horizontal position of the lever. [pt]"""
    right: float
    """Right end of the cell. [pt]"""
    gap: float
    """Width of the gap to the right, for connections. [pt]"""
    band: int = 0
    """Index of the row of levers."""

    @property
    def speeds(self) -> Span:
        """Left and right end of the area of speeds [pt]; equal for a shaft without speeds."""
        end = self.right - NUMBER_WIDTH - BESIDE_LEVER
        return (end - SPEEDS, end) if self.lever.devices else (end, end)


class LeverPage(NamedTuple):
    """Positions of the levers of a case, common to all gears."""

    case: Transmission
    cells: Sequence[LeverCell]

    @property
    def levers(self) -> list[Lever]:
        """Levers from left to right."""
        return [cell.lever for cell in self.cells]

    @property
    def bands(self) -> list[list[int]]:
        """Indices of the levers in each row."""
        places = range(len(self.cells))
        last = self.cells[-1].band
        return [[n for n in places if self.cells[n].band == band] for band in range(last + 1)]

    @property
    def width(self) -> float:
        """Width of the widest row, with the connections after the last lever [pt]."""
        return max(cell.right + cell.gap for cell in self.cells)

    def extent(self, band: int) -> Span:
        """Return the heights of the lowest and highest point of a row of levers [pt]."""
        spans = [row.span for n in self.bands[band] for row in self.cells[n].rows.values()]
        return min(low for low, _ in spans), max(high for _, high in spans)


def page_of(case: Transmission, style: Style) -> LeverPage | None:
    """Return the positions of the levers of a case, if any."""
    drawn = levers(case, merged=style.merged)
    if not drawn:
        return None
    drawn = ordered(case, [*drawn, *shafts(case, drawn)])
    shares = heights(case, drawn)
    scale = max(_height(lever, some) for lever, some in zip(drawn, shares, strict=True))
    cells = []
    for lever, shares_of_lever, held in zip(drawn, shares, _held(case, drawn), strict=True):
        rows = _rows(case, lever, shares_of_lever, scale, style)
        wide = widest(row.name for row in rows.values())
        at = max(wide, ARROW + 10 if lever.devices else 0.0) + BESIDE_LEVER
        speeds = SPEEDS if lever.devices else 0.0
        right = at + BESIDE_LEVER + held + BESIDE_LEVER * bool(held) + NUMBER_WIDTH + speeds
        cells.append(LeverCell(lever, rows, 0.0, at, right, 0.0))
    gaps = gaps_of(case, drawn, [cell.rows for cell in cells])
    cells = [cell._replace(gap=gap) for cell, gap in zip(cells, gaps, strict=True)]
    passing = [*joins(drawn), *every(case, drawn)]
    cuts = [sum(tie.ends[0][0] <= n < tie.ends[1][0] for tie in passing) for n in range(len(drawn))]
    return LeverPage(case, list(_placed(cells, cuts, style.width - 2 * WIDE_MARGIN)))


def _placed(cells: Sequence[LeverCell], cuts: Sequence[int], room: float) -> Iterator[LeverCell]:
    for band, some in enumerate(broken([(cell.right, cell.gap) for cell in cells], cuts, room)):
        left = WIDE_MARGIN
        for cell in (cells[n] for n in some):
            at, right = left + cell.at, left + cell.right
            yield cell._replace(left=left, at=at, right=right, band=band)
            left = right + cell.gap


def broken(sizes: Sequence[tuple[float, float]], cuts: Sequence[int], room: float) -> list[range]:
    """Divide levers, given as (length, gap), into as few rows of the width `room` as possible.

    `cuts` is the number of lines that a new row after each lever would cut. Among divisions with
    the fewest rows, the division with the fewest cut lines is chosen, then the division into rows
    of similar lengths.

    >>> broken([(40.0, 5.0)] * 4, [1] * 4, 140.0), broken([(40.0, 5.0)] * 4, [1, 1, 0, 1], 140.0)
    ([range(0, 2), range(2, 4)], [range(0, 3), range(3, 4)])
    """

    def cost(start: int, end: int) -> float:
        long = sum(wide + gap for wide, gap in sizes[start:end])
        if long > room and end - start > 1:
            return inf
        return COST_OF_ROW + COST_OF_CUT * cuts[end - 1] + (long / room) ** 2

    return divided(range(1, len(sizes) + 1), cost)


def _held(case: Transmission, drawn: Sequence[Lever]) -> list[float]:
    """Return the width at each lever for support symbols and the names of brakes [pt]."""
    spots = spots_of(drawn)
    widths = [0.0] * len(drawn)
    good = (spots[link][0] for link in held_for_good(case) if link in spots)
    for place, _ in (*spots.get(HOUSING, ()), *good):
        widths[place] = GROUND_WIDTH
    for gear in [*case.gears, Gear(case.freewheels)]:
        for (place, _), some in brakes_of(case, gear, spots).items():
            named = min(width(", ".join(some)), BRAKE_NAME_WIDTH)
            sign = GROUND_WIDTH + FREEWHEEL_WIDTH * any_freewheel(case, some)
            widths[place] = max(widths[place], sign + named)
    return widths


def any_freewheel(case: Transmission, names: Sequence[str]) -> bool:
    """Return True if a shift element in a list of names is a freewheel."""
    return any(item.is_freewheel and item.name in names for item in case.shift_elements)


def _height(lever: Lever, shares: Sequence[float]) -> float:
    """Return the height of a lever [pt], sufficient for the texts between points up to a limit."""
    if len(lever.nodes) < 2:
        return LEAST
    least = min(abs(end - start) for start, end in pairwise(sorted(shares)))
    most = max(MOST, MOST_FOR_POINT * len(shares))
    return max(LEAST, min(most, 2.4 * UNDER / max(least, LEAST_POINT_DISTANCE)))


def _rows(
    case: Transmission, lever: Lever, shares: Sequence[float], scale: float, style: Style
) -> dict[int, LeverRow]:
    shown = [n for n in range(len(lever.nodes)) if lever.is_shown(n)]
    names = {n: node_text(case, lever, n, style) for n in shown}
    heights = [height(name) + 3 for name in names.values()]
    over = [(high - UNDER) / 2 for high in heights]
    wanted = [shares[n] * scale + up for n, up in zip(shown, over, strict=True)]
    middles = spread(wanted, [high + UNDER for high in heights])
    return {
        n: LeverRow(names[n], shares[n] * scale, middle - up)
        for n, middle, up in zip(shown, middles, over, strict=True)
    }


def node_text(case: Transmission, lever: Lever, number: int, style: Style) -> str:
    """Return the name of the link at a point, preceded by the member if needed."""
    node = lever.nodes[number]
    name = link_name(case, node.link, style)
    is_told = node.member.replace("_", " ").lower() in name.lower()
    if node.member and lever.ratio is None and not is_told:
        name = f"{word(node.member, style)}: {name}"
    return wrapped(name, SHORT_NAME)


def link_name(case: Transmission, link: int, style: Style) -> str:
    """Return the name of a link or of the housing."""
    return case.link_name(link) if link else style.text("housing")
