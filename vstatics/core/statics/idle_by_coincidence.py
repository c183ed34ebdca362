"""Mechanisms that transmit no power by coincidence, so that a direction of power is assumed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from vstatics.core.errors import spoken
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.numerics.traced import Number, absolute, plain
from vstatics.core.statics.bodies import held_as_one
from vstatics.core.statics.efficiency import lossy_ratios
from vstatics.core.statics.matrix import columns, rows
from vstatics.core.statics.power import power
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.speeds import solve_speeds
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import solve_torques


def idle_with_torque(results: Results) -> list[set[int]]:
    """Return for each gear the mechanisms that carry torque, but possibly no power, by index.

    The sets are empty for gears without consistent torques.
    """
    case, consistent = results.case, results.consistent
    if case.drawing is not None:
        gears = enumerate(consistent.tolist())
        return [set(_idle_in_sets(results, n)) if holds else set() for n, holds in gears]
    first = len(case.shift_elements)
    loaded = results.lossy_torques[:, first : first + len(case.mechanisms)] != 0
    marks = (results.idle & loaded & consistent[:, np.newaxis]).tolist()
    return [{index for index, is_idle in enumerate(row) if is_idle} for row in marks]


def coincidences(results: Results, number: int, gear: Gear, idle: set[int]) -> dict[str, bool]:
    """Return the mechanisms without power whose assumed direction of power affects the results.

    Keys are names of mechanisms for which the direction changes a torque at the ports. The value is
    True if it also changes the efficiency. Mechanisms locked up by engaged shift elements are left
    out, because the direction then affects only the torque split within the gear train.

    Parameters
    ----------
    number : int
        Index of the gear in `results`.
    gear : Gear
        The gear with the freewheels that hold among the engaged shift elements.
    idle : set of int
        Indices of mechanisms, from `idle_with_torque`.
    """
    if not idle or idle <= held_as_one(results.case, gear):
        return {}
    return _coincidences_of_state(results.gear_at(number))


def _idle_in_sets(results: Results, number: int) -> Iterator[int]:
    """Yield the indices of mechanisms that possibly transmit no power, although their set does."""
    case, is_idle = results.case, results.idle[number].tolist()
    behind = len(case.springs) + 1
    torques = iter(results.lossy_torques[number, len(case.shift_elements) : -behind].tolist())
    meshes = zip(
        results.mesh_losses[number].tolist(),
        results.lossy_mesh_torques[number].tolist(),
        strict=True,
    )
    for device, idle in zip(case.own_devices, is_idle, strict=True):
        loaded = sum(torque != 0 for torque in islice(torques, len(device.members))) > 0
        if device.meshes:
            for index in device.mechanisms:
                loss, torque = next(meshes)
                if loss == 0 and torque != 0:
                    yield index
        elif loaded and (idle or len(device.mechanisms) > 1):
            yield from device.mechanisms


def _coincidences_of_state(state: GearState) -> dict[str, bool]:
    case, gear, ideal = state.case, state.gear, state.ideal
    elements = len(case.shift_elements)
    idle = [
        place
        for place, is_idle in enumerate(state.search.idle)
        if is_idle
        and state.lossy_torques.on_first_link[elements + place] != 0
        and ideal.variant.efficiencies[place].lossy
    ]
    held = held_as_one(case, gear) if idle else set()
    idle = [place for place in idle if place not in held]
    if not idle:
        return {}

    def at_ports(place: int, sign: float) -> tuple[list[Number], Number]:
        """Return torques at the ports, and the input power, for a direction `sign` of power [-]."""
        turned = [*state.signs[:place], sign, *state.signs[place + 1 :]]
        ratios = lossy_ratios(ideal.variant.ratios, ideal.variant.efficiencies, turned)
        torques = solve_torques(case, gear, columns(case, ratios), state.drag)
        output = torques.on_first_link[-1]
        entering = -power(output, state.output_speed)
        for link, torque in torques.holding.items():
            entering = entering + power(torque, state.speeds[link - 1])
        return [output, *torques.holding.values()], entering

    if not gear.speeds and not gear.torques:
        # By virtual work, the output torque depends on the ratio of a mechanism only if the
        # mechanism has internal motion in a train with the same ratios, here the lossy ratios.
        relative_speeds = solve_speeds(case, gear, rows(case, state.lossy_ratios)).relative_speeds
        idle = [place for place in idle if relative_speeds[place] != 0]
    matters = {}
    for place in idle:
        driving, power_driving = at_ports(place, 1.0)
        driven, power_driven = at_ports(
            place, -1.0 if ideal.variant.efficiencies[place].back else 0.0
        )
        if _differ(driving, driven):
            matters[case.mechanisms[place].name] = not absolute(power_driving - power_driven) <= TIE
    return matters


def _differ(torques: list[Number], others: list[Number]) -> bool:
    """Return whether two lists of torques differ; pairs with NaN are left out."""
    pairs = [(a, b) for a, b in zip(torques, others, strict=True) if a == a and b == b]  # noqa: PLR0124
    largest = max((absolute(a) for a, _ in pairs), default=0.0)
    return any(absolute(a - b) > TIE * largest for a, b in pairs)


def idle_messages(results: Results, number: int, gear: Gear, idle: set[int]) -> Iterator[Message]:
    """Report mechanisms without power whose assumed direction of power affects the torques."""
    matters = coincidences(results, number, gear, idle)
    if matters:
        what = "torques with losses and efficiency depend"
        if not any(matters.values()):
            what = "torques with losses, but not the efficiency, depend"
        verb = "happens" if len(matters) == 1 else "happen"
        yield Message(
            "N413" if _is_straight_ahead(results, number, [*matters]) else "W425",
            f"{spoken([*matters])} {verb} to transmit no power; {what} on the direction of power "
            "that is assumed there",
        )


def _is_straight_ahead(results: Results, number: int, idle: Sequence[str]) -> bool:
    """Return whether all mechanisms `idle` rotate with a locked-up differential (no turn)."""
    speeds = [0.0, *map(plain, results.gear_at(number).speeds)]
    parts = [part for part in results.case.mechanisms if part.name in idle]
    of_differentials = [speeds[part.third] for part in parts if part.ratio == -1]
    return all(
        any(math.isclose(speeds[link], speed, rel_tol=TIE) for speed in of_differentials)
        for part in parts
        for link in (part.first, part.third)
    )
