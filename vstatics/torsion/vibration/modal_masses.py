"""The elastic devices of a system in motions of modal mass 1: all that its frequencies need.

With these motions the natural frequencies are the singular values of the twists, each by the
root of its stiffness, as in `natural`. Here it is done with stacks of small matrices, for many
inertias and stiffnesses at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import LOST_SQUARE


class Split(NamedTuple):
    """Forms of links by the motions of a system, split as `Coordinates` has them.

    Each may have leading axes: of variants in which links are joined otherwise.

    Attributes
    ----------
    bodies : ndarray, shape (..., bodies, heavy motions)
    twists : ndarray, shape (..., devices, heavy motions)
    massless : ndarray, shape (..., devices, massless motions)
        Twists.
    rigid : ndarray, shape (..., heavy motions, rigid motions)
        What of the heavy motions is in the rigid ones.
    """

    bodies: Floats
    twists: Floats
    massless: Floats
    rigid: Floats


class NormedTwists(NamedTuple):
    """Twists of the elastic devices by motions of a system.

    Attributes
    ----------
    heavy : ndarray, shape (..., devices, modes)
        By motions of modal mass 1, orthogonal in M to each other and to rigid ones. The leading
        axes are those of the inertias. [1/sqrt(kg*m^2)]
    massless : ndarray, shape (..., devices, massless motions)
    """

    heavy: Floats
    massless: Floats


def normed_twists(system: TorsionalSystem, split: Coordinates, inertias: Floats) -> NormedTwists:
    """The twists of a system, for other inertias of its bodies.

    Parameters
    ----------
    inertias : ndarray, shape (..., bodies)
        0 where they are 0 in the system, and nowhere else. [kg*m^2]

    Examples
    --------
    Two masses on a shaft, for two inertias of the second:

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
    by_every: Floats = np.asarray(np.linalg.lstsq(every, split.rigid, rcond=None)[0])
    parts = Split(
        system.speeds @ heavy,
        twists @ heavy,
        twists @ split.massless,
        by_every[: heavy.shape[1]],
    )
    return of_split(parts, inertias)


def of_split(split: Split, inertias: Floats) -> NormedTwists:
    """The same of forms by motions, with leading axes of these or of the inertias."""
    triangle = _triangle(np.sqrt(inertias)[..., None] * split.bodies)
    apart: Floats = np.broadcast_to(np.eye(triangle.shape[-1]), triangle.shape)
    if rigid := split.rigid.shape[-1]:
        turned, _ = np.linalg.qr(triangle @ split.rigid, mode="complete")
        apart = turned[..., rigid:]
    return NormedTwists(split.twists @ np.linalg.solve(triangle, apart), split.massless)


def natural_frequencies(twists: NormedTwists, stiffnesses: Floats, first: int = 0) -> Floats:
    """The frequencies of systems of other stiffnesses.

    Parameters
    ----------
    stiffnesses : ndarray, shape (variants, devices)
        [N*m/rad]
    first : int
        The lowest mode that has to be accurate, from 0.

    Returns
    -------
    ndarray, shape (variants, modes)
        Ascending. [rad/s]
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
    """Twists by the roots of stiffnesses, massless motions first: where there are any, triangular.

    Then what is right of and below the massless motions is left when they follow the others in
    balance of their torques. Stiff devices come first, which an elimination by rows needs.

    Returns
    -------
    ndarray, shape (variants, rows, massless motions + modes)
    """
    roots = np.sqrt(stiffnesses)[..., None]
    heavy: Floats = roots * twists.heavy
    if not twists.massless.shape[-1]:
        return heavy
    massless = np.broadcast_to(
        roots * twists.massless, (*heavy.shape[:-1], twists.massless.shape[-1])
    )
    both = np.concatenate([massless, heavy], axis=-1)
    order = np.argsort(-np.abs(both).max(axis=-1), axis=-1)
    ordered: Floats = np.take_along_axis(both, order[..., None], axis=-2)
    return _triangle(ordered)


def _triangle(matrices: Floats) -> Floats:
    triangle: Floats = np.asarray(np.linalg.qr(matrices, mode="r"))  # one array, not two
    return triangle
