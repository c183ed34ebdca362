"""Power (torque times speed) that links exchange with ports and devices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

from vstatics.core.model.transmission import HOUSING, Gear, ShiftElement, Transmission
from vstatics.core.named_tuple import NamedTuple
from vstatics.core.numerics.traced import Number
from vstatics.core.statics.matrix import external_torques, held_links
from vstatics.core.statics.torques import Drag, Torques, times

DeviceKind = Literal["element", "mechanism", "spring", "port", "drag", "gear"]
"""Kind of a device.

`mechanism` includes drawn gear sets, `drag` is the drag of a link, and `gear` the loss `Gear.loss`.
"""


class LinkPower(NamedTuple):
    """Power that a link gives to a member of a device, negative if the link receives power."""

    kind: DeviceKind
    number: int
    """Number of the shift element, mechanism, drawn gear set or spring, or of the port's link."""
    name: str
    member: str
    """Name of the member; empty for ports and drag of links."""
    link: int
    power: Number
    """Power relative to the input power; NaN if indeterminate. [-]"""


power = times
"""Function that returns the power of a torque and a speed; 0 if either is 0."""


def port_powers(
    case: Transmission, gear: Gear, speeds: Sequence[Number], torques: Torques
) -> Iterator[LinkPower]:
    """Yield the power that links give to external torques and the load, negative if entering."""
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
    """Yield the power of members of shift elements, mechanisms and springs.

    Shift elements are included if they carry torque or drag.

    Parameters
    ----------
    members : sequence of mapping
        Torques that links give to the members of each mechanism or drawn gear set. [-]
    """
    with_housing = [0.0, *speeds]
    for number, element in enumerate(case.shift_elements, 1):
        dragging = drag.elements.get(number - 1)
        if number not in gear.carrying and dragging is None:
            continue
        torque = torques.on_first_link[number - 1] if dragging is None else dragging
        for member, link, torque_on_member in (
            ("first", element.first, torque),
            ("second", element.second, -torque),
        ):
            given = 0.0 if link == HOUSING else power(torque_on_member, with_housing[link])
            yield LinkPower("element", number, element.name, member, link, given)
    for number, (device, own_torques) in enumerate(zip(case.own_devices, members, strict=True), 1):
        for joined_member in device.members:
            given = (
                power(own_torques[joined_member.name], with_housing[joined_member.link])
                if joined_member.link
                else 0.0
            )
            yield LinkPower(
                "mechanism", number, device.name, joined_member.name, joined_member.link, given
            )
    first = len(case.shift_elements) + len(case.mechanisms)
    for number, spring in enumerate(case.springs, 1):
        torque = torques.on_first_link[first + number - 1]
        for link, part in spring.form.items():
            given = power(part * torque, with_housing[link])
            yield LinkPower("spring", number, spring.name, case.link_name(link), link, given)


def drag_powers(
    case: Transmission, gear: Gear, speeds: Sequence[Number], drag: Drag
) -> Iterator[LinkPower]:
    """Yield the power that each link loses to drag and to `Gear.loss`."""
    for link, torque in drag.links.items():
        name = case.link_name(link)
        yield LinkPower("drag", link, name, "", link, -power(torque, speeds[link - 1]))
    for link, torque in drag.gear.items():
        name = loss_name(gear)
        yield LinkPower("gear", link, name, "", link, -power(torque, speeds[link - 1]))


def slip_name(element: ShiftElement) -> str:
    """Return the name of the slip loss of a shift element, for lists of losses."""
    return f"slip.{element.name}"


def loss_name(gear: Gear) -> str:
    """Return the name of the loss `Gear.loss`, for lists of losses."""
    return f"gear.{gear.name}"
