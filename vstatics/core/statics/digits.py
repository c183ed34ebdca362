"""Number of correct digits in the results of a gear whose equations are nearly singular.

The equations of a mechanism of ratio u near 1 contain the difference u - 1. The product of several
such differences can be as small as rounding errors. The solver calculates such gears in fractions
that equal the floats of the ratios. This module solves the equations again with fractions that
equal the decimals as written (1/10 instead of the float 0.1). The results differ because of the
rounding of the ratios to floats.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.core.named_tuple import NamedTuple
from vstatics.core.numerics import elimination
from vstatics.core.numerics.elimination import Equation
from vstatics.core.numerics.tolerances import NO_POWER, UNCERTAIN
from vstatics.core.numerics.traced import Number, plain
from vstatics.core.statics.matrix import Column, columns, loaded_devices, speed_rows, torque_rows
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import Torques

MOST_EXACT_UNKNOWNS = 64
"""Largest number of unknowns of a system that is solved in fractions.

Each unknown makes the numerators and denominators longer, and the calculation slower.
"""


class LostDigits(NamedTuple):
    """Links and devices of a gear whose speeds and torques have few correct digits."""

    digits: int
    """Number of correct digits in the least certain speed or torque."""
    links: list[str]
    """Names of the links with uncertain speeds."""
    devices: list[str]
    """Names of the devices with uncertain torques; `the output` for the output torque."""


def lost_digits(state: GearState) -> LostDigits | None:
    """Return the names of speeds and torques of a gear that rounding makes uncertain.

    The gear must belong to one case, not to arrays of variants. The result is None if all speeds
    and torques are certain, and for large systems, which are not examined.
    """
    case, ideal = state.case, state.ideal
    if len(case.devices) + case.links > MOST_EXACT_UNKNOWNS:
        return None
    speeds = _solved_exactly(speed_rows(case, state.gear, ideal.variant.rows), case.links)
    by_link = _relative_errors(state.speeds, speeds)
    by_device = _torque_parts(state, state.torques, ideal.variant.columns, lossy=False)
    if state.consistent and all(abs(plain(u)) < math.inf for u in state.lossy_ratios):
        lossy = _torque_parts(state, state.lossy_torques, columns(case, state.lossy_ratios))
        by_device = list(map(max, by_device, lossy))
    worst = max(*by_link, *by_device)
    if worst <= UNCERTAIN:
        return None
    return LostDigits(
        max(math.floor(-math.log10(worst)), 0),
        [name for name, part in zip(case.link_names, by_link, strict=True) if part > UNCERTAIN],
        [
            name
            for name, part in zip([*case.devices, "the output"], by_device, strict=True)
            if part > UNCERTAIN
        ],
    )


def _torque_parts(
    state: GearState, torques: Torques, by_column: Sequence[Column], *, lossy: bool = True
) -> list[float]:
    """Return the relative errors of the torques of devices and of the output torque [-]."""
    case, gear = state.case, state.gear
    loaded = [*loaded_devices(case, gear), len(case.devices)]
    drag = state.drag.external if lossy else {}
    exact = _solved_exactly(
        torque_rows(case, gear, by_column, drag), len(loaded) + len(torques.holding)
    )
    rounded = [torques.factors[device] for device in loaded]
    parts = [0.0] * (len(case.devices) + 1)
    for device, part in zip(loaded, _relative_errors(rounded, exact[: len(loaded)]), strict=True):
        parts[device] = part
    return parts


def _solved_exactly(rows: Sequence[Equation], unknowns: int) -> list[float]:
    from vstatics.core.numerics.exact import rounded  # fractions cost start-up time

    solution = elimination.solve(rows, unknowns, arithmetic=elimination.EXACT)
    return list(map(rounded, solution.values))


def _relative_errors(numbers: Sequence[Number], exact: Sequence[float]) -> list[float]:
    """Return the relative errors of numbers [-]; 1 if a number or its exact value is NaN."""
    return [
        _relative_error(plain(number), value) for number, value in zip(numbers, exact, strict=True)
    ]


def _relative_error(number: float, exact: float) -> float:
    if math.isnan(number) or math.isnan(exact):
        return float(math.isnan(number) != math.isnan(exact))
    return abs(number - exact) / max(abs(number), abs(exact), NO_POWER)
