"""Gears of the steps of a driving cycle: from the trace, or by a rule."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, spoken
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.vehicle.operation.point_loads import numbers_of_gears, unknown_gear
from vstatics.vehicle.operation.shifting import (
    EngineSpeeds,
    ShiftSpeed,
    by_least_speed,
    by_shift_speeds,
    directions,
)
from vstatics.vehicle.operation.trace import Trace

_AT_STANDSTILL = ("", "0", "0.0", "n", "p")
"""Names that published cycles give the neutral gear, allowed at standstill."""
_IN_NEUTRAL = ": a moving vehicle needs a gear, and coasting in neutral is not calculated"


class GearChoice(NamedTuple):
    """Rule that chooses gears for a trace without gears."""

    least_speed: float | None = None
    """Least engine speed; each step has the highest gear that reaches it. [rad/s]"""
    shifts: Sequence[ShiftSpeed] = ()
    least_loss: bool = False
    """True if each step has the gear that needs the least energy of engine or battery.

    Without `least_speed`, the engine turns at its first full-load point or faster.
    """


def chosen_gears(
    case: Transmission, trace: Trace, choice: GearChoice, engine: EngineSpeeds, ratios: Floats
) -> Integers:
    """Return the gear index of each step, from the trace or by the rule of `choice`.

    Parameters
    ----------
    ratios : ndarray, shape (gears,)
        Ratios of the case; NaN if other machines drive, too. [-]

    Raises
    ------
    CaseError
        If a gear is not in the case, if no gear is given, or if shifts are not in ascending order.
    """
    names = [gear.name for gear in case.gears]
    ways = {
        "the column `gear`": bool(trace.gears),
        "--shift": bool(choice.shifts),
        "--strategy" if choice.least_loss else "--least-speed": choice.least_speed is not None,
    }
    if len(means := [name for name, given in ways.items() if given]) > 1:
        message = f"{spoken(means)} give the gears, expected one of them"
        raise CaseError("E426", message, place=trace.place)
    if choice.least_speed is not None:
        ahead = next(iter(directions(ratios, names)), [])
        return by_least_speed(engine, choice.least_speed, ahead)
    if choice.shifts:
        try:
            return by_shift_speeds(case, choice.shifts, trace.speed, engine, ratios)
        except ValueError as error:
            raise CaseError("E426", f"--shift: {error}") from None
    if not trace.gears:
        if len(names) == 1:
            return np.zeros(len(trace.speed), np.int64)
        message = "the trace has no column `gear`, expected this column or one of --shift, "
        message += f"--least-speed and --strategy{trace.hint_of_gears}"
        raise CaseError("E426", message, place=trace.place)
    neutrals = {name for name in {*trace.gears} - {*names} if name.casefold() in _AT_STANDSTILL}
    standing: Booleans = trace.speed <= 0
    given = _given_gears(trace, neutrals)
    chosen = numbers_of_gears(case, given)
    problems = [
        Problem("E416", unknown_gear(case, name) + _IN_NEUTRAL * (name in neutrals), (row,))
        for row, name in enumerate(given)
        if chosen[row] is None and not (standing[row] and name in neutrals)
    ]
    if problems:
        raise CaseError(problems)
    return np.array([number or 0 for number in chosen])


def _given_gears(trace: Trace, neutrals: Collection[str]) -> list[str]:
    """Return the gear names of a trace; from rest in neutral, a step has the gear of its end."""
    from_rest = np.array(trace.table.numbers["speed"][:-1]) == 0
    return [
        end if moves_off and name in neutrals else name
        for moves_off, (name, end) in zip(
            from_rest & (trace.speed > 0), pairwise(trace.table.texts["gear"]), strict=True
        )
    ]
