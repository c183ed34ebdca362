"""Where levers and their texts stand in a picture, in rows of a width; lengths in points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.pictures.drawing.labels import Span, height, spread, widest, width, wrapped
from vstatics.pictures.drawing.style import SHORT_NAME, WIDE_MARGIN, Style
from vstatics.pictures.drawing.tolerances import LEAST_POINT_DISTANCE
from vstatics.pictures.drawing.words import word
from vstatics.pictures.lever.gear import Spot, brakes_of, joins, spots_of
from vstatics.pictures.lever.order import every, heights, ordered
from vstatics.pictures.lever.points import Lever, held_for_good, levers, shafts
from vstatics.pictures.lever.routes import UNDER, LeverRow, gaps_of, middle_of

ARROW = 26.0
"""Of the longest torque."""
SPEEDS = 32.0
"""Width of the speeds of a lever."""
NUMBER = 30.0
"""Width of a number."""
BESIDE_LEVER = 6.0
"""Between a lever and the rows of its points."""
LEAST, MOST = 62.0, 84.0
"""Height of levers of three points."""
MOST_FOR_POINT = 22.0
"""Of each point, of levers that have many."""
GROUND_WIDTH, FREEWHEEL_WIDTH = 14.0, 9.0
"""Width of the sign of what stands, and of a freewheel before it."""
BRAKE = 40.0
"""Room for the name of a brake; a longer one goes on over the speeds."""


class LeverCell(NamedTuple):
    """A lever with what stands beside it."""

    lever: Lever
    rows: dict[int, LeverRow]
    """By node; the housing of a pair has none."""
    left: float
    at: float
    """Where the lever stands."""
    right: float
    """Where it ends."""
    gap: float
    """Then joins follow for so long."""
    band: int = 0
    """In which row of levers it stands."""

    @property
    def speeds(self) -> Span:
        """Ends of the speeds; of a shaft there is nothing between them."""
        end = self.right - NUMBER - BESIDE_LEVER
        return (end - SPEEDS, end) if self.lever.devices else (end, end)

    @property
    def middle(self) -> float:
        """Of the lever."""
        return middle_of(self.rows)


class LeverPage(NamedTuple):
    """The levers of a case in all its pictures."""

    case: Transmission
    cells: Sequence[LeverCell]

    @property
    def levers(self) -> list[Lever]:
        """From left to right."""
        return [cell.lever for cell in self.cells]

    @property
    def bands(self) -> list[list[int]]:
        """The levers of each row."""
        places = range(len(self.cells))
        last = self.cells[-1].band
        return [[n for n in places if self.cells[n].band == band] for band in range(last + 1)]

    @property
    def width(self) -> float:
        """With joins behind the last lever of each row."""
        return max(cell.right + cell.gap for cell in self.cells)

    def extent(self, band: int) -> Span:
        """The lowest and highest of all rows of points in a row of levers."""
        spans = [row.span for n in self.bands[band] for row in self.cells[n].rows.values()]
        return min(low for low, _ in spans), max(high for _, high in spans)

    def row(self, spot: Spot) -> LeverRow:
        """The row of a point."""
        return self.cells[spot[0]].rows[spot[1]]


def page_of(case: Transmission, style: Style) -> LeverPage | None:
    """Where the levers of a case stand; none if it has none."""
    drawn = levers(case, merged=style.merged)
    if not drawn:
        return None
    drawn = ordered(case, [*drawn, *shafts(case, drawn)])
    shares = heights(case, drawn)
    scale = max(_height(lever, some) for lever, some in zip(drawn, shares, strict=True))
    cells = []
    for lever, own, held in zip(drawn, shares, _held(case, drawn), strict=True):
        rows = _rows(case, lever, own, scale, style)
        wide = widest(row.name for row in rows.values())
        at = max(wide, ARROW + 10 if lever.devices else 0.0) + BESIDE_LEVER
        speeds = SPEEDS if lever.devices else 0.0
        right = at + BESIDE_LEVER + held + BESIDE_LEVER * bool(held) + NUMBER + speeds
        cells.append(LeverCell(lever, rows, 0.0, at, right, 0.0))
    gaps = gaps_of(case, drawn, [cell.rows for cell in cells])
    cells = [cell._replace(gap=gap) for cell, gap in zip(cells, gaps, strict=True)]
    passing = [*joins(drawn), *every(case, drawn)]
    cuts = [sum(one.ends[0][0] <= n < one.ends[1][0] for one in passing) for n in range(len(drawn))]
    return LeverPage(case, list(_placed(cells, cuts, style.width - 2 * WIDE_MARGIN)))


def _placed(cells: Sequence[LeverCell], cuts: Sequence[int], room: float) -> Iterator[LeverCell]:
    """Levers side by side in as few rows as a width needs."""
    for band, some in enumerate(broken([(one.right, one.gap) for one in cells], cuts, room)):
        left = WIDE_MARGIN
        for cell in (cells[n] for n in some):
            at, right = left + cell.at, left + cell.right
            yield cell._replace(left=left, at=at, right=right, band=band)
            left = right + cell.gap


def broken(sizes: Sequence[tuple[float, float]], cuts: Sequence[int], room: float) -> list[range]:
    """Pieces of lengths, each with the gap behind it, in as few rows as there must be.

    Of these so that few lines are cut, as many as pass each gap, and no row is longer than it
    must be.

    >>> broken([(40.0, 5.0)] * 4, [1] * 4, 140.0), broken([(40.0, 5.0)] * 4, [1, 1, 0, 1], 140.0)
    ([range(0, 2), range(2, 4)], [range(0, 3), range(3, 4)])
    """
    best: list[tuple[int, int, float, list[range]]] = [(0, 0, 0.0, [])]
    for end in range(1, len(sizes) + 1):
        found = []
        for start in range(end):
            long = sum(wide + gap for wide, gap in sizes[start:end])
            if long <= room or end - start == 1:
                count, cost, most, rows = best[start]
                rows = [*rows, range(start, end)]
                found.append((count + 1, cost + cuts[end - 1], max(most, long), rows))
        best.append(min(found, key=lambda one: one[:3]))
    return best[-1][3]


def _held(case: Transmission, drawn: Sequence[Lever]) -> list[float]:
    """Width of the signs of what stands at each lever, with the names of its brakes."""
    spots = spots_of(drawn)
    found = [0.0] * len(drawn)
    good = (spots[link][0] for link in held_for_good(case) if link in spots)
    for place, _ in (*spots.get(HOUSING, ()), *good):
        found[place] = GROUND_WIDTH
    for gear in [*case.gears, Gear(case.freewheels)]:
        for (place, _), some in brakes_of(case, gear, spots).items():
            named = min(width(", ".join(some)), BRAKE)
            sign = GROUND_WIDTH + FREEWHEEL_WIDTH * any_freewheel(case, some)
            found[place] = max(found[place], sign + named)
    return found


def any_freewheel(case: Transmission, names: Sequence[str]) -> bool:
    """Whether one of some shift elements is a freewheel."""
    return any(one.is_freewheel and one.name in names for one in case.shift_elements)


def _height(lever: Lever, shares: Sequence[float]) -> float:
    """High enough for texts between the points, as far as it goes."""
    if len(lever.nodes) < 2:
        return LEAST
    least = min(abs(one - other) for one, other in pairwise(sorted(shares)))
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
    """The link of a node, with what it is in the element if its name does not tell."""
    node = lever.nodes[number]
    name = link_name(case, node.link, style)
    is_told = node.member.replace("_", " ").lower() in name.lower()
    if node.member and lever.ratio is None and not is_told:
        name = f"{word(node.member, style)}: {name}"
    return wrapped(name, SHORT_NAME)


def link_name(case: Transmission, link: int, style: Style) -> str:
    """The name of a link, or of the housing."""
    return case.link_name(link) if link else style.text("housing")
