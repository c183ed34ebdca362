"""Where levers, their texts and what joins them stand in a picture; lengths in points."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.model.transmission import HOUSING, Gear, Transmission
from vstatics.pictures.lever.gear import Spot, brakes_of, spots_of
from vstatics.pictures.lever.order import every, heights, ordered
from vstatics.pictures.lever.points import Lever, held_for_good, levers, shafts
from vstatics.pictures.sheet.labels import Span, height, spread, widest, width, wrapped
from vstatics.pictures.sheet.style import SHORT_NAME, SIZE, WIDE_MARGIN, Style
from vstatics.pictures.sheet.tolerances import LEAST_POINT_DISTANCE
from vstatics.pictures.sheet.words import term, word

ARROW = 34.0
"""Of the longest torque."""
SPEEDS = 48.0
"""Width of the speeds of a lever."""
NUMBER = 30.0
"""Width of a number."""
BESIDE_LEVER = 7.0
"""Between a lever and the rows of its points."""
LEAST, MOST = 74.0, 125.0
"""Height of levers."""
UNDER = 1.25 * SIZE + 3.0
"""Room for a number under the line of a row."""
GROUND_WIDTH = 14.0
"""Width of the sign of what stands."""
BRAKE = 40.0
"""Room for the name of a brake; a longer one goes on over the speeds."""
LEAST_GAP = 34.0
"""Between levers."""


class LeverRow(NamedTuple):
    """The line of a point, with its texts."""

    name: str
    """In lines."""
    at: float
    """Height of the point on the lever."""
    y: float
    """Height of the line, which gives way to its neighbours."""

    @property
    def span(self) -> Span:
        """What its texts take of the height."""
        return self.y - UNDER, self.y + height(self.name) + 2


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

    @property
    def speeds(self) -> Span:
        """Ends of the speeds; of a shaft there is nothing between them."""
        end = self.right - NUMBER - BESIDE_LEVER
        return (end - SPEEDS, end) if self.lever.devices else (end, end)

    @property
    def middle(self) -> float:
        """Of the lever."""
        heights = [row.at for row in self.rows.values()]
        return (min(heights) + max(heights)) / 2

    @property
    def box(self) -> list[Span]:
        """What the ratio of a pair takes of the height; a lever has none."""
        return [(self.middle - SIZE, self.middle + SIZE)] if self.lever.ratio is not None else []


class LeverPage(NamedTuple):
    """The levers of a case in all its pictures."""

    case: Transmission
    cells: Sequence[LeverCell]

    @property
    def levers(self) -> list[Lever]:
        """From left to right."""
        return [cell.lever for cell in self.cells]

    @property
    def width(self) -> float:
        """With joins behind the last lever."""
        return self.cells[-1].right + self.cells[-1].gap

    @property
    def extent(self) -> Span:
        """The lowest and highest of all rows."""
        spans = [row.span for cell in self.cells for row in cell.rows.values()]
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
    cells, left = list[LeverCell](), WIDE_MARGIN
    between = zip(drawn, shares, _held(case, drawn), _gaps(case, drawn), strict=True)
    for lever, own, held, gap in between:
        rows = _rows(case, lever, own, scale, style)
        wide = widest(row.name for row in rows.values())
        at = left + max(wide, ARROW + 10 if lever.devices else 0.0) + BESIDE_LEVER
        speeds = SPEEDS if lever.devices else 0.0
        right = at + BESIDE_LEVER + held + BESIDE_LEVER + NUMBER + speeds
        cells.append(LeverCell(lever, rows, left, at, right, gap))
        left = right + gap
    return LeverPage(case, cells)


def _gaps(case: Transmission, drawn: Sequence[Lever]) -> list[float]:
    """Room behind each lever, for the names of what ties it to one on its right, or itself."""
    found = [LEAST_GAP] * (len(drawn) - 1) + [0.0]
    for one in every(case, drawn):
        place = one.ends[0][0]
        found[place] = max(found[place], LEAST_GAP, width(one.name) + 12)
    return found


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
            found[place] = max(found[place], GROUND_WIDTH + named)
    return found


def _height(lever: Lever, shares: Sequence[float]) -> float:
    """High enough for texts between the points, as far as it goes."""
    if len(lever.nodes) < 2:
        return LEAST
    least = min(abs(one - other) for one, other in pairwise(sorted(shares)))
    return max(LEAST, min(MOST, 2.4 * UNDER / max(least, LEAST_POINT_DISTANCE)))


def _rows(
    case: Transmission, lever: Lever, shares: Sequence[float], scale: float, style: Style
) -> dict[int, LeverRow]:
    shown = [n for n in range(len(lever.nodes)) if lever.is_shown(n)]
    names = {n: node_text(case, lever, n, style) for n in shown}
    heights = [height(name) + 2 for name in names.values()]
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
    return case.link_name(link) if link else term("housing", style)
