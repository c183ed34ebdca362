"""Nodes of a mode: how many places stand still."""

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
    """How many places stand still in each mode.

    An elastic device has a node in it where all terms of its twist pull the same way: of a
    shaft, where its ends turn against each other. Of a device that a link with the reaction
    takes part in, such as a casing, the links count that turn when nothing vibrates. Links that
    stand, though they could move, are one node together with those that devices join to them,
    if there are links on two sides of them that move. In a chain their number is that of the
    lower modes, rigid ones too (Sturm), however small amplitudes are.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        The largest amplitude of each is about 1.
    """
    nodes = np.zeros(shapes.shape[1], np.intp)
    stands = np.abs(shapes) <= NO_POWER
    moving = np.where(stands, 0.0, shapes)
    turning = np.any(split.rigid != 0, axis=1)
    for device in system.elastic:
        own = [link for link in device.twist if turning[link]]
        links = own if len(own) > 1 else device.twist
        terms = np.array([device.twist[link] * moving[link] for link in links])
        same = np.all(terms >= 0, axis=0) | np.all(terms <= 0, axis=0)
        nodes += same & (np.count_nonzero(terms, axis=0) > 1)
    movable = np.any(split.free != 0, axis=1)
    twists = [device.twist for device in system.devices]
    for mode in np.flatnonzero(stands[movable].any(axis=0)):
        nodes[mode] += _standing_groups(twists, stands[:, mode] & movable, ~stands[:, mode])
    for chain in _chains(system):
        joined = chain.tolist()
        own, others = np.abs(shapes[joined]).max(axis=0), np.abs(np.delete(shapes, joined, axis=0))
        of_chain = np.flatnonzero(others.max(axis=0, initial=0.0) <= NO_POWER * own)
        nodes[of_chain] = np.arange(len(of_chain)) + int(split.rigid[joined].any())
    return nodes


def _chains(system: TorsionalSystem) -> Iterator[Integers]:
    """Links of each chain: bodies with a speed of their own, one device between neighbours."""
    free = system.free()
    heavy = [body.form for body in system.bodies if body.inertia > 0]
    moved = [set(np.flatnonzero(row).tolist()) for row in system.rows(heavy) @ free]
    twisted = [set(np.flatnonzero(row).tolist()) for row in system.twists @ free]
    group = list(range(free.shape[1]))
    for joined in (*moved, *twisted):
        groups = {group[one] for one in joined}
        group = [min(groups) if one in groups else one for one in group]
    for first in sorted(set(group)):
        own = {place for place, one in enumerate(group) if one == first}
        pairs = [one for one in twisted if one <= own and len(one) > 1]
        ends = [place for pair in pairs for place in pair]
        single = all(len(one) <= 1 for one in moved if one <= own)
        if (
            single
            and len(pairs) == len(own) - 1
            and all(len(pair) == 2 for pair in pairs)
            and max(map(ends.count, own), default=0) <= 2
        ):
            yield np.flatnonzero(free[:, sorted(own)].any(axis=1))


def _standing_groups(twists: list[Form], stands: Booleans, moves: Booleans) -> int:
    """How many groups of links stand, each joined by devices, between links that move."""
    group = list(range(len(stands)))
    for twist in twists:
        joined = {group[link] for link in twist if stands[link]}
        if len(joined) > 1:
            group = [min(joined) if one in joined else one for one in group]
    sides: dict[int, int] = {}
    for twist in twists:
        held = {group[link] for link in twist if stands[link]}
        for one in held if any(moves[link] for link in twist) else ():
            sides[one] = sides.get(one, 0) + 1
    return sum(count > 1 for count in sides.values())
