"""Constant matrices of the equations of motion while a set of contacts sticks.

``M dw/dt = F - B m`` and ``C' w = 0``, with inertia matrix M, torques F at ports and constraint
torques m. The columns of C belong to rigid mechanisms and sticking contacts; B is C with losses:
``u eta^x`` instead of u. With bases N and L of the motions that C and B leave free, ``(L' M N)
dq/dt = L' F`` and ``w = N q``. Motions without inertia are separate: the torques along them
balance, ``L0' F = 0``.
"""

from __future__ import annotations

from collections.abc import Mapping
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
"""Flags of contacts: True if sticking."""
MeshStates = tuple[str, ...]
"""States of the rigid mechanisms.

`""`: lossless; `stick`: at rest by friction; otherwise two signs such as `+-`: of the speed of the
first link relative to the third, and of the torque on the first link.
"""

_FIRST_PREFERENCE = 1e-2
"""Weight of mechanisms in the minimised norm of redundant torques; others have weight 1.

Because of the small weight, mechanisms carry redundant torques first.
"""
_LAST_PREFERENCE = 1e2
"""Weight of drags and of friction at rest in the minimised norm of redundant torques.

Because of the large weight, drags and friction at rest carry redundant torques last.
"""


class Multiplier(NamedTuple):
    """Identity of a constraint torque: kind, and index of mechanism or contact."""

    kind: str
    """`mesh` (first link of a mechanism), `friction` (mechanism at rest), or `contact`."""
    of: int


class MotionStructure:
    """Matrices of the equations of motion while a set of contacts sticks.

    Attributes
    ----------
    free : ndarray, shape (links, motions)
        Matrix ``N`` from motions with inertia to speeds of links. The last motions belong to
        contacts that stick at speeds other than 0; the coordinate of such a motion is this speed.
    light : ndarray, shape (links, massless motions)
        Matrix from motions without inertia to speeds of links.
    drivers : sequence of int
        Indices of contacts that stick at speeds other than 0 (drivers), one for each such speed.
    projection : ndarray, shape (motions, links)
        Matrix from speeds of links to the motions with inertia of the same momentum. The speeds can
        violate constraints, for example at links without inertia.
    rates, light_rates : ndarray
        Matrices from motions with and without inertia to rates of ports.
    accelerations : ndarray, shape (motions, ports)
        Matrix from torques of ports to dq/dt. Instead of the torque of a driver, it takes the
        derivative of the speed at which the driver sticks.
    balances : ndarray, shape (massless motions, ports)
        Matrix from torques of ports to sums of torques along massless motions, which must be 0.
    multipliers : sequence of Multiplier
        Mechanisms first, in the order of the system.
    contact_rows : dict of int to int
        Row of the constraint torque in `torques`, by index of each sticking contact.
    torques : ndarray, shape (multipliers, ports)
        Matrix from torques of ports to constraint torques; redundant torques have least norm.
    redundant : ndarray, shape (multipliers, directions)
        Directions of redundant torques, orthonormal in the weighted norm.
    mesh_rates, mesh_light_rates : ndarray
        Matrices from motions to the power loss of each mechanism per torque on its first link.
    """

    def __init__(self, system: MotionSystem, held: Held, meshes: MeshStates) -> None:
        rows, columns, self.multipliers = _constraints(system, held, meshes)
        self.contact_rows = {
            multiplier.of: row
            for row, multiplier in enumerate(self.multipliers)
            if multiplier.kind == "contact"
        }
        mass, ports = system.mass, system.port_rows
        signs = np.full(len(ports), -1.0)
        signs[: len(system.outside)] = 1.0
        forces = ports.T * signs
        self.free, self.light = split_motions(system.heavy, null(rows.T))
        left, left_light = self.free, self.light
        taken = columns.T[: len(meshes)] - rows.T[: len(meshes)]
        conditions = np.zeros((len(self.multipliers), 0))
        if columns is not rows:
            friction = np.array([multiplier.kind == "friction" for multiplier in self.multipliers])
            circulating, conditions = _circulating(rows, columns, friction)
            columns = columns - columns @ circulating @ conditions.T
            left, left_light = split_motions(system.heavy, null(columns.T))
        momenta = self.free.T @ mass
        self.projection = np.asarray(np.linalg.solve(momenta @ self.free, momenta), float)
        self.light_rates = _exact(ports @ self.light)
        self.balances = left_light.T @ forces
        reduced = left.T @ mass @ self.free
        self.accelerations = np.linalg.solve(reduced, left.T @ forces)
        self.drivers, driven = _driven(system, self.contact_rows, rows)
        if self.drivers:
            at = [system.layout.contacts + index for index in self.drivers]
            self.accelerations[:, at] = -np.linalg.solve(reduced, left.T @ mass @ driven)
            forces[:, at] = 0.0
            self.free = np.column_stack([self.free, driven])
            self.accelerations = np.vstack([self.accelerations, np.eye(len(ports))[at]])
        self.rates = _exact(ports @ self.free)
        residual = forces - mass @ self.free @ self.accelerations
        weights = np.array([_weight(system, multiplier) for multiplier in self.multipliers])
        fixed = np.vstack([columns, conditions.T])
        residual = np.vstack([residual, np.zeros((conditions.shape[1], residual.shape[1]))])
        self.torques, self.redundant = _multipliers(fixed, weights, residual)
        self.mesh_rates = taken @ self.free
        self.mesh_light_rates = taken @ self.light
        self.loses = any(state not in ("", "stick") for state in meshes)

    def motions(self, speeds: Floats, driven: Floats) -> Floats:
        """Return the coordinates of motions with inertia for given speeds of links.

        Inconsistent speeds are replaced by a motion of the same momentum. The last motions have the
        speeds `driven` of the drivers.
        """
        count = self.free.shape[1] - len(driven)
        free = self.free[:, :count]
        moved = speeds - self.free[:, count:] @ driven
        motions = free.T @ moved
        motions += self.projection @ (moved - free @ motions)
        return np.append(motions, driven) if len(driven) else motions


