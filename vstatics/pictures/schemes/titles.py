"""Tooltips of components and links of a scheme."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.elements.element import Element
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.gear_state import PictureState
from vstatics.pictures.drawing.style import Style, number
from vstatics.pictures.drawing.words import quantity, word
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text


class Titles(NamedTuple):
    """Tooltips of components by index, and of links by number; empty where missing."""

    devices: Mapping[int, str] = {}
    links: Mapping[int, str] = {}


def titles_of(
    results: Results, scheme: Scheme, style: Style, gear: int | None, state: PictureState | None
) -> Titles:
    """Return the tooltips: kind, teeth, ratio and, in a gear, relative speeds and torques.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.pictures.schemes.scheme import scheme_of
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> titles_of(solve(case), scheme_of(case), Style(), None, None).devices[0]
    'D1: mechanism, u = −2; first = 1, second = 2, third = 3'
    """
    torques = iter(() if gear is None else _torques(results, gear))
    devices = []
    for device in scheme.devices:
        facts = ", ".join(filter(None, _facts(results.case, device, style)))
        joins = ", ".join(
            f"{word(member, style)} = {scheme.name(link) if link else style.text('housing')}"
            for member, link in device.members.items()
        )
        nonzero = {member: value for member, value in next(torques, {}).items() if value}
        carried = f"{style.text('torque')} " if nonzero else ""
        carried += ", ".join(
            f"{word(member, style)} {number(value)}".strip() for member, value in nonzero.items()
        )
        devices.append(f"{device.name}: {'; '.join(filter(None, (facts, joins, carried)))}")
    links = dict(enumerate(scheme.links, 1))
    if state is not None:
        speeds = {link: quantity("speed", state.speeds[link], style) for link in links}
        links = {link: f"{name}: {speeds[link]}" for link, name in links.items()}
    return Titles(dict(enumerate(devices)), links)


def _facts(case: Transmission, device: Device, style: Style) -> Iterator[str]:
    yield word(device.kind, style)
    if device.element is not None:
        yield from (
            f"{word(gear, style)} {teeth:g}" for gear, teeth in teeth_of(device.element).items()
        )
    is_mechanism = not device.is_coupling and device.kind != "spring"
    if is_mechanism and len(device.numbers) == 1:
        mechanism = case.mechanisms[device.numbers[0]]
        yield from [] if mechanism.kind else [ratio_text(mechanism.ratio)]


def teeth_of(element: Element) -> dict[str, float]:
    """Return the tooth numbers of central gears and planet gears by name.

    >>> teeth_of(Element("P", "planetary", {"sun": 1}, {"sun": 30, "ring": 75}))
    {'sun': 30, 'ring': 75}
    """
    rims = {rim: float(count) for gears in element.rims.values() for rim, count in gears.items()}
    return {**element.teeth, **{wheel.member: wheel.teeth for wheel in element.wheels}, **rims}


def _torques(results: Results, gear: int) -> Iterator[dict[str, float]]:
    state = results.gear_at(gear - 1)
    for members in state.member_torques(lossy=False):
        yield {name: plain(torque) for name, torque in members.items()}
    values, devices = state.torques.on_first_link, results.case.among_devices
    for torque in (*values[: devices.start], *values[devices.stop : -1]):
        yield {"": plain(torque)}
