"""The eigenvalues and shapes of damped vibration, by natural modes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from vstatics.errors import CaseError
from vstatics.numerics.arrays import Booleans, Complex, Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import REAL_EIGENVALUE, SAME_MODULUS
from vstatics.torsion.vibration.natural import NaturalModes, weighted_twists
from vstatics.torsion.vibration.refined import Pencils


class Pencil(NamedTuple):
    """``M q'' + D q' + K q`` by natural modes, in which M is 1, and massless motions that creep.

    Attributes
    ----------
    stiffness, viscous, lost : ndarray, shape (coordinates, coordinates)
        ``K``, and ``D`` at omega is ``viscous + lost/omega``.
    modes : int
        How many of the coordinates are natural modes, the first ones.
    """

    stiffness: Floats
    viscous: Floats
    lost: Floats
    modes: int

    def at(self, omegas: Floats) -> Pencils:
        """With the ``D`` of each frequency."""
        masses = (np.arange(len(self.stiffness)) < self.modes).astype(float)
        return Pencils(masses, self.stiffness, self.viscous + self.lost / omegas[:, None, None])

    def resistance_of_all(self, omegas: Floats) -> Floats:
        """``D`` for all modes: what couples two of them is lost by the mean of their frequencies.

        Massless motions that creep have the mean of all.
        """
        logarithms = np.log(omegas) / 2
        creeping = np.full(len(self.stiffness) - self.modes, logarithms.mean())
        roots = np.exp(np.concatenate([logarithms, creeping]))
        return np.asarray(self.viscous + self.lost / np.outer(roots, roots))

    def lengths(self, shapes: Complex, values: Complex) -> Floats:
        """Of shapes by columns, 1 of a natural mode: all energy as if it were that of masses."""
        swinging, creeping = shapes[: self.modes], shapes[self.modes :]
        stiff = self.stiffness[self.modes :, self.modes :]
        elastic = (creeping.conjugate() * (stiff @ creeping)).real.sum(axis=0)
        sizes = np.abs(values)
        with np.errstate(all="ignore"):
            squares = (np.abs(swinging) ** 2).sum(axis=0) + elastic / sizes**2
        return np.where((squares > 0) & np.isfinite(squares), np.sqrt(squares), 1.0)


def pencil_of(system: TorsionalSystem, split: Coordinates, modes: NaturalModes) -> Pencil:
    """The matrices of a system, by its natural modes."""
    dampings = [device.damping for device in system.elastic]
    viscous = np.array([one.viscous for one in dampings])
    lost = np.array([one.loss_factor for one in dampings]) * system.rates
    stiff = weighted_twists(system)
    damped = np.sqrt(viscous + lost)[:, None] * system.twists
    basis = np.hstack([modes.shapes, _damped_massless(split, damped, stiff)])
    twists, count = system.twists @ basis, len(modes.omegas)
    stiffness = (stiff @ basis).T @ (stiff @ basis)
    stiffness[:count, :count] = np.diag(modes.omegas**2)
    resisted, hysteresis = (twists.T @ (sizes[:, None] * twists) for sizes in (viscous, lost))
    return Pencil(stiffness, resisted, hysteresis, count)


def _damped_massless(split: Coordinates, damped: Floats, stiff: Floats) -> Floats:
    """Massless motions that a damper resists, each apart from the others in D.

    The natural modes have massless motions in elastic balance; what is damped of them leaves it.
    The undamped rest follows in elastic balance.
    """
    if not split.massless.shape[1]:
        return np.zeros((len(split.massless), 0))
    rates = damped @ split.massless
    _, sizes, directions = linalg.svd(rates, full_matrices=True)
    rank = int(np.sum(sizes > REAL_EIGENVALUE * sizes.max(initial=0.0)))
    moved = split.massless @ directions[:rank].T
    quiet = split.massless @ directions[rank:].T
    if not (quiet.shape[1] and moved.shape[1]):
        return moved
    following, *_ = linalg.lstsq(stiff @ quiet, stiff @ moved)
    slow: Floats = moved - quiet @ following
    return slow


class EigenPairs(NamedTuple):
    """Eigenvalues, and the shape of each."""

    eigenvalues: Complex
    """By modulus, those with an imaginary part of 0 or more. [1/s]"""
    shapes: Complex
    """Shape (coordinates, eigenvalues): natural modes have a length of 1."""

    def of_mode(self, mode: int) -> tuple[int, int]:
        """Which have the largest parts in a natural mode: one that swings, twice, or two real."""
        parts, swings = np.abs(self.shapes[mode]), self.eigenvalues.imag > 0
        first = _largest(parts, swings)
        if swings[first]:
            return first, first
        parts[first] = -np.inf
        second = _largest(np.where(swings, -np.inf, parts), swings)
        if parts[second] < 0 or swings[second]:  # it creeps alone: of a massless motion
            swinging = _largest(parts, swings)
            return swinging, swinging
        return min(first, second), max(first, second)

    def values(self, modes: Iterable[int]) -> Complex:
        """Both of natural modes, of shape (modes, 2)."""
        places = np.array([self.of_mode(mode) for mode in modes], int).reshape(-1, 2)
        found = self.eigenvalues[places]
        return np.column_stack([found[:, 0], found[:, 1].conjugate()])


def _largest(parts: Floats, swings: Booleans) -> int:
    """The largest part; at a tie one that swings, else the first."""
    ties = np.flatnonzero(parts >= parts.max() * (1 - SAME_MODULUS))
    return int(ties[np.argmax(swings[ties])])


def eigen_pairs(pencil: Pencil, resistance: Floats) -> EigenPairs:
    """Of a state of modal coordinates, their speeds, and massless motions that are damped.

    A massless motion y that is damped follows by its own rate:
    ``D_yy y' = -K_yy y - (K_yq q + D_yq q')``, where q are the modal coordinates.

    Raises
    ------
    CaseError
        Of numbers that have no eigenvalues in floats.
    """
    count, size = pencil.modes, len(pencil.stiffness)
    state = _state(_finite(pencil.stiffness), _finite(resistance), count)
    values, vectors = linalg.eig(_finite(state))
    values = settled(values)
    kept = np.flatnonzero(values.imag >= 0)
    values, vectors = values[kept], vectors[:size, kept].astype(np.complex128)
    order = order_of(values)
    shapes = vectors[:, order]
    return EigenPairs(values[order], shapes / pencil.lengths(shapes, values[order]))


def _finite(matrix: Floats) -> Floats:
    """A matrix, of which all are numbers."""
    if not np.isfinite(matrix).all():
        message = (
            "inertias, stiffnesses and dampings differ by so many powers of ten that the damped "
            "vibration can't be calculated: expected numbers nearer to each other"
        )
        raise CaseError("E520", message, ("inertias",))
    return matrix


def settled(values: Complex) -> Complex:
    """Eigenvalues without rounding: nothing here feeds a vibration, and some are real."""
    values = np.minimum(values.real, 0.0) + 1j * values.imag
    return np.where(np.abs(values.imag) <= REAL_EIGENVALUE * np.abs(values), values.real, values)


def _state(stiffness: Floats, resistance: Floats, count: int) -> Floats:
    """The matrix of ``x' = A x`` for the state of modal coordinates, massless ones, speeds."""
    size = len(stiffness)
    fast, slow = slice(0, count), slice(count, size)
    matrix = np.zeros((size + count, size + count))
    speeds = slice(size, size + count)
    matrix[fast, speeds] = np.eye(count)
    if size > count:
        own = resistance[slow, slow]
        scale = 1 / np.sqrt(np.diag(own))[:, None]  # dampings may differ by many powers of ten
        right = np.hstack([stiffness[slow, :], resistance[slow, fast]])
        solved = linalg.solve(own * scale * scale.T, scale * right, assume_a="pos")
        matrix[slow, :] = -scale * solved
    matrix[speeds, :size] = -stiffness[fast, :]
    matrix[speeds, speeds] = -resistance[fast, fast]
    matrix[speeds, :] -= resistance[fast, slow] @ matrix[slow, :]
    return matrix


def order_of(values: Complex) -> NDArray[np.intp]:
    """By modulus, then imaginary part; moduli that differ by rounding are one."""
    moduli = np.abs(values)
    order = np.argsort(moduli, kind="stable")
    rank = np.empty(len(values))
    level, last = 0.0, -1.0
    for index in order:
        if moduli[index] > last * (1 + SAME_MODULUS):
            level, last = level + 1, moduli[index]
        rank[index] = level
    return np.lexsort((values.imag, rank))
