"""Natural frequencies and shapes without damping, accurate over any range of stiffness.

The modes solve ``K z = omega^2 M z`` with ``K = B' c B`` and ``M = L' J L``: twists ``B z`` of
elastic components with stiffnesses c, and speeds ``L z`` of bodies with inertias J. `natural_modes`
takes omega as the generalised singular values of ``sqrt(c) B`` and ``sqrt(J) L``. It never forms K,
because rounding of stiff springs would swamp soft springs. `lowest_modes` forms K and M, as sparse
matrices.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import linalg, sparse
from scipy.sparse.linalg import eigsh

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import BELOW_SQUARES


class NaturalModes(NamedTuple):
    """Modes of a system by ascending frequency, without rigid modes.

    Attributes
    ----------
    omegas : ndarray, shape (modes,)
        Angular natural frequencies. [rad/s]
    shapes : ndarray, shape (links, modes)
        Amplitudes of all links, with a modal mass of 1.
    """

    omegas: Floats
    shapes: Floats


def natural_modes(system: TorsionalSystem, split: Coordinates) -> NaturalModes:
    """Return all modes of a system except rigid modes; links without inertia add none.

    Examples
    --------
    Two masses on a shaft: ``omega^2 = c (1/J_1 + 1/J_2)``.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> natural_modes(system, coordinates(system)).omegas
    array([10.])
    """
    basis = elastic_basis(system, split)
    twists = weighted_twists(system) @ basis
    if not twists.size:
        return NaturalModes(np.zeros(0), basis)
    _, omegas, vectors = linalg.svd(twists, full_matrices=True, lapack_driver="gesvd")
    count = basis.shape[1]
    every = np.zeros(count)
    every[: len(omegas)] = omegas[:count]
    return NaturalModes(every[::-1], (basis @ vectors.T)[:, ::-1])


def lowest_modes(system: TorsionalSystem, split: Coordinates, count: int) -> NaturalModes:
    """Return the lowest modes except rigid modes, by shifted Lanczos iteration.

    Examples
    --------
    A shaft of 400 equal masses, free at its ends: ``omega_k = 2 sin(k pi/800)``.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> springs = [Spring({n: 1, n + 1: -1}, stiffness=1.0) for n in range(1, 400)]
    >>> case = Transmission(400, [], [], [], springs=springs,
    ...                     inertias=dict.fromkeys(range(1, 401), 1.0))
    >>> system = torsional_system(case, case.gears[0])
    >>> omegas = lowest_modes(system, coordinates(system), 2).omegas
    >>> np.allclose(omegas, 2*np.sin(np.pi*np.array([1, 2])/800), rtol=1e-9)
    True
    """
    free = sparse.csc_matrix(split.bound)
    twists = sparse.csc_matrix(weighted_twists(system)) @ free
    speeds = sparse.csc_matrix(weighted_bodies(system)) @ free
    stiffness, mass = (twists.T @ twists).tocsc(), (speeds.T @ speeds).tocsc()
    # The lowest squared frequency is about the mean square divided by the number of modes squared.
    mean = float(stiffness.diagonal().sum() / mass.diagonal().sum())
    below = -BELOW_SQUARES * mean / free.shape[1] ** 2
    rigid = split.rigid.shape[1]
    start = np.random.default_rng(1).standard_normal(free.shape[1])
    squares, all_vectors = eigsh(stiffness, rigid + count, mass, sigma=below, v0=start)
    vectors = all_vectors[:, np.argsort(squares)[rigid:]]
    sizes = np.linalg.norm(np.asarray(speeds @ vectors), axis=0)
    omegas = np.linalg.norm(np.asarray(twists @ vectors), axis=0) / sizes
    return NaturalModes(omegas, np.asarray(free @ vectors) / sizes)


def elastic_basis(system: TorsionalSystem, split: Coordinates) -> Floats:
    """Return motions of modal mass 1, mutually orthogonal in M and orthogonal to rigid motions.

    In these motions the elastic torques on links without inertia are in equilibrium.

    Returns
    -------
    ndarray, shape (links, modes)
    """
    following = split.heavy - split.massless @ _followed(system, split)
    speeds = weighted_bodies(system)
    if not following.shape[1] or not system.elastic:
        return following[:, :0]
    _, triangle = linalg.qr(speeds @ following, mode="economic")
    inverse, _ = linalg.lapack.dtrtri(triangle)
    orthogonal: Floats = inverse
    if split.rigid.size:
        rigid, *_ = linalg.lstsq(following, split.rigid)
        turned, _ = linalg.qr(triangle @ rigid)
        orthogonal = orthogonal @ turned[:, rigid.shape[1] :]
    return following @ orthogonal


def _followed(system: TorsionalSystem, split: Coordinates) -> Floats:
    """Return the massless motion that follows each motion with inertia in elastic equilibrium."""
    counts = split.massless.shape[1], split.heavy.shape[1]
    if 0 in counts:
        return np.zeros(counts)
    twists = weighted_twists(system)
    order = np.argsort(-np.abs(twists).max(axis=1), kind="stable")  # accurate QR
    solution, *_ = linalg.lstsq(
        (twists @ split.massless)[order], (twists @ split.heavy)[order], lapack_driver="gelsy"
    )
    return solution


def weighted_twists(system: TorsionalSystem) -> Floats:
    """Return the matrix from link angles to twists times roots of stiffnesses."""
    return np.asarray(np.sqrt(system.rates)[:, None] * system.twists)


def weighted_bodies(system: TorsionalSystem) -> Floats:
    """Return the matrix from link speeds to speeds of bodies times roots of inertias."""
    return np.asarray(np.sqrt(system.inertias)[:, None] * system.speeds)
