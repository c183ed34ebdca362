"""Eigenvalues and complex shapes of damped vibration, in modal coordinates."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Booleans, Complex, Floats
from vstatics.torsion.system.coordinates import Coordinates, without_rounding
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import REAL_EIGENVALUE, SAME_MODULUS
from vstatics.torsion.vibration.natural import NaturalModes, weighted_bodies, weighted_twists
from vstatics.torsion.vibration.refined import Pencils


class Pencil(NamedTuple):
    """Matrices of ``M q'' + D q' + K q = 0``, with M = 1, in modal coordinates.

    The coordinates are natural modes, then rigid modes if converters or separate dampers resist
    motions, then damped massless motions.

    Attributes
    ----------
    stiffness, viscous, lost : ndarray, shape (coordinates, coordinates)
        Matrix ``K``, and two parts of ``D = viscous + lost/omega`` at the frequency omega.
    modes : int
        Number of natural modes, which are the first coordinates.
    rigid : int
        Number of rigid modes, which are the next coordinates; their modal mass is 1, too.
    symmetric : bool
        True if D is symmetric, as it is without converters.
    """

    stiffness: Floats
    viscous: Floats
    lost: Floats
    modes: int
    rigid: int = 0
    symmetric: bool = True

    @property
    def massive(self) -> int:
        """Number of coordinates with mass."""
        return self.modes + self.rigid

    def at(self, omegas: Floats) -> Pencils:
        """Return the matrices at several frequencies [rad/s], each with its ``D``."""
        masses = (np.arange(len(self.stiffness)) < self.massive).astype(float)
        return Pencils(masses, self.stiffness, self.viscous + self.lost / omegas[:, None, None])

    def resistance_of_all(self, omegas: Floats) -> Floats:
        """Return a common ``D`` for all modes; each entry uses the mean frequency of its two modes.

        Massless motions count with the geometric mean of all natural frequencies.
        """
        logarithms = np.log(omegas) / 2
        creeping = np.full(len(self.stiffness) - self.modes, logarithms.mean())
        roots = np.exp(np.concatenate([logarithms, creeping]))
        return np.asarray(self.viscous + self.lost / np.outer(roots, roots))

    def lengths(self, shapes: Complex, values: Complex) -> Floats:
        """Return the lengths of complex shapes (columns), in which a natural mode has length 1.

        The elastic energy of massless motions counts like kinetic energy.
        """
        swinging, creeping = shapes[: self.massive], shapes[self.massive :]
        stiff = self.stiffness[self.massive :, self.massive :]
        elastic = (creeping.conjugate() * (stiff @ creeping)).real.sum(axis=0)
        sizes = np.abs(values)
        with np.errstate(all="ignore"):
            squares = (np.abs(swinging) ** 2).sum(axis=0) + elastic / sizes**2
        return np.where((squares > 0) & np.isfinite(squares), np.sqrt(squares), 1.0)


def pencil_of(
    system: TorsionalSystem, split: Coordinates, modes: NaturalModes, *, hysteretic: bool = True
) -> Pencil:
    """Build the matrices of a system in modal coordinates, with or without loss factors.

    Without loss factors, massless motions that only these damp are in elastic equilibrium.
    """
    viscous, lost = system.dampings
    lost *= hysteretic
    stiff = weighted_twists(system)
    damped = resisting_rows(system, viscous + lost)
    rigid = rigid_basis(system, split) if system.resists else split.rigid[:, :0]
    basis = np.hstack([modes.shapes, rigid, massless_parts(split, damped, stiff)[0]])
    twists, count = system.twists @ basis, len(modes.omegas)
    stiffness = (stiff @ basis).T @ (stiff @ basis)
    stiffness[:count, :count] = np.diag(modes.omegas**2)
    massive = count + rigid.shape[1]
    stiffness[count:massive] = stiffness[:, count:massive] = 0.0
    resisted, hysteresis = (twists.T @ (sizes[:, None] * twists) for sizes in (viscous, lost))
    slips = without_rounding(system.damper_rows, basis)
    resisted += slips.T @ slips + basis.T @ system.converter_resistance @ basis
    return Pencil(stiffness, resisted, hysteresis, count, rigid.shape[1], not system.converters)


def resisting_rows(system: TorsionalSystem, resistances: Floats) -> Floats:
    """Return the resisted motions of links, as rows times roots of resistances.

    The first rows are twists times roots of `resistances` of elastic components; then come dampers
    and converters.
    """
    slipping = np.abs(system.converter_resistance)
    links = np.maximum(slipping.max(axis=0), slipping.max(axis=1))
    slips = np.diag(np.sqrt(links))[links > 0]
    return np.vstack([np.sqrt(resistances)[:, None] * system.twists, system.damper_rows, slips])


def rigid_basis(system: TorsionalSystem, split: Coordinates) -> Floats:
    """Return rigid motions of modal mass 1 that are orthogonal in the inertia matrix."""
    if not split.rigid.size:
        return split.rigid
    _, triangle = linalg.qr(weighted_bodies(system) @ split.rigid, mode="economic")
    return linalg.solve_triangular(triangle, split.rigid.T, trans="T").T


def massless_parts(split: Coordinates, damped: Floats, stiff: Floats) -> tuple[Floats, Floats]:
    """Split massless motions into damped motions, uncoupled in D, and undamped motions.

    In natural modes all massless motions are in elastic equilibrium. With damping, the damped
    massless motions depart from it, and the undamped ones follow in equilibrium.
    """
    if not split.massless.shape[1]:
        return split.massless, split.massless
    _, sizes, directions = linalg.svd(without_rounding(damped, split.massless), full_matrices=True)
    rank = int(np.sum(sizes > REAL_EIGENVALUE * sizes.max(initial=0.0)))
    damped_motions = split.massless @ directions[:rank].T
    undamped_motions = split.massless @ directions[rank:].T
    if not (undamped_motions.shape[1] and damped_motions.shape[1]):
        return damped_motions, undamped_motions
    following, *_ = linalg.lstsq(stiff @ undamped_motions, stiff @ damped_motions)
    return damped_motions - undamped_motions @ following, undamped_motions


class EigenPairs(NamedTuple):
    """Eigenvalues of damped vibration, with complex shapes."""

    eigenvalues: Complex
    """Eigenvalues with an imaginary part of 0 or more, sorted by modulus. [1/s]"""
    shapes: Complex
    """Complex shapes, shape (coordinates, eigenvalues); natural modes have the length 1."""

    def of_mode(self, mode: int) -> tuple[int, int]:
        """Return the indices of both eigenvalues with the largest shares of a natural mode.

        Both indices are equal for a complex eigenvalue. An overdamped mode has two real
        eigenvalues.
        """
        parts, swings = np.abs(self.shapes[mode]), self.eigenvalues.imag > 0
        first = _largest(parts, swings)
        if swings[first]:
            return first, first
        parts[first] = -np.inf
        second = _largest(np.where(swings, -np.inf, parts), swings)
        if parts[second] < 0 or swings[second]:  # the mode has no second real eigenvalue
            swinging = _largest(parts, swings)
            return swinging, swinging
        return min(first, second), max(first, second)

    def of_no_mode(self, modes: int) -> Complex:
        """Return the eigenvalues that belong to no natural mode."""
        taken = {place for mode in range(modes) for place in self.of_mode(mode)}
        return self.eigenvalues[[n for n in range(len(self.eigenvalues)) if n not in taken]]

    def values(self, modes: Iterable[int]) -> Complex:
        """Return the two eigenvalues of each natural mode in `modes`, shape (modes, 2)."""
        places = np.array([self.of_mode(mode) for mode in modes], int).reshape(-1, 2)
        values = self.eigenvalues[places]
        return np.column_stack([values[:, 0], values[:, 1].conjugate()])


def _largest(parts: Floats, swings: Booleans) -> int:
    """Return the index of the largest share; a complex eigenvalue wins a tie."""
    ties = np.flatnonzero(parts >= parts.max() * (1 - SAME_MODULUS))
    return int(ties[np.argmax(swings[ties])])


def eigen_pairs(pencil: Pencil, resistance: Floats) -> EigenPairs:
    """Calculate the eigenvalues and shapes of a system in first-order form.

    The state contains modal coordinates, massless motions and speeds. Rigid motions are represented
    by their speeds only, and are left out if nothing resists them.

    A damped massless motion y has an equation of the first order,
    ``D_yy y' = -K_yy y - (K_yq q + D_yq q')``, where q are the modal coordinates.

    Raises
    ------
    CaseError
        If the numbers differ too much for floating-point numbers.
    """
    state = _state(pencil, _require_finite(pencil.stiffness), _require_finite(resistance))
    values, vectors = linalg.eig(_require_finite(state))
    values = settled(values) if pencil.symmetric else _real_if_close(values)
    unresisted = 0
    if pencil.rigid:
        rigid = slice(pencil.modes, pencil.massive)
        sizes = linalg.svdvals(resistance[rigid, rigid])
        unresisted = int(np.sum(sizes <= REAL_EIGENVALUE * sizes.max()))
    places = np.argsort(np.abs(values), kind="stable")[unresisted:]
    places = np.sort(places[values[places].imag >= 0])
    values, vectors = values[places], vectors[:, places].astype(np.complex128)
    first, last = pencil.modes, len(vectors) - pencil.massive
    rigid_parts = vectors[last + pencil.modes :] / values
    order = order_of(values)
    shapes: Complex = np.vstack([vectors[:first], rigid_parts, vectors[first:last]])[:, order]
    return EigenPairs(values[order], shapes / pencil.lengths(shapes, values[order]))


def _require_finite(matrix: Floats) -> Floats:
    if not np.isfinite(matrix).all():
        raise CaseError(
            "E520",
            "inertias, stiffnesses and dampings differ by so many powers of ten that the damped "
            "vibration cannot be calculated: expected numbers of similar size",
            ("inertias",),
        )
    return matrix


def _state(pencil: Pencil, stiffness: Floats, resistance: Floats) -> Floats:
    """Build the matrix A of ``x' = A x`` for x = (modal coordinates, massless motions, speeds)."""
    size, count = len(stiffness), pencil.massive
    fast, slow = slice(0, count), slice(count, size)
    matrix = np.zeros((size + count, size + count))
    speeds = slice(size, size + count)
    matrix[fast, speeds] = np.eye(count)
    if size > count:
        right = np.hstack([stiffness[slow, :], resistance[slow, fast]])
        matrix[slow, :] = -_rates(resistance[slow, slow], right, symmetric=pencil.symmetric)
    matrix[speeds, :size] = -stiffness[fast, :]
    matrix[speeds, speeds] = -resistance[fast, fast]
    matrix[speeds, :] -= resistance[fast, slow] @ matrix[slow, :]
    places = np.r_[0 : pencil.modes, count : size + count]
    state: Floats = matrix[np.ix_(places, places)]
    return state


