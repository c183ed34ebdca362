"""Sign of each mechanism's power flow in a gear, and the reason for it."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

from vstatics.core.numerics.traced import is_nan, plain
from vstatics.core.statics.efficiency import lossy_ratios
from vstatics.core.statics.losses import torques_for_signs
from vstatics.core.statics.roles import IDLE, ONE_PIECE, mechanism_roles
from vstatics.core.statics.speeds import is_tie
from vstatics.core.statics.state import GearState
from vstatics.core.tables.answer import Known
from vstatics.core.texts import tr


class PowerSign(NamedTuple):
    """Sign of the power of a mechanism, whose ratio with losses is ``ratio efficiency**sign``."""

    mechanism: str
    torque: float
    """Torque on the first link, with drag but without losses in meshes. [-]"""
    motion: float
    """Speed of the first link minus speed of the third link. [-]"""
    power: float
    """Power that enters by the first link, seen from the third: torque times motion. [-]

    When coasting, the input power is negative, so entering power is below 0.
    """
    sign: float
    """Sign of the power: +1, -1 or 0; NaN if indeterminate."""
    ratio: float
    """Basic ratio. [-]"""
    efficiency: float
    """Efficiency for the direction of power. [-]"""
    lossy_ratio: float
    """Ratio with losses. [-]"""
    why: str

    @property
    def told(self) -> str:
        """Reason for the sign in the language of the output."""
        return "".join(tr(part) for part in re.split(r"([,;] )", self.why))


def signs_of(state: GearState) -> list[PowerSign]:
    """Return the signs of a gear by equation (5) of docs/method.md."""
    case = state.case
    speeds = [0.0, *map(plain, state.speeds)]
    torques = map(plain, state.ideal.torques_with_drag.on_first_link[case.among_devices])
    signs = []
    for place, (mechanism, torque) in enumerate(zip(case.mechanisms, torques, strict=True)):
        first, third = speeds[mechanism.first], speeds[mechanism.third]
        motion = 0.0 if is_tie(abs(first - third), abs(first), abs(third)) else first - third
        sign, efficiency = state.signs[place], state.ideal.variant.efficiencies[place]
        power = torque * motion
        signs.append(
            PowerSign(
                mechanism=mechanism.name,
                torque=torque,
                motion=motion,
                power=power,
                sign=plain(sign),
                ratio=mechanism.ratio,
                efficiency=plain(efficiency.back if sign < 0 else efficiency.forward),
                lossy_ratio=plain(state.lossy_ratios[place]),
                why=_why(state, place, motion, power),
            )
        )
    return signs


MOST_TRIED = 3
"""Largest number of moving mechanisms with losses for which all combinations of signs are shown."""


class TriedSigns(NamedTuple):
    """Combination of signs that contradicts the resulting power flow."""

    signs: Mapping[str, float]
    """Sign of each mechanism."""
    lossy_ratios: Mapping[str, float]
    """Ratio of each mechanism with losses, ``u eta^x``. [-]"""
    output_torque: Known
    """Torque that the output gives to the load for these signs. [-]"""
    against: str
    """Mechanism whose power contradicts its sign; empty if the contradiction is at the output."""


def tried_signs(state: GearState) -> list[TriedSigns]:
    """Return all combinations of signs of a self-locking gear, with their contradictions.

    The list is empty for other gears, and for more than `MOST_TRIED` moving mechanisms.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, 0.995, 0.98)], [Gear([1])])
    >>> tried = tried_signs(solve(case).gear_at(0))
    >>> [(*one.signs.values(), round(one.output_torque, 4), one.against) for one in tried]
    [(-1.0, -0.0153, ''), (1.0, 0.0249, 'D1')]
    """
    ideal, names = state.ideal, [item.name for item in state.case.mechanisms]
    efficiencies = ideal.variant.efficiencies
    moving = zip(efficiencies, ideal.speeds.relative_speeds, strict=True)
    free = [place for place, (efficiency, speed) in enumerate(moving) if efficiency.lossy and speed]
    if not state.search.locked or len(free) > MOST_TRIED:
        return []
    tried = []
    for efficiency in product((-1.0, 1.0), repeat=len(free)):
        signs = list(state.signs)
        for place, x in zip(free, efficiency, strict=True):
            signs[place] = x
        lossy = torques_for_signs(ideal, tuple(signs))
        ratios = lossy_ratios(ideal.variant.ratios, efficiencies, signs)
        against = (names[place] for place in free if signs[place] * lossy.directions[place] < 0)
        tried.append(
            TriedSigns(
                {names[place]: plain(signs[place]) for place in free},
                {names[place]: plain(ratios[place]) for place in free},
                plain(lossy.torques.on_first_link[-1]),
                next(against, ""),
            )
        )
    return [item for item in tried if not math.isnan(item.output_torque)]


def _why(state: GearState, place: int, motion: float, power: float) -> str:
    case, sign = state.case, state.signs[place]
    mechanism = case.mechanisms[place]
    if mechanism.efficiency == 1 and mechanism.back_efficiency in (None, 1):
        return "no losses"
    if is_nan(sign):
        return "not determined"
    if state.search.idle[place]:
        why = {IDLE: "unloaded: no torque", ONE_PIECE: ONE_PIECE}.get(
            mechanism_roles(state)[place],
            "at rest" if motion == 0 else "no torque without losses",
        )
        if sign == 0:
            return why
        # By convention the sign is +1 without torque, and the sign of the ratio for a torque
        # without motion; see docs/method.md.
        chosen = (1.0, math.copysign(1, mechanism.ratio))[: 2 if motion == 0 else 1]
        by_convention = case.idle == "published" and sign in chosen
        by = "convention `published`" if by_convention else "flow with losses"
        return f"{why}; x by the {by}"
    ideal = power * state.ideal.direction
    way = "coasting, power" if state.ideal.direction < 0 else "power"
    if math.isnan(ideal):
        return f"{way} {'enters' if sign > 0 else 'leaves'} by the first link"
    why = f"{way} {'enters' if ideal > 0 else 'leaves'} by the first link"
    turned = state.search.turned[place] or ideal * sign < 0
    return f"{why}, but losses turn it round" if turned else why
