"""How many digits rounding leaves of a gear whose ratios are nearly those of a singular train.

A mechanism of ratio u near 1 has differences u - 1 in its equations; where several meet,
their product is soon as small as rounding. So such a gear is calculated in exact fractions,
in which a ratio is what its float is; so is one whose elimination leaves too few digits. Here
its systems are solved once more, with the decimals that the numbers show: what then differs is
lost by the rounding of the numbers themselves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.elimination import Equation
from vstatics.core.numerics.tolerances import NEAR_ONE, NO_POWER, UNCERTAIN
from vstatics.core.numerics.traced import Number, absolute, may_lie, plain
from vstatics.core.statics.matrix import Column, columns, loaded_devices, speed_rows, torque_rows
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import Torques

MOST_EXACT_UNKNOWNS = 64
"""Unknowns of a system that is solved exactly; fractions grow with each of them."""


class LostDigits(NamedTuple):
    """Speeds and torques of a gear that rounding leaves few digits of."""

    digits: int
    """So many are certain in every one of them."""
    links: list[str]
    """Those with such speeds."""
    devices: list[str]
    """Those with such torques; `the output` is the output torque."""


def is_nearly_one(case: Transmission, ratios: Sequence[Number]) -> bool:
    """Whether the ratio of a mechanism with three links is nearly 1, but is not.

    Then rounding may leave no digit. Of traced numbers the answer holds for all variants.
    """
    return any(
        one.third
        and may_lie(ratio, 1 - NEAR_ONE, 1 + NEAR_ONE)
        and bool(0 < absolute(ratio - 1) < NEAR_ONE)
        for one, ratio in zip(case.mechanisms, ratios, strict=True)
    )


def lost_digits(state: GearState) -> LostDigits | None:
    """The speeds and torques of a gear that rounding makes uncertain; None if it makes none.

    The gear is that of one case, not of arrays of variants. None for large systems, too.
    """
    case, ideal = state.case, state.ideal
    if len(case.devices) + case.links > MOST_EXACT_UNKNOWNS:
        return None
    speeds = _exactly(speed_rows(case, state.gear, ideal.variant.rows), case.links)
    by_link = _parts(state.speeds, speeds)
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
    """Of each device and the output: the part of its torque that is lost."""
    case, gear = state.case, state.gear
    loaded = [*loaded_devices(case, gear), len(case.devices)]
    drag = state.drag.external if lossy else {}
    exact = _exactly(torque_rows(case, gear, by_column, drag), len(loaded) + len(torques.holding))
    found = [torques.factors[device] for device in loaded]
    parts = [0.0] * (len(case.devices) + 1)
    for device, part in zip(loaded, _parts(found, exact[: len(loaded)]), strict=True):
        parts[device] = part
    return parts


def _exactly(rows: Sequence[Equation], unknowns: int) -> list[float]:
    """The solution in exact fractions, rounded once; NaN as by `elimination.solve`."""
    from vstatics.core.numerics.exact import rounded  # fractions cost start-up time

    solution = elimination.solve(rows, unknowns, arithmetic=elimination.EXACT)
    return list(map(rounded, solution.values))


def _parts(found: Sequence[Number], exact: Sequence[float]) -> list[float]:
    """The parts by which numbers differ, 1 where only one of them exists.

    What is nothing beside the input's 1 is 0.
    """
    return [_part(plain(one), other) for one, other in zip(found, exact, strict=True)]


def _part(one: float, other: float) -> float:
    if math.isnan(one) or math.isnan(other):
        return float(math.isnan(one) != math.isnan(other))
    return abs(one - other) / max(abs(one), abs(other), NO_POWER)
