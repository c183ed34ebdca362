"""Freewheels: which of them hold in a gear, found by trying.

A freewheel keeps its first link from turning backward against the second. It holds,
like an engaged element, with a torque on its first link that is not above 0, or it
overruns, with a slip that is not below 0. Both are turned where the unit of speed or of
torque is below 0: that of speed with an input that turns backward; that of torque too,
and also when coasting.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.traced import Number, absolute, is_nan, is_traced, plain, sign
from vstatics.core.statics import matrix
from vstatics.core.statics.digits import is_nearly_one
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.ideal import IdealGear, ideal_gear, is_nothing
from vstatics.core.statics.matrix import Variant, variant_of
from vstatics.core.statics.signs import find_signs
from vstatics.core.statics.speeds import Speeds, is_tie, solve_speeds
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import NO_DRAG, Torques

Losses = Sequence[Number | Efficiency]
"""Efficiencies: of one direction, where a mechanism has its own for the other; or of both."""


def find_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    """The gear with its freewheels where they belong.

    All sets of freewheels that may hold are tried, the smallest first. The first is
    taken that is possible, determines the output speed and has torques in balance; if
    there is none they all overrun, and the gear is neutral, or nothing holds. Where one of
    them is driven backward while none holds, holding it would tie the gear up: a conflict,
    without values.

    Parameters
    ----------
    ratios, efficiencies : sequence of Number
        Of each mechanism: floats, or traced numbers, as those of the gear may be; its speed
        ratios go before. [-]
    """
    ratios = case.gear_ratios(gear, ratios)
    if not is_nearly_one(case, ratios):
        state = _find_state(case, gear, ratios, efficiencies)
        if state.certain:
            return state
    if any(map(is_traced, _numbers(gear, ratios, efficiencies))):
        raise Untraceable
    return _exact_state(case, gear, ratios, efficiencies)


def _numbers(gear: Gear, ratios: Sequence[Number], efficiencies: Losses) -> Iterator[Any]:
    """All numbers that may be traced."""
    yield from ratios
    for one in efficiencies:
        yield from one if isinstance(one, Efficiency) else (one,)
    for by_part in (gear.speeds, gear.torques, gear.drag, gear.open_drag):
        yield from by_part.values()


def _exact_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    """The state of a gear of which rounding leaves too few digits, calculated in fractions.

    A ratio and an efficiency are what the float is, to its last bit.
    """
    from fractions import Fraction  # they cost start-up time

    from vstatics.core.numerics.exact import rounded

    def exactly(one: Number | Efficiency) -> Any:
        if isinstance(one, Efficiency):
            return one._replace(forward=exactly(one.forward), back=exactly(one.back))
        return Fraction(plain(one))

    exact = [list(map(exactly, numbers)) for numbers in (ratios, efficiencies)]
    try:
        state: GearState = rounded(_find_state(case, gear, *exact))
    except OverflowError:  # beyond any float, where the search asks for one
        return _find_state(case, gear, ratios, efficiencies)
    return state._replace(exact=True)


def _find_state(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Losses
) -> GearState:
    """The state in the arithmetic of the given numbers."""
    variant = variant_of(case, ratios, efficiencies)
    nobody = solve_speeds(case, gear, variant.rows)
    if not case.freewheels or not nobody.consistent:  # tied up, whatever the freewheels do
        return _state(variant, gear, nobody)
    if driven_backward(case, gear, nobody):
        return _conflict(variant, gear, nobody)
    for held in _sets(case):
        chosen = with_engaged(gear, held)
        speeds = solve_speeds(case, chosen, variant.rows) if held else nobody
        state = _possible(variant, chosen, speeds)
        if state is not None:
            return state
    return _state(variant, gear, nobody)


def _possible(variant: Variant, gear: Gear, speeds: Speeds) -> GearState | None:
    """A gear with some freewheels engaged, if they can hold it and the others can overrun."""
    case = variant.case
    held = [number for number in case.freewheels if number in gear.engaged]
    drives = speeds.consistent and not is_nan(speeds.links[case.gear_output(gear) - 1])
    if not drives or driven_backward(case, gear, speeds):
        return None
    state = _state(variant, gear, speeds)
    holds = state.balanced and all(_can_hold(state, number) for number in held)
    return state if holds else None


def alternatives(case: Transmission, gear: Gear, held: Sequence[int]) -> list[int]:
    """Numbers of the freewheels that could hold in place of some of those that do.

    Then statics does not determine the torques that they share.

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
    """Return the numbers of freewheels whose links are to be exchanged for the gear to drive.

    Each of them is exchanged alone, and then all together. The list is empty where that does not
    help, and where the gear coasts, as a freewheel overruns there by design.

    Parameters
    ----------
    state : GearState
        Neutral, or without torques in balance.
    overrunning : sequence of int
        Numbers of freewheels that do not hold.
    """
    case, variant = state.case, state.ideal.variant
    if case.coasts(state.gear):
        return []
    for numbers in dict.fromkeys([*((number,) for number in overrunning), (*overrunning,)]):
        elements = [
            element._replace(first=element.second, second=element.first)
            if number in numbers
            else element
            for number, element in enumerate(case.shift_elements, 1)
        ]
        exchanged = case.replace(shift_elements=elements)
        tried = find_state(exchanged, state.gear, variant.ratios, variant.efficiencies)
        if tried.calculable and not is_nan(tried.output_speed):
            return [*numbers]
    return []


