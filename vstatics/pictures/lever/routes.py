"""How lines that join levers run; lengths in points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.pictures.lever.gear import LeverTie
from vstatics.pictures.lever.places import LeverPage
from vstatics.pictures.sheet.labels import Point, spread
from vstatics.pictures.sheet.style import SIZE

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