def _rates(resistance: Floats, right: Floats, *, symmetric: bool) -> Floats:
    """Solve ``resistance x = right``, where dampings can differ by orders of magnitude."""
    sizes = np.diag(resistance) if symmetric else np.abs(resistance).max(axis=1)
    scale = 1 / np.sqrt(sizes)[:, None]
    scaled = resistance * scale * scale.T
    if not symmetric and np.linalg.cond(scaled) * REAL_EIGENVALUE > 1:
        raise CaseError(
            "E526",
            "a pump or turbine has no inertia, and the torque of its converter does not depend on "
            "its speed: give its link an inertia",
            ("inertias",),
        )
    rates: Floats = scale * linalg.solve(
        scaled, scale * right, assume_a="pos" if symmetric else "gen"
    )
    return rates


def settled(values: Complex) -> Complex:
    """Remove rounding errors: positive real parts, tiny imaginary parts of real eigenvalues."""
    return _real_if_close(np.minimum(values.real, 0.0) + 1j * values.imag)


def _real_if_close(values: Complex) -> Complex:
    return np.where(np.abs(values.imag) <= REAL_EIGENVALUE * np.abs(values), values.real, values)


def order_of(values: Complex) -> NDArray[np.intp]:
    """Return the order of eigenvalues by modulus, then imaginary part.

    Moduli that differ by rounding count as equal.
    """
    moduli = np.abs(values)
    order = np.argsort(moduli, kind="stable")
    rank = np.empty(len(values))
    level, last = 0.0, -1.0
    for index in order:
        if moduli[index] > last * (1 + SAME_MODULUS):
            level, last = level + 1, moduli[index]
        rank[index] = level
    return np.lexsort((values.imag, rank))
