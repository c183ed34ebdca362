"""State of a gear, with the values that pictures show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.fields import Bodies
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import Role, roles
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import Status

NOT_DETERMINED = Status("missing", "not determined", "")
"""Fault of a gear in which a speed is undetermined."""


class PictureState(NamedTuple):
    """State of a gear, with the values that pictures show."""

    input: int
    """Number of the input link."""
    output: int
    outputs: Sequence[int]
    """Numbers of the output links. The link to which the ratio refers comes first."""
    gear: Gear
    """Gear whose engaged shift elements include the holding freewheels."""
    faults: Sequence[Status]
    """Reasons why the gear cannot be calculated."""
    ratio: float
    """Ratio of the gear. [-]"""
    speeds: Sequence[float]
    """Relative speed of each link, the housing first; NaN if undetermined. [-]"""
    joined: Bodies
    """Body of each link, the housing first, identified by the lowest link number of the body."""
    roles: Sequence[Role]
    """Role of each mechanism or gear set: unloaded, locked up, or empty."""
    loaded_springs: Sequence[bool]
    """True for springs with torque, or with unknown torque."""
    loaded_elements: Sequence[bool]
    """True for shift elements that carry torque, or whose torque is unknown."""
    loaded_links: Sequence[frozenset[int]]
    """Links on which each mechanism or gear set exerts a torque, or an unknown torque."""
    leaving: Mapping[tuple[int, str], float]
    """Power that leaves the gear at each port, calculated without losses, by link and role. [-]

    Entering power is negative. The roles are ``input``, ``output``, and ``given`` for other links
    with a given torque.
    """


def state_of(results: Results, number: int) -> PictureState:
    """Return the state of the gear with a number, from 1.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> state.speeds[:3], state.joined
    ([0.0, 1.0, 0.0], [0, 1, 0, 3])
    """
    state = results.gear_at(number - 1)
    case, gear = state.case, state.gear
    faults = [status for status in state.statuses if status.is_fault]
    if state.ideal.speeds.missing and not state.unloaded:
        faults.append(NOT_DETERMINED)
    torques = state.torques.on_first_link
    return PictureState(
        case.gear_input(gear),
        case.gear_output(gear),
        _outputs(state),
        gear,
        faults,
        plain(state.ratio),
        [0.0, *map(plain, state.speeds)],
        case.bodies(gear),
        roles(results, number - 1),
        [torque != 0 for torque in torques[case.among_devices.stop : -1]],
        [
            number in gear.carrying and not (state.calculable and torque == 0)
            for number, torque in enumerate(torques[: case.among_devices.start], 1)
        ],
        _loaded_links(state),
        _leaving(state) if state.calculable else {},
    )


def _loaded_links(state: GearState) -> list[frozenset[int]]:
    devices = state.case.own_devices
    if not state.calculable:
        return [frozenset(member.link for member in device.members) for device in devices]
    sides = [state.member_torques(lossy=lossy) for lossy in (False, True)[: 1 + state.consistent]]
    return [
        frozenset(
            member.link
            for member in device.members
            if any(not abs(plain(side[member.name])) < NO_POWER for side in torques)
        )
        for device, *torques in zip(devices, *sides, strict=True)
    ]


def _leaving(state: GearState) -> dict[tuple[int, str], float]:
    """Return the power that leaves at each port without losses. The first output has the load."""
    entry, outputs = state.case.gear_input(state.gear), _outputs(state)
    powers: dict[tuple[int, str], float] = {}
    *others, load = [power for power in state.powers(lossy=False) if power.kind == "port"]
    for power in others:
        role = "input" if power.link == entry else "output" if power.link in outputs else "given"
        powers[power.link, role] = plain(power.power)
    loaded = outputs[0], "output"
    powers[loaded] = powers.get(loaded, 0.0) + plain(load.power)
    return powers


def _outputs(state: GearState) -> list[int]:
    return [state.case.gear_output(state.gear), *state.case.further_outputs(state.gear)]
