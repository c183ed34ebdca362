"""A torsional system on one shaft, masses and springs without rigid constraints; the case of it.

A spring is a linear form of angles, its twist: +1, -1 of a shaft between two masses, 1 of a
support on the housing, 1, -i, i-1 of three links with a compliance. Everything that is linear
has this one shape (Tsitovich, Algin, Vehicle dynamics, 1981, chapter 1).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.planet_bodies import Body
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.motions import values_of
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.vibration.natural import natural_modes


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


def twists(scheme: TorsionScheme) -> Floats:
    """A row for each spring with its coefficients [-], a column for each mass."""
    return values_of([spring.twist for spring in scheme.springs], len(scheme.names))


def stiffness_matrix(scheme: TorsionScheme) -> Floats:
    """K, the sum of a a^T/E over all springs [N*m/rad].

    >>> shaft = SchemeSpring("shaft", {0: 1.0, 1: -1.0}, 0.5)
    >>> stiffness_matrix(TorsionScheme(("a", "b"), (1.0, 3.0), (shaft,))).tolist()
    [[2.0, -2.0], [-2.0, 2.0]]
    """
    rows = twists(scheme)
    compliances = np.array([spring.compliance for spring in scheme.springs])
    stiffness: Floats = rows.T @ (rows / compliances[:, None])
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


def scheme_case(scheme: TorsionScheme, name: str, ends: Sequence[str], gear: str) -> Transmission:
    """A case that vibrates as a scheme does, on its reference shaft.

    Parameters
    ----------
    scheme : TorsionScheme
    name : str
        Of the case.
    ends : sequence of str
        The links of input and output, as far as masses are named after them.
    gear : str
        The name of its gear.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = (SchemeSpring("s", {0: 1.0, 1: -1.0}, 0.5),)
    >>> case = scheme_case(TorsionScheme(("a+b", "c"), (1.0, 2.0), springs), "", ("b", "c"), "1")
    >>> case.link_name(case.input), case.link_name(case.output), case.springs[0].compliance
    ('a+b', 'c', 0.5)
    """
    first, last = (_mass_of(scheme.names, end) for end in ends)
    masses = range(1, len(scheme.names) + 1)
    others = [mass for mass in reversed(masses) if mass != first]
    output = last if last not in (None, first) else next(iter(others), 1)
    return Transmission(
        len(scheme.names),
        [],
        [],
        [Gear(name=gear)],
        input=first or next((mass for mass in masses if mass != output), 1),
        output=output or 0,
        name=name,
        link_names=scheme.names,
        inertias={mass: scheme.inertias[mass - 1] for mass in masses},
        springs=[
            Spring(
                {mass + 1: part for mass, part in spring.twist.items()},
                compliance=spring.compliance,
                damping=spring.damping,
                name=spring.name,
            )
            for spring in scheme.springs
        ],
    )


def _mass_of(names: Sequence[str], link: str) -> int | None:
    """The number of the mass that a link is part of."""
    found = (n for n, name in enumerate(names, 1) if link in (name, *name.split("+")))
    return next(found, None)
