"""Eigenpairs of damped vibration from near ones, many at once: Newton's method.

For ``T(s) x = 0`` with ``T(s) = s^2 M + s D + K`` the step of the shape x and of s solves

    [T(s)  T'(s) x] [dx]     [T(s) x]
    [x^H      0   ] [ds] = - [  0   ]

which stays regular at a simple eigenvalue (Ruhe, Algorithms for the nonlinear eigenvalue problem,
1973). All matrices are symmetric, so s then is that root of ``x^T T(s) x`` which is near: its
error is the square of that of the shape.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Complex, Floats, Integers
from vstatics.torsion.tolerances import LAST_EIGENVALUE_STEP

MOST_NEWTON_STEPS = 8
"""From a near shape three or four do; where more are needed it is not near."""
STACKED_NUMBERS = 2**20
"""Of the matrices that are solved at once."""


class Pencils(NamedTuple):
    """The matrices of several systems, in one set of coordinates.

    Attributes
    ----------
    masses : ndarray, shape (coordinates,)
        On the diagonal of M; all else of it is 0.
    stiffness : ndarray, shape (coordinates, coordinates)
    resistances : ndarray, shape (systems, coordinates, coordinates)
    """

    masses: Floats
    stiffness: Floats
    resistances: Floats

    def of(self, systems: Integers) -> Pencils:
        """Of some of the systems."""
        return self._replace(resistances=self.resistances[systems])

    def damped(self, shapes: Complex) -> Complex:
        """``D x`` for a shape x of each system."""
        return _products(self.resistances, shapes)

    def twisted(self, shapes: Complex) -> Complex:
        """``K x`` likewise."""
        return _products(self.stiffness, shapes)

    def roots(self, shapes: Complex) -> tuple[Complex, Complex]:
        """Both s with ``x^T T(s) x = 0``, the smaller first, for a shape x of each system."""
        mass = (self.masses * shapes**2).sum(axis=1)
        square = (self.twisted(shapes) * shapes).sum(axis=1) / mass
        half = (self.damped(shapes) * shapes).sum(axis=1) / (2 * mass)
        root = np.sqrt(half**2 - square)
        larger = -half - np.where((half.conjugate() * root).real < 0, -root, root)
        return square / larger, larger


class Refined(NamedTuple):
    """Eigenpairs, one of each system.

    Attributes
    ----------
    eigenvalues : ndarray, shape (systems,)
    shapes : ndarray, shape (systems, coordinates)
        In all coordinates, of length 1.
    converged : ndarray, shape (systems,)
    """

    eigenvalues: Complex
    shapes: Complex
    converged: Booleans


def refined(pencils: Pencils, eigenvalues: Complex, shapes: Complex) -> Refined:
    """The eigenpairs next to some others.

    Examples
    --------
    Two masses on springs of 1 and 4, a damper between the two: from the shapes without it.

    >>> resistance = 0.1 * np.array([[[1.0, -1.0], [-1.0, 1.0]]])
    >>> pencils = Pencils(np.ones(2), np.diag([1.0, 4.0]), resistance)
    >>> made = refined(pencils, np.array([1j]), np.array([[1.0 + 0j, 0.0]]))
    >>> made.converged, made.eigenvalues.round(6)
    (array([ True]), array([-0.050168+1.000416j]))
    """
    with np.errstate(all="ignore"):
        shapes = shapes / np.linalg.norm(shapes, axis=1, keepdims=True)
        values, converged = eigenvalues.copy(), np.zeros(len(eigenvalues), np.bool_)
        left = np.arange(len(eigenvalues))
        for _ in range(MOST_NEWTON_STEPS):
            if not len(left):
                break
            some = pencils.of(left)
            guess, shapes[left] = _step(some, values[left], shapes[left])
            one, other = some.roots(shapes[left])
            found = np.where(np.abs(one - guess) < np.abs(other - guess), one, other)
            steps = np.abs(found - values[left])
            values[left] = found
            converged[left] = steps <= LAST_EIGENVALUE_STEP * np.abs(found)
            left = left[~converged[left] & np.isfinite(found)]
    return Refined(values, shapes, converged)


def _products(matrices: Floats, shapes: Complex) -> Complex:
    """A real matrix, or one of each system, by complex shapes."""
    made = matrices @ np.stack([shapes.real, shapes.imag], axis=-1)
    return np.asarray(made[:, :, 0] + 1j * made[:, :, 1])


def _step(pencils: Pencils, values: Complex, shapes: Complex) -> tuple[Complex, Complex]:
    """The next eigenvalues, and shapes of length 1."""
    s, size, every = values[:, None], shapes.shape[1], np.arange(shapes.shape[1])
    massive, resisted = pencils.masses * shapes, pencils.damped(shapes)
    bordered = np.zeros((len(values), size + 1, size + 1), np.complex128)
    own = bordered[:, :size, :size]
    np.multiply(pencils.resistances, s[:, :, None], out=own)
    own += pencils.stiffness
    own[:, every, every] += s**2 * pencils.masses
    bordered[:, :size, size] = 2 * s * massive + resisted
    bordered[:, size, :size] = shapes.conjugate()
    right = np.zeros((len(values), size + 1, 1), np.complex128)
    right[:, :size, 0] = -(s**2 * massive + s * resisted + pencils.twisted(shapes))
    try:
        steps = np.linalg.solve(bordered, right)[:, :, 0]
    except np.linalg.LinAlgError:  # one of them is singular
        return np.full_like(values, np.nan), shapes
    moved = shapes + steps[:, :size]
    return values + steps[:, size], moved / np.linalg.norm(moved, axis=1, keepdims=True)
