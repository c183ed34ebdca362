"""Damped vibration: the eigenvalues of ``M q'' + D q' + K q = 0`` besides those of rigid modes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from vstatics.numerics.arrays import Complex, Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import REAL_EIGENVALUE, SAME_MODULUS
from vstatics.torsion.vibration.natural import NaturalModes, weighted_twists


class DampedModes(NamedTuple):
    """The eigenvalues of a system, and which of them belongs to each natural mode.

    Attributes
    ----------
    eigenvalues : ndarray
        Those with an imaginary part of 0 or more, by modulus, then imaginary part. [1/s]
    of_modes : ndarray, shape (modes,)
        Of each natural mode that whose complex shape is nearest to it in the mass norm. [1/s]
    """

    eigenvalues: Complex
    of_modes: Complex


def damped_modes(system: TorsionalSystem, split: Coordinates, modes: NaturalModes) -> DampedModes:
    """The damped vibration of a system in which anything is damped.

    A loss factor is taken at each natural frequency as the viscous damping that is equal to it
    there, ``c * loss_factor / omega``; then there is one eigenvalue for each natural mode.

    Examples
    --------
    One mass on a spring: ``s = -zeta omega +- i omega sqrt(1 - zeta^2)``.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.vibration.natural import natural_modes
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> spring = Spring({1: 1}, stiffness=100.0, damping=12.0)
    >>> case = Transmission(1, [], [], [], springs=[spring], inertias={1: 1.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> split = coordinates(system)
    >>> damped_modes(system, split, natural_modes(system, split)).eigenvalues.round(9)
    array([-6.+8.j])
    """
    dampings = [device.damping for device in system.elastic]
    viscous = np.array([one.viscous for one in dampings])
    if not any(one.loss_factor for one in dampings):
        found = _eigenvalues(system, split, modes, viscous)
        nearest = [_nearest(found, number) for number in range(len(modes.omegas))]
        return DampedModes(found.eigenvalues, np.array(nearest, complex))
    lost = np.array([one.loss_factor for one in dampings]) * system.rates
    of_modes = [
        _nearest(_eigenvalues(system, split, modes, viscous + lost / omega), number)
        for number, omega in enumerate(modes.omegas)
    ]
    chosen = np.array(of_modes, complex)
    return DampedModes(chosen[_order(chosen)], chosen)


class _EigenPairs(NamedTuple):
    eigenvalues: Complex
    shapes: Complex
    """Shape (modes, eigenvalues): by natural modes, each of length 1 in the mass norm."""


def _eigenvalues(
    system: TorsionalSystem, split: Coordinates, modes: NaturalModes, viscous: Floats
) -> _EigenPairs:
    """Of a state of modal coordinates, their speeds, and massless motions that are damped.

    In natural modes M is 1 and K is diagonal. A massless motion y that is damped follows by
    its own rate: ``D_yy y' = -K_yy y - (K_yq q + D_yq q')``, where q are the modal coordinates.
    """
    stiff, damped = weighted_twists(system), np.sqrt(viscous)[:, None] * system.twists
    slow = _damped_massless(split, damped, stiff)
    count = len(modes.omegas)
    basis = np.hstack([modes.shapes, slow])
    stiffness = (stiff @ basis).T @ (stiff @ basis)
    stiffness[:count, :count] = np.diag(modes.omegas**2)
    resistance = (damped @ basis).T @ (damped @ basis)
    state = _state(stiffness, resistance, count)
    values, vectors = linalg.eig(state)
    values = np.minimum(values.real, 0.0) + 1j * values.imag  # nothing here feeds a vibration
    values = np.where(np.abs(values.imag) <= REAL_EIGENVALUE * np.abs(values), values.real, values)
    kept = np.flatnonzero(values.imag >= 0)
    values, vectors = values[kept], vectors[:, kept]
    order = _order(values)
    shapes = vectors[:count, order]
    lengths = np.linalg.norm(shapes, axis=0)
    return _EigenPairs(values[order], shapes / np.where(lengths, lengths, 1.0))


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


def _nearest(found: _EigenPairs, mode: int) -> complex:
    """The eigenvalue whose shape has the largest part in a natural mode; at a tie the first."""
    parts = np.abs(found.shapes[mode])
    first = np.flatnonzero(parts >= parts.max() * (1 - SAME_MODULUS))[0]
    return complex(found.eigenvalues[first])


def _order(values: Complex) -> NDArray[np.intp]:
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
