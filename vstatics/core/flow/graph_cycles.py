"""Edges on cycles of an undirected graph.

An edge is on a cycle unless it is a bridge. The removal of a bridge separates its two nodes. A
single depth-first walk over the graph finds the bridges, because no other edge leads back from the
nodes beyond a bridge (Tarjan, A note on finding the bridges of a graph, Information Processing
Letters 2, 1974).
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

_Node = TypeVar("_Node", bound=Hashable)


def edges_on_cycles(edges: Iterable[tuple[_Node, _Node]]) -> set[tuple[_Node, _Node]]:
    """Return the edges that are not bridges.

    Parameters
    ----------
    edges : iterable of pairs of nodes
        Edges between different nodes. Each edge occurs once, in any direction.

    Examples
    --------
    Two triangles, joined by one edge.

    >>> edges = [(1, 2), (2, 3), (3, 1), (3, 4), (4, 5), (5, 6), (6, 4)]
    >>> sorted(edges_on_cycles(edges))
    [(1, 2), (2, 3), (3, 1), (4, 5), (5, 6), (6, 4)]
    """
    given = [(first, second) for first, second in edges]
    nodes: dict[_Node, list[tuple[int, _Node]]] = {}
    for number, (first, second) in enumerate(given):
        nodes.setdefault(first, []).append((number, second))
        nodes.setdefault(second, []).append((number, first))
    order: dict[_Node, int] = {}
    return {given[number] for root in nodes for number in _closed(root, nodes, order)}


def _closed(
    root: _Node, nodes: Mapping[_Node, Sequence[tuple[int, _Node]]], order: dict[_Node, int]
) -> Iterator[int]:
    """Yield the numbers of edges on cycles, for all nodes connected to `root`.

    A depth-first walk numbers the nodes in `order`. For each node, `back` is the smallest node
    number that edges reach from the node or from the nodes visited through it.
    """
    if root in order:
        return
    order[root] = len(order)
    back: dict[_Node, int] = {root: order[root]}
    way = [(root, -1, iter(nodes[root]))]
    while way:
        node, entry, ahead = way[-1]
        for number, other in ahead:
            if number == entry:
                continue
            if other not in order:
                order[other] = back[other] = len(order)
                way.append((other, number, iter(nodes[other])))
                break
            back[node] = min(back[node], order[other])
            yield number
        else:
            way.pop()
            if way:
                before = way[-1][0]
                back[before] = min(back[before], back[node])
                if back[node] < order[node]:
                    yield entry
