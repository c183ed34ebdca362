"""A torsional system on one shaft, without rigid constraints: masses and springs between them.

A spring is a linear form of angles, its twist: +1, -1 of a shaft between two masses, 1 of a
support on the housing, 1, -i, i-1 of three links with a compliance. Everything that is linear
has this one shape (Tsitovich, Algin, Vehicle dynamics, 1981, chapter 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.numerics.tolerances import TIE

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

    They are the singular values of C^(1/2) A J^(-1/2), so no stiffness is squared away beside a
    larger one. How many are rigid motions comes from the rank of the twists A. Masses without
    inertia follow the others as they must: what they can take is projected out.

    Returns
    -------
    tuple of float
        [rad/s]

    Examples
    --------
    >>> shaft = SchemeSpring("shaft", {0: 1.0, 1: -1.0}, 0.5)
    >>> natural_frequencies(TorsionScheme(("a", "b"), (1.0, 2.0), (shaft,)))
    (1.7320508075688772,)
    """
    rows, inertias = twists(scheme), np.array(scheme.inertias)
    if not rows.size:
        return ()
    heavy, light = rows[:, inertias > 0], rows[:, inertias == 0]
    root = np.array([spring.compliance for spring in scheme.springs])[:, None] ** -0.5
    scaled = root * heavy / np.sqrt(inertias[inertias > 0])
    taken = _rank(light)
    if taken:
        basis = np.linalg.svd(root * light, full_matrices=False)[0][:, :taken]
        scaled -= basis @ (basis.T @ scaled)
    values = np.linalg.svd(scaled, compute_uv=False) if scaled.size else np.zeros(0)
    return tuple(values[: _rank(rows) - taken][::-1].tolist())


def _rank(rows: Array) -> int:
    """The rank of twists, each measured by its own length."""
    if not rows.size:
        return 0
    lengths = np.linalg.norm(rows, axis=1, keepdims=True)
    values = np.linalg.svd(rows / np.where(lengths > 0, lengths, 1), compute_uv=False)
    return int(np.sum(values > TIE * values[0]))
