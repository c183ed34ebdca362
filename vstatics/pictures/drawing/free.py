"""Places within a panel where a text covers no other one."""

from __future__ import annotations

from collections.abc import Iterable

from vstatics.pictures.drawing.labels import Point, Span

Taken = list[tuple[Span, Span]]
"""What texts that stand already take across and upward [pt]."""


def first_free(
    places: Iterable[Point], wide: float, high: float, size: Point, taken: Taken
) -> Point | None:
    """The first place that can be the middle of a text; it is taken then.

    Parameters
    ----------
    wide, high : float
        Of the text, with the room around it. [pt]
    size : Point
        Of the panel, which the text does not leave.

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
        if inside and not any(_meet(across, own) and _meet(up, other) for own, other in taken):
            taken.append((across, up))
            return x, y
    return None


def _meet(one: Span, other: Span) -> bool:
    return one[0] < other[1] and other[0] < one[1]
