"""Nodes of a mode: points at rest while the mode vibrates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.motions import Form
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem


def count_nodes(system: TorsionalSystem, split: Coordinates, shapes: Floats) -> NDArray[np.intp]:
    """Count the points at rest in each mode.

    An elastic component contains a node if all terms of its twist have the same sign, as in a shaft
    whose ends rotate in opposite directions. For a component with a reaction link, such as a
    casing, only links that rotate in rigid motions count. Adjacent links at rest form a single node
    if links move on at least two sides of them. In a chain the number of nodes is the number of
    lower modes, including rigid modes (Sturm), however small the amplitudes are.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        Amplitudes; the largest of each mode is about 1.
    """
    nodes = np.zeros(shapes.shape[1], np.intp)
    stands = np.abs(shapes) <= NO_POWER
    moving = np.where(stands, 0.0, shapes)
    turning = np.any(split.rigid != 0, axis=1)
    for device in system.elastic:
        turning_links = [link for link in device.twist if turning[link]]
        links = turning_links if len(turning_links) > 1 else device.twist
        terms = np.array([device.twist[link] * moving[link] for link in links])
        same = np.all(terms >= 0, axis=0) | np.all(terms <= 0, axis=0)
        nodes += same & (np.count_nonzero(terms, axis=0) > 1)
    movable = np.any(split.free != 0, axis=1)
    twists = [device.twist for device in system.devices]
    for mode in np.flatnonzero(stands[movable].any(axis=0)):
        nodes[mode] += _standing_groups(twists, stands[:, mode] & movable, ~stands[:, mode])
    for chain in _chains(system):
        joined = chain.tolist()
        largest, others = np.abs(shapes[joined]).max(axis=0), np.delete(shapes, joined, axis=0)
        sizes = np.abs(others).max(axis=0, initial=0.0)
        of_chain = np.flatnonzero(sizes <= NO_POWER * largest)
        nodes[of_chain] = np.arange(len(of_chain)) + int(split.rigid[joined].any())
    return nodes


def _chains(system: TorsionalSystem) -> Iterator[Integers]:
    """Yield the links of each chain, in which bodies of independent speeds are joined in a row."""
    free = system.free()
    moved = [np.flatnonzero(row).tolist() for row in system.rows(system.heavy) @ free]
    twisted = [np.flatnonzero(row).tolist() for row in system.twists @ free]
    group = _connected(free.shape[1], (*moved, *twisted))
    separate = {group[body[0]] for body in moved if len(body) > 1}
    by_group: dict[int, list[list[int]]] = {}
    for device in twisted:
        if len(device) > 1:
            by_group.setdefault(group[device[0]], []).append(device)
    motions_of: dict[int, list[int]] = {}
    for motion, number in enumerate(group):
        motions_of.setdefault(number, []).append(motion)
    for number, motions in motions_of.items():
        pairs = by_group.get(number, [])
        ends = Counter(motion for pair in pairs for motion in pair)
        if (
            number not in separate
            and len(pairs) == len(motions) - 1
            and all(len(pair) == 2 for pair in pairs)
            and max(ends.values(), default=0) <= 2
        ):
            yield np.flatnonzero(free[:, motions].any(axis=1))


def _connected(count: int, joined: Iterable[Sequence[int]]) -> list[int]:
    """Return the group number of each item; items in an entry of `joined` are connected."""
    pairs = [pair for items in joined for pair in pairwise(items)]
    rows, columns = np.array(pairs, np.intp).reshape(-1, 2).T
    graph = coo_array((np.ones(len(pairs)), (rows, columns)), shape=(count, count))
    groups: list[int] = connected_components(graph, directed=False)[1].tolist()
    return groups


def _standing_groups(twists: list[Form], stands: Booleans, moves: Booleans) -> int:
    """Return the number of connected groups of links at rest between moving links."""
    standing_in = [[link for link in twist if stands[link]] for twist in twists]
    group = _connected(len(stands), standing_in)
    sides: dict[int, int] = {}
    for twist, standing in zip(twists, standing_in, strict=True):
        groups = {group[link] for link in standing}
        for number in groups if any(moves[link] for link in twist) else ():
            sides[number] = sides.get(number, 0) + 1
    return sum(count > 1 for count in sides.values())
