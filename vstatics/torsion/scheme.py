"""A torsional system on one shaft, without rigid constraints: masses and springs between them.

A spring is a linear form of angles, its twist: +1, -1 of a shaft between two masses, 1 of a
support on the housing, 1, -i, i-1 of three links with a compliance. Everything that is linear
has this one shape (Tsitovich, Algin, Vehicle dynamics, 1981, chapter 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.torsion.body import Body
from vstatics.torsion.coordinates import coordinates
from vstatics.torsion.natural import natural_modes
from vstatics.torsion.system import TorsionalDevice, TorsionalSystem

Array = np.ndarray[Any, np.dtype[np.float64]]


class SchemeSpring(NamedTuple):
    """An elastic device; what it resists is its twist."""

    name: str
    twist: Mapping[int, float]
    """Number of a mass, from 0 -> coefficient of its angle. [-]"""
    compliance: float
    """On the reference shaft. [rad/(N*m)]"""
    damping: float = 0.0
    """[N*m*s/rad]"""


class TorsionScheme(NamedTuple):
    """Masses in the order of the case, and springs."""

    names: tuple[str, ...]
    inertias: tuple[float, ...]
    """Of the masses. [kg*m^2]"""
    springs: tuple[SchemeSpring, ...]


def twists(scheme: TorsionScheme) -> Array:
    """A row for each spring with its coefficients [-], a column for each mass."""
    rows = np.zeros((len(scheme.springs), len(scheme.names)))
    for row, spring in zip(rows, scheme.springs, strict=True):
        for mass, coefficient in spring.twist.items():
            row[mass] = coefficient
    return rows


def stiffness_matrix(scheme: TorsionScheme) -> Array:
    """K, the sum of a a^T/E over all springs [N*m/rad].

    >>> shaft = SchemeSpring("shaft", {0: 1.0, 1: -1.0}, 0.5)
    >>> stiffness_matrix(TorsionScheme(("a", "b"), (1.0, 3.0), (shaft,))).tolist()
    [[2.0, -2.0], [-2.0, 2.0]]
    """
    rows = twists(scheme)
    compliances = np.array([spring.compliance for spring in scheme.springs])
    stiffness: Array = rows.T @ (rows / compliances[:, None])
    return stiffness


def natural_frequencies(scheme: TorsionScheme) -> tuple[float, ...]:
    """Natural frequencies without damping, ascending, without those of rigid motions.

    Masses without inertia follow the others.

    Returns
    -------
    tuple of float
        [rad/s]

    Examples
    --------
    >>> shaft = SchemeSpring("shaft", {0: 1.0, 1: -1.0}, 0.5)
    >>> natural_frequencies(TorsionScheme(("a", "b"), (1.0, 2.0), (shaft,)))
    (1.732050807568877...,)
    """
    system = TorsionalSystem(
        scheme.names,
        len(scheme.names),
        tuple(
            Body(name, {mass: 1.0}, inertia)
            for mass, (name, inertia) in enumerate(zip(scheme.names, scheme.inertias, strict=True))
        ),
        tuple(
            TorsionalDevice(spring.name, spring.twist, 1 / spring.compliance)
            for spring in scheme.springs
        ),
        scheme.inertias,
    )
    return tuple(natural_modes(system, coordinates(system)).omegas.tolist())
