"""The slopes that springs with points have in a gear, at what they carry at mean speeds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.solve import solve
from vstatics.torsion.system.working_points import mean_gear


class SpringSlope(NamedTuple):
    """What a spring with points is in a gear."""

    number: int
    """Of the spring, from 1."""
    name: str
    torque: float
    """At mean speeds, with losses. [N*m]"""
    slope: float
    """There; 0 in play: it is open. [N*m/rad]"""

    def __str__(self) -> str:
        """As a message tells it."""
        slope = f"{self.slope:.6g} N*m/rad" if self.slope else "in play, so it is open,"
        return f"{slope} at {self.torque:.6g} N*m"


def spring_slopes(case: Transmission, gear: Gear) -> Iterator[SpringSlope]:
    """The slopes of the springs with points, under the torque of the load; without one at 0 N*m.

    Where a gear gives the speed ratio of a converter, they are under the torque of its pump.

    Raises
    ------
    CaseError
        If the torque of one is not determined.

    Examples
    --------
    >>> from vstatics import Load, Spring
    >>> spring = Spring({1: 1, 2: -1}, points=[(0, 0), (0.1, 0), (0.2, 30)], name="damper")
    >>> case = Transmission(2, [], [], [], inertias={1: 1, 2: 1}, springs=[spring])
    >>> loaded = case.replace(load=Load(torque=20))
    >>> for one in (case, loaded):
    ...     print(*spring_slopes(one, one.gears[0]))
    in play, so it is open, at 0 N*m
    300 N*m/rad at 20 N*m
    """
    bent = [(number, one) for number, one in enumerate(case.springs, 1) if one.points]
    if not bent:
        return
    carried = _carried(case, gear)
    for number, spring in bent:
        torque = carried[number - 1]
        if math.isnan(torque):
            message = (
                f"what {spring.name} carries in gear {gear.name} is not determined, so its slope "
                "is not known: leave out the load, or give a `stiffness`"
            )
            raise CaseError("E521", message, ("springs", number, "points"))
        yield SpringSlope(number, spring.name, torque, spring.curve.slope_at(torque))


def _carried(case: Transmission, gear: Gear) -> list[float]:
    """The torques of springs [N*m]; none where no load says so, or nothing comes through."""
    case, gear, *_ = mean_gear(case, gear)
    if not case.gear_load(gear).torque:
        return [0.0] * len(case.springs)
    results = solve(case.replace(gears=[gear]))
    *torques, output = results.lossy_torques_Nm[0, -len(case.springs) - 1 :].tolist()
    return [0.0] * len(torques) if math.isnan(output) else torques
