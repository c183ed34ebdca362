"""Natural frequencies of many variants, from twists of components in motions of modal mass 1.

The natural frequencies are the singular values of the matrix of these twists times roots of
stiffnesses, as in `natural`. Stacks of small matrices are solved for many inertias and stiffnesses
at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import LOST_SQUARE


class Split(NamedTuple):
    """Speeds of bodies and twists of components in each motion of `Coordinates`.

    Leading axes are variants with other ratios.

    Attributes
    ----------
    bodies : ndarray, shape (..., bodies, heavy motions)
        Speeds of bodies in motions with inertia.
    twists : ndarray, shape (..., devices, heavy motions)
        Twists of components in motions with inertia.
    massless : ndarray, shape (..., devices, massless motions)
        Twists of components in massless motions.
    rigid : ndarray, shape (..., heavy motions, rigid motions)
        Rigid motions as combinations of motions with inertia.
    """

    bodies: Floats
    twists: Floats
    massless: Floats
    rigid: Floats


class NormedTwists(NamedTuple):
    """Twists of elastic components in normalised motions of a system.

    Attributes
    ----------
    heavy : ndarray, shape (..., devices, modes)
        Twists in motions of modal mass 1 that are orthogonal, in the inertia matrix, to each other
        and to rigid motions. Leading axes as in the inertias. [1/sqrt(kg*m^2)]
    massless : ndarray, shape (..., devices, massless motions)
        Twists in massless motions.
    """

    heavy: Floats
    massless: Floats


def normed_twists(system: TorsionalSystem, split: Coordinates, inertias: Floats) -> NormedTwists:
    """Calculate the twists in motions of modal mass 1 for several sets of inertias.

    Parameters
    ----------
    inertias : ndarray, shape (..., bodies)
        Inertias of bodies; the same bodies as in `system` must have the inertia 0. [kg*m^2]

    Examples
    --------
    Two masses on a shaft, for two inertias of the second mass:

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> inertias = np.array([[2.0, 2.0], [2.0, 0.5]])
    >>> np.abs(normed_twists(system, coordinates(system), inertias).heavy) ** 2
    array([[[1. ]],
    <BLANKLINE>
           [[2.5]]])
    """
    heavy, twists = split.heavy, system.twists
    every = np.hstack([heavy, split.massless])
    by_every = np.asarray(np.linalg.lstsq(every, split.rigid, rcond=None)[0])
    parts = Split(
        system.speeds @ heavy,
        twists @ heavy,
        twists @ split.massless,
        by_every[: heavy.shape[1]],
    )
    return of_split(parts, inertias)


def of_split(split: Split, inertias: Floats) -> NormedTwists:
    """Return the twists in motions of modal mass 1, from any basis of motions.

    Leading axes of `split` and of `inertias` are broadcast.
    """
    triangle = _triangle(np.sqrt(inertias)[..., None] * split.bodies)
    coefficients = np.broadcast_to(np.eye(triangle.shape[-1]), triangle.shape)
    if rigid := split.rigid.shape[-1]:
        turned, _ = np.linalg.qr(triangle @ split.rigid, mode="complete")
        coefficients = turned[..., rigid:]
    return NormedTwists(split.twists @ np.linalg.solve(triangle, coefficients), split.massless)


def natural_frequencies(twists: NormedTwists, stiffnesses: Floats, first: int = 0) -> Floats:
    """Return the natural frequencies for several sets of stiffnesses.

    Parameters
    ----------
    stiffnesses : ndarray, shape (variants, devices)
        Stiffnesses of the elastic components. [N*m/rad]
    first : int
        Number of the lowest mode that must be accurate, from 0.

    Returns
    -------
    ndarray, shape (variants, modes)
        Angular natural frequencies, ascending. [rad/s]
    """
    rows = triangular(twists, stiffnesses)
    massless = twists.massless.shape[-1]
    rows = rows[..., massless:, massless:] if massless else rows
    squares = np.linalg.eigvalsh(rows.swapaxes(-1, -2) @ rows)
    omegas: Floats = np.sqrt(np.maximum(squares, 0.0))
    lossy = ~(squares[:, first] > LOST_SQUARE * squares[:, -1])
    if lossy.any():
        omegas[lossy] = np.linalg.svd(rows[lossy], compute_uv=False)[:, ::-1]
    return omegas


def triangular(twists: NormedTwists, stiffnesses: Floats) -> Floats:
    """Return twists times roots of stiffnesses, with massless motions as the first columns.

    With massless motions the matrix is reduced to triangular form. The block to the right of their
    columns, below their rows, is valid for massless motions that follow the other motions in
    equilibrium. Rows of stiff components come first, because the elimination is then accurate.

    Returns
    -------
    ndarray, shape (variants, rows, massless motions + modes)
    """
    roots = np.sqrt(stiffnesses)[..., None]
    heavy = roots * twists.heavy
    if not twists.massless.shape[-1]:
        return heavy
    massless = np.broadcast_to(
        roots * twists.massless, (*heavy.shape[:-1], twists.massless.shape[-1])
    )
    both = np.concatenate([massless, heavy], axis=-1)
    order = np.argsort(-np.abs(both).max(axis=-1), axis=-1)
    ordered = np.take_along_axis(both, order[..., None], axis=-2)
    return _triangle(ordered)


def _triangle(matrices: Floats) -> Floats:
    return np.asarray(np.linalg.qr(matrices, mode="r"))  # mode "r" saves memory
