"""Masses without inertia taken out of a scheme: springs on what they leave.

A mass without inertia stands where the torques on it are in balance. Two springs that meet there
become one, by the closed form of figure П1.6 of Tsitovich and Algin, Vehicle dynamics (1981): so
n springs become n - 1, one after another. All terms are positive, so nothing is lost where one
spring is far stiffer than another, and K = sum of a a^T/E is that of static condensation.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from vstatics.core.numerics.tolerances import TIE
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme


def tidied(scheme: TorsionScheme) -> TorsionScheme:
    """The same scheme with as few devices as do the same.

    Parallel springs are one, so are two in a row: a mass without inertia stays only where three
    springs or more meet. The first coefficient of every twist is 1.

    Examples
    --------
    >>> springs = [SchemeSpring("s", {0: 1, 1: -1}, 2.0), SchemeSpring("t", {1: 2, 2: -2}, 1.0)]
    >>> short = tidied(TorsionScheme(("a", "b", "c"), (1.0, 0.0, 1.0), tuple(springs)))
    >>> short.names, short.springs
    (('a', 'c'), (SchemeSpring(name='s+t', twist={0: 1.0, 1: -1.0}, compliance=2.25, damping=0.0),))
    """
    return _condensed(scheme, most=2)


def without_massless(scheme: TorsionScheme) -> TorsionScheme:
    """The scheme of the masses with inertia alone.

    Where three springs or more met, those in their place act on many masses each, and what
    couples their damping is left out.
    """
    return _condensed(scheme, most=len(scheme.springs))


def _condensed(scheme: TorsionScheme, most: int) -> TorsionScheme:
    """Take out masses without inertia on which this many springs act at most."""
    light = [mass for mass, inertia in enumerate(scheme.inertias) if inertia == 0]
    springs = _parallel_as_one(scheme.springs)
    while True:
        few = next((one for one in light if sum(one in s.twist for s in springs) <= most), None)
        if few is None:
            break
        light.remove(few)
        springs = _parallel_as_one(_without(springs, few))
    stay = [mass for mass, inertia in enumerate(scheme.inertias) if inertia > 0 or mass in light]
    number = {mass: new for new, mass in enumerate(stay)}
    return TorsionScheme(
        tuple(scheme.names[mass] for mass in stay),
        tuple(scheme.inertias[mass] for mass in stay),
        tuple(
            spring._replace(twist={number[mass]: a for mass, a in spring.twist.items()})
            for spring in springs
        ),
    )


def _without(springs: Iterable[SchemeSpring], mass: int) -> list[SchemeSpring]:
    """What is left of springs where a mass gives way until its torques are in balance."""
    left: list[SchemeSpring] = []
    meeting: SchemeSpring | None = None
    for spring in springs:
        if mass not in spring.twist:
            left.append(spring)
        elif meeting is None:
            meeting = spring
        else:
            left.append(_in_series(meeting, spring, mass))
            meeting = _side_by_side(meeting, spring, mass)
    return left  # the last of `meeting` is followed without torque


def _in_series(one: SchemeSpring, two: SchemeSpring, mass: int) -> SchemeSpring:
    """Two springs that meet at a mass carry one torque: figure П1.6, damping by (П1.14).

    With twists a1 x + b1 and a2 x + b2, x the angle of the mass, a2 b1 - a1 b2 is free of x.
    """
    a1, a2 = one.twist[mass], two.twist[mass]
    first, second = a2**2 * one.compliance, a1**2 * two.compliance
    compliance = first + second
    damping = one.damping * (first / compliance / a2) ** 2
    damping += two.damping * (second / compliance / a1) ** 2
    twist = _sum(one.twist, a2, two.twist, -a1)
    twist.pop(mass, None)
    return SchemeSpring(f"{one.name}+{two.name}", twist, compliance, damping)


def _side_by_side(one: SchemeSpring, two: SchemeSpring, mass: int) -> SchemeSpring:
    """What two springs that meet at a mass are where the one in series has no twist.

    Its twist is x plus the mean of b1/a1 and b2/a2, weighted by stiffness: so the energy of both
    is that of this spring and of the one in series.
    """
    a1, a2 = one.twist[mass], two.twist[mass]
    stiffness = a1**2 / one.compliance + a2**2 / two.compliance
    weights = a1 / one.compliance / stiffness, a2 / two.compliance / stiffness
    twist = _sum(one.twist, weights[0], two.twist, weights[1])
    twist[mass] = 1.0
    damping = one.damping * a1**2 + two.damping * a2**2
    return SchemeSpring(f"{one.name}+{two.name}", twist, 1 / stiffness, damping)


def _sum(
    one: Mapping[int, float], factor: float, two: Mapping[int, float], other: float
) -> dict[int, float]:
    """A sum of two twists, without coefficients that are nothing but rounding."""
    total = {}
    for mass in one.keys() | two.keys():
        parts = factor * one.get(mass, 0), other * two.get(mass, 0)
        if abs(sum(parts)) > TIE * max(map(abs, parts)):
            total[mass] = sum(parts)
    return total


def _parallel_as_one(springs: Iterable[SchemeSpring]) -> list[SchemeSpring]:
    """Springs whose twists differ; one with no twist at all is none."""
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
    """The same spring with 1 as the first coefficient of its twist, in the order of the masses."""
    twist = {mass: a for mass, a in sorted(spring.twist.items()) if a}
    first = next(iter(twist.values()), 1.0)
    twist = {mass: a / first for mass, a in twist.items()}
    return SchemeSpring(spring.name, twist, spring.compliance / first**2, spring.damping * first**2)
