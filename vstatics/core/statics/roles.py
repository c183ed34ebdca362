"""Roles of mechanisms that transmit no power in a gear: unloaded or locked up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Literal

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.bodies import is_one_piece
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import GearState

Role = Literal["", "unloaded", "locked up"]
IDLE: Role = "unloaded"
"""Role of a mechanism without torque."""
ONE_PIECE: Role = "locked up"
"""Role of a loaded mechanism without internal motion: at rest or rotating as a block."""
MEANINGS = {
    ONE_PIECE: "loaded, but turns 1:1 or is at rest",
    IDLE: "carries no torque",
}
"""Meaning of each role, in words."""


def role(torques: Iterable[float], *, still: bool) -> Role:
    """Return the role of a mechanism; empty if the mechanism transmits power.

    Parameters
    ----------
    torques : iterable of float
        All torques that the mechanism carries, without and with losses; NaN if unknown. [-]
    still : bool
        True if the mechanism has no internal motion.

    Examples
    --------
    >>> role([0.0, 0.0], still=True), role([-2.1, 1.0], still=True), role([1.0], still=False)
    ('unloaded', 'locked up', '')
    """
    if all(torque == 0 for torque in torques):
        return IDLE
    return ONE_PIECE if still else ""


def roles(results: Results, number: int) -> list[Role]:
    """Return the role of each device in a gear, given the index of the gear.

    Roles are empty if the gear has no torques.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> elements = [ShiftElement(2, 0, "B"), ShiftElement(1, 2, "C")]
    >>> case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> [roles(solve(case), number) for number in range(2)]
    [[''], ['locked up']]
    """
    case = results.case
    if not results.calculable[number]:
        return [""] * len(case.own_devices)
    speeds = results.speeds[number].tolist()
    sides = [device_torques(case, results.in_own_unit("torques")[number].tolist())]
    if results.consistent[number]:
        lossy = results.in_own_unit("lossy_torques")[number].tolist()
        sides.append(device_torques(case, lossy))
    device_roles = []
    for device, idle, *torques in zip(case.own_devices, results.idle[number], *sides, strict=True):
        links = [member.link for member in device.members]
        # All members of a shaft with ratio 1 rotate at the same speed although the shaft transmits
        # power. Such a shaft is locked up only if it is idle.
        still = _may_turn(links) and bool(idle) and is_one_piece(device, speeds)
        device_roles.append(role((torque for side in torques for torque in side), still=still))
    return device_roles


def mechanism_roles(state: GearState) -> list[Role]:
    """Return the role of each mechanism of the solver, from the state of a gear."""
    places = state.case.among_devices
    if not state.calculable:
        return [""] * len(state.case.mechanisms)
    torques = [state.torques.on_first_link[places], state.lossy_torques.on_first_link[places]]
    by_mechanism = zip(*torques[: 1 + state.consistent], strict=True)
    return [
        role(map(plain, carried), still=_may_turn(mechanism.links) and bool(motion == 0))
        for mechanism, motion, carried in zip(
            state.case.mechanisms, state.relative_speeds, by_mechanism, strict=True
        )
    ]


def _may_turn(links: Sequence[int]) -> bool:
    """Return whether a device connects at least two rotating links; False for a support."""
    return len({*links} - {HOUSING}) > 1


def device_torques(case: Transmission, torques: Sequence[float]) -> Iterator[list[float]]:
    """Yield the torques of each device from an array row: on the first link, or on the members."""
    behind_elements = iter(torques[len(case.shift_elements) :])
    for device in case.own_devices:
        yield list(islice(behind_elements, 1 if case.drawing is None else len(device.members)))
