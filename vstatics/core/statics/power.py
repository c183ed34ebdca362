"""Power: torque times speed; what ports and devices exchange with their links."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics.traced import Number
from vstatics.core.statics.matrix import external_torques, held_links
from vstatics.core.statics.torques import Drag, Torques, times

DeviceKind = Literal["element", "mechanism", "spring", "port", "drag"]
"""`element`: a shift element; `mechanism`: also a drawn element; `drag`: of a link."""


class LinkPower(NamedTuple):
    """The power that a link gives to a member of a device; below 0 where it takes."""

    kind: DeviceKind
    number: int
    """Of the shift element, mechanism or drawn element, spring, of the link of a port or drag."""
    name: str
    member: str
    """Nothing for ports and drag of links, which have one link only."""
    link: int
    power: Number
    """NaN where it is not determined. [-]"""


power = times
"""Torque times speed, or power times a share."""


def port_torques(
    case: Transmission, gear: Gear, holding: Mapping[int, Number], output_torque: Number
) -> dict[int, Number]:
    """Link -> all external torque on it [-], also that of the load and of what holds a speed."""
    external: dict[int, Number] = {**external_torques(case, gear), **holding}
    output = case.gear_output(gear)
    external[output] = external[output] - output_torque if output in external else -output_torque
    return external


def entering_powers(
    case: Transmission, gear: Gear, speeds: Sequence[Number], torques: Torques
) -> list[Number]:
    """By link of `port_torques`: the power of all that acts on it from outside [-].

    A torque given at the output link counts with the load; for `port_powers` they are two.
    """
    external = port_torques(case, gear, torques.holding, torques.on_first_link[-1])
    return [power(torque, speeds[link - 1]) for link, torque in external.items()]


def port_powers(
    case: Transmission, gear: Gear, speeds: Sequence[Number], torques: Torques
) -> Iterator[LinkPower]:
    """Of each link on which an external torque acts, the load apart; what enters is below 0."""
    external: dict[int, Number] = {**external_torques(case, gear)}
    for link in held_links(case, gear):
        external[link] = external.get(link, 0.0) + torques.holding[link]
    entry, output = case.gear_input(gear), case.gear_output(gear)
    for link, torque in external.items():
        name = "input" if link == entry else case.link_name(link)
        yield LinkPower("port", link, name, "", link, -power(torque, speeds[link - 1]))
    load = power(torques.on_first_link[-1], speeds[output - 1])
    yield LinkPower("port", output, "output", "", output, load)


def device_powers(  # noqa: PLR0913
    case: Transmission,
    gear: Gear,
    speeds: Sequence[Number],
    torques: Torques,
    *,
    members: Sequence[Mapping[str, Number]],
    drag: Drag,
) -> Iterator[LinkPower]:
    """Of each member of engaged or dragging shift elements, of mechanisms, and of springs.

    Parameters
    ----------
    members : sequence of mapping
        By mechanism or drawn element: the torques that links give to its members. [-]
    """
    with_housing = [0.0, *speeds]
    for number, element in enumerate(case.shift_elements, 1):
        dragging = drag.elements.get(number - 1)
        if number not in gear.engaged and dragging is None:
            continue
        torque = torques.on_first_link[number - 1] if dragging is None else dragging
        for member, link, own in (
            ("first", element.first, torque),
            ("second", element.second, -torque),
        ):
            given = 0.0 if link == HOUSING else power(own, with_housing[link])
            yield LinkPower("element", number, element.name, member, link, given)
    for number, (device, own_torques) in enumerate(zip(case.own_devices, members, strict=True), 1):
        for one in device.members:
            given = power(own_torques[one.name], with_housing[one.link]) if one.link else 0.0
            yield LinkPower("mechanism", number, device.name, one.name, one.link, given)
    first = len(case.shift_elements) + len(case.mechanisms)
    for number, spring in enumerate(case.springs, 1):
        torque = torques.on_first_link[first + number - 1]
        for link, part in spring.form.items():
            given = power(part * torque, with_housing[link])
            yield LinkPower("spring", number, spring.name, case.link_name(link), link, given)


def drag_powers(case: Transmission, speeds: Sequence[Number], drag: Drag) -> Iterator[LinkPower]:
    """Of each link that is braked by its own drag."""
    for link, torque in drag.links.items():
        name = case.link_name(link)
        yield LinkPower("drag", link, name, "", link, -power(torque, speeds[link - 1]))