def with_engaged(gear: Gear, held: Sequence[int]) -> Gear:
    """The gear with some freewheels engaged."""
    return gear._replace(engaged=(*gear.engaged, *held)) if held else gear


def driven_backward(case: Transmission, gear: Gear, speeds: Speeds) -> list[int]:
    """Numbers of the freewheels that do not hold and would have to overrun backward."""
    by_link = [0.0, *map(absolute, speeds.links)]
    turns = input_direction(case, gear)
    found = []
    for number in case.freewheels:
        element, slip = case.shift_elements[number - 1], speeds.slips[number - 1]
        if number not in gear.engaged and slip * turns < 0:
            ends = by_link[element.first], by_link[element.second]
            found += [number] * (not is_tie(absolute(slip), *ends))
    return found


def input_direction(case: Transmission, gear: Gear) -> int:
    """+1, or -1 where the input turns backward: the sign of the unit of speed."""
    return -1 if case.input_turns(gear) == "backward" else 1


def _sets(case: Transmission) -> Iterator[tuple[int, ...]]:
    """All sets of freewheels, the smallest first."""
    for size in range(len(case.freewheels) + 1):
        yield from combinations(case.freewheels, size)


def _state(variant: Variant, gear: Gear, speeds: Speeds) -> GearState:
    """The gear with torques, for the elements that are engaged."""
    ideal = ideal_gear(variant, gear, speeds)
    moving = ideal.torques.consistent and speeds.consistent
    return GearState(ideal, find_signs(ideal, moving=moving))


def _can_hold(state: GearState, number: int) -> bool:
    """Whether a freewheel that holds has a torque of the right sign, with losses if they exist."""
    ideal, lossy = state.ideal, state.search.lossy
    torques, columns = ideal.torques_with_drag, ideal.variant.columns
    if not is_nan(lossy.torques.on_first_link[number - 1]):
        torques, columns = lossy.torques, matrix.columns(state.case, state.lossy_ratios)
    turns = ideal.direction * input_direction(state.case, state.gear)
    pull = sign(torques.on_first_link[number - 1]) * turns
    return bool(pull <= 0 or (pull > 0 and is_nothing(ideal, columns, torques, number)))


def _conflict(variant: Variant, gear: Gear, nobody: Speeds) -> GearState:
    """A gear without a state, and so without values."""
    case = variant.case
    nan = math.nan
    speeds = nobody._replace(
        links=[nan] * len(nobody.links),
        relative_speeds=[nan] * len(nobody.relative_speeds),
        slips=[nan] * len(nobody.slips),
    )
    torques = Torques(
        [nan] * (len(case.devices) + 1),
        dict.fromkeys(matrix.held_links(case, gear), nan),
        consistent=False,
    )
    ideal = IdealGear(variant, gear, speeds, torques, NO_DRAG, torques)
    return GearState(ideal, find_signs(ideal, moving=False), conflict=True)
