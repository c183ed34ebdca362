"""Stiffnesses of nonlinear springs (given by points) in a gear, at their torques under load."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.solve import solve
from vstatics.torsion.system.working_points import mean_gear


class SpringSlope(NamedTuple):
    """Nonlinear spring (given by points), linearised at its torque in a gear."""

    number: int
    """Number of the spring, from 1."""
    name: str
    torque: float
    """Mean torque of the spring under load, with losses. [N*m]"""
    slope: float
    """Stiffness at `torque`; 0 within the free play, where the spring is disengaged. [N*m/rad]"""

    def __str__(self) -> str:
        """Return the slope and the torque as printed in messages."""
        slope = f"{self.slope:.6g} N*m/rad" if self.slope else "in play, so it is open,"
        return f"{slope} at {self.torque:.6g} N*m"


def spring_slopes(case: Transmission, gear: Gear) -> Iterator[SpringSlope]:
    """Yield the stiffnesses of nonlinear springs under load, or at 0 N*m without a load.

    If the gear gives the speed ratio of a converter, the torque of its pump replaces the load.

    Raises
    ------
    CaseError
        If the torque of a spring is indeterminate.

    Examples
    --------
    >>> from vstatics import Load, Spring
    >>> spring = Spring({1: 1, 2: -1}, points=[(0, 0), (0.1, 0), (0.2, 30)], name="damper")
    >>> case = Transmission(2, [], [], [], inertias={1: 1, 2: 1}, springs=[spring])
    >>> loaded = case.replace(load=Load(torque=20))
    >>> for variant in (case, loaded):
    ...     print(*spring_slopes(variant, variant.gears[0]))
    in play, so it is open, at 0 N*m
    300 N*m/rad at 20 N*m
    """
    with_points = [(n, spring) for n, spring in enumerate(case.springs, 1) if spring.points]
    if not with_points:
        return
    torques = _torques_of_springs(case, gear)
    for number, spring in with_points:
        torque = torques[number - 1]
        if math.isnan(torque):
            raise CaseError(
                "E521",
                f"the torque of {spring.name} in gear {gear.name} is indeterminate, so its "
                "stiffness is unknown: leave out the load, or give a `stiffness`",
                ("springs", number, "points"),
            )
        yield SpringSlope(number, spring.name, torque, spring.curve.slope_at(torque))


def _torques_of_springs(case: Transmission, gear: Gear) -> list[float]:
    case, gear, *_ = mean_gear(case, gear)
    if not case.gear_load(gear).torque:
        return [0.0] * len(case.springs)
    results = solve(case.replace(gears=[gear]))
    # without a torque at the output, springs carry no torque
    *torques, output = results.lossy_torques_Nm[0, -len(case.springs) - 1 :].tolist()
    return [0.0] * len(torques) if math.isnan(output) else torques
