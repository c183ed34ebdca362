"""What pictures show of a gear: all that they read of how it was calculated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.bodies import Bodies
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.bodies import is_one_piece
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import Role, mechanism_roles
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import Status

NOT_DETERMINED = Status("missing", "not determined", "")
"""Some speed is free."""


class PictureState(NamedTuple):
    """A gear as pictures show it."""

    input: int
    """Its link."""
    output: int
    outputs: Sequence[int]
    """That of the ratio, then the others."""
    gear: Gear
    """With the freewheels that hold among the engaged elements."""
    faults: Sequence[Status]
    """What keeps it from being calculated."""
    ratio: float
    """[-]"""
    speeds: Sequence[float]
    """By link, the housing first; NaN where it is free. [-]"""
    joined: Bodies
    """By link, the housing first: the least of the links that engaged elements, and springs
    as shafts, join to it."""
    is_still: Sequence[bool]
    """By mechanism or drawn element: whether nothing in it moves, as far as the gear exists."""
    roles: Sequence[Role]
    """By mechanism: whether it is idle, or one piece."""
    loaded_springs: Sequence[bool]
    """By spring: whether it carries torque, or one that is not known."""
    loaded_elements: Sequence[bool]
    """By shift element: the same."""
    loaded_links: Sequence[frozenset[int]]
    """By mechanism or drawn element: the links that it has torque from."""
    leaving: Mapping[tuple[int, str], float]
    """Power that leaves, as far as it is known, by link and role of the port: ``input``,
    ``output`` or ``given``. [-]"""


def state_of(results: Results, number: int) -> PictureState:
    """The state of a gear of one case; its number counts from 1.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> state.speeds[:3], state.joined
    ([0.0, 1.0, 0.0], [0, 1, 0, 3])
    """
    return shown_of(results.gear_at(number - 1))


def shown_of(state: GearState) -> PictureState:
    """What pictures show of the state of a gear."""
    case, gear = state.case, state.gear
    faults = [one for one in state.statuses if one.is_fault]
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
        [  # as `roles` decides it; a support, which holds one link, is not meant
            state.calculable
            and all(state.search.idle[place] for place in device.mechanisms)
            and is_one_piece(device, state.speeds)
            for device in case.own_devices
        ],
        mechanism_roles(state),
        [torque != 0 for torque in torques[case.among_devices.stop : -1]],
        [
            number in gear.engaged and not (state.calculable and torque == 0)
            for number, torque in enumerate(torques[: case.among_devices.start], 1)
        ],
        _loaded_links(state),
        _leaving(state) if state.calculable else {},
    )


def _loaded_links(state: GearState) -> list[frozenset[int]]:
    devices = state.case.own_devices
    if not state.calculable:
        return [frozenset(one.link for one in device.members) for device in devices]
    sides = [state.member_torques(lossy=lossy) for lossy in (False, True)[: 1 + state.consistent]]
    return [
        frozenset(
            one.link
            for one in device.members
            if any(not abs(plain(side[one.name])) < NO_POWER for side in own)
        )
        for device, *own in zip(devices, *sides, strict=True)
    ]


def _leaving(state: GearState) -> dict[tuple[int, str], float]:
    """Without losses; what is given at the output counts with the load."""
    entry, outputs = state.case.gear_input(state.gear), _outputs(state)
    found: dict[tuple[int, str], float] = {}
    *others, load = [one for one in state.powers(lossy=False) if one.kind == "port"]
    for one in others:
        role = "input" if one.link == entry else "output" if one.link in outputs else "given"
        found[one.link, role] = plain(one.power)
    loaded = outputs[0], "output"
    found[loaded] = found.get(loaded, 0.0) + plain(load.power)
    return found


def _outputs(state: GearState) -> list[int]:
    return [state.case.gear_output(state.gear), *state.case.further_outputs(state.gear)]
