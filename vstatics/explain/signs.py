"""The sign of each mechanism's power flow in a gear, and why it is that one."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.model.transmission import HOUSING
from vstatics.statics import drag
from vstatics.statics.losses import both_ways, with_loss
from vstatics.statics.results import Results
from vstatics.statics.speeds import is_tie
from vstatics.statics.torques import solve_torques


class PowerSign(NamedTuple):
    """A mechanism with losses: ``ratio x efficiency**sign`` stands in place of its ratio."""

    mechanism: str
    torque: float
    """On the first link, without losses, but with drag. [-]"""
    motion: float
    """Speed of the first link against the third. [-]"""
    power: float
    """Their product: what enters by the first link, seen from the third. [-]"""
    sign: float
    """+1, -1 or 0; NaN where it is open."""
    ratio: float
    """[-]"""
    efficiency: float
    """That of this direction of power. [-]"""
    lossy_ratio: float
    """[-]"""
    why: str


def signs_of(results: Results, number: int) -> list[PowerSign]:
    """The signs of a gear, by mechanism.

    Source: closed form of the published test, docs/method.md.

    Parameters
    ----------
    number : int
        Index of the gear.
    """
    case = results.case
    speeds = [0.0, *results.speeds[number].tolist()]
    torques = _torques(results, number)
    both = both_ways(case, [mechanism.efficiency for mechanism in case.mechanisms])
    found = []
    for place, mechanism in enumerate(case.mechanisms):
        first, third = speeds[mechanism.first], speeds[mechanism.third]
        motion = 0.0 if is_tie(abs(first - third), abs(first), abs(third)) else first - third
        sign = float(results.power_sign[number, place])
        torque, efficiency = torques[place], both[place]
        power = torque * motion
        found.append(
            PowerSign(
                mechanism=mechanism.name,
                torque=torque,
                motion=motion,
                power=power,
                sign=sign,
                ratio=mechanism.ratio,
                efficiency=float(efficiency.back if sign < 0 else efficiency.forward),
                lossy_ratio=float(with_loss(mechanism.ratio, efficiency, sign)),
                why=_why(results, number, place, motion, power),
            )
        )
    return found


def _torques(results: Results, number: int) -> list[float]:
    """On the first links of the mechanisms: those of which the power decides the signs."""
    case = results.with_freewheels_engaged
    elements = len(case.shift_elements)
    dragging = drag.of_gear(results, number)
    if dragging is drag.NO_DRAG or not results.calculable[number]:
        first = results.torques[number].tolist()
    else:
        ratios = [mechanism.ratio for mechanism in case.mechanisms]
        first = solve_torques(case, case.gears[number], ratios, dragging).first
    return list(first[elements:-1])


def _why(results: Results, number: int, place: int, motion: float, power: float) -> str:
    """The reason for a sign, in words."""
    case = results.case
    sign = float(results.power_sign[number, place])
    mechanism = case.mechanisms[place]
    if mechanism.efficiency == 1 and mechanism.back_efficiency in (None, 1):
        return "no losses"
    if math.isnan(sign):
        return "not determined"
    if results.idle[number, place]:
        still = "the first link stands" if mechanism.third == HOUSING else "it turns as one piece"
        why = f"idle: {still if motion == 0 else 'no torque'}"
        if sign == 0:
            return why
        # of the convention: +1 without torque, else the sign of the ratio; see docs/method.md
        chosen = (1.0, math.copysign(1, mechanism.ratio))[: 2 if motion == 0 else 1]
        by_convention = case.idle == "published" and sign in chosen
        by = "convention `published`" if by_convention else "flow with losses"
        return f"{why}; x by the {by}"
    ideal = power * (-1 if case.coast else 1)
    way = "coasting, power" if case.coast else "power"
    if math.isnan(ideal):
        return f"{way} {'enters' if sign > 0 else 'leaves'} by the first link"
    why = f"{way} {'enters' if ideal > 0 else 'leaves'} by the first link"
    turned = results.turned[number, place] or ideal * sign < 0
    return f"{why}, but losses turn it round" if turned else why
