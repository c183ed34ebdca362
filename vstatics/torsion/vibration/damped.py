"""Damped vibration: eigenvalues of ``M q'' + D q' + K q = 0``, except for rigid modes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.system.coordinates import Coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.vibration.eigen_pairs import eigen_pairs, order_of, pencil_of
from vstatics.torsion.vibration.loss_factors import pairs_of_modes
from vstatics.torsion.vibration.natural import NaturalModes


class DampedModes(NamedTuple):
    """Eigenvalues of a damped system, and their assignment to natural modes.

    Attributes
    ----------
    eigenvalues : ndarray
        Eigenvalues with an imaginary part of 0 or more, sorted by modulus, then imaginary part.
        [1/s]
    of_modes : ndarray, shape (modes, 2)
        The two eigenvalues of each natural mode, a conjugate pair or two real numbers: their
        complex shapes are nearest to the mode in the mass norm. [1/s]
    """

    eigenvalues: Complex
    of_modes: Complex

    @property
    def ratios(self) -> Floats:
        """Damping ratios of natural modes: ``-(s1 + s2)/2/sqrt(s1 s2)`` of both eigenvalues [-]."""
        sizes = np.sqrt(np.abs(self.of_modes)).prod(axis=1)
        sums = -self.of_modes.real.sum(axis=1) / 2
        return np.asarray(np.divide(sums, sizes, out=np.ones(len(sizes)), where=sizes > 0) + 0.0)

    @property
    def frequencies(self) -> Floats:
        """Damped angular frequencies of the natural modes; 0 for an overdamped mode [rad/s]."""
        return np.asarray(self.of_modes[:, 0].imag)


def damped_modes(system: TorsionalSystem, split: Coordinates, modes: NaturalModes) -> DampedModes:
    """Calculate the eigenvalues of a damped system.

    At each natural frequency a loss factor is replaced by equivalent viscous damping, ``c *
    loss_factor / omega``. The eigenvalues then belong to the natural modes, and to rigid modes that
    converters or separate dampers resist.

    Examples
    --------
    A mass on a spring: ``s = -zeta omega +- i omega sqrt(1 - zeta^2)``.

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
    pencil = pencil_of(system, split, modes)
    if not pencil.lost.any():
        pairs = eigen_pairs(pencil, pencil.viscous)
        return DampedModes(pairs.eigenvalues, pairs.values(range(len(modes.omegas))))
    of_modes = pairs_of_modes(pencil, modes.omegas)
    upper = np.concatenate([of_modes[:, 0], of_modes[of_modes[:, 1].imag == 0, 1]])
    if pencil.rigid:
        pencil = pencil_of(system, split, modes, hysteretic=False)
        others = eigen_pairs(pencil, pencil.viscous).of_no_mode(len(of_modes))
        upper = np.concatenate([upper, others])
    return DampedModes(upper[order_of(upper)], of_modes)
