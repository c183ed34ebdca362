"""What a mechanism does in a gear that is no transmission of power: the words for it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Literal

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.bodies import is_one_piece
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import GearState

Role = Literal["", "idle", "one piece"]
IDLE: Role = "idle"
"""It carries no torque."""
ONE_PIECE: Role = "one piece"
"""It carries torque, and nothing in it moves: it turns, or stands, as one piece."""
MEANINGS = {ONE_PIECE: "carries torque, nothing in it moves", IDLE: "carries no torque"}


def role(torques: Iterable[float], *, still: bool) -> Role:
    """What a mechanism does, or nothing where it transmits power.

    Parameters
    ----------
    torques : iterable of float
        All that it carries, without and with losses; NaN is one that is not known. [-]
    still : bool
        Whether nothing in it moves.

    Examples
    --------
    >>> role([0.0, 0.0], still=True), role([-2.1, 1.0], still=True), role([1.0], still=False)
    ('idle', 'one piece', '')
    """
    if all(torque == 0 for torque in torques):
        return IDLE
    return ONE_PIECE if still else ""


def roles(results: Results, number: int) -> list[Role]:
    """What each device of one case does in a gear, by its index; nothing where no flow exists.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> elements = [ShiftElement(2, 0, "B"), ShiftElement(1, 2, "C")]
    >>> case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> [roles(solve(case), number) for number in range(2)]
    [[''], ['one piece']]
    """
    case = results.case
    if not results.calculable[number]:
        return [""] * len(case.own_devices)
    speeds = results.speeds[number].tolist()
    sides = [device_torques(case, results.in_own_unit("torques")[number].tolist())]
    if results.consistent[number]:
        lossy = results.in_own_unit("lossy_torques")[number].tolist()
        sides.append(device_torques(case, lossy))
    found = []
    for device, idle, *torques in zip(case.own_devices, results.idle[number], *sides, strict=True):
        links = [member.link for member in device.members]
        # a shaft of ratio 1 turns alike, too, but against the housing
        still = _may_turn(links) and bool(idle) and is_one_piece(device, speeds)
        found.append(role((torque for side in torques for torque in side), still=still))
    return found


def mechanism_roles(state: GearState) -> list[Role]:
    """The same of each mechanism that the solver knows, by the state of a gear."""
    places = state.case.among_devices
    if not state.calculable:
        return [""] * len(state.case.mechanisms)
    torques = [state.torques.on_first_link[places], state.lossy_torques.on_first_link[places]]
    by_mechanism = zip(*torques[: 1 + state.consistent], strict=True)
    return [
        role(map(plain, carried), still=_may_turn(one.links) and bool(motion == 0))
        for one, motion, carried in zip(
            state.case.mechanisms, state.relative_speeds, by_mechanism, strict=True
        )
    ]


def _may_turn(links: Sequence[int]) -> bool:
    """Whether a device is more than a support, which holds one link and never turns."""
    return len({*links} - {HOUSING}) > 1


def device_torques(case: Transmission, torques: Sequence[float]) -> Iterator[list[float]]:
    """The torques of each device among those of an array: on its first link, or its members."""
    rest = iter(torques[len(case.shift_elements) :])
    for device in case.own_devices:
        yield list(islice(rest, 1 if case.drawing is None else len(device.members)))
