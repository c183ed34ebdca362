"""Signs of the power flow without losses: the closed form, and conventions for idle mechanisms.

``x = sign(M (w_f - w_h))``: equation (5) of docs/method.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.numerics.traced import Number, sign
from vstatics.statics.efficiency import Signs
from vstatics.statics.ideal import IdealGear, mechanism_torques
from vstatics.statics.power import power


class IdealSigns(NamedTuple):
    """By mechanism: the sign that the flow without losses gives, and why it may give none."""

    signs: Signs
    """+1, -1 or 0; NaN where torque or motion is not determined."""
    unloaded: Sequence[bool]
    """It carries no torque."""
    still: Sequence[bool]
    """It turns as one piece."""

    @property
    def idle(self) -> list[bool]:
        """Whether there is no flow that could give a sign."""
        return [a or b for a, b in zip(self.unloaded, self.still, strict=True)]


def ideal_signs(ideal: IdealGear, *, moving: bool) -> IdealSigns:
    """Signs by the closed form, equation (5); ties by convention.

    Parameters
    ----------
    moving : bool
        Whether speeds, and torques without losses, exist.
    """
    if not moving:
        none = [False] * len(ideal.variant.ratios)
        return IdealSigns((math.nan,) * len(none), none, none)
    torques = mechanism_torques(ideal, ideal.variant.columns, ideal.torques_with_drag)
    relative_speeds = ideal.speeds.relative_speeds
    unloaded = [bool(torque == 0) for torque in torques]
    still = [bool(speed == 0) for speed in relative_speeds]
    signs = [
        _of_idle(ideal, place, is_unloaded=unloaded[place])
        if unloaded[place] or still[place]
        else sign(power(torques[place], relative_speeds[place])) * ideal.variant.direction
        for place in range(len(torques))
    ]
    return IdealSigns(tuple(signs), unloaded, still)


def _of_idle(ideal: IdealGear, place: int, *, is_unloaded: bool) -> Number:
    """The sign of an idle mechanism by the convention of the case."""
    if ideal.case.idle == "exact":
        return 0.0
    published = 1.0 if is_unloaded else sign(ideal.variant.ratios[place])
    return 0.0 if ideal.variant.efficiencies[place].back == 0 and published < 0 else published
