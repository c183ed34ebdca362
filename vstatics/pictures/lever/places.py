"""Where levers, their texts and what joins them stand in a picture; lengths in points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.model.transmission import HOUSING, Gear, Transmission
from vstatics.pictures.lever.gear import LeverTie, Spot, brakes_of, spots_of
from vstatics.pictures.lever.order import every, heights, ordered
from vstatics.pictures.lever.points import Lever, held_for_good, levers, shafts
from vstatics.pictures.sheet.labels import Point, Span, height, spread, widest, width, wrapped
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


LANE = 6.0
"""Between lines that pass levers."""


class LeverRoute(NamedTuple):
    """The line of a tie through the picture."""

    tie: LeverTie
    points: Sequence[Point]
    sign: Point
    """Where its sign stands, if it has one."""


def routes(page: LeverPage, ties: Iterable[LeverTie]) -> list[LeverRoute]:
    """Lines that join points: slanted between neighbours, level where they pass a lever."""
    signed = list(ties)
    middles = _signs(page, [one for one in signed if one.name])
    used: list[tuple[int, float]] = []
    return [
        LeverRoute(one, list(_points(page, one, middles.get(one), used)), middles.get(one, (0, 0)))
        for one in sorted(signed, key=lambda one: (bool(one.name), one.ends[1][0] - one.ends[0][0]))
    ]


def _signs(page: LeverPage, ties: Sequence[LeverTie]) -> dict[LeverTie, Point]:
    """Where signs stand, right of the first point, so that their names keep apart."""
    found: dict[LeverTie, Point] = {}
    for place, cell in enumerate(page.cells):
        here = [one for one in ties if one.ends[0][0] == place]
        ends = [[page.row(spot).y for spot in one.ends] for one in here]
        # where several may cross each is nearer to where it begins
        share = 0.3 if len({start for start, _ in ends}) > 1 else 0.5
        wanted = [(1 - share) * start + share * end for start, end in ends]
        for one, y in zip(here, spread(wanted, [2.6 * SIZE] * len(here)), strict=True):
            found[one] = cell.right + cell.gap / 2, y
    return found


def _points(
    page: LeverPage, one: LeverTie, sign: Point | None, used: list[tuple[int, float]]
) -> Iterator[Point]:
    (first, _), (last, _) = one.ends
    start, end = (page.row(spot).y for spot in one.ends)
    yield page.cells[first].right, start
    if sign is not None:
        yield sign
    if first == last:
        yield page.cells[first].right, end
        return
    between = range(first + 1, last)
    if between:
        lane = _lane(page, between, (start + end) / 2, used)
        for place in between:
            yield page.cells[place].left, lane
            yield page.cells[place].right, lane
    yield page.cells[last].left, end


def _lane(page: LeverPage, between: range, wanted: float, used: list[tuple[int, float]]) -> float:
    """The free height next to a wanted one, past some levers."""
    spans = [row.span for place in between for row in page.cells[place].rows.values()]
    taken = [(low - 1, high + 2) for low, high in spans]
    taken += [box for place in between for box in page.cells[place].box]
    taken += [(y - LANE, y + LANE) for place, y in used if place in between]
    places = [wanted, *(y for span in taken for y in span)]
    free = [y for y in places if not any(low < y < high for low, high in taken)]
    lane = min(free, key=lambda y: abs(y - wanted))
    used += [(place, lane) for place in between]
    return lane
