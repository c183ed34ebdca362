"""Test whether a train can be drawn as a half-section without crossings (planarity of a graph).

The graph includes the axis and the housing. A carrier of several gear sets or planes is split into
a part for each set: around its planets, sun, carrier, ring and carrier follow in this order.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice, pairwise, product
from math import prod

from vstatics.core.groups import grouped
from vstatics.pictures.schemes.coaxial.train import AXIS, HOUSING_VERTEX, CoaxialTrain, Planes

MOST_GRAPHS = 512
"""Largest number of ways to split carriers that are all tried; with more, carriers stay whole."""
_Vertex = int | tuple[int, int]
_Joined = tuple[_Vertex, _Vertex]
_NumberedSet = tuple[int, Planes]


def has_half_section(train: CoaxialTrain, left_out: int = 0) -> bool:
    """Return whether a half-section without crossings exists.

    Parameters
    ----------
    left_out : int
        Bit mask of the edges to ignore.

    Examples
    --------
    Link 1 is the carrier of two gear sets; one has sun 2 and ring 3, the other sun 4 and ring 5.
    Connecting the suns and connecting the rings needs no crossing, but connecting each sun with
    both other wheels does:

    >>> sets = [Planes(1, [(2, 3)]), Planes(1, [(4, 5)])]
    >>> has_half_section(CoaxialTrain(sets, [(2, 4), (3, 5)], [], 1, 2))
    True
    >>> has_half_section(CoaxialTrain(sets, [(2, 4), (4, 3), (3, 5), (5, 2)], [], 1, 1))
    False

    If there are too many arrangements to try, the answer can be True although none exists:

    >>> has_half_section(CoaxialTrain([Planes(1, [(2, 3)])] * 20, [], [], 1, 2))
    True
    """
    import networkx as nx  # networkx is an optional package

    numbered = enumerate(train.sets)
    by_carrier = grouped((planes.carrier, (number, planes)) for number, planes in numbered)
    apart = {
        carrier: sets
        for carrier, sets in by_carrier.items()
        if len(sets) > 1 or len(sets[0][1].wheels) > 1
    }
    ways = _ways(train, apart, left_out)
    if prod(map(len, ways)) > MOST_GRAPHS:
        ways = _ways(train, {}, left_out)
    graphs = (nx.Graph(chain.from_iterable(way)) for way in product(*ways))
    return any(nx.check_planarity(graph)[0] for graph in graphs)


def _ways(
    train: CoaxialTrain, apart: Mapping[int, Sequence[_NumberedSet]], left_out: int
) -> list[list[list[_Joined]]]:
    """Return, for each edge or group of edges, the alternatives from which a graph takes one."""
    ends = {link: list(chain(*map(_ends, sets))) for link, sets in apart.items()}

    def joined(
        bit: int, starts: Sequence[_Vertex], stops: Sequence[_Vertex]
    ) -> list[list[_Joined]]:
        return [[both] for both in product(starts, stops)] if not bit & left_out else [[]]

    ways: list[list[list[_Joined]]] = [[[(AXIS, HOUSING_VERTEX)]]]
    ways += [joined(0, [AXIS], ends.get(train.start, [train.start]))]
    ways += [[*islice(_trees(sets), MOST_GRAPHS + 1)] for sets in apart.values()]
    for sets in apart.values():
        for number, gear_set in sets:
            ways.append([_rim(number, gear_set)])
            for n, (wheels, bits) in enumerate(
                zip(gear_set.wheels, train.wheel_bits[number], strict=True)
            ):
                for wheel, bit, place in zip(wheels, bits, (2 * n + 2, 2 * n + 3), strict=True):
                    at: _Vertex = (number, place if len(gear_set.wheels) > 1 else 0)
                    ways += [joined(bit, [at], ends.get(wheel, [wheel]))] * bool(wheel)
    drawn = sum(
        bit
        for sets in apart.values()
        for number, _ in sets
        for bit in chain(*train.wheel_bits[number])
    )
    for bit, one_end, other_end in train.edges:
        if not bit & drawn and one_end != other_end:
            both = (ends.get(link, [link]) for link in (one_end, other_end))
            ways.append(joined(bit, *both))
    return ways


def _ends(numbered: _NumberedSet) -> list[_Vertex]:
    """Return the vertices of a carrier: one, or both ends if the gear set has several planes."""
    number, planes = numbered
    return [(number, end) for end in range(min(2, len(planes.wheels)))]


def _rim(number: int, gear_planes: Planes) -> list[_Joined]:
    """Return the edges of a gear set: a cycle of suns, carrier, rings, carrier around a hub."""
    planes = range(len(gear_planes.wheels))
    if len(planes) == 1:
        return []
    order = [0, *(2 * n + 2 for n in planes), 1, *(2 * n + 3 for n in reversed(planes))]
    rim: list[_Vertex] = [(number, place) for place in order]
    hub: _Vertex = (number, -1)
    return [*pairwise([*rim, rim[0]]), *((hub, vertex) for vertex in rim)]


def _trees(sets: Sequence[_NumberedSet]) -> Iterator[list[_Joined]]:
    """Yield all trees of edges that connect the parts of a split carrier."""
    import networkx as nx  # networkx is an optional package

    for code in product(range(len(sets)), repeat=max(len(sets) - 2, 0)):
        tree = nx.from_prufer_sequence(code).edges if len(sets) > 1 else ()
        joints = (product(_ends(sets[a]), _ends(sets[b])) for a, b in tree)
        yield from (list(way) for way in product(*joints))
