"""Condensation of a scheme: removal of masses without inertia.

The torques on a mass without inertia are in balance. Therefore n springs that meet at such a mass
are replaced, one after another, by n - 1 springs (Tsitovich, Algin, Vehicle dynamics, 1981, figure
П1.6). The stiffness matrix of the result is the sum of ``a a^T/E`` over all springs, with the
coefficients a of the twist and the compliance E. It equals the matrix of static condensation. No
matrices are subtracted, so no digits cancel if a spring is far stiffer than another.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from vstatics.core.numerics.tolerances import TIE
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme


def tidied(scheme: TorsionScheme, most: int = 2) -> TorsionScheme:
    """Return an equivalent scheme with the smallest number of springs.

    Springs in parallel or in series are combined, so that masses without inertia remain only where
    more than `most` springs meet. The first coefficient of every twist is 1.

    Examples
    --------
    >>> springs = [SchemeSpring("s", {0: 1, 1: -1}, 2.0), SchemeSpring("t", {1: 2, 2: -2}, 1.0)]
    >>> short = tidied(TorsionScheme(("a", "b", "c"), (1.0, 0.0, 1.0), tuple(springs)))
    >>> short.names, short.springs
    (('a', 'c'), (SchemeSpring(name='s+t', twist={0: 1.0, 1: -1.0}, compliance=2.25, damping=0.0),))
    """
    light = [mass for mass, inertia in enumerate(scheme.inertias) if inertia == 0]
    springs = _parallel_combined(scheme.springs)
    while True:
        mass = next((m for m in light if sum(m in s.twist for s in springs) <= most), None)
        if mass is None:
            break
        light.remove(mass)
        springs = _parallel_combined(_without(springs, mass))
    masses = [mass for mass, inertia in enumerate(scheme.inertias) if inertia > 0 or mass in light]
    number = {mass: new for new, mass in enumerate(masses)}
    return TorsionScheme(
        tuple(scheme.names[mass] for mass in masses),
        tuple(scheme.inertias[mass] for mass in masses),
        tuple(
            spring._replace(twist={number[mass]: a for mass, a in spring.twist.items()})
            for spring in springs
        ),
    )


def without_massless(scheme: TorsionScheme) -> TorsionScheme:
    """Return an equivalent scheme in which all masses have inertia.

    A spring of the result can act on many masses. The dampings of such springs would be coupled;
    this coupling is neglected.
    """
    return tidied(scheme, len(scheme.springs))


def _without(springs: Iterable[SchemeSpring], mass: int) -> list[SchemeSpring]:
    """Return equivalent springs, none of which acts on a mass without inertia."""
    remaining: list[SchemeSpring] = []
    meeting = None
    for spring in springs:
        if mass not in spring.twist:
            remaining.append(spring)
        elif meeting is None:
            meeting = spring
        else:
            remaining.append(_in_series(meeting, spring, mass))
            meeting = _side_by_side(meeting, spring, mass)
    # `meeting` is left out: a single spring at a mass without inertia carries no torque.
    return remaining


def _in_series(spring: SchemeSpring, other: SchemeSpring, mass: int) -> SchemeSpring:
    """Replace two springs in series at a mass by one: figure П1.6, damping by (П1.14).

    With the twists a1 x + b1 and a2 x + b2, where x is the angle of the mass, the twist
    a2 b1 - a1 b2 does not depend on x.
    """
    a1, a2 = spring.twist[mass], other.twist[mass]
    first, second = a2**2 * spring.compliance, a1**2 * other.compliance
    compliance = first + second
    damping = spring.damping * (first / compliance / a2) ** 2
    damping += other.damping * (second / compliance / a1) ** 2
    twist = _weighted_sum(spring.twist, a2, other.twist, -a1)
    twist.pop(mass, None)
    return SchemeSpring(f"{spring.name}+{other.name}", twist, compliance, damping)


def _side_by_side(spring: SchemeSpring, other: SchemeSpring, mass: int) -> SchemeSpring:
    """Return the spring that, together with the series connection, replaces two springs at a mass.

    With the symbols of `_in_series`, the twist is x plus the mean of b1/a1 and b2/a2, weighted by
    the stiffnesses a1^2/E1 and a2^2/E2. The energy of this spring and of the series connection is
    then equal to the energy of both springs.
    """
    a1, a2 = spring.twist[mass], other.twist[mass]
    stiffness = a1**2 / spring.compliance + a2**2 / other.compliance
    weights = a1 / spring.compliance / stiffness, a2 / other.compliance / stiffness
    twist = _weighted_sum(spring.twist, weights[0], other.twist, weights[1])
    twist[mass] = 1.0
    damping = spring.damping * a1**2 + other.damping * a2**2
    return SchemeSpring(f"{spring.name}+{other.name}", twist, 1 / stiffness, damping)


def _weighted_sum(
    twist: Mapping[int, float], factor: float, other: Mapping[int, float], other_factor: float
) -> dict[int, float]:
    total = {}
    for mass in twist.keys() | other.keys():
        parts = factor * twist.get(mass, 0), other_factor * other.get(mass, 0)
        if abs(sum(parts)) > TIE * max(map(abs, parts)):  # more than a rounding error
            total[mass] = sum(parts)
    return total


def _parallel_combined(springs: Iterable[SchemeSpring]) -> list[SchemeSpring]:
    """Combine springs with equal twist, and drop springs whose twist is always 0."""
    different: list[SchemeSpring] = []
    for spring in map(_normal, springs):
        for place, other in enumerate(different):
            twist = other.twist
            if spring.twist.keys() == twist.keys() and all(
                math.isclose(a, twist[mass], rel_tol=TIE) for mass, a in spring.twist.items()
            ):
                stiffness = 1 / spring.compliance + 1 / other.compliance
                damping = spring.damping + other.damping
                name = f"{other.name}+{spring.name}"
                different[place] = SchemeSpring(name, twist, 1 / stiffness, damping)
                break
        else:
            if spring.twist:
                different.append(spring)
    return different


def _normal(spring: SchemeSpring) -> SchemeSpring:
    """Return an equivalent spring with coefficients sorted by mass, the first of which is 1.

    If the sum of the coefficients is a rounding error, it becomes 0, so that all masses can rotate
    together without a twist.
    """
    twist = {mass: a for mass, a in sorted(spring.twist.items()) if a}
    first = next(iter(twist.values()), 1.0)
    twist = {mass: a / first for mass, a in twist.items()}
    if twist and abs(total := math.fsum(twist.values())) < TIE:
        twist[max(twist)] -= total
    return SchemeSpring(spring.name, twist, spring.compliance / first**2, spring.damping * first**2)
