"""Groups of modes that no variant couples, whose frequencies can therefore cross in a sweep.

In coordinates of the natural modes of the first variant, another variant has the matrices ``K + sum
dc t t^T`` and ``M + sum dJ b b^T``. The vector t contains the twists of a varied component, and b
the speeds of a varied body. Modes without a common t or b remain uncoupled in all variants. Within
a group of coupled modes the frequencies keep their order (von Neumann, Wigner, 1929), so group and
order identify a mode in any variant.
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
    """Group of motions that are uncoupled from all other motions in every variant."""

    modes: list[int]
    """Numbers of the modes of the group in the first variant, from 0."""
    split: Coordinates
    devices: frozenset[int]
    bodies: frozenset[int]
    """Indices of the varied bodies that take part; `devices` contains varied components."""


def separate_motions(
    system: TorsionalSystem, split: Coordinates, devices: Collection[int], bodies: Collection[int]
) -> list[SeparateMotions]:
    """Return the uncoupled groups of motions of a system with varied stiffnesses and inertias.

    Parameters
    ----------
    system : TorsionalSystem
        The first variant.
    split : Coordinates
        Coordinates of `system`.
    devices, bodies : collection of int
        Indices of the varied components and bodies.

    Examples
    --------
    Two masses, each on a spring; one stiffness varies, so the frequencies can cross.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> springs = [Spring({1: 1}, stiffness=9.0), Spring({2: 1}, stiffness=4.0)]
    >>> case = Transmission(2, [], [], [], springs=springs, inertias={1: 1.0, 2: 1.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> [group.modes for group in separate_motions(system, coordinates(system), [0], [])]
    [[1], [0]]
    """
    natural = natural_modes(system, split)
    rigid = split.rigid.shape[1]
    basis = np.hstack([split.rigid, natural.shapes])
    joined: list[_Coupling] = []
    for coupling in _couplings(system, basis, natural.omegas, devices, bodies):
        common = [group for group in joined if group.motions & coupling.motions]
        joined = [*(group for group in joined if group not in common), _united([coupling, *common])]
    if split.massless.shape[1] and len(joined) > 1:  # a massless motion can couple all groups
        joined = [_united(joined)]
    coupled = [motion for group in joined for motion in group.motions]
    unvaried = _Coupling(
        frozenset(), frozenset(), frozenset(range(basis.shape[1])).difference(coupled)
    )
    groups = []
    for group in (*joined, unvaried):
        columns = sorted(group.motions)
        modes = [column - rigid for column in columns if column >= rigid]
        if modes:
            bound = np.hstack([basis[:, columns], split.massless])
            rigid_of_group = split.rigid[:, [column for column in columns if column < rigid]]
            coordinates_of_group = split._replace(bound=bound, rigid=rigid_of_group)
            groups.append(SeparateMotions(modes, coordinates_of_group, group.devices, group.bodies))
    return groups


class _Coupling(NamedTuple):
    """Motions coupled by varied components and bodies, by number; rigid motions come first."""

    devices: frozenset[int]
    bodies: frozenset[int]
    motions: frozenset[int]


def _couplings(
    system: TorsionalSystem,
    basis: Floats,
    omegas: Floats,
    devices: Collection[int],
    bodies: Collection[int],
) -> list[_Coupling]:
    rigid = np.ones(basis.shape[1] - len(omegas))
    sizes = np.concatenate([rigid, np.where(omegas, omegas, 1.0)])
    twists = np.abs(weighted_twists(system) @ basis) / sizes
    speeds = weighted_bodies(system) @ basis
    moved = np.abs(speeds) / np.linalg.norm(speeds, axis=0)

    def motions(parts: Floats) -> frozenset[int]:
        return frozenset(np.flatnonzero(parts > APART).tolist())

    nothing: frozenset[int] = frozenset()
    return [
        *(_Coupling(frozenset([place]), nothing, motions(twists[place])) for place in devices),
        *(_Coupling(nothing, frozenset([place]), motions(moved[place])) for place in bodies),
    ]


def _united(couplings: Sequence[_Coupling]) -> _Coupling:
    devices, bodies, motions = (
        frozenset[int]().union(*sets) for sets in zip(*couplings, strict=True)
    )
    return _Coupling(devices, bodies, motions)
