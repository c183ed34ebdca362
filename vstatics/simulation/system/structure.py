"""The equations of motion while the same things stick: constant matrices.

``M dw/dt = F - B x`` and ``C' w = 0``: the columns C are those of rigid mechanisms and of contacts
that stick, B is C with ``u eta^x`` in place of u. With N and L, bases of what C and B leave
free, ``(L' M N) dq/dt = L' F`` and ``w = N q``. Motions in which nothing heavy moves are apart:
along these the torques balance, ``L0' F = 0``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, largest
from vstatics.simulation.system.matrices import MotionSystem, Switch
from vstatics.simulation.tolerances import (
    BEARING_MOTION,
    DEPENDENT,
    INDEPENDENT_MOTION,
    NOT_ZERO,
    ROUNDED_MOTION,
    STANDING,
)

Held = tuple[bool, ...]
"""Of each contact, whether it sticks."""
MeshStates = tuple[str, ...]
"""Of each rigid mechanism: `""` lossless; `stick`; else the signs of the speed of its first link
against the third and of the torque on its first link, as `+-`."""

_LAST_PREFERENCE = 1e2
_FIRST = 1e-2
"""Weights in the norm of redundant torques: drags and meshes take a part last."""


class Multiplier(NamedTuple):
    """A torque that follows from what holds."""

    kind: str
    """`mesh`: on the first link of a mechanism; `friction` of a mesh that sticks; `contact`."""
    of: int


class MotionStructure:
    """Matrices while the same things stick.

    Attributes
    ----------
    free : ndarray, shape (links, motions)
        Speeds of links by those of the motions with inertia, ``N``. The last of them are those
        of contacts that stick at speeds other than 0, ``p``: these speeds are their sizes.
    light : ndarray, shape (links, massless motions)
        Speeds of links by those of the motions without.
    drivers : sequence of int
        Contacts that stick at speeds other than 0, one for each such speed.
    projection : ndarray, shape (motions, links)
        Motions of the same momentum by speeds of links that do not fit, as those of links without
        inertia.
    rates, light_rates : ndarray
        Rates of ports by these.
    accelerations : ndarray, shape (motions, ports)
        dq/dt by the torques of ports; in place of the torque of a driver stands the change of its
        speed, dw0/dt.
    balances : ndarray, shape (massless motions, ports)
        What must be 0, by the torques of ports.
    multipliers : sequence of Multiplier
    torques : ndarray, shape (multipliers, ports)
        By the torques of ports; of redundant ones those of least norm.
    redundant : ndarray, shape (multipliers, directions)
        Changes of these that change nothing else, orthonormal in the weighted norm.
    mesh_rates, mesh_light_rates : ndarray
        What a mesh loses by the torque on its first link, by the motions.
    """

    def __init__(self, system: MotionSystem, held: Held, meshes: MeshStates) -> None:
        self.held = held
        rows, columns, self.multipliers = _constraints(system, held, meshes)
        mass, ports = system.mass, system.port_rows
        signs = np.full(len(ports), -1.0)
        signs[: len(system.outside)] = 1.0
        forces = ports.T * signs
        self.free, self.light = _motions(system.heavy, rows)
        left, left_light = self.free, self.light
        taken = columns.T[: len(meshes)] - rows.T[: len(meshes)]
        conditions = np.zeros((len(self.multipliers), 0))
        if columns is not rows:
            friction = np.array([one.kind == "friction" for one in self.multipliers])
            circulating, conditions = _circulating(rows, columns, friction)
            columns = columns - columns @ circulating @ conditions.T
            left, left_light = _motions(system.heavy, columns)
        momenta = self.free.T @ mass
        self.projection = np.asarray(np.linalg.solve(momenta @ self.free, momenta), float)
        self.light_rates = ports @ self.light
        self.balances = left_light.T @ forces
        reduced = left.T @ mass @ self.free
        self.accelerations: Floats = np.linalg.solve(reduced, left.T @ forces)
        self.drivers, driven = _driven(system, self.multipliers, rows)
        if self.drivers:
            at = [system.layout.contacts + index for index in self.drivers]
            self.accelerations[:, at] = -np.linalg.solve(reduced, left.T @ mass @ driven)
            forces[:, at] = 0.0
            self.free = np.column_stack([self.free, driven])
            self.accelerations = np.vstack([self.accelerations, np.eye(len(ports))[at]])
        self.rates = ports @ self.free
        residual = forces - mass @ self.free @ self.accelerations
        weights = np.array([_weight(system, one) for one in self.multipliers])
        fixed = np.vstack([columns, conditions.T])
        residual = np.vstack([residual, np.zeros((conditions.shape[1], residual.shape[1]))])
        self.torques, self.redundant = _multipliers(fixed, weights, residual)
        self.mesh_rates: Floats = taken @ self.free
        self.mesh_light_rates: Floats = taken @ self.light
        self.loses = any(state not in ("", "stick") for state in meshes)

    def motions(self, speeds: Floats, driven: Floats) -> Floats:
        """The motions with inertia that fit speeds of links, by their momentum where none do.

        The last ones have the speeds of their drivers.
        """
        count = self.free.shape[1] - len(driven)
        free = self.free[:, :count]
        moved = speeds - self.free[:, count:] @ driven
        made: Floats = free.T @ moved
        made += self.projection @ (moved - free @ made)
        return np.append(made, driven)


def _driven(
    system: MotionSystem, multipliers: Sequence[Multiplier], rows: Floats
) -> tuple[tuple[int, ...], Floats]:
    """Contacts that stick at speeds other than 0, and speeds of links by these.

    Several that do so at one place are one.
    """
    places: dict[Switch | int, list[int]] = {}
    for row, one in enumerate(multipliers):
        if one.kind != "contact" or not system.contacts[one.of].drives:
            continue
        switch = system.contacts[one.of].switch
        place = switch._replace(jump=switch.jump._replace(side="")) if switch else one.of
        places.setdefault(place, []).append(row)
    wanted = np.zeros((len(multipliers), len(places)))
    for column, sticking in enumerate(places.values()):
        wanted[sticking, column] = 1.0
    made = solved(rows.T, wanted)
    if largest(rows.T @ made - wanted) > STANDING:
        message = "speeds at which contacts stick contradict each other"
        raise np.linalg.LinAlgError(message)
    return tuple(multipliers[sticking[0]].of for sticking in places.values()), made


def _weight(system: MotionSystem, multiplier: Multiplier) -> float:
    if multiplier.kind == "mesh":
        return _FIRST
    if multiplier.kind == "friction" or system.contacts[multiplier.of].is_drag:
        return _LAST_PREFERENCE
    return 1.0


def mesh_factor(efficiency: float, back: float, state: str) -> float:
    """``eta^x`` of a mesh: x is +1 where power enters by the first link, seen from the third.

    >>> mesh_factor(0.98, 0.98, "+-"), mesh_factor(0.98, 0.98, "--"), mesh_factor(1, 1, "")
    (1.0204081632653061, 0.98, 1.0)
    """
    if state in ("", "stick"):
        return 1.0
    return efficiency if state[0] == state[1] else 1 / back


def _constraints(
    system: MotionSystem, held: Held, meshes: MeshStates
) -> tuple[Floats, Floats, list[Multiplier]]:
    """Rows and columns of what holds, both as columns; the same array where nothing is lost."""
    own = list(zip(system.meshes, meshes, strict=True))
    held_rows = {
        Multiplier("friction", index): mesh.friction
        for index, (mesh, state) in enumerate(own)
        if state == "stick"
    } | {
        Multiplier("contact", index): contact.row
        for index, (contact, sticks) in enumerate(zip(system.contacts, held, strict=True))
        if sticks
    }
    made = system.rows([*(mesh.row for mesh in system.meshes), *held_rows.values()]).T
    multipliers = [*(Multiplier("mesh", index) for index in range(len(own))), *held_rows]
    if all(state in ("", "stick") for state in meshes):
        return made, made, multipliers
    columns = [
        mesh.row + (mesh_factor(mesh.efficiency, mesh.back, state) - 1) * mesh.friction
        for mesh, state in own
    ]
    return made, np.array([*columns, *held_rows.values()]).T, multipliers


def null(matrix: Floats) -> Floats:
    """An orthonormal basis of what a matrix takes to 0, as columns."""
    if not matrix.shape[0]:
        return np.eye(matrix.shape[1])
    norms = np.linalg.norm(matrix, axis=1, keepdims=True)
    scaled = matrix / np.where(norms > 0, norms, 1.0)
    _, sizes, right = np.linalg.svd(scaled)
    basis: Floats = right[_counting(sizes, sizes.max(initial=NOT_ZERO)) :].T
    return basis


def solved(matrix: Floats, values: Floats) -> Floats:
    """The least of the solutions of equations, or of what comes nearest to one."""
    return np.asarray(np.linalg.lstsq(matrix, values, rcond=DEPENDENT)[0], float)


def _counting(sizes: Floats, large: float) -> int:
    """How many singular values are more than rounding of what is large."""
    return int((sizes > INDEPENDENT_MOTION * large).sum())


def _motions(heavy: Floats, columns: Floats) -> tuple[Floats, Floats]:
    """What columns leave free: motions of something heavy, and those of nothing heavy."""
    return split_motions(heavy, null(columns.T))


def split_motions(heavy: Floats, free: Floats) -> tuple[Floats, Floats]:
    """Split motions into those of something heavy and those in which nothing heavy moves.

    Examples
    --------
    >>> moving, light = split_motions(np.array([[1.0, 0.0]]), np.eye(2))
    >>> np.abs(moving).tolist(), np.abs(light).tolist()
    ([[1.0], [0.0]], [[0.0], [1.0]])
    """
    if not free.shape[1]:
        return free, free
    moved = heavy @ free
    rank = _rank(moved) if largest(moved) > INDEPENDENT_MOTION else 0
    if rank == free.shape[1]:
        return free, free[:, :0]
    right = np.linalg.svd(moved)[2]
    light = free @ right[rank:].T
    light[np.abs(light) < ROUNDED_MOTION] = 0.0  # or a law of a heavy link would seem to sense it
    return free @ right[:rank].T, light


def _circulating(rows: Floats, columns: Floats, friction: Booleans) -> tuple[Floats, Floats]:
    """Multipliers that change no speed but lose power, as gears on two ways that turn alike.

    Nothing tells how large they are: those are taken that leave least friction in meshes that
    stand, none as a rule, as in statics; of these the least.

    Returns
    -------
    directions : ndarray, shape (multipliers, directions)
        Multipliers, as columns.
    conditions : ndarray, shape (multipliers, directions)
        What is 0 of multipliers, as columns; their products with `directions` are the unit matrix.
    """
    spare = null(rows) if rows.shape[1] else np.zeros((0, 0))
    if not spare.shape[1]:
        return spare, spare
    _, sizes, right = np.linalg.svd(columns @ spare)
    count = _counting(sizes, largest(columns))
    circulating, redundant = spare @ right[:count].T, spare @ right[count:].T
    if not friction.any():
        return circulating, circulating
    own = null(redundant[friction].T)  # friction that nothing redundant could take
    _, sizes, right = np.linalg.svd(own.T @ circulating[friction])
    count = _counting(sizes, 1.0)
    directions: Floats = circulating @ right.T
    conditions = directions.copy()
    conditions[:, :count] = 0.0
    shares = own @ (own.T @ directions[friction, :count])
    conditions[friction, :count] = shares / sizes[:count] ** 2
    return directions, conditions


def _multipliers(columns: Floats, weights: Floats, residual: Floats) -> tuple[Floats, Floats]:
    """Multipliers by ports, and what of them is redundant.

    Of redundant ones those of least weighted norm; drags and meshes take a part only where
    nothing else does.
    """
    count = columns.shape[1]
    if not count:
        return np.zeros((0, residual.shape[1])), np.zeros((0, 0))
    rank = _rank(columns)
    bearing: Booleans = weights < _LAST_PREFERENCE
    places = np.arange(count)
    if not bearing.all():
        found = _rank(columns[:, bearing])
        for index in np.flatnonzero(~bearing):
            bearing[index] = found < rank and _rank(columns[:, bearing | (places == index)]) > found
            found += int(bearing[index])
    scaled = columns[:, bearing] / weights[bearing]
    left, sizes, right = np.linalg.svd(scaled, full_matrices=False)
    used = sizes > BEARING_MOTION * sizes[0]
    made = np.zeros((count, residual.shape[1]))
    least = (right[used].T / sizes[used]) @ left[:, used].T @ residual
    made[bearing] = least / weights[bearing, None]
    if rank == count:
        return made, np.zeros((count, 0))
    spare = null(columns) * weights[:, None]
    basis, _ = np.linalg.qr(spare)  # orthonormal in the weighted norm
    return made, basis / weights[:, None]


def _rank(columns: Floats) -> int:
    sizes = np.asarray(np.linalg.svd(columns, compute_uv=False), float)
    return _counting(sizes, sizes.max(initial=0.0))
