"""Edges on cycles of an undirected graph.

An edge is on a cycle unless it is a bridge. The removal of a bridge separates its two nodes. Each
edge outside a spanning tree closes one cycle. An edge of the tree is on a cycle if any edge outside
the tree connects the nodes beyond it with other nodes.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable
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
    given = {*edges}
    nodes = defaultdict[_Node, list[tuple[_Node, tuple[_Node, _Node]]]](list)
    for edge in given:
        for node, other in (edge, edge[::-1]):
            nodes[node].append((other, edge))
    tree: dict[_Node, tuple[_Node, tuple[_Node, _Node]]] = {}
    waiting = [(node, node, (node, node)) for node in nodes]
    while waiting:
        node, before, edge = waiting.pop()
        if node not in tree:
            tree[node] = before, edge
            waiting += ((other, node, edge) for other, edge in nodes[node])
    closed = given.difference(edge for _, edge in tree.values())
    crossing = dict.fromkeys(nodes, 0)  # bits of `closed` edges that leave the nodes beyond
    for number, edge in enumerate(closed):
        for node in edge:
            crossing[node] ^= 1 << number
    for node, (before, edge) in reversed(tree.items()):
        if crossing[node]:
            closed.add(edge)
        crossing[before] ^= crossing[node]
    return closed
