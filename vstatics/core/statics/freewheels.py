"""Search for the freewheels that hold in a gear, by trial.

A freewheel prevents its first link from turning backward relative to the second. If it holds, the
torque that its first link gives to it is 0 or less. If it overruns, its slip is 0 or more. Speeds
and torques are relative to the input. So the sign of the slip changes if the input turns backward,
and the sign of the torque if the input torque is negative.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import chain, combinations
from typing import Any

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.signed import renamed
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.tolerances import NEAR_ONE
from vstatics.core.numerics.traced import Number, absolute, is_nan, is_traced, may_lie, plain, sign
from vstatics.core.statics import matrix
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.ideal import (
    IdealGear,
    direction_of,
    driving,
    gaining,
    ideal_gear,
    is_nothing,
    no_torques,
)
from vstatics.core.statics.matrix import Variant, variant_of
from vstatics.core.statics.signs import find_signs
from vstatics.core.statics.speeds import Speeds, is_tie, solve_speeds
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import NO_DRAG, Torques

Losses = Sequence[Number | Efficiency]
"""Efficiency of each mechanism: forward only, or of both directions. [-]"""


def find_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    """Return the state of a gear in which every freewheel holds or overruns.

    All sets of freewheels that could hold are tried, smallest sets first. The result is the first
    set that is possible, determines the output speed and balances the torques. Without such a set
    all freewheels overrun, and the gear is neutral or an external torque has no reaction. If a
    freewheel is then driven backward, the gear has a conflict, because it would be tied up if the
    freewheel held. A state of conflict contains no values.

    Parameters
    ----------
    ratios, efficiencies : sequence of Number
        Basic ratio and efficiency of each mechanism, as floats or traced numbers. The gear's
        `speed_ratios` override `ratios`. [-]
    """
    ratios = case.gear_ratios(gear, ratios)
    if not is_nearly_one(case, ratios):
        state = _find_state(case, gear, ratios, efficiencies)
        if state.certain:
            return state
    if any(map(is_traced, _traceable_numbers(gear, ratios, efficiencies))):
        raise Untraceable
    return _exact_state(case, gear, ratios, efficiencies)


def is_nearly_one(case: Transmission, ratios: Sequence[Number]) -> bool:
    """Return whether any mechanism with three links has a ratio close to 1, but not 1.

    Rounding can then leave no correct digit. Traced numbers give a common answer for all variants.
    """
    return any(
        mechanism.third
        and may_lie(ratio, 1 - NEAR_ONE, 1 + NEAR_ONE)
        and bool(renamed(absolute(ratio - 1) < NEAR_ONE, "close") and ratio != 1)
        for mechanism, ratio in zip(case.mechanisms, ratios, strict=True)
    )


def _traceable_numbers(gear: Gear, ratios: Sequence[Number], efficiencies: Losses) -> Iterator[Any]:
    yield from ratios
    for efficiency in efficiencies:
        yield from efficiency if isinstance(efficiency, Efficiency) else (efficiency,)
    for by_part in (gear.speeds, gear.slip, gear.torques, gear.drag, gear.open_drag):
        yield from by_part.values()


def _exact_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    """Calculate a gear with fractions that equal the floats of its ratios and efficiencies."""
    from fractions import Fraction  # fractions cost start-up time

    from vstatics.core.numerics.exact import rounded

    def exactly(number: Number | Efficiency) -> Any:
        if isinstance(number, Efficiency):
            return number._replace(forward=exactly(number.forward), back=exactly(number.back))
        return Fraction(plain(number))

    exact = [list(map(exactly, numbers)) for numbers in (ratios, efficiencies)]
    try:
        state: GearState = rounded(_find_state(case, gear, *exact))
    except OverflowError:  # the search compares floats, and a fraction can exceed their range
        return _find_state(case, gear, ratios, efficiencies)
    return state._replace(exact=True)


def _find_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    variant = variant_of(case, ratios, efficiencies)
    overrunning = solve_speeds(case, gear, variant.rows)
    if not case.freewheels or not overrunning.consistent:  # tied up even if all freewheels overrun
        return _state(variant, gear, overrunning)
    if driven_backward(case, gear, overrunning):
        return _state_without_values(variant, gear, overrunning)
    sizes = range(len(case.freewheels) + 1)
    for held in chain.from_iterable(combinations(case.freewheels, size) for size in sizes):
        gear_with_held = with_engaged(gear, held)
        speeds = solve_speeds(case, gear_with_held, variant.rows) if held else overrunning
        state = _possible(variant, gear_with_held, speeds)
        if state is not None:
            return state
    return _state(variant, gear, overrunning)


def _possible(variant: Variant, gear: Gear, speeds: Speeds) -> GearState | None:
    """Return the state if engaged freewheels can hold and the others can overrun, else None."""
    case = variant.case
    held = [number for number in case.freewheels if number in gear.engaged]
    drives = speeds.consistent and not is_nan(speeds.links[case.gear_output(gear) - 1])
    if not drives or driven_backward(case, gear, speeds):
        return None
    state = _state(variant, gear, speeds)
    holds = state.balanced and all(_can_hold(state, number) for number in held)
    return state if holds else None


def alternatives(case: Transmission, gear: Gear, held: Sequence[int]) -> list[int]:
    """Return the numbers of freewheels that could replace a holding freewheel.

    Statics does not determine how such freewheels share their torque.

    Parameters
    ----------
    held : sequence of int
        The freewheels that hold.
    """
    variant = variant_of(case, case.gear_ratios(gear))
    others: set[int] = set()
    for chosen in combinations(case.freewheels, len(held)):
        other = with_engaged(gear, chosen)
        if chosen != tuple(held):
            speeds = solve_speeds(case, other, variant.rows)
            if _possible(variant, other, speeds) is not None:
                others.update(chosen)
    return sorted(others.difference(held))


def in_wrong_order(state: GearState, overrunning: Sequence[int]) -> list[int]:
    """Return the numbers of freewheels whose links must be swapped so that the gear can drive.

    Each freewheel is tried alone, then all freewheels together. The list is empty if no swap helps,
    and when coasting, because freewheels then overrun by design.

    Parameters
    ----------
    state : GearState
        Neutral state, or state whose torques do not balance.
    overrunning : sequence of int
        Numbers of freewheels that do not hold.
    """
    case, gear = state.case, state.gear._replace(speed_ratios={})  # `trial_ratios` has them
    if case.coasts(gear):
        return []
    for numbers in dict.fromkeys([*((number,) for number in overrunning), (*overrunning,)]):
        elements = [
            element._replace(first=element.second, second=element.first)
            if number in numbers
            else element
            for number, element in enumerate(case.shift_elements, 1)
        ]
        exchanged = case.replace(shift_elements=elements)
        tried = find_state(exchanged, gear, state.trial_ratios, state.ideal.variant.efficiencies)
        if tried.calculable and not is_nan(tried.output_speed):
            return [*numbers]
    return []


def with_engaged(gear: Gear, held: Sequence[int]) -> Gear:
    """Return the gear with some freewheels engaged."""
    return gear._replace(engaged=(*gear.engaged, *held)) if held else gear


def driven_backward(case: Transmission, gear: Gear, speeds: Speeds) -> list[int]:
    """Return the numbers of freewheels that do not hold, but whose slip is backward."""
    by_link = [0.0, *map(absolute, speeds.links)]
    turns = input_direction(case, gear)
    backward = []
    for number in case.freewheels:
        element, slip = case.shift_elements[number - 1], speeds.slips[number - 1]
        if number not in gear.engaged and slip * turns < 0:
            ends = by_link[element.first], by_link[element.second]
            backward += [number] * (not is_tie(absolute(slip), *ends))
    return backward


def input_direction(case: Transmission, gear: Gear) -> int:
    """Return -1 for an input that turns backward, else +1."""
    return -1 if case.input_turns(gear) == "backward" else 1


def _state(variant: Variant, gear: Gear, speeds: Speeds) -> GearState:
    ideal = ideal_gear(variant, gear, speeds)
    moving = ideal.torques.consistent and speeds.consistent
    search = find_signs(ideal, moving=moving)
    # A slipping clutch or converter that would give power makes a gear impossible only if no
    # torques with drag and losses exist, because both can reverse its torque.
    if not search.lossy.admissible and (
        driving(ideal, variant.columns, ideal.torques)
        or gaining(variant, ideal.direction, speeds, ideal.torques)
    ):
        ideal = ideal._replace(torques=no_torques(ideal.torques))
        search = find_signs(ideal, moving=False)
    return GearState(ideal, search)


def _can_hold(state: GearState, number: int) -> bool:
    """Return whether the torque of a holding freewheel has the right sign.

    The torque with losses is tested, or if that does not exist, the torque without losses.
    """
    ideal, lossy = state.ideal, state.search.lossy
    torques, columns = ideal.torques_with_drag, ideal.variant.columns
    if not is_nan(lossy.torques.on_first_link[number - 1]):
        torques, columns = lossy.torques, matrix.columns(state.case, state.lossy_ratios)
    turns = ideal.direction * input_direction(state.case, state.gear)
    pull = sign(torques.on_first_link[number - 1]) * turns
    return bool(pull <= 0 or (pull > 0 and is_nothing(ideal, columns, torques, number)))


def _state_without_values(variant: Variant, gear: Gear, overrunning: Speeds) -> GearState:
    case = variant.case
    nan = math.nan
    speeds = overrunning._replace(
        links=[nan] * len(overrunning.links),
        relative_speeds=[nan] * len(overrunning.relative_speeds),
        slips=[nan] * len(overrunning.slips),
    )
    torques = Torques(
        [nan] * (len(case.devices) + 1),
        dict.fromkeys(matrix.held_links(case, gear), nan),
        consistent=False,
    )
    direction, external = direction_of(case, gear), matrix.external_torques(case, gear)
    ideal = IdealGear(variant, gear, direction, external, speeds, torques, NO_DRAG, torques)
    return GearState(ideal, find_signs(ideal, moving=False), conflict=True)
