"""The lines of ties through the rows of levers of a picture; lengths in points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.groups import grouped
from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.lever.gear import LeverTie
from vstatics.pictures.lever.places import LeverPage
from vstatics.pictures.lever.routes import LeverStep, steps

LEAD_IN = 9.0
"""Of a line that comes from the row before."""
BandPoint = tuple[int, Point]
"""A row of levers, and a place over its foot."""


class LeverRoute(NamedTuple):
    """The line of a tie through the picture."""

    tie: LeverTie
    pieces: Sequence[Sequence[BandPoint]]
    """One in each row of levers."""
    sign: BandPoint | None = None
    """Where its sign stands, if it has one."""
    is_upright: bool = False
    """Whether that is on an upright line."""

    @property
    def points(self) -> list[BandPoint]:
        """All of them."""
        return [point for piece in self.pieces for point in piece]


def routes(page: LeverPage, ties: Iterable[LeverTie]) -> list[LeverRoute]:
    """Lines that join points, level but for a place of their own between two levers."""
    boxes = [lever.ratio is not None for lever in page.levers]
    found = steps([cell.rows for cell in page.cells], boxes, ties)
    return [_route(page, own) for own in grouped((step.tie, step) for step in found).values()]


def _route(page: LeverPage, own: Sequence[LeverStep]) -> LeverRoute:
    pieces: list[list[BandPoint]] = [[]]
    sign: BandPoint | None = None
    for step in own:
        cell = page.cells[step.gap]
        x, band = cell.right + step.x, cell.band
        pieces[-1] += [(band, (cell.right, step.start))]
        if step.wide:
            pieces[-1] += [(band, (x, step.start)), (band, (x + step.slant, step.end))]
        if step.is_signed:
            sign = band, (cell.right + step.sign_at, step.sign)
        if step.is_back:
            pieces[-1].append((band, (cell.right, step.end)))
            continue
        after = page.cells[step.gap + 1]
        if after.band != band:
            pieces[-1].append((band, (cell.right + cell.gap, step.end)))
            pieces.append([(after.band, (WIDE_MARGIN - LEAD_IN, step.end))])
        pieces[-1].append((after.band, (after.left, step.end)))
    return LeverRoute(
        own[0].tie, pieces, sign, any(one.is_signed and one.is_upright for one in own)
    )
