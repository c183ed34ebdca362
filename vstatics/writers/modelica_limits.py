"""What a case has that its Modelica model does not."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.elements.drawing import drawing_of
from vstatics.errors import listed
from vstatics.model.parts import damping
from vstatics.model.springs import Spring
from vstatics.model.transmission import Mechanism, Transmission

SHOWN = 20
"""Names of a kind that are told."""


def lost(case: Transmission) -> list[str]:
    """What is left out, or is not the same; each with its names.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> pair = Mechanism(1, 2, 0, -2.5, 0.98, name="pair")
    >>> lost(Transmission(2, [], [pair], [Gear(torques={}, drag={1: 0.1}, name="low")]))
    ['the losses of pair', 'drag in gear low']
    """
    found = [f"{what} {listed(names, SHOWN)}" for what, names in _of_parts(case) if names]
    return [*found, *_of_case(case)]


def _of_parts(case: Transmission) -> Iterator[tuple[str, list[str]]]:
    elements, mechanisms = case.shift_elements, case.mechanisms
    lossy = [one for one in mechanisms if one.efficiency != 1 or one.back_efficiency is not None]
    # of mechanisms that were made from elements the names are those of the elements
    owner = {
        mechanisms[index].name: device.name
        for device in case.own_devices
        for index in device.mechanisms
    }
    yield "the losses of", [*dict.fromkeys(owner.get(one.name, one.name) for one in lossy)]
    yield "the drag of", [one.name for one in elements if one.drag]
    yield "the stiffness of", [one.name for one in elements if one.stiffness is not None]
    told = bool(case.load and case.load.torque)
    relative = [one for one in elements if one.capacity is not None and not told]
    unknown = [one.name for one in relative if not hasattr(one.capacity, "given")]
    yield "the capacity, by a torque that no load tells, of", unknown
    yield "the jump of speeds of", [one.name for one in elements if one.kind == "dog_clutch"]
    warmed = [one.name for one in elements if one.pack and one.pack.table]
    yield "the coefficient of friction by temperature of", warmed
    yield "the limit of", [one.name for one in case.springs if one.limit is not None]
    yield "the converter", [one.name for one in case.converters]
    yield "the points of", [one.name for one in case.springs if one.points]
    yield "the strut of", [one.name for one in case.springs if one.strut]
    yield "the mass of", [case.link_name(link) for link, one in case.masses.items() if one]
    yield "the friction of", [one.name for one in case.springs if one.friction]
    elastic: list[Spring | Mechanism] = [*case.springs, *mechanisms]
    yield "the loss factor of", [one.name for one in elastic if damping(one.damping).loss_factor]
    yield "the drag of link", [case.link_name(link) for link, drag in case.drag.items() if drag]
    yield "drag in gear", [one.name for one in case.gears if one.drag or one.open_drag]
    given = [one.name for one in case.gears if one.speeds or one.torques]
    yield "given speeds and torques in gear", given
    yield (
        "the input or output of its own of gear",
        [one.name for one in case.gears if one.input or one.output],
    )


def _of_case(case: Transmission) -> Iterator[str]:
    if case.load is not None or any(gear.load for gear in case.gears):
        yield "the load"
    drawing = drawing_of(case)
    if drawing and drawing.elements:
        yield "teeth: elements are mechanisms of their ratios"
    if any(map(case.coasts, case.gears)):
        yield "that power enters at the output"
    if case.vehicle is not None:
        yield "the vehicle"
    if case.cylinders is not None:
        yield "the cylinders"
    if case.dump is not None:
        yield "the clutch that is dumped"
    if case.fatigue:
        yield "fatigue strengths"
