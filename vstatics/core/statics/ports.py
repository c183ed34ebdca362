"""Ports: the links through which power enters and leaves a gear, and what is lost between."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.power import port_torques, power
from vstatics.core.statics.state import GearState

Way = Literal["in", "out", ""]
"""Whether power enters or leaves by a port; nothing where it has none, or it is unknown."""


class Port(NamedTuple):
    """A link on which something acts from outside: engine, motor, brake of a test bench, load."""

    link: int
    is_output: bool
    speed: float
    """[-]"""
    torque: float
    """Of an output: that which it gives to its load; of another link: that which acts on it.
    NaN where it is not determined. [-]"""
    power: float
    """That passes it, never below 0. [-]"""
    way: Way


class GearPorts(NamedTuple):
    """All ports of a gear and its losses: what enters less what leaves is lost."""

    ports: Sequence[Port]
    """The input, the outputs, then those with a given speed or torque."""
    meshes: float
    """Power lost in the mechanisms that are no variators or converters. [-]"""
    drag: float
    """Power lost to drag. [-]"""
    by_kind: Mapping[str, float]
    """Power lost in the variators and in the converters of a case that has such. [-]"""


def ports(state: GearState) -> GearPorts:
    """The ports of a gear with losses; without them where they do not exist.

    Speeds and torques are relative to those of the input, powers to that at the input link.
    Torques that do not balance, as in neutral, or that friction holds, pass no power.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
    >>> found = ports(solve(case).gear(1))
    >>> [(one.link, round(one.torque, 3), round(one.power, 3), one.way) for one in found.ports]
    [(1, 1.0, 1.0, 'in'), (3, 3.4, 0.971, 'out')]
    >>> round(found.meshes, 3), found.drag
    (0.029, 0.0)
    """
    case, gear, direction = state.case, state.gear, state.ideal.direction
    torques = state.lossy_torques
    acting = port_torques(case, gear, torques.holding, torques.on_first_link[-1])
    ends = [case.gear_input(gear), case.gear_output(gear)]
    stands = state.calculable and state.consistent
    outputs = {ends[1], *case.further_outputs(gear)}
    found = []
    for link in dict.fromkeys([*ends, *case.further_outputs(gear), *sorted(acting)]):
        torque = plain(acting.get(link, 0.0)) if stands else math.nan
        speed = plain(state.speeds[link - 1])
        entering = direction * plain(power(torque, speed))
        own = -torque + 0.0 if link in outputs else torque
        found.append(Port(link, link in outputs, speed, own, abs(entering), _way(entering)))
    losses: dict[str, list[float]] = {"": []}
    for one, loss in zip(case.mechanisms, state.mechanism_losses, strict=True):
        losses.setdefault(one.kind, []).append(plain(loss))
    lost = {kind: direction * math.fsum(each) + 0.0 for kind, each in losses.items()}
    drag = direction * plain(state.search.lossy.drag_losses) + 0.0
    return GearPorts(found, lost.pop(""), drag, lost)


def _way(entering: float) -> Way:
    """By the power that enters, relative to that at the input link."""
    if math.isnan(entering) or abs(entering) <= NO_POWER:
        return ""
    return "in" if entering > 0 else "out"
