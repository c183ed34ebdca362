"""Cycles of an undirected graph: which of its edges are on one.

An edge is on a cycle unless it is a bridge, without which its ends are no longer joined.
A bridge is found in one walk over the graph (Tarjan, A note on finding the bridges of a
graph, Information Processing Letters 2, 1974): no edge but itself leads back from what
the walk found behind it.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

_Node = TypeVar("_Node", bound=Hashable)


def edges_on_cycles(edges: Iterable[tuple[_Node, _Node]]) -> set[tuple[_Node, _Node]]:
    """The edges that are no bridges.

    Parameters
    ----------
    edges : iterable of pairs of nodes
        Each once, from either end; of different nodes.

    Examples
    --------
    Two triangles, which one edge joins.

    >>> edges = [(1, 2), (2, 3), (3, 1), (3, 4), (4, 5), (5, 6), (6, 4)]
    >>> sorted(edges_on_cycles(edges))
    [(1, 2), (2, 3), (3, 1), (4, 5), (5, 6), (6, 4)]
    """
    given = [(one, other) for one, other in edges]
    nodes: dict[_Node, list[tuple[int, _Node]]] = {}
    for number, (one, other) in enumerate(given):
        nodes.setdefault(one, []).append((number, other))
        nodes.setdefault(other, []).append((number, one))
    found: dict[_Node, int] = {}
    return {given[number] for root in nodes for number in _closed(root, nodes, found)}


def _closed(
    root: _Node, nodes: Mapping[_Node, Sequence[tuple[int, _Node]]], found: dict[_Node, int]
) -> Iterator[int]:
    """Numbers of the edges on cycles, of all that a node is joined with.

    The walk goes on from the node found last, and counts the nodes in `found`. Back from
    what is behind a node, edges lead to a node counted `back` at the earliest.
    """
    if root in found:
        return
    found[root] = len(found)
    back: dict[_Node, int] = {root: found[root]}
    way = [(root, -1, iter(nodes[root]))]
    while way:
        node, entry, ahead = way[-1]
        for number, other in ahead:
            if number == entry:
                continue
            if other not in found:
                found[other] = back[other] = len(found)
                way.append((other, number, iter(nodes[other])))
                break
            back[node] = min(back[node], found[other])
            yield number
        else:
            way.pop()
            if way:
                before = way[-1][0]
                back[before] = min(back[before], back[node])
                if back[node] < found[node]:
                    yield entry
