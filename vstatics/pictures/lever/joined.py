"""Lines of connections through all rows of levers of a picture; lengths in points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.lever.gear import LeverTie
from vstatics.pictures.lever.places import LeverPage
from vstatics.pictures.lever.routes import LeverStep, steps

LEAD_IN = 9.0
"""Length of the piece of line that comes from the previous row. [pt]"""
BandPoint = tuple[int, Point]
"""Index of a row of levers, and a point relative to the left end of the row's foot."""


class LeverRoute(NamedTuple):
    """Line of a connection through the rows of a picture."""

    tie: LeverTie
    pieces: Sequence[Sequence[BandPoint]]
    """Points of the line, as a separate piece in each row of levers."""
    sign: BandPoint | None
    """Position of the symbol of a clutch or spring, if any."""
    is_upright: bool
    """True if the symbol is on a vertical part of the line."""

    @property
    def points(self) -> list[BandPoint]:
        """Points of all pieces."""
        return [point for piece in self.pieces for point in piece]


def routes(page: LeverPage, ties: Iterable[LeverTie]) -> list[LeverRoute]:
    """Return the lines of connections, horizontal except for a vertical part between levers."""
    boxes = [lever.ratio is not None for lever in page.levers]
    all_steps = steps([cell.rows for cell in page.cells], boxes, ties)
    return [
        _route(page, tie_steps)
        for tie_steps in grouped((step.tie, step) for step in all_steps).values()
    ]


def _route(page: LeverPage, tie_steps: Sequence[LeverStep]) -> LeverRoute:
    pieces: list[list[BandPoint]] = [[]]
    sign: BandPoint | None = None
    for step in tie_steps:
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
        tie_steps[0].tie,
        pieces,
        sign,
        any(step_.is_signed and step_.is_upright for step_ in tie_steps),
    )
