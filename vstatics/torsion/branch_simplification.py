"""Schemes of any shape with one mass less, by static condensation.

Tsitovich and Algin, Vehicle dynamics (1981), appendix П1.2: the mass of the system of one mass
with the highest partial frequency is taken out. K - Kj Kj^T / Kjj is left of the stiffness
matrix, and a part of its inertia goes to the masses that it is joined with.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

from vstatics.torsion.chain import PartialSystem
from vstatics.torsion.condensation import tidied, without_massless
from vstatics.torsion.scheme import TorsionScheme, stiffness_matrix

BranchRule = Literal["r", "b", "u"]
"""How the inertia of a mass is shared out."""

_SHARES: dict[BranchRule, Callable[[float], float]] = {
    "r": lambda part: part,  # (П1.7), which the book recommends
    "b": lambda part: part**2,  # (П1.6), of Banakh
    "u": lambda _: 0.0,
}
"""What a mass gets of the inertia, by its part |Kij|/Kjj of the stiffness."""


def one_mass_systems(scheme: TorsionScheme) -> list[PartialSystem]:
    """Each mass with all others held: sqrt(Kjj/Jj), K and J without the massless ones.

    Parameters
    ----------
    scheme : TorsionScheme
        Masses without inertia are where springs meet.

    Returns
    -------
    list of PartialSystem
        In the order of the scheme.
    """
    heavy = without_massless(scheme)
    stiffness = stiffness_matrix(heavy).diagonal().tolist()
    number = {name: mass for mass, name in enumerate(scheme.names)}
    return [
        PartialSystem((number[name],), (name,), math.sqrt(own / inertia))
        for name, inertia, own in zip(heavy.names, heavy.inertias, stiffness, strict=True)
    ]


def acted_on_by_several(scheme: TorsionScheme, mass: int) -> bool:
    """Whether more than one device acts on a mass: it is no end of the scheme."""
    return sum(mass in spring.twist for spring in scheme.springs) > 1


def without_branch_mass(scheme: TorsionScheme, mass: int, rule: BranchRule) -> TorsionScheme:
    """The scheme without the inertia of one mass, a part of which others get.

    The mass stays as a place without inertia where three springs or more meet: so the scheme
    keeps its shape, and it is still seen which device acts on which mass.

    Parameters
    ----------
    scheme : TorsionScheme
    mass : int
        Its number, from 0.
    rule : {"r", "b", "u"}

    Examples
    --------
    >>> from vstatics.torsion.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 1/3)
    >>> three = TorsionScheme(("a", "b", "c"), (4.0, 2.0, 4.0), springs)
    >>> [without_branch_mass(three, 1, rule).inertias for rule in ("r", "b", "u")]
    [(4.5, 5.5), (4.125, 5.125), (4.0, 4.0)]
    """
    heavy = without_massless(scheme)
    own = heavy.names.index(scheme.names[mass])
    column = stiffness_matrix(heavy)[own].tolist()
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for name, stiffness in zip(heavy.names, column, strict=True):
        if name != scheme.names[mass]:
            inertias[name] += scheme.inertias[mass] * _SHARES[rule](abs(stiffness) / column[own])
    inertias[scheme.names[mass]] = 0.0
    return tidied(scheme._replace(inertias=tuple(inertias.values())))
