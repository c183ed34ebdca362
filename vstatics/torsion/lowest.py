"""The lowest natural frequencies of a system of many links, by sparse matrices."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse import linalg

from vstatics.torsion.coordinates import Coordinates
from vstatics.torsion.natural import NaturalModes, weighted_bodies, weighted_twists
from vstatics.torsion.system import TorsionalSystem


def lowest_modes(system: TorsionalSystem, split: Coordinates, count: int) -> NaturalModes:
    """The lowest modes that are not rigid, by Lanczos iteration about a point below 0.

    Examples
    --------
    A shaft of 400 equal masses, free at its ends: ``omega_k = 2 sin(k pi/800)``.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.coordinates import coordinates
    >>> from vstatics.torsion.system import torsional_system
    >>> springs = [Spring({n: 1, n + 1: -1}, stiffness=1.0) for n in range(1, 400)]
    >>> case = Transmission(400, [], [], [], springs=springs,
    ...                     inertias=dict.fromkeys(range(1, 401), 1.0))
    >>> system = torsional_system(case, case.gears[0])
    >>> omegas = lowest_modes(system, coordinates(system), 2).omegas
    >>> np.allclose(omegas, 2*np.sin(np.pi*np.array([1, 2])/800), rtol=1e-9)
    True
    """
    free = sparse.csc_matrix(split.free)
    twists = sparse.csc_matrix(weighted_twists(system)) @ free
    speeds = sparse.csc_matrix(weighted_bodies(system)) @ free
    stiffness, mass = (twists.T @ twists).tocsc(), (speeds.T @ speeds).tocsc()
    # about the square of the lowest frequency: a mean of all, by the square of their number
    mean = float(stiffness.diagonal().sum() / mass.diagonal().sum())
    below = -1e-3 * mean / free.shape[1] ** 2
    rigid = split.rigid.shape[1]
    start = np.random.default_rng(1).standard_normal(free.shape[1])
    found, all_vectors = linalg.eigsh(stiffness, rigid + count, mass, sigma=below, v0=start)
    vectors = all_vectors[:, np.argsort(found)[rigid:]]
    sizes = np.linalg.norm(np.asarray(speeds @ vectors), axis=0)
    omegas = np.linalg.norm(np.asarray(twists @ vectors), axis=0) / sizes
    return NaturalModes(omegas, np.asarray(free @ vectors) / sizes)
