"""Search for a place within a panel where a text does not overlap with other texts."""

from __future__ import annotations

from collections.abc import Iterable

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Span

Taken = list[tuple[Span, Span]]
"""Horizontal and vertical extents of texts that are already placed. [pt]"""


def first_free(
    places: Iterable[Point], wide: float, high: float, size: Point, taken: Taken
) -> Point | None:
    """Return the first place where a centred text overlaps no other, and add it to `taken`.

    Parameters
    ----------
    wide, high : float
        Size of the text with margins. [pt]
    size : Point
        Size of the panel, within which the text must be. [pt]

    Examples
    --------
    >>> taken = []
    >>> places = [(4.0, 10.0), (10.0, 10.0), (30.0, 10.0)]
    >>> [first_free(places, 12.0, 8.0, (40.0, 20.0), taken) for _ in range(3)]
    [(10.0, 10.0), (30.0, 10.0), None]
    """
    for x, y in places:
        across, up = (x - wide / 2, x + wide / 2), (y - high / 2, y + high / 2)
        inside = across[0] > 0 and up[0] > 0 and across[1] < size[0] and up[1] < size[1]
        if inside and not any(
            _meet(across, other_across) and _meet(up, other_up) for other_across, other_up in taken
        ):
            taken.append((across, up))
            return x, y
    return None


def _meet(first: Span, second: Span) -> bool:
    return first[0] < second[1] and second[0] < first[1]
