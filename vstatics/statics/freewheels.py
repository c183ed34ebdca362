"""Freewheels: which of them hold in a gear, found by trying.

A freewheel keeps its first link from turning backward against the second. It holds,
like an engaged element, with a torque on its first link that is not above 0 (in units
of an input torque that is below 0 when coasting: not below 0); or it overruns, with a
slip that is not below 0.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.traced import Number
from vstatics.statics import matrix, signs
from vstatics.statics.drag import NO_DRAG, acting
from vstatics.statics.losses import Efficiency, Flow, both_ways, is_nothing, sign, with_loss
from vstatics.statics.signs import Outcome
from vstatics.statics.speeds import Speeds, is_tie, solve_speeds
from vstatics.statics.torques import Torques, solve_torques

Held = tuple[int, ...]
"""Numbers of the freewheels that hold."""


class State(NamedTuple):
    """A gear in which every freewheel either holds or overruns."""

    gear: Gear
    """With the freewheels that hold among the engaged elements."""
    speeds: Speeds
    flow: Flow
    outcome: Outcome
    conflict: bool = False
    """There is no such state."""


def settle(
    case: Transmission, gear: Gear, ratios: Sequence[Number], efficiencies: Sequence[Number]
) -> State:
    """The gear with its freewheels where they belong.

    All sets of freewheels that may hold are tried, the smallest first. The first is
    taken that is possible and determines the output speed; if there is none they all
    overrun, and the gear is neutral. Where one of them is driven backward while none
    holds, holding it would tie the gear up: a conflict, without values.

    Parameters
    ----------
    ratios, efficiencies : sequence of Number
        Of each mechanism: floats, or traced numbers. [-]
    """
    both = both_ways(case, efficiencies)
    if not case.freewheels:
        return _state(case, gear, ratios, both, solve_speeds(case, gear, ratios))
    nobody = solve_speeds(case, gear, ratios)
    if not nobody.consistent:  # tied up, whatever the freewheels do
        return _state(case, gear, ratios, both, nobody)
    if driven_backward(case, gear, nobody):
        return _conflict(case, gear, ratios, both, nobody)
    for held in _sets(case):
        chosen = holding(gear, held)
        speeds = solve_speeds(case, chosen, ratios) if held else nobody
        state = _possible(case, chosen, ratios, both, speeds)
        if state is not None:
            return state
    return _state(case, gear, ratios, both, nobody)


def _possible(
    case: Transmission,
    gear: Gear,
    ratios: Sequence[Number],
    efficiencies: Sequence[Efficiency],
    speeds: Speeds,
) -> State | None:
    """A gear with some freewheels engaged, if they can hold and the others can overrun."""
    held = [number for number in case.freewheels if number in gear.engaged]
    drives = speeds.consistent and not math.isnan(sign(speeds.links[case.gear_output(gear) - 1]))
    if not drives or driven_backward(case, gear, speeds):
        return None
    state = _state(case, gear, ratios, efficiencies, speeds)
    return state if all(_can_hold(state, number) for number in held) else None


def as_well(
    case: Transmission, gear: Gear, held: Sequence[int], ratios: Sequence[float]
) -> list[int]:
    """Numbers of the freewheels that could hold in place of some of those that do.

    Then statics does not determine the torques that they share.

    Parameters
    ----------
    held : sequence of int
        The freewheels that hold.
    """
    both = both_ways(case, [mechanism.efficiency for mechanism in case.mechanisms])
    others: set[int] = set()
    for chosen in combinations(case.freewheels, len(held)):
        other = holding(gear, chosen)
        if chosen != tuple(held):
            speeds = solve_speeds(case, other, ratios)
            if _possible(case, other, ratios, both, speeds) is not None:
                others.update(chosen)
    return sorted(others.difference(held))


def holding(gear: Gear, held: Sequence[int]) -> Gear:
    """The gear with some freewheels engaged."""
    return gear._replace(engaged=(*gear.engaged, *held)) if held else gear


def driven_backward(case: Transmission, gear: Gear, speeds: Speeds) -> list[int]:
    """Numbers of the freewheels that do not hold and would have to overrun backward."""
    by_link = [0.0, *map(abs, speeds.links)]
    found = []
    for number in case.freewheels:
        element, slip = case.shift_elements[number - 1], speeds.slips[number - 1]
        if number not in gear.engaged and slip < 0:
            ends = by_link[element.first], by_link[element.second]
            found += [number] * (not is_tie(abs(slip), *ends))
    return found


def _sets(case: Transmission) -> Iterator[Held]:
    """All sets of freewheels, the smallest first."""
    for size in range(len(case.freewheels) + 1):
        yield from combinations(case.freewheels, size)


def _state(
    case: Transmission,
    gear: Gear,
    ratios: Sequence[Number],
    efficiencies: Sequence[Efficiency],
    speeds: Speeds,
) -> State:
    """Torques without and with losses, for the elements that are engaged."""
    torques = solve_torques(case, gear, ratios)
    drag = acting(case, gear, speeds.links, speeds.slips)
    driving = torques if drag is NO_DRAG else solve_torques(case, gear, ratios, drag)
    flow = Flow(
        case, gear, ratios, efficiencies, speeds.links, speeds.motion, torques, drag, driving
    )
    moving = torques.consistent and speeds.consistent
    return State(gear, speeds, flow, signs.search(flow, moving=moving))


def _can_hold(state: State, number: int) -> bool:
    """Whether a freewheel that holds has a torque of the right sign, with losses if they exist."""
    flow, lossy = state.flow, state.outcome.lossy
    torques, ratios = flow.driving, flow.ratios
    if not math.isnan(sign(lossy.torques[number - 1])):
        torques = Torques(list(lossy.torques), lossy.holding, consistent=True)
        ratios = list(map(with_loss, ratios, flow.efficiencies, lossy.signs))
    pull = sign(torques.first[number - 1]) * flow.direction
    return pull <= 0 or (pull > 0 and is_nothing(flow, ratios, torques, number))


def _conflict(
    case: Transmission,
    gear: Gear,
    ratios: Sequence[Number],
    efficiencies: Sequence[Efficiency],
    nobody: Speeds,
) -> State:
    """A gear without a state, and so without values."""
    nan = math.nan
    speeds = nobody._replace(
        links=[nan] * len(nobody.links),
        motion=[nan] * len(nobody.motion),
        slips=[nan] * len(nobody.slips),
    )
    torques = Torques(
        [nan] * (len(case.shift_elements) + len(case.mechanisms) + 1),
        dict.fromkeys(matrix.held_links(case, gear), nan),
        consistent=False,
    )
    flow = Flow(
        case, gear, ratios, efficiencies, speeds.links, speeds.motion, torques, NO_DRAG, torques
    )
    return State(gear, speeds, flow, signs.search(flow, moving=False), conflict=True)
