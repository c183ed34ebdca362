"""One gear: speeds, torques without and with losses, what is determined."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.model.transmission import Gear, Mechanism, Transmission
from vstatics.numerics.traced import Number, Rest, Traced, guard_within
from vstatics.statics import freewheels
from vstatics.statics.results import ARRAYS, Rows

CLOSED = 1e-9
"""Powers agree to this part of the input power, or rounding is too large for a plan."""

Numbers = Sequence[Number]


class Solved(NamedTuple):
    """The values of `Results` for one gear and one variant, or traced for many."""

    speeds: Numbers
    planet_speeds: Numbers
    slip_speeds: Numbers
    ratio: Number
    torques: Numbers
    holding_torques: Numbers
    lossy_torques: Numbers
    lossy_holding_torques: Numbers
    efficiency: Number
    power_sign: Numbers
    idle: Sequence[bool]
    losses: Numbers
    power_balance: Number
    drag_losses: Number
    consistent: bool
    locked: bool
    undecided: bool
    turned: Sequence[bool]
    choices: int
    tied_up: bool
    missing: int
    excess: int
    balanced: bool
    holds: Sequence[bool]
    conflict: bool


def solve_gear(case: Transmission, gear: Gear, ratios: Numbers, efficiencies: Numbers) -> Solved:
    """Everything that is calculated for one gear.

    Parameters
    ----------
    ratios, efficiencies : sequence of Number
        Of each mechanism: floats, or traced numbers. [-]
    """
    state = freewheels.settle(case, gear, ratios, efficiencies)
    speeds, torques, outcome = state.speeds, state.flow.torques, state.outcome
    lossy = outcome.lossy
    output_speed = speeds.links[case.gear_output(gear) - 1]
    return Solved(
        speeds=speeds.links,
        planet_speeds=[
            _planet_speed(mechanism, ratio, motion)
            for mechanism, ratio, motion in zip(case.mechanisms, ratios, speeds.motion, strict=True)
        ],
        slip_speeds=speeds.slips,
        ratio=math.nan if output_speed == 0 else 1 / output_speed,
        torques=torques.first,
        holding_torques=_by_link(case, torques.holding),
        lossy_torques=lossy.torques,
        lossy_holding_torques=_by_link(case, lossy.holding),
        efficiency=lossy.efficiency,
        power_sign=lossy.signs,
        idle=outcome.idle,
        losses=lossy.losses,
        power_balance=lossy.balance,
        drag_losses=lossy.drag_losses,
        consistent=lossy.admissible,
        locked=outcome.locked,
        undecided=outcome.undecided,
        turned=outcome.turned,
        choices=outcome.choices,
        tied_up=not speeds.consistent,
        missing=speeds.missing,
        excess=speeds.excess,
        balanced=torques.consistent,
        holds=[n in state.gear.engaged for n in range(1, len(case.shift_elements) + 1)],
        conflict=state.conflict,
    )


def _planet_speed(mechanism: Mechanism, ratio: Number, motion: Number) -> Number:
    """Speed of the planet against the third link."""
    if mechanism.planet_ratio is not None:
        return motion / mechanism.planet_ratio
    return motion / ((ratio + 1) / 2) if mechanism.is_plain(ratio) else math.nan


def _by_link(case: Transmission, holding: dict[int, Number]) -> Numbers:
    return [holding.get(link, math.nan) for link in range(1, case.links + 1)]


def watch(case: Transmission, gear: Gear, solved: Solved) -> None:
    """Guard, for traced numbers, that power is conserved: without losses and with them.

    A variant of which this is not true is left to be calculated by itself.
    """
    output_speed = solved.speeds[case.gear_output(gear) - 1]
    power = solved.torques[-1] * output_speed
    if not gear.speeds and not gear.torques and isinstance(power, Traced):
        guard_within(power, 1 - CLOSED, 1 + CLOSED)
    if isinstance(solved.power_balance, Rest):
        guard_within(solved.power_balance, -CLOSED, CLOSED)


def widths(case: Transmission) -> dict[str, int | None]:
    """Field of `Solved` -> how many values it has; None for a value of the gear itself."""
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    counts: dict[Rows, int | None] = {
        "links": case.links,
        "elements": elements,
        "mechanisms": mechanisms,
        "torques": elements + mechanisms + 1,
        "one": None,
    }
    return {name: counts[ARRAYS[name].rows] for name in Solved._fields}


def flat(solved: Solved, fields: Sequence[str]) -> list[Number]:
    """The values of some fields in their order, without -0; what overflowed does not exist."""
    values: list[Number] = []
    for name in fields:
        value = getattr(solved, name)
        values += value if isinstance(value, list | tuple) else [value]
    return [_tidy(value) if value.__class__ is float else value for value in values]


def _tidy(value: float) -> float:
    return value + 0.0 if -math.inf < value < math.inf else math.nan
