"""Scheme of a case for diagrams (links, components and ports), and its state in a gear."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from typing import NamedTuple

from vstatics.core.elements.drawing import parts_of
from vstatics.core.elements.element import Element
from vstatics.core.errors import CaseError
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.parts import ELEMENT_KINDS
from vstatics.core.model.springs import Spring, TwistCurve, ends
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.statics.roles import ONE_PIECE
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.gear_state import PictureState

MOST_DEVICES = 200
"""Largest number of components in a diagram. The largest diagram takes about ten seconds."""


class Device(NamedTuple):
    """Component of a scheme: a mechanism, gear set, spring or shift element, with the links."""

    name: str
    kind: str
    """Kind: ``mechanism``, ``spring``, or the kind of a gear set or shift element."""
    members: dict[str, int]
    """Link of each member; 0 is the housing."""
    numbers: tuple[int, ...]
    """Indices of the component's mechanisms, or the index of the shift element or spring."""
    element: Element | None = None
    """Gear set with teeth, if the case gives teeth."""
    ratio: float = math.nan
    """Basic ratio of a mechanism; NaN if not given. [-]"""
    labels: Mapping[str, str] = EMPTY
    """Texts that differ from the names of members, by the member."""
    has_gap: bool = False
    """True for an elastic component with play, such as a spring or an elastic dog clutch."""

    @property
    def is_shift_element(self) -> bool:
        """True for a shift element."""
        return self.kind in ELEMENT_KINDS

    @property
    def is_coupling(self) -> bool:
        """True for a component drawn on a line between two links, or to the housing."""
        is_shaft = self.kind == "spring" and "second" in self.members
        return is_shaft or self.is_shift_element or self.kind == "held"

    @property
    def sign(self) -> str:
        """Kind that determines the symbol: ``play`` for a component with play, else `kind`."""
        return "play" if self.has_gap else self.kind

    @property
    def links(self) -> set[int]:
        """Numbers of the connected links, without the housing."""
        return set(self.members.values()) - {HOUSING}

    @property
    def is_on_housing(self) -> bool:
        """True for a component between a link and the housing: a brake, a support, or a spring."""
        return self.is_coupling and len(self.links) == 1


class SchemePort(NamedTuple):
    """Port: link at which power enters or leaves the picture."""

    link: int
    role: str
    """Role of the port in a gear or in the picture.

    Roles in a gear are ``input``, ``output``, and ``given`` (link with given speed or torque). The
    roles ``before`` and ``behind`` mean that the link continues in an earlier or later row.
    """

    @property
    def is_left(self) -> bool:
        """True for a port at the left end of the picture."""
        return self.role in ("input", "before")

    @property
    def is_further(self) -> bool:
        """True if the link continues in a further row of the picture."""
        return self.role in ("before", "behind")


@dataclass(frozen=True)
class SchemeState:
    """State of the components of a scheme in a gear; empty without a gear."""

    engaged: AbstractSet[int] = frozenset()
    """Indices of the engaged components in `Scheme.devices`."""
    idle: AbstractSet[int] = frozenset()
    """Indices of components that are released or carry no torque, drawn pale."""
    pieces: AbstractSet[int] = frozenset()
    """Indices of components that carry torque but rotate as a block."""
    loaded: Sequence[AbstractSet[int]] | None = None
    """Links on which each component exerts a torque; None without a gear."""
    idle_links: AbstractSet[int] = frozenset()
    idle_ports: AbstractSet[SchemePort] = frozenset()
    leaving: Mapping[SchemePort, bool] = field(default_factory=dict)
    """Whether power leaves at each port with known power; False if power enters."""
    slipping: AbstractSet[int] = frozenset()
    """Indices of the engaged components that slip under torque."""

    def is_closed(self, index: int) -> bool:
        """Return whether a component is engaged and does not slip."""
        return index in self.engaged and index not in self.slipping


@dataclass(frozen=True)
class Scheme:
    """Scheme: links, components and ports of a case for a diagram. Planets are not links."""

    links: Sequence[str]
    devices: Sequence[Device]
    ports: Sequence[SchemePort]

    def name(self, link: int) -> str:
        """Return the name of a link."""
        return self.links[link - 1]


def scheme_of(case: Transmission) -> Scheme:
    """Return the links, components and ports of a case.

    Raises
    ------
    CaseError
        If there are too many components for the search for an arrangement.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> [(device.name, device.members) for device in scheme_of(case).devices]
    [('D1', {'first': 1, 'second': 2, 'third': 3}), ('T1', {'first': 2, 'second': 0})]
    """
    devices = [
        *_mechanisms(case),
        *_shift_elements(case.shift_elements),
        *(_spring(number, spring, case) for number, spring in enumerate(case.springs)),
    ]
    if len(devices) > MOST_DEVICES:
        message = f"this picture shows up to {MOST_DEVICES} components"
        raise CaseError("E409", f"{message}; this case has {len(devices)}")
    ports = dict.fromkeys(
        port
        for gear in case.gears or [Gear()]
        for port in _ports(
            case.gear_input(gear), [case.gear_output(gear), *case.further_outputs(gear)], gear
        )
    )
    ends = {port.link for port in ports if port.role != "given"}
    shown = [port for port in ports if port.role != "given" or port.link not in ends]
    return Scheme(case.link_names[: case.own_links], devices, shown)


