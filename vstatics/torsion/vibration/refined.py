"""Newton's method for eigenvalues and shapes of damped vibration, for many systems at once.

For ``T(s) x = 0`` with ``T(s) = s^2 M + s D + K`` the step of the shape x and of s solves

    [T(s)  T'(s) x] [dx]     [T(s) x]
    [x^H      0   ] [ds] = - [  0   ]

which stays regular at a simple eigenvalue (Ruhe, Algorithms for the nonlinear eigenvalue problem,
1973). All matrices are symmetric, so the next s is the nearest root of ``x^T T(s) x``, whose error
is of the order of the squared error of x.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Complex, Floats, Integers
from vstatics.torsion.tolerances import LAST_EIGENVALUE_STEP

MOST_NEWTON_STEPS = 8
"""Largest number of Newton steps; from an approximate shape, three or four suffice."""
STACKED_NUMBERS = 2**20
"""Largest number of matrix entries in a batch."""


class Pencils(NamedTuple):
    """Matrices of several systems that differ in their damping.

    Attributes
    ----------
    masses : ndarray, shape (coordinates,)
        Diagonal of the diagonal matrix M.
    stiffness : ndarray, shape (coordinates, coordinates)
        Common matrix K.
    resistances : ndarray, shape (systems, coordinates, coordinates)
        Matrices D of the systems.
    """

    masses: Floats
    stiffness: Floats
    resistances: Floats

    def of(self, systems: Integers) -> Pencils:
        """Return the matrices of a selection of systems."""
        return self._replace(resistances=self.resistances[systems])

    def roots(self, shapes: Complex) -> tuple[Complex, Complex]:
        """Return both roots s of ``x^T T(s) x = 0`` for a shape x of each system.

        The first root has the smaller modulus.
        """
        mass = (self.masses * shapes**2).sum(axis=1)
        square = (_products(self.stiffness, shapes) * shapes).sum(axis=1) / mass
        half = (_products(self.resistances, shapes) * shapes).sum(axis=1) / (2 * mass)
        root = np.sqrt(half**2 - square)
        larger = -half - np.where((half.conjugate() * root).real < 0, -root, root)
        return square / larger, larger


class Refined(NamedTuple):
    """Eigenvalue and shape of each system.

    Attributes
    ----------
    eigenvalues : ndarray, shape (systems,)
        Eigenvalues s. [1/s]
    shapes : ndarray, shape (systems, coordinates)
        Complex shapes of length 1.
    converged : ndarray, shape (systems,)
        True if the last step of the eigenvalue was below the tolerance.
    """

    eigenvalues: Complex
    shapes: Complex
    converged: Booleans


def refined(pencils: Pencils, eigenvalues: Complex, shapes: Complex) -> Refined:
    """Refine an approximate eigenvalue and shape of each system.

    Examples
    --------
    Two masses on springs of 1 and 4, with a damper between them, from an undamped shape:

    >>> resistance = 0.1 * np.array([[[1.0, -1.0], [-1.0, 1.0]]])
    >>> pencils = Pencils(np.ones(2), np.diag([1.0, 4.0]), resistance)
    >>> pairs = refined(pencils, np.array([1j]), np.array([[1.0 + 0j, 0.0]]))
    >>> pairs.converged, pairs.eigenvalues.round(6)
    (array([ True]), array([-0.050168+1.000416j]))
    """
    with np.errstate(all="ignore"):
        shapes = shapes / np.linalg.norm(shapes, axis=1, keepdims=True)
        values, converged = eigenvalues.copy(), np.zeros(len(eigenvalues), np.bool_)
        places = np.arange(len(eigenvalues))
        for _ in range(MOST_NEWTON_STEPS):
            if not len(places):
                break
            unfinished = pencils.of(places)
            guess, shapes[places] = _newton_step(unfinished, values[places], shapes[places])
            smaller, larger = unfinished.roots(shapes[places])
            nearest = np.where(np.abs(smaller - guess) < np.abs(larger - guess), smaller, larger)
            steps = np.abs(nearest - values[places])
            values[places] = nearest
            converged[places] = steps <= LAST_EIGENVALUE_STEP * np.abs(nearest)
            places = places[~converged[places] & np.isfinite(nearest)]
    return Refined(values, shapes, converged)


def _products(matrices: Floats, shapes: Complex) -> Complex:
    """Return products of complex shapes with a real matrix, or with a matrix for each system."""
    products = matrices @ np.stack([shapes.real, shapes.imag], axis=-1)
    return np.asarray(products[:, :, 0] + 1j * products[:, :, 1])


def _newton_step(pencils: Pencils, values: Complex, shapes: Complex) -> tuple[Complex, Complex]:
    s, size, every = values[:, None], shapes.shape[1], np.arange(shapes.shape[1])
    massive, resisted = pencils.masses * shapes, _products(pencils.resistances, shapes)
    bordered = np.zeros((len(values), size + 1, size + 1), np.complex128)
    of_shapes = bordered[:, :size, :size]
    np.multiply(pencils.resistances, s[:, :, None], out=of_shapes)
    of_shapes += pencils.stiffness
    of_shapes[:, every, every] += s**2 * pencils.masses
    bordered[:, :size, size] = 2 * s * massive + resisted
    bordered[:, size, :size] = shapes.conjugate()
    right = np.zeros((len(values), size + 1, 1), np.complex128)
    right[:, :size, 0] = -(s**2 * massive + s * resisted + _products(pencils.stiffness, shapes))
    try:
        steps = np.linalg.solve(bordered, right)[:, :, 0]
    except np.linalg.LinAlgError:  # a matrix in the stack is singular
        return np.full_like(values, np.nan), shapes
    moved = shapes + steps[:, :size]
    return values + steps[:, size], moved / np.linalg.norm(moved, axis=1, keepdims=True)
