"""Test whether the remaining components can still be drawn to the right."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterator, Sequence

from vstatics.pictures.schemes.coaxial.train import AXIS, HOUSING_VERTEX, CoaxialTrain


def can_go_on(train: CoaxialTrain, bars: Sequence[int], done: int) -> bool:
    """Return False if the remaining components certainly cannot be drawn without crossings.

    Remaining components joined by links that have not begun form a part. All parts are to the right
    of the present bars (lines of links), from the axis to the housing. Two parts would cross if
    their ends alternate along the bars. The condition is necessary, but not sufficient.

    Parameters
    ----------
    bars : sequence of int
        Bars from the axis outwards, each as 8 times its link plus the number of its part.
    """
    parts = list(_parts(train, bars, done))
    for places in parts:
        line = sorted(places)
        for other in parts:
            gaps = {bisect(line, place) % len(line) for place in other - places}
            if len(gaps) > 1:
                return False
    return True


def _parts(train: CoaxialTrain, bars: Sequence[int], done: int) -> Iterator[frozenset[int]]:  # noqa: C901 - by kind of edge
    """Yield the indices of the bars at which each connected part of the remainder ends."""
    places: dict[int, set[int]] = {AXIS: {-1}, HOUSING_VERTEX: {len(bars)}}
    pieces: dict[int, set[int]] = {}
    for place, bar in enumerate(bars):
        places.setdefault(bar >> 3, set()).add(place)
        pieces.setdefault(bar >> 3, set()).add(bar)
    # A link whose bars are connected to each other can be met at any of them.
    loose = {
        link
        for link, bars_of_link in pieces.items()
        if len(bars_of_link) == 1 and len(places[link]) > 1
    }
    ends = {link for link, bars_of_link in places.items() if len(bars_of_link) == 1}
    over: dict[int, int] = {}

    def root(link: int) -> int:
        while link in over:
            link = over[link]
        return link

    met = [
        (link, bars_of_link)
        for link, bars_of_link in places.items()
        if link not in loose and link not in ends
    ]
    single_edges: list[set[int]] = []
    for bit, first_link, second_link in train.edges:
        if done & bit or first_link in loose or second_link in loose:
            continue
        if first_link in ends and second_link in ends:
            single_edges.append(places[first_link] | places[second_link])
        elif first_link in ends:
            met.append((second_link, places[first_link]))
        elif second_link in ends:
            met.append((first_link, places[second_link]))
        elif (first := root(first_link)) != (second := root(second_link)):
            over[first] = second
    groups: dict[int, set[int]] = {}
    for link, bars_of_link in met:
        groups.setdefault(root(link), set()).update(bars_of_link)
    yield from {
        frozenset(bars_of_link)
        for bars_of_link in (*single_edges, *groups.values())
        if len(bars_of_link) > 1
    }
