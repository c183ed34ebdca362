"""The eigenvalues and shapes of damped vibration, by natural modes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Booleans, Complex, Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import REAL_EIGENVALUE, SAME_MODULUS
from vstatics.torsion.vibration.natural import NaturalModes, weighted_bodies, weighted_twists
from vstatics.torsion.vibration.refined import Pencils


class Pencil(NamedTuple):
    """``M q'' + D q' + K q`` by natural modes, in which M is 1, and massless motions that creep.

    Behind the natural modes stand the rigid ones if converters resist, whose D is not symmetric.

    Attributes
    ----------
    stiffness, viscous, lost : ndarray, shape (coordinates, coordinates)
        ``K``, and ``D`` at omega is ``viscous + lost/omega``.
    modes : int
        How many of the coordinates are natural modes, the first ones.
    rigid : int
        How many rigid modes are behind them, of modal mass 1, too.
    symmetric : bool
    """

    stiffness: Floats
    viscous: Floats
    lost: Floats
    modes: int
    rigid: int = 0
    symmetric: bool = True

    @property
    def massive(self) -> int:
        """How many of the coordinates have a mass."""
        return self.modes + self.rigid

    def at(self, omegas: Floats) -> Pencils:
        """With the ``D`` of each frequency."""
        masses = (np.arange(len(self.stiffness)) < self.massive).astype(float)
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
        swinging, creeping = shapes[: self.massive], shapes[self.massive :]
        stiff = self.stiffness[self.massive :, self.massive :]
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
    slipping = system.slip_resistance
    damped = resisting_rows(system)
    rigid = rigid_basis(system, split) if system.resists else split.rigid[:, :0]
    basis = np.hstack([modes.shapes, rigid, massless_parts(split, damped, stiff)[0]])
    twists, count = system.twists @ basis, len(modes.omegas)
    stiffness = (stiff @ basis).T @ (stiff @ basis)
    stiffness[:count, :count] = np.diag(modes.omegas**2)
    massive = count + rigid.shape[1]
    stiffness[count:massive] = stiffness[:, count:massive] = 0.0
    resisted, hysteresis = (twists.T @ (sizes[:, None] * twists) for sizes in (viscous, lost))
    resisted += basis.T @ slipping @ basis
    return Pencil(stiffness, resisted, hysteresis, count, rigid.shape[1], not system.converters)


def rigid_basis(system: TorsionalSystem, split: Coordinates) -> Floats:
    """Rigid motions of modal mass 1, orthogonal to each other."""
    if not split.rigid.size:
        return split.rigid
    _, triangle = linalg.qr(weighted_bodies(system) @ split.rigid, mode="economic")
    basis: Floats = linalg.solve_triangular(triangle, split.rigid.T, trans="T").T
    return basis


def resisting_rows(system: TorsionalSystem) -> Floats:
    """What dampers and converters resist of the motions of links, by the roots of resistances."""
    dampings = [device.damping for device in system.elastic]
    lost = system.rates * np.array([one.loss_factor for one in dampings])
    sizes = np.array([one.viscous for one in dampings]) + lost
    slipping = np.abs(system.converter_resistance)
    links = np.maximum(slipping.max(axis=0), slipping.max(axis=1))
    slips = np.diag(np.sqrt(links))[links > 0]
    rows: Floats = np.vstack([np.sqrt(sizes)[:, None] * system.twists, system.damper_rows, slips])
    return rows


def massless_parts(split: Coordinates, damped: Floats, stiff: Floats) -> tuple[Floats, Floats]:
    """Massless motions that a damper resists, each apart from the others in D, and the rest.

    The natural modes have massless motions in elastic balance; what is damped of them leaves it.
    The undamped rest follows in elastic balance.
    """
    if not split.massless.shape[1]:
        return split.massless, split.massless
    rates = damped @ split.massless
    _, sizes, directions = linalg.svd(rates, full_matrices=True)
    rank = int(np.sum(sizes > REAL_EIGENVALUE * sizes.max(initial=0.0)))
    moved = split.massless @ directions[:rank].T
    quiet = split.massless @ directions[rank:].T
    if not (quiet.shape[1] and moved.shape[1]):
        return moved, quiet
    following, *_ = linalg.lstsq(stiff @ quiet, stiff @ moved)
    slow: Floats = moved - quiet @ following
    return slow, quiet


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

    def of_no_mode(self, modes: int) -> Complex:
        """Those that belong to none of the natural modes."""
        taken = {place for mode in range(modes) for place in self.of_mode(mode)}
        return self.eigenvalues[[n for n in range(len(self.eigenvalues)) if n not in taken]]

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

    Of rigid motions the speeds alone are in it. Those that keep their speed are left out.

    A massless motion y that is damped follows by its own rate:
    ``D_yy y' = -K_yy y - (K_yq q + D_yq q')``, where q are the modal coordinates.

    Raises
    ------
    CaseError
        Of numbers that have no eigenvalues in floats.
    """
    state = _state(pencil, _finite(pencil.stiffness), _finite(resistance))
    values, vectors = linalg.eig(_finite(state))
    values = settled(values) if pencil.symmetric else _real_if_close(values)
    kept = np.argsort(np.abs(values), kind="stable")[_steady(pencil, resistance) :]
    kept = np.sort(kept[values[kept].imag >= 0])
    values, vectors = values[kept], vectors[:, kept].astype(np.complex128)
    first, last = pencil.modes, len(vectors) - pencil.massive
    turning = vectors[last + pencil.modes :] / values
    order = order_of(values)
    shapes: Complex = np.vstack([vectors[:first], turning, vectors[first:last]])[:, order]
    return EigenPairs(values[order], shapes / pencil.lengths(shapes, values[order]))


def _steady(pencil: Pencil, resistance: Floats) -> int:
    """How many rigid motions keep their speed, as no converter resists them."""
    if not pencil.rigid:
        return 0
    rigid = slice(pencil.modes, pencil.massive)
    sizes = linalg.svdvals(resistance[rigid, rigid])
    return int(np.sum(sizes <= REAL_EIGENVALUE * sizes.max()))


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
    return _real_if_close(np.minimum(values.real, 0.0) + 1j * values.imag)


def _real_if_close(values: Complex) -> Complex:
    return np.where(np.abs(values.imag) <= REAL_EIGENVALUE * np.abs(values), values.real, values)


def _state(pencil: Pencil, stiffness: Floats, resistance: Floats) -> Floats:
    """The matrix of ``x' = A x`` for the state of modal coordinates, massless ones, speeds."""
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
    kept = np.r_[0 : pencil.modes, count : size + count]
    state: Floats = matrix[np.ix_(kept, kept)]
    return state


def _rates(own: Floats, right: Floats, *, symmetric: bool) -> Floats:
    """What solves ``own x = right``, for dampings that may differ by many powers of ten."""
    sizes = np.diag(own) if symmetric else np.abs(own).max(axis=1)
    scale = 1 / np.sqrt(sizes)[:, None]
    scaled = own * scale * scale.T
    if not symmetric and np.linalg.cond(scaled) * REAL_EIGENVALUE > 1:
        message = (
            "a pump or turbine has no inertia, and the torque of its converter does not depend on "
            "its speed: give its link an inertia"
        )
        raise CaseError("E526", message, ("inertias",))
    solved: Floats = scale * linalg.solve(
        scaled, scale * right, assume_a="pos" if symmetric else "gen"
    )
    return solved


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
