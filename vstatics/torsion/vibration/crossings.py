"""Motions that no variant couples: frequencies of different ones may cross in a sweep.

In natural modes of the first variant others have ``K + sum dc t t^T`` and ``M + sum dJ b b^T``,
with the twists t of the devices and the forms b of the bodies that vary. What no t or b has in
common stays apart in all variants; within each part frequencies keep their order (von Neumann,
Wigner, 1929). So the parts tell by shape which mode is which, for any variants in any order.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import APART
from vstatics.torsion.vibration.natural import natural_modes, weighted_bodies, weighted_twists


class SeparateMotions(NamedTuple):
    """Motions of a system that stay apart from all others."""

    modes: list[int]
    """Numbers of their modes in the first variant, from 0."""
    split: Coordinates
    devices: frozenset[int]
    bodies: frozenset[int]
    """What varies and has a part in them."""


def separate_motions(
    system: TorsionalSystem, split: Coordinates, devices: Collection[int], bodies: Collection[int]
) -> list[SeparateMotions]:
    """The parts of a system in which some stiffnesses and inertias vary.

    Parameters
    ----------
    system : TorsionalSystem
        The first variant.
    split : Coordinates
        Its own.
    devices, bodies : collection of int
        Places of those that vary.

    Examples
    --------
    Two masses on springs of their own; one spring varies, so the frequencies may cross.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> springs = [Spring({1: 1}, stiffness=9.0), Spring({2: 1}, stiffness=4.0)]
    >>> case = Transmission(2, [], [], [], springs=springs, inertias={1: 1.0, 2: 1.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> [one.modes for one in separate_motions(system, coordinates(system), [0], [])]
    [[1], [0]]
    """
    natural = natural_modes(system, split)
    rigid = split.rigid.shape[1]
    basis = np.hstack([split.rigid, natural.shapes])
    joined = _joined(_takers(system, basis, natural.omegas, devices, bodies))
    if split.massless.shape[1] and len(joined) > 1:  # massless motions may join any of them
        joined = [_together(joined)]
    taken = [motion for one in joined for motion in one.motions]
    still = _Takers(frozenset(), frozenset(), frozenset(range(basis.shape[1])).difference(taken))
    found = []
    for one in (*joined, still):
        columns = sorted(one.motions)
        modes = [column - rigid for column in columns if column >= rigid]
        if modes:
            free = np.hstack([basis[:, columns], split.massless])
            turning = split.rigid[:, [column for column in columns if column < rigid]]
            own = split._replace(free=free, rigid=turning)
            found.append(SeparateMotions(modes, own, one.devices, one.bodies))
    return found


class _Takers(NamedTuple):
    """What varies, and the motions that it has a part in: rigid ones first, then modes."""

    devices: frozenset[int]
    bodies: frozenset[int]
    motions: frozenset[int]


def _takers(
    system: TorsionalSystem,
    basis: Floats,
    omegas: Floats,
    devices: Collection[int],
    bodies: Collection[int],
) -> list[_Takers]:
    """Each device and body that varies, by its part in the energy of each motion."""
    rigid = np.ones(basis.shape[1] - len(omegas))
    sizes = np.concatenate([rigid, np.where(omegas, omegas, 1.0)])
    twists = np.abs(weighted_twists(system) @ basis) / sizes
    speeds = weighted_bodies(system) @ basis
    moved = np.abs(speeds) / np.linalg.norm(speeds, axis=0)

    def motions(parts: Floats) -> frozenset[int]:
        return frozenset(np.flatnonzero(parts > APART).tolist())

    nothing: frozenset[int] = frozenset()
    return [
        *(_Takers(frozenset([place]), nothing, motions(twists[place])) for place in devices),
        *(_Takers(nothing, frozenset([place]), motions(moved[place])) for place in bodies),
    ]


def _joined(takers: Sequence[_Takers]) -> list[_Takers]:
    """Those together that have a motion in common."""
    joined: list[_Takers] = []
    for some in takers:
        common = [one for one in joined if one.motions & some.motions]
        joined = [*(one for one in joined if one not in common), _together([some, *common])]
    return joined


def _together(takers: Sequence[_Takers]) -> _Takers:
    devices, bodies, motions = (frozenset[int]().union(*some) for some in zip(*takers, strict=True))
    return _Takers(devices, bodies, motions)
