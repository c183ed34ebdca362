"""Chains of masses, and the partial systems that they are made of.

A chain is a path of masses with a shaft between neighbours; one end or both may be held by the
housing, which is a mass without end: so no formula has a case of its own for it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.errors import spoken
from vstatics.core.numerics.tolerances import TIE
from vstatics.torsion.reduction.condensation import tidied
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme


class ChainSpring(NamedTuple):
    """A shaft of a chain."""

    name: str
    compliance: float
    """[rad/(N*m)]"""
    damping: float = 0.0
    """[N*m*s/rad]"""


class Chain(NamedTuple):
    """Masses along a path, and the springs between neighbours: one less."""

    names: tuple[str, ...]
    """Of the masses; the housing has none."""
    inertias: tuple[float, ...]
    """Infinite for the housing. [kg*m^2]"""
    springs: tuple[ChainSpring, ...]


class PartialSystem(NamedTuple):
    """A mass between two springs with all others held, or a spring between two free masses."""

    masses: tuple[int, ...]
    """Their numbers along the chain, from 0: one, or two neighbours."""
    names: tuple[str, ...]
    frequency: float
    """[rad/s]"""


def partial_systems(chain: Chain) -> list[PartialSystem]:
    """Partial systems with their frequencies, (П1.3): those of one mass, then those of two.

    The last mass at a free end has one spring, and is no system of one mass.

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
            frequency = math.sqrt(sum(1 / one for one in chain.inertias[pair]) / spring.compliance)
            systems.append(PartialSystem((left, left + 1), chain.names[pair], frequency))
    return systems


def one_mass_system(chain: Chain, mass: int) -> PartialSystem:
    """A mass of a chain with all others held, at an end too."""
    stiffness = sum(1 / spring.compliance for spring in chain.springs[max(mass - 1, 0) : mass + 1])
    frequency = math.sqrt(stiffness / chain.inertias[mass])
    return PartialSystem((mass,), (chain.names[mass],), frequency)


def chain_of(scheme: TorsionScheme) -> Chain | str:
    """The scheme as a chain, or why it is none.

    The chain begins with the end that comes first in the scheme. What does the same is a chain
    too: parallel shafts are one, so are two with no inertia between them.

    Examples
    --------
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 2.0), SchemeSpring("mount", {1: 1}, 1.0)
    >>> chain_of(TorsionScheme(("a", "b"), (3.0, 4.0), springs)).inertias
    (3.0, 4.0, inf)
    >>> chain_of(TorsionScheme(("a", "b"), (3.0, 4.0), (SchemeSpring("s", {0: 1, 1: -2}, 1.0),)))
    '`s` is no shaft between two links: it acts on a and b with coefficients 1 and -2'
    """
    names, inertias, springs = tidied(scheme)
    for spring in springs:
        if not _is_shaft(spring):
            coefficients = spoken(f"{a:.4g}" for a in spring.twist.values())
            return (
                f"`{spring.name}` is no shaft between two links: it acts on "
                f"{spoken(names[mass] for mass in spring.twist)} with coefficients {coefficients}"
            )
    for mass, name in enumerate(names):
        if (count := sum(mass in spring.twist for spring in springs)) > 2:
            return f"{count} devices act on `{name}`"
    path = _path(len(names), springs)
    if isinstance(path, str):
        return path
    return Chain(
        tuple("" if mass is None else names[mass] for mass in path.masses),
        tuple(math.inf if mass is None else inertias[mass] for mass in path.masses),
        tuple(ChainSpring(one.name, one.compliance, one.damping) for one in path.springs),
    )


def scheme_of(chain: Chain) -> TorsionScheme:
    """The scheme that a chain is, with its masses in the order of the chain."""
    masses = [mass for mass, inertia in enumerate(chain.inertias) if inertia < math.inf]
    number = {mass: new for new, mass in enumerate(masses)}
    springs = []
    for left, (name, compliance, damping) in enumerate(chain.springs):
        joined = [number[mass] for mass in (left, left + 1) if mass in number]
        twist = dict(zip(joined, (1.0, -1.0), strict=False))  # the first alone at the housing
        springs.append(SchemeSpring(name, twist, compliance, damping))
    return TorsionScheme(
        tuple(chain.names[mass] for mass in masses),
        tuple(chain.inertias[mass] for mass in masses),
        tuple(springs),
    )


class _Path(NamedTuple):
    """A walk from end to end; None is the housing."""

    masses: list[int | None]
    springs: list[SchemeSpring]


def _is_shaft(spring: SchemeSpring) -> bool:
    """Whether it joins two masses, or one and the housing, by the difference of their angles."""
    first, *others = spring.twist.values()
    return not others or (len(others) == 1 and math.isclose(others[0], -first, rel_tol=TIE))


def _path(count: int, springs: tuple[SchemeSpring, ...]) -> _Path | str:
    """The walk along shafts, two at most at a mass, that meets each mass once, or why not."""
    between = [spring for spring in springs if len(spring.twist) == 2]
    ends = [mass for mass in range(count) if sum(mass in one.twist for one in between) < 2]
    if not ends:
        return "its springs make a ring"
    path = _Path([ends[0]], [])
    while further := [s for s in between if path.masses[-1] in s.twist and s not in path.springs]:
        path.springs.append(further[0])
        path.masses.append(next(mass for mass in further[0].twist if mass != path.masses[-1]))
    if len(path.masses) < count:
        return "not all of its links are joined by springs"
    for spring in springs:
        if len(spring.twist) == 1:
            place = len(path.masses) if path.masses[-1] in spring.twist else 0
            path.masses.insert(place, None)
            path.springs.insert(place, spring)
    return path
