"""Equivalent model of a torsional system: masses and springs, without rigid constraints.

The model (scheme) is reduced to a reference shaft. The twist of a spring is a linear form of angles
(Tsitovich, Algin, Vehicle dynamics, 1981, chapter 1). Its coefficients are 1 and -1 for a shaft
between two masses, and 1 for a support on the housing. For an elastic gear set of ratio i between
three links they are 1, -i and i - 1.
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
    """Spring of a scheme."""

    name: str
    twist: Mapping[int, float]
    """Coefficients of the angles of masses in the twist, by index of the mass from 0. [-]"""
    compliance: float
    """Compliance, reduced to the reference shaft. [rad/(N*m)]"""
    damping: float = 0.0
    """Viscous damping, reduced to the reference shaft. [N*m*s/rad]"""


class TorsionScheme(NamedTuple):
    """Equivalent model of a gear: masses, in the order of the case, and springs."""

    names: tuple[str, ...]
    inertias: tuple[float, ...]
    """Inertias of the masses, reduced to the reference shaft. [kg*m^2]"""
    springs: tuple[SchemeSpring, ...]


def twists(scheme: TorsionScheme) -> Floats:
    """Return the coefficients of all twists, shape (springs, masses) [-]."""
    return values_of([spring.twist for spring in scheme.springs], len(scheme.names))


def stiffness_matrix(scheme: TorsionScheme) -> Floats:
    """Return the stiffness matrix [N*m/rad]: sum of a a^T/E with twists a and compliances E.

    >>> shaft = SchemeSpring("shaft", {0: 1.0, 1: -1.0}, 0.5)
    >>> stiffness_matrix(TorsionScheme(("a", "b"), (1.0, 3.0), (shaft,))).tolist()
    [[2.0, -2.0], [-2.0, 2.0]]
    """
    rows = twists(scheme)
    compliances = np.array([spring.compliance for spring in scheme.springs])
    stiffness: Floats = rows.T @ (rows / compliances[:, None])
    return stiffness


def natural_frequencies(scheme: TorsionScheme) -> tuple[float, ...]:
    """Return the undamped natural frequencies of elastic motions, ascending [rad/s].

    Masses without inertia follow the other masses.

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
    """Return a case whose links and springs are the masses and springs of a scheme.

    Parameters
    ----------
    scheme : TorsionScheme
    name : str
        Name of the case.
    ends : sequence of str
        Names of the input link and the output link; a mass is used whose name contains the link.
    gear : str
        Name of the gear.

    Returns
    -------
    Transmission
        Case with a link for each mass and a single gear without shift elements.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = (SchemeSpring("s", {0: 1.0, 1: -1.0}, 0.5), SchemeSpring("t", {1: 1, 2: -1}, 1))
    >>> scheme = TorsionScheme(("a+b", "c", "d"), (1.0, 2.0, 1.0), springs)
    >>> case = scheme_case(scheme, "", ("b", "c"), "1")
    >>> case.link_name(case.input), case.link_name(case.output), case.springs[0].compliance
    ('a+b', 'c', 0.5)
    """
    first, last = (_mass_number(scheme.names, end) for end in ends)
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


def _mass_number(names: Sequence[str], link: str) -> int | None:
    masses = (n for n, name in enumerate(names, 1) if link in (name, *name.split("+")))
    return next(masses, None)
