"""Chains of masses, and their partial systems.

A chain is a path of masses with a shaft between neighbours. The housing can hold one or both ends;
it is a mass of infinite inertia, so that the formulas need no special case. A partial system
consists of a mass between two shafts with all other masses held, or of two masses and their shaft.
Equation numbers are from Tsitovich, Algin, Vehicle dynamics, 1981, appendix 1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.errors import spoken
from vstatics.core.numerics.tolerances import TIE
from vstatics.torsion.reduction.condensation import tidied
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme


class ChainSpring(NamedTuple):
    """Shaft between two neighbouring masses of a chain."""

    name: str
    compliance: float
    """Compliance. [rad/(N*m)]"""
    damping: float = 0.0
    """Viscous damping. [N*m*s/rad]"""


class Chain(NamedTuple):
    """Masses along a path, with a spring between neighbouring masses."""

    names: tuple[str, ...]
    """Names of the masses; the name of the housing is empty."""
    inertias: tuple[float, ...]
    """Inertias of the masses; infinite for the housing. [kg*m^2]"""
    springs: tuple[ChainSpring, ...]


class PartialSystem(NamedTuple):
    """Mass between springs with all other masses held, or spring between two free masses."""

    masses: tuple[int, ...]
    """Indices of the mass, or of both masses, along the chain."""
    names: tuple[str, ...]
    frequency: float
    """Natural frequency of the partial system. [rad/s]"""


def partial_systems(chain: Chain) -> list[PartialSystem]:
    """Return the partial systems of one mass, then of two masses, with frequencies by (П1.3).

    A mass at a free end has a single spring, so it is not a partial system.

    Parameters
    ----------
    chain : Chain

    Returns
    -------
    list of PartialSystem

    Examples
    --------
    >>> three = Chain(("a", "b", "c"), (4, 1, 4), (ChainSpring("s", 1), ChainSpring("t", 0.25)))
    >>> [(system.names, round(system.frequency, 3)) for system in partial_systems(three)]
    [(('b',), 2.236), (('a', 'b'), 1.118), (('b', 'c'), 2.236)]
    """
    systems = [one_mass_system(chain, mass) for mass in range(1, len(chain.names) - 1)]
    for left, spring in enumerate(chain.springs):
        pair = slice(left, left + 2)
        if math.inf not in chain.inertias[pair]:
            frequency = math.sqrt(sum(1 / J for J in chain.inertias[pair]) / spring.compliance)
            systems.append(PartialSystem((left, left + 1), chain.names[pair], frequency))
    return systems


def one_mass_system(chain: Chain, mass: int) -> PartialSystem:
    """Return the partial system of a mass, which can be at an end of the chain."""
    stiffness = sum(1 / spring.compliance for spring in chain.springs[max(mass - 1, 0) : mass + 1])
    frequency = math.sqrt(stiffness / chain.inertias[mass])
    return PartialSystem((mass,), (chain.names[mass],), frequency)


def chain_of(scheme: TorsionScheme) -> Chain | str:
    """Return a scheme as a chain, or the reason why it is not a chain.

    The chain begins with the end that is first in the scheme. Parallel shafts count as one shaft.
    So do two shafts in series without an inertia between them.

    Examples
    --------
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 2.0), SchemeSpring("mount", {1: 1}, 1.0)
    >>> chain_of(TorsionScheme(("a", "b"), (3.0, 4.0), springs)).inertias
    (3.0, 4.0, inf)
    >>> chain_of(TorsionScheme(("a", "b"), (3.0, 4.0), (SchemeSpring("s", {0: 1, 1: -2}, 1.0),)))
    '`s` is not a shaft between two links: it acts on a and b with coefficients 1 and -2'
    """
    names, inertias, springs = tidied(scheme)
    for spring in springs:
        if not _is_shaft(spring):
            coefficients = spoken(f"{a:.4g}" for a in spring.twist.values())
            return (
                f"`{spring.name}` is not a shaft between two links: it acts on "
                f"{spoken(names[mass] for mass in spring.twist)} with coefficients {coefficients}"
            )
    for mass, name in enumerate(names):
        if (count := sum(mass in spring.twist for spring in springs)) > 2:
            return f"{count} components act on `{name}`"
    path = _path(len(names), springs)
    if isinstance(path, str):
        return path
    return Chain(
        tuple("" if mass is None else names[mass] for mass in path.masses),
        tuple(math.inf if mass is None else inertias[mass] for mass in path.masses),
        tuple(ChainSpring(s.name, s.compliance, s.damping) for s in path.springs),
    )


def scheme_of(chain: Chain) -> TorsionScheme:
    """Return a chain as a scheme without the housing, with masses in the order of the chain."""
    masses = [mass for mass, inertia in enumerate(chain.inertias) if inertia < math.inf]
    number = {mass: new for new, mass in enumerate(masses)}
    springs = []
    for left, (name, compliance, damping) in enumerate(chain.springs):
        joined = [number[mass] for mass in (left, left + 1) if mass in number]
        twist = dict(zip(joined, (1.0, -1.0), strict=False))  # the housing has no angle
        springs.append(SchemeSpring(name, twist, compliance, damping))
    return TorsionScheme(
        tuple(chain.names[mass] for mass in masses),
        tuple(chain.inertias[mass] for mass in masses),
        tuple(springs),
    )


class _Path(NamedTuple):
    """Masses and springs of a chain from end to end."""

    masses: list[int | None]
    """Indices of the masses; None for the housing."""
    springs: list[SchemeSpring]


def _is_shaft(spring: SchemeSpring) -> bool:
    first, *others = spring.twist.values()
    return not others or (len(others) == 1 and math.isclose(others[0], -first, rel_tol=TIE))


def _path(count: int, springs: tuple[SchemeSpring, ...]) -> _Path | str:
    """Return the path through all masses, or the reason why there is no path."""
    between = [spring for spring in springs if len(spring.twist) == 2]
    ends = [mass for mass in range(count) if sum(mass in s.twist for s in between) < 2]
    if not ends:
        return "its springs make a ring"
    path = _Path([ends[0]], [])
    while onward := [s for s in between if path.masses[-1] in s.twist and s not in path.springs]:
        path.springs.append(onward[0])
        path.masses.append(next(mass for mass in onward[0].twist if mass != path.masses[-1]))
    if len(path.masses) < count:
        return "not all of its links are joined by springs"
    for spring in springs:
        if len(spring.twist) == 1:
            place = len(path.masses) if path.masses[-1] in spring.twist else 0
            path.masses.insert(place, None)
            path.springs.insert(place, spring)
    return path
