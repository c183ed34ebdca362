"""Tooth power: what goes through the meshes of a mechanism, seen from its carrier.

It may be a small part of the power through the mechanism or many times as much, and it
is what losses are a part of: equation (2) of docs/method.md.
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
    """What enters the teeth of a mechanism or of one mesh, against the carrier."""

    device: Flat[Node]
    mesh: str
    """Its two wheels; nothing for a mechanism or a drawn element as a whole."""
    power: float
    """NaN where it is not determined. [-]"""
    loss: float
    """[-]"""


def tooth_powers(state: GearState, *, lossy: bool) -> Iterator[ToothPower]:
    """Of each mechanism or drawn element, and of the mechanisms or meshes that it became.

    A mechanism with losses loses the part ``1 - efficiency`` of it. An element without
    teeth (shaft, belt, held link) has none, nor has a variator or converter.
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
        return not any(one.mechanism.kind for one in part.lowered)
    shape = part.element.shape
    return not isinstance(shape, Simple) or (bool(shape.toothed) and shape.size == "teeth")


def _of_mechanism(state: GearState, index: int, *, lossy: bool) -> tuple[float, float]:
    """What enters a mechanism by its first or by its second link, and its loss."""
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
    """What enters an element by its central wheels, seen from the carrier that they share."""
    speeds = [0.0, *map(plain, state.speeds)]
    carrier = state.case.mechanisms[device.mechanisms[0]].third
    torques = state.member_torques(lossy=lossy)[number - 1]
    wheels = (one for one in device.members if {place for _, place in one.places} != {2})
    found = [
        state.ideal.direction
        * plain(power(plain(torques[one.name]), speeds[one.link] - speeds[carrier]))
        for one in wheels
    ]
    return sum(one for one in found if not one < 0) + 0.0
