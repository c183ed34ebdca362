"""Whether what is not drawn yet can still be drawn to the right of what is."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterator, Sequence

from vstatics.pictures.schemes.coaxial.train import AXIS, HOUSING_VERTEX, CoaxialTrain


def can_go_on(train: CoaxialTrain, bars: Sequence[int], done: int) -> bool:
    """Whether no two parts of the rest alternate along the bars, so that they would cross.

    What is left falls into parts that hang together by links not begun. The bars from the axis
    to the housing are a line, all of the rest is on one side of it: of two parts, one lies
    between two neighbouring ends of the other. This is necessary, not sufficient.

    Parameters
    ----------
    bars : sequence of int
        From the axis outward: eight times a link, and the number of its part.
    """
    parts = list(_parts(train, bars, done))
    for own in parts:
        line = sorted(own)
        for other in parts:
            gaps = {bisect(line, place) % len(line) for place in other - own}
            if len(gaps) > 1:
                return False
    return True


def _parts(train: CoaxialTrain, bars: Sequence[int], done: int) -> Iterator[frozenset[int]]:  # noqa: C901 - what each edge joins
    """Of each part of the rest, the places of the bars that it ends at."""
    places: dict[int, set[int]] = {AXIS: {-1}, HOUSING_VERTEX: {len(bars)}}
    pieces: dict[int, set[int]] = {}
    for place, bar in enumerate(bars):
        places.setdefault(bar >> 3, set()).add(place)
        pieces.setdefault(bar >> 3, set()).add(bar)
    # a link with several bars that hang together may be met at any of them
    loose = {link for link, own in pieces.items() if len(own) == 1 and len(places[link]) > 1}
    ends = {link for link, own in places.items() if len(own) == 1}
    over: dict[int, int] = {}

    def root(link: int) -> int:
        while link in over:
            link = over[link]
        return link

    met = [(link, own) for link, own in places.items() if link not in loose and link not in ends]
    found: list[set[int]] = []
    for bit, one, other in train.edges:
        if done & bit or one in loose or other in loose:
            continue
        if one in ends and other in ends:
            found.append(places[one] | places[other])
        elif one in ends:
            met.append((other, places[one]))
        elif other in ends:
            met.append((one, places[other]))
        elif (first := root(one)) != (second := root(other)):
            over[first] = second
    groups: dict[int, set[int]] = {}
    for link, own in met:
        groups.setdefault(root(link), set()).update(own)
    yield from {frozenset(own) for own in (*found, *groups.values()) if len(own) > 1}
