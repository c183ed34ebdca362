"""Rolling power: the power through the meshes of a mechanism, relative to its carrier.

Rolling power can be a small fraction or a multiple of the power through the mechanism. The losses
of a mechanism are a fraction of its rolling power, equation (2) of docs/method.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.elements.drawing import parts_of
from vstatics.core.elements.kinds import Simple
from vstatics.core.elements.lower import DrawnPart
from vstatics.core.flow.circulation import Node
from vstatics.core.model.parts import OwnDevice
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.efficiency import lossy_ratio
from vstatics.core.statics.power import power
from vstatics.core.statics.state import GearState
from vstatics.core.tables.answer import Flat


class ToothPower(NamedTuple):
    """Rolling power of a mechanism or a mesh, relative to the carrier."""

    device: Flat[Node]
    mesh: str
    """Names of the two gears in mesh; empty for a whole mechanism or gear set."""
    power: float
    """Rolling power; NaN if indeterminate. [-]"""
    loss: float
    """Power lost. [-]"""


def tooth_powers(state: GearState, *, lossy: bool) -> Iterator[ToothPower]:
    """Yield the rolling power of each mechanism or drawn gear set, and of each mesh.

    A mechanism loses the fraction ``1 - efficiency`` of its rolling power. Nothing is yielded for
    shafts, belts, held links, variators and converters, which have no teeth.
    """
    case = state.case
    for number, (part, device) in enumerate(zip(parts_of(case), case.own_devices, strict=True), 1):
        if not device.mechanisms or not _has_teeth(part):
            continue
        node = Node("mechanism", number, device.name)
        meshes = [(index, *_of_mechanism(state, index, lossy=lossy)) for index in device.mechanisms]
        if len(meshes) == 1:
            yield ToothPower(node, "", *meshes[0][1:])
            continue
        lost = sum(loss for *_, loss in meshes)
        yield ToothPower(node, "", _of_wheels(state, number, device, lossy=lossy), lost)
        for index, entering, loss in meshes:
            name = case.mechanisms[index].name.removeprefix(f"{device.name}.")
            yield ToothPower(node, name, entering, loss)


def _has_teeth(part: DrawnPart) -> bool:
    if part.element is None:
        return not any(lowered.mechanism.kind for lowered in part.lowered)
    shape = part.element.shape
    return not isinstance(shape, Simple) or (bool(shape.toothed) and shape.size == "teeth")


def _of_mechanism(state: GearState, index: int, *, lossy: bool) -> tuple[float, float]:
    """Return the rolling power that enters at the first or second link, and the loss [-]."""
    torques = state.lossy_torques if lossy else state.torques
    torque = torques.on_first_link[len(state.case.shift_elements) + index]
    by_first = state.ideal.direction * plain(power(torque, state.relative_speeds[index]))
    if not lossy:
        return abs(by_first), 0.0
    efficiency, sign = state.ideal.variant.efficiencies[index], state.signs[index]
    loss = state.ideal.direction * plain(state.mechanism_losses[index]) + 0.0
    by_second = -plain(power(by_first, lossy_ratio(1.0, efficiency, sign)))
    return (by_second if by_first < 0 else by_first), loss


def _of_wheels(state: GearState, number: int, device: OwnDevice, *, lossy: bool) -> float:
    """Return the rolling power that enters a gear set through its central gears [-]."""
    speeds = [0.0, *map(plain, state.speeds)]
    carrier = state.case.mechanisms[device.mechanisms[0]].third
    torques = state.member_torques(lossy=lossy)[number - 1]
    wheels = (member for member in device.members if {place for _, place in member.places} != {2})
    powers_of_wheels = [
        state.ideal.direction
        * plain(power(plain(torques[member.name]), speeds[member.link] - speeds[carrier]))
        for member in wheels
    ]
    return sum(member for member in powers_of_wheels if not member < 0) + 0.0
