"""The friction pack of a shift element: its keys in a case, and what it must fulfil."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.errors import Path, Problem
from vstatics.model.part_checks import expect
from vstatics.model.parts import Friction
from vstatics.model.shape import COUNT, NUMBER, ByKey, ByPoints, KeyShape, Leaf, RowOf

_ABOVE_0 = {"exclusiveMinimum": 0}

FRICTION = ByKey(
    "Friction",
    "The friction pack of a shift element, whose controls are then pressures.",
    (
        KeyShape(
            "radius",
            Leaf("length"),
            "Mean radius of friction, in m.",
            required=True,
            limits=_ABOVE_0,
            examples=(0.1,),
        ),
        KeyShape(
            "area",
            Leaf("area"),
            "Area on which the pressure acts, in m^2.",
            required=True,
            limits=_ABOVE_0,
            examples=("60 cm^2",),
        ),
        KeyShape("surfaces", COUNT, "Pairs of friction surfaces.", required=True, examples=(8,)),
        KeyShape(
            "coefficient",
            ByPoints(RowOf((Leaf("si_speed"), NUMBER), "slip, coefficient")),
            "Coefficient of friction: a number, or points [slip in rad/s, coefficient] in "
            "ascending order, straight between.",
            required=True,
            examples=(0.12, [[0, 0.12], [10, 0.1]]),
        ),
    ),
    Friction,
)


def of_friction(friction: Friction, path: Path) -> Iterator[Problem]:
    """Sizes above 0, whole surfaces, slips in ascending order, coefficients above 0.

    Examples
    --------
    >>> [one] = of_friction(Friction(0.1, 0.006, 8, ((3, 0.12), (1, 0.1))), ())
    >>> print(one.message)
    read 1, expected a slip of 3 rad/s or more: slips are in ascending order
    """
    for name, one in (("radius", "a radius"), ("area", "an area")):
        size = getattr(friction, name)
        yield from expect(size, f"{one} above 0", (*path, name), right=0 < size < math.inf)
    surfaces, what = friction.surfaces, "a whole number of surfaces from 1"
    right = surfaces >= 1 and surfaces == int(surfaces)
    yield from expect(surfaces, what, (*path, "surfaces"), right=right)
    here = (*path, "coefficient")
    if not friction.coefficient:
        yield Problem("there is no point, expected one at least", here)
    least = 0.0
    for number, (slip, coefficient) in enumerate(friction.coefficient, 1):
        if not 0 <= slip < math.inf:
            yield Problem(f"read {slip:g}, expected a slip of 0 or more", (*here, number, 1))
        elif slip < least:
            message = f"read {slip:g}, expected a slip of {least:g} rad/s or more"
            yield Problem(f"{message}: slips are in ascending order", (*here, number, 1))
        right = 0 < coefficient < math.inf
        yield from expect(coefficient, "a coefficient above 0", (*here, number, 2), right=right)
        least = max(least, slip)
