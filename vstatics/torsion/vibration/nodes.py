"""Nodes of a mode: the places at rest while the mode vibrates."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.motions import Form
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem


def count_nodes(system: TorsionalSystem, split: Coordinates, shapes: Floats) -> NDArray[np.intp]:
    """Count the places at rest in each mode.

    An elastic device contains a node if all terms of its twist have the same sign: a shaft, if
    its ends rotate in opposite directions. For a device that includes a reaction link, such as
    a casing, only the links count that rotate in rigid motions. Movable links at rest form one
    node together with neighbours at rest, if links move on at least two sides of them. In a
    chain the number of nodes is the number of lower modes including rigid ones (Sturm), however
    small the amplitudes are.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        Amplitudes, of which the largest of each mode is about 1.
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
    """Yield the links of each chain: bodies with separate speeds, joined in a row by devices."""
    free = system.free()
    heavy = [body.form for body in system.bodies if body.inertia > 0]
    moved = [set(np.flatnonzero(row).tolist()) for row in system.rows(heavy) @ free]
    twisted = [set(np.flatnonzero(row).tolist()) for row in system.twists @ free]
    group = list(range(free.shape[1]))
    for joined in (*moved, *twisted):
        groups = {group[motion] for motion in joined}
        group = [min(groups) if label in groups else label for label in group]
    for first in sorted(set(group)):
        motions = {motion for motion, label in enumerate(group) if label == first}
        pairs = [pair for pair in twisted if pair <= motions and len(pair) > 1]
        ends = [motion for pair in pairs for motion in pair]
        single = all(len(body) <= 1 for body in moved if body <= motions)
        if (
            single
            and len(pairs) == len(motions) - 1
            and all(len(pair) == 2 for pair in pairs)
            and max(map(ends.count, motions), default=0) <= 2
        ):
            yield np.flatnonzero(free[:, sorted(motions)].any(axis=1))


def _standing_groups(twists: list[Form], stands: Booleans, moves: Booleans) -> int:
    """Count the connected groups of links at rest that lie between moving links."""
    group = list(range(len(stands)))
    for twist in twists:
        joined = {group[link] for link in twist if stands[link]}
        if len(joined) > 1:
            group = [min(joined) if label in joined else label for label in group]
    sides: dict[int, int] = {}
    for twist in twists:
        standing = {group[link] for link in twist if stands[link]}
        for label in standing if any(moves[link] for link in twist) else ():
            sides[label] = sides.get(label, 0) + 1
    return sum(count > 1 for count in sides.values())