RATIO_SIGN = "u = "
"""Sign before a basic ratio."""


def ratio_text(ratio: float) -> str:
    """Return a basic ratio as a text for pictures.

    >>> ratio_text(-2.4610)
    'u = −2.461'
    """
    return typeset(f"{RATIO_SIGN}{ratio:.5g}")


def _mechanisms(case: Transmission) -> list[Device]:
    devices: list[Device] = []
    number = 0
    for part in parts_of(case):
        numbers = tuple(range(number, number + len(part.lowered)))
        number += len(part.lowered)
        if part.element is None:
            mechanism = part.lowered[0].mechanism
            shape = _shape_of(mechanism)
            devices.append(Device(part.name, *shape, numbers, ratio=mechanism.ratio))
        else:
            kind = part.element.kind
            devices.append(Device(part.name, kind, part.members, numbers, part.element))
    return devices


def _shape_of(mechanism: Mechanism) -> tuple[str, dict[str, int]]:
    """Return the kind and members with which to draw a mechanism that is given without teeth."""
    if mechanism.second == mechanism.third == HOUSING:
        return "held", {"link": mechanism.first}
    links = mechanism.links if mechanism.third else mechanism.links[:2]
    members = dict(zip(("first", "second", "third"), links, strict=False))
    return mechanism.kind or "mechanism", members


def _shift_elements(elements: Sequence[ShiftElement]) -> list[Device]:
    return [
        Device(
            element.name,
            element.kind or ("clutch" if element.first and element.second else "brake"),
            {"first": element.first, "second": element.second},
            (number,),
            has_gap=element.kind == "dog_clutch" and element.stiffness is not None,
        )
        for number, element in enumerate(elements)
    ]


def _spring(number: int, spring: Spring, case: Transmission) -> Device:
    """Return a spring: a shaft if two links define its twist, else a box with coefficients."""
    shaft = ends(spring.twist)
    if shaft is not None:
        members = dict(zip(("first", "second"), shaft, strict=True))
        has_gap = isinstance(spring.curve, TwistCurve) and spring.curve.has_play
        has_gap &= not spring.is_damper
        return Device(spring.name, "spring", members, (number,), has_gap=has_gap)
    members = {case.link_name(link): link for link in spring.form}
    labels = {case.link_name(link): f"×{part:.5g}" for link, part in spring.form.items()}
    return Device(spring.name, "spring", members, (number,), labels=labels)


def _ports(first: int, outputs: Sequence[int], gear: Gear) -> list[SchemePort]:
    further = dict.fromkeys([*gear.speeds, *gear.torques])
    return [
        SchemePort(first, "input"),
        *(SchemePort(link, "output") for link in outputs),
        *(SchemePort(link, "given") for link in further),
    ]


def scheme_state(scheme: Scheme, state: PictureState) -> SchemeState:
    """Return the state of a scheme in a gear: engaged, unloaded and locked-up components, links."""
    engaged: set[int] = set()
    idle: set[int] = set()
    pieces: set[int] = set()
    loaded: list[set[int]] = []
    ports = _ports(state.input, state.outputs, state.gear)
    ends = [port.link for port in ports]
    for place, device in enumerate(scheme.devices):
        if device.is_shift_element:
            (engaged if device.numbers[0] + 1 in state.gear.carrying else idle).add(place)
            links = device.links if state.loaded_elements[device.numbers[0]] else set()
        elif device.kind == "spring":
            links = device.links if state.loaded_springs[device.numbers[0]] else set()
        else:
            links = device.links & state.loaded_links[place]
            if links and state.roles[place] == ONE_PIECE:
                pieces.add(place)
        if not (links or device.is_shift_element):
            idle.add(place)
        loaded.append(links)
        ends += links
    pale = {link for link in range(1, len(scheme.links) + 1) if ends.count(link) < 2}
    used = {port.link for port in ports}
    unused = {port for port in scheme.ports if port.link not in used}
    powers = {port: state.leaving.get(port, 0.0) for port in ports}
    ways = {port: power > 0 for port, power in powers.items() if abs(power) > 0}
    slipping = {
        place for place in engaged if scheme.devices[place].numbers[0] + 1 in state.gear.slipping
    }
    return SchemeState(engaged, idle, pieces, loaded, pale, unused, ways, slipping)
