"""Inertia of each gear reduced to the input, and the acceleration by the torques."""

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
    """Inertia of all moving parts in a gear, reduced to the input."""

    gear: str
    inertia: float
    """Reduced inertia ``sum J (w/w_input)^2``; NaN if a speed is indeterminate. [kg*m^2]"""
    acceleration: float
    """Acceleration of the input without losses and drag; NaN without input torque. [rad/s^2]"""


def reduced_inertias(results: Results, output_torque: float = 0.0) -> Sequence[GearInertia]:
    """Return the reduced inertias of a case, including planets; empty without inertias.

    Springs count as rigid. The acceleration is the power of the external torques divided by the
    input speed and the reduced inertia. External torques are the input torque, `torques` of the
    gear, the torque that balances its battery, and the output torque. If a link has a prescribed
    speed other than 0, its torque depends on the acceleration, which is then NaN.

    Parameters
    ----------
    results : Results
    output_torque : float
        External torque on the output, positive in the direction of the input torque. The torque of
        a load is below 0. [N*m]

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], load=Load(torque=100),
    ...                     inertias={1: 0.5, 2: 24})
    >>> reduced_inertias(solve(case), output_torque=-80)
    [GearInertia(gear='1', inertia=2.0, acceleration=40.0)]
    """
    case = results.case
    drawing = drawing_of(case)
    planets = planet_inertias(drawing) if drawing else ()
    moving = [
        *((inertia, {link: 1.0}) for link, inertia in case.heavy.items() if inertia),
        *((planet.inertia, dict(planet.speed)) for planet in planets),
    ]
    if not moving:
        return []
    inertias = []
    torques = scales(case)["Nm"].tolist()
    gears = results.points.gears if results.points else case.gears
    for gear, speeds, torque in zip(gears, results.speeds.tolist(), torques, strict=True):
        inertia = math.fsum(
            inertia * math.fsum(part * speeds[link - 1] for link, part in form.items()) ** 2
            for inertia, form in moving
        )
        power = _power(case, gear, speeds, torque, output_torque)
        possible = inertia > 0 and math.isfinite(power)
        inertias.append(GearInertia(gear.name, inertia, power / inertia if possible else math.nan))
    return inertias


def _power(
    case: Transmission, gear: Gear, speeds: Sequence[float], torque: float, output_torque: float
) -> float:
    """Return the power of external torques divided by the input speed [N*m]; NaN if unknown."""
    if gear.slipping or any(isinstance(speed, SpeedOf) or speed for speed in gear.speeds.values()):
        return math.nan
    power = 0.0
    for link, part in external_torques(case, gear).items():
        power += part * torque * speeds[link - 1]
    if output_torque:
        power += output_torque * speeds[case.gear_output(gear) - 1]
    return power