def _exact(rates: Floats) -> Floats:
    """Return rates of ports without rounding noise: equal rates are exactly equal, also to 0.

    Formulas can jump where two speeds are equal, such as those of links that stick to each other.
    """
    if not rates.size:
        return rates
    clean = np.where(np.abs(rates) < ROUNDED_MOTION, 0.0, rates)
    # Sums with unrelated weights are close only for ports with equal rates.
    order = np.argsort(clean @ np.sin(np.arange(1.0, clean.shape[1] + 1)))
    sorted_rates = clean[order]
    apart = np.abs(np.diff(sorted_rates, axis=0)).max(axis=1)
    is_new = np.append(True, apart >= ROUNDED_MOTION)
    clean[order] = sorted_rates[is_new][np.cumsum(is_new) - 1]
    return clean


def _driven(
    system: MotionSystem, contact_rows: Mapping[int, int], rows: Floats
) -> tuple[tuple[int, ...], Floats]:
    """Return the drivers, and the speeds of all links per unit speed of each driver.

    Several drivers at the same jump count once.
    """
    places: dict[Switch | int, list[int]] = {}
    for index in contact_rows:
        if system.contacts[index].drives:
            switch = system.contacts[index].switch
            place = switch._replace(jump=switch.jump._replace(side="")) if switch else index
            places.setdefault(place, []).append(index)
    if not places:
        return (), np.zeros((rows.shape[0], 0))
    wanted = np.zeros((rows.shape[1], len(places)))
    for column, sticking in enumerate(places.values()):
        wanted[[contact_rows[index] for index in sticking], column] = 1.0
    speeds = solved(rows.T, wanted)
    if largest(rows.T @ speeds - wanted) > STANDING:
        raise np.linalg.LinAlgError("speeds at which contacts stick contradict each other")
    return tuple(sticking[0] for sticking in places.values()), speeds


def _weight(system: MotionSystem, multiplier: Multiplier) -> float:
    if multiplier.kind == "mesh":
        return _FIRST_PREFERENCE
    if multiplier.kind == "friction" or system.contacts[multiplier.of].is_drag:
        return _LAST_PREFERENCE
    return 1.0


def mesh_factor(efficiency: float, back: float, state: str) -> float:
    """Return ``eta^x`` of a mechanism: x = 1 if power enters at the first link, otherwise -1.

    >>> mesh_factor(0.98, 0.98, "+-"), mesh_factor(0.98, 0.98, "--"), mesh_factor(1, 1, "")
    (1.0204081632653061, 0.98, 1.0)
    """
    if state in ("", "stick"):
        return 1.0
    return efficiency if state[0] == state[1] else 1 / back


def _constraints(
    system: MotionSystem, held: Held, meshes: MeshStates
) -> tuple[Floats, Floats, list[Multiplier]]:
    """Return the matrices C and B, and the constraint torque that belongs to each column.

    C and B are equal if no mechanism has losses.
    """
    mesh_states = list(zip(system.meshes, meshes, strict=True))
    held_rows = {
        Multiplier("friction", index): mesh.friction
        for index, (mesh, state) in enumerate(mesh_states)
        if state == "stick"
    } | {
        Multiplier("contact", index): contact.row
        for index, (contact, sticks) in enumerate(zip(system.contacts, held, strict=True))
        if sticks
    }
    rows = system.rows([*(mesh.row for mesh in system.meshes), *held_rows.values()]).T
    multipliers = [*(Multiplier("mesh", index) for index in range(len(mesh_states))), *held_rows]
    if all(state in ("", "stick") for state in meshes):
        return rows, rows, multipliers
    columns = [
        mesh.row + (mesh_factor(mesh.efficiency, mesh.back, state) - 1) * mesh.friction
        for mesh, state in mesh_states
    ]
    return rows, np.array([*columns, *held_rows.values()]).T, multipliers


