"""What a gear is to its engine: one inertia at the input, and how fast a torque moves it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.planet_inertia import planet_inertias
from vstatics.core.model.parts import Gear, SpeedOf
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.matrix import external_torques
from vstatics.core.statics.physical import scales
from vstatics.core.statics.results import Results


class GearInertia(NamedTuple):
    """The inertia of all that turns in a gear, reduced to the input."""

    gear: str
    inertia: float
    """``sum J (w/w_input)^2``; NaN where a speed is not determined. [kg*m^2]"""
    acceleration: float
    """Of the input, without losses and drag; NaN without a load. [rad/s^2]"""


def reduced_inertias(results: Results, output_torque: float = 0.0) -> Sequence[GearInertia]:
    """The reduced inertias of one case, planets included; none if nothing has an inertia.

    Springs do not wind up, as at mean speeds. Outside torques are that of the load at the input,
    those that a gear gives or its balance finds, and that on the output; the acceleration is
    their power by the speed of the input and the reduced inertia. Where a link other than the
    housing is driven at a given speed, its torque follows from the acceleration, which is then
    not told.

    Parameters
    ----------
    results : Results
    output_torque : float
        Outside torque on the output, positive like the input's: below 0 for a load that
        resists. [N*m]

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], load=Load(torque=100),
    ...                     inertias={1: 0.5, 2: 24})
    >>> reduced_inertias(solve(case), output_torque=-80)
    [GearInertia(gear='1', inertia=2.0, acceleration=40.0)]
    """
    case = results.case
    moving = _moving(case)
    if not moving:
        return []
    found = []
    torques = scales(case)["Nm"].tolist()
    gears = results.points.gears if results.points else case.gears
    for gear, speeds, torque in zip(gears, results.speeds.tolist(), torques, strict=True):
        inertia = math.fsum(
            inertia * math.fsum(part * speeds[link - 1] for link, part in form.items()) ** 2
            for inertia, form in moving
        )
        power = _power(case, gear, speeds, torque, output_torque)
        possible = inertia > 0 and math.isfinite(power)
        found.append(GearInertia(gear.name, inertia, power / inertia if possible else math.nan))
    return found


def _moving(case: Transmission) -> list[tuple[float, dict[int, float]]]:
    """Inertias, each with its speed by those of links."""
    drawing = drawing_of(case)
    planets = planet_inertias(drawing) if drawing else ()
    return [
        *((inertia, {link: 1.0}) for link, inertia in case.heavy.items() if inertia),
        *((one.inertia, dict(one.speed)) for one in planets),
    ]


def _power(
    case: Transmission, gear: Gear, speeds: Sequence[float], torque: float, output_torque: float
) -> float:
    """Of all outside torques, by the speed of the input; NaN where one is unknown; in N*m."""
    if any(isinstance(speed, SpeedOf) or speed for speed in gear.speeds.values()):
        return math.nan
    power = 0.0
    for link, part in external_torques(case, gear).items():
        power += part * torque * speeds[link - 1]
    if output_torque:
        power += output_torque * speeds[case.gear_output(gear) - 1]
    return power
