"""Whether a train has a half-section without crossings: a planar graph with the axis.

A carrier that is that of several sets, or of one with several planes, is taken apart: each set has
its own planets, round which sun, carrier, ring and carrier stand in this order.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, combinations, pairwise, product
from math import prod

from vstatics.pictures.schemes.coaxial.train import AXIS, HOUSING_VERTEX, CoaxialTrain, Planes

MOST_GRAPHS = 512
"""Ways to take carriers apart that are tried; where there are more, none is taken apart."""
_Vertex = int | tuple[int, int]
_Joined = tuple[_Vertex, _Vertex]
_NumberedSet = tuple[int, Planes]


def has_half_section(train: CoaxialTrain, left_out: int = 0) -> bool:
    """Whether a half-section without crossings exists.

    Parameters
    ----------
    left_out : int
        The bits of edges that need not be drawn.

    Examples
    --------
    Carriers of two sets side by side: each sun goes to the other set's ring past the planets.

    >>> sets = [Planes(1, [(2, 3)]), Planes(1, [(4, 5)])]
    >>> has_half_section(CoaxialTrain(sets, [(2, 4), (3, 5)], [], 1, 2))
    True
    >>> has_half_section(CoaxialTrain(sets, [(2, 4), (4, 3), (3, 5), (5, 2)], [], 1, 1))
    False

    Where there are more ways than are tried, the answer is kinder than it should be.

    >>> has_half_section(CoaxialTrain([Planes(1, [(2, 3)])] * 20, [], [], 1, 2))
    True
    """
    import networkx as nx  # an extra

    own: dict[int, list[_NumberedSet]] = {}
    for number, one in enumerate(train.sets):
        own.setdefault(one.carrier, []).append((number, one))
    apart = {c: sets for c, sets in own.items() if len(sets) > 1 or len(sets[0][1].wheels) > 1}
    if any(len(sets) ** (len(sets) - 2) > MOST_GRAPHS for sets in apart.values()):
        apart = {}  # so many trees n parts of a carrier have (Cayley)
    ways = _ways(train, apart, left_out)
    if prod(map(len, ways)) > MOST_GRAPHS:
        ways = _ways(train, {}, left_out)
    graphs = (nx.Graph(chain.from_iterable(way)) for way in product(*ways))
    return any(nx.check_planarity(graph)[0] for graph in graphs)


def _ways(
    train: CoaxialTrain, apart: Mapping[int, Sequence[_NumberedSet]], left_out: int
) -> list[list[list[_Joined]]]:
    """What is joined, for each of the things that can be joined in several ways, these."""
    ends = {link: list(chain(*map(_ends, sets))) for link, sets in apart.items()}

    def joined(bit: int, one: Sequence[_Vertex], other: Sequence[_Vertex]) -> list[list[_Joined]]:
        return [[both] for both in product(one, other)] if not bit & left_out else [[]]

    ways: list[list[list[_Joined]]] = [[[(AXIS, HOUSING_VERTEX)]]]
    ways += [joined(0, [AXIS], ends.get(train.start, [train.start]))]
    ways += [list(_trees(sets)) for sets in apart.values()]
    for sets in apart.values():
        for number, one in sets:
            ways.append([_rim(number, one)])
            for n, (wheels, bits) in enumerate(
                zip(one.wheels, train.wheel_bits[number], strict=True)
            ):
                for wheel, bit, place in zip(wheels, bits, (2 * n + 2, 2 * n + 3), strict=True):
                    at: _Vertex = (number, place if len(one.wheels) > 1 else 0)
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
    """Where a carrier may be joined at a set: at both ends of its planets if it has planes."""
    number, one = numbered
    return [(number, end) for end in range(min(2, len(one.wheels)))]


def _rim(number: int, one: Planes) -> list[_Joined]:
    """A wheel round a hub: suns, an end of the carrier, rings, the other end."""
    planes = range(len(one.wheels))
    if len(planes) == 1:
        return []
    order = [0, *(2 * n + 2 for n in planes), 1, *(2 * n + 3 for n in reversed(planes))]
    rim: list[_Vertex] = [(number, place) for place in order]
    hub: _Vertex = (number, -1)
    return [*pairwise([*rim, rim[0]]), *((hub, vertex) for vertex in rim)]


def _trees(sets: Sequence[_NumberedSet]) -> Iterator[list[_Joined]]:
    """All ways in which the parts of a carrier hang together."""
    import networkx as nx  # an extra

    places = range(len(sets))
    for tree in combinations(combinations(places, 2), len(sets) - 1):
        if len(sets) == 1 or (len(set(chain(*tree))) == len(sets) and nx.is_tree(nx.Graph(tree))):
            joints = (product(_ends(sets[a]), _ends(sets[b])) for a, b in tree)
            yield from (list(way) for way in product(*joints))
