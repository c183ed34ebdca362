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


class LeverRoute(NamedTuple):
    """Line of a connection through the rows of a picture."""

    tie: LeverTie
    pieces: Sequence[tuple[int, list[Point]]]
    """Pieces of the line: index of the row of levers, and points relative to the row's foot."""
    sign: tuple[int, Point] | None
    """Index of a row of levers, and position of the symbol of a clutch or spring, if any."""
    is_upright: bool
    """True if the symbol is on a vertical part of the line."""


def routes(page: LeverPage, ties: Iterable[LeverTie]) -> list[LeverRoute]:
    """Return the lines of connections, horizontal except for a vertical part between levers."""
    boxes = [lever.ratio is not None for lever in page.levers]
    all_steps = steps([cell.rows for cell in page.cells], boxes, ties)
    return [
        _route(page, tie_steps)
        for tie_steps in grouped((step.tie, step) for step in all_steps).values()
    ]


def _route(page: LeverPage, tie_steps: Sequence[LeverStep]) -> LeverRoute:
    pieces = [(page.cells[tie_steps[0].gap].band, list[Point]())]
    sign: tuple[int, Point] | None = None
    for step in tie_steps:
        cell = page.cells[step.gap]
        x, points = cell.right + step.x, pieces[-1][1]
        points.append((cell.right, step.start))
        if step.wide:
            points += [(x, step.start), (x + step.slant, step.end)]
        if step.is_signed:
            sign = cell.band, (cell.right + step.sign_at, step.sign)
        if step.is_back:
            points.append((cell.right, step.end))
            continue
        after = page.cells[step.gap + 1]
        if after.band != cell.band:
            points.append((cell.right + cell.gap, step.end))
            pieces.append((after.band, [(WIDE_MARGIN - LEAD_IN, step.end)]))
        pieces[-1][1].append((after.left, step.end))
    is_upright = any(step.is_signed and step.is_upright for step in tie_steps)
    return LeverRoute(tie_steps[0].tie, pieces, sign, is_upright)