def null(matrix: Floats) -> Floats:
    """Return an orthonormal basis of the null space of a matrix, as columns."""
    if not matrix.shape[0]:
        return np.eye(matrix.shape[1])
    norms = np.linalg.norm(matrix, axis=1, keepdims=True)
    scaled = matrix / np.where(norms > 0, norms, 1.0)
    _, sizes, right = np.linalg.svd(scaled)
    return right[_counting(sizes, sizes.max(initial=NOT_ZERO)) :].T


def solved(matrix: Floats, values: Floats) -> Floats:
    """Return the least-squares solution of ``matrix @ x = values`` with least norm."""
    return np.asarray(np.linalg.lstsq(matrix, values, rcond=DEPENDENT)[0], float)


def moves(rows: Floats, *motions: Floats) -> Booleans:
    """Return True for rows whose speed some motion changes; a single row gives a single flag.

    Parameters
    ----------
    rows : ndarray, shape (links,) or (rows, links)
    *motions : ndarray, shape (links, motions)
        Bases of motions, as columns.

    Examples
    --------
    >>> moves(np.eye(2), np.array([[1.0], [0.0]]), np.zeros((2, 0))).tolist()
    [True, False]
    """
    return np.asarray((np.abs(rows @ np.hstack(motions)) > STANDING).any(axis=-1))


def _counting(sizes: Floats, large: float) -> int:
    return int((sizes > INDEPENDENT_MOTION * large).sum())


def split_motions(heavy: Floats, free: Floats) -> tuple[Floats, Floats]:
    """Split a basis of motions into motions with inertia and motions without inertia.

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
    light[np.abs(light) < ROUNDED_MOTION] = 0.0  # links with inertia do not move
    return free @ right[:rank].T, light


def _circulating(rows: Floats, columns: Floats, friction: Booleans) -> tuple[Floats, Floats]:
    """Return combinations of constraint torques that circulate power in parallel paths.

    The equations do not determine the size of these torques. As in statics, the friction of
    mechanisms at rest is minimised (usually to zero), and then the norm of the constraint torques.

    Returns
    -------
    directions : ndarray, shape (multipliers, directions)
        Combinations of constraint torques, as columns.
    conditions : ndarray, shape (multipliers, directions)
        Linear conditions for the constraint torques, as columns; biorthogonal to `directions`.
    """
    spare = null(rows) if rows.shape[1] else np.zeros((0, 0))
    if not spare.shape[1]:
        return spare, spare
    _, sizes, right = np.linalg.svd(columns @ spare)
    count = _counting(sizes, largest(columns))
    circulating, redundant = spare @ right[:count].T, spare @ right[count:].T
    if not friction.any():
        return circulating, circulating
    irreducible = null(redundant[friction].T)  # friction that must carry torque
    _, sizes, right = np.linalg.svd(irreducible.T @ circulating[friction])
    count = _counting(sizes, 1.0)
    directions = circulating @ right.T
    conditions = directions.copy()
    conditions[:, :count] = 0.0
    shares = irreducible @ (irreducible.T @ directions[friction, :count])
    conditions[friction, :count] = shares / sizes[:count] ** 2
    return directions, conditions


def _multipliers(columns: Floats, weights: Floats, residual: Floats) -> tuple[Floats, Floats]:
    """Return the matrix from port torques to constraint torques, and the redundant directions.

    Redundant torques have least weighted norm. Drags and the friction of mechanisms at rest carry a
    torque only if no other constraint can.
    """
    count = columns.shape[1]
    if not count:
        return np.zeros((0, residual.shape[1])), np.zeros((0, 0))
    rank = _rank(columns)
    bearing = weights < _LAST_PREFERENCE
    places = np.arange(count)
    if not bearing.all():
        bearing_rank = _rank(columns[:, bearing])
        for index in np.flatnonzero(~bearing):
            bearing[index] = (
                bearing_rank < rank
                and _rank(columns[:, bearing | (places == index)]) > bearing_rank
            )
            bearing_rank += int(bearing[index])
    scaled = columns[:, bearing] / weights[bearing]
    left, sizes, right = np.linalg.svd(scaled, full_matrices=False)
    used = sizes > BEARING_MOTION * sizes[0]
    multipliers = np.zeros((count, residual.shape[1]))
    least = (right[used].T / sizes[used]) @ left[:, used].T @ residual
    multipliers[bearing] = least / weights[bearing, None]
    if rank == count:
        return multipliers, np.zeros((count, 0))
    spare = null(columns) * weights[:, None]
    basis, _ = np.linalg.qr(spare)  # orthonormal in the weighted norm
    return multipliers, basis / weights[:, None]


def _rank(columns: Floats) -> int:
    sizes = np.asarray(np.linalg.svd(columns, compute_uv=False), float)
    return _counting(sizes, sizes.max(initial=0.0))
