"""Ports: links through which power enters and leaves a gear, and the losses between them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.power import power
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import port_torques

Way = Literal["in", "out", ""]
"""Direction of power at a port; empty without power, or if the power is unknown."""


class Port(NamedTuple):
    """Link with an external torque, from an engine, motor, brake or driven load."""

    link: int
    is_output: bool
    speed: float
    """Speed of the link, relative to the input speed. [-]"""
    torque: float
    """External torque on the link, but on an output the torque that the output gives to the load.
    [-]

    NaN if indeterminate.
    """
    power: float
    """Magnitude of the power that passes the port. [-]"""
    way: Way


class GearPorts(NamedTuple):
    """Ports and losses of a gear. The sum of the losses is input power minus output power."""

    ports: Sequence[Port]
    """Ports in the order: input, outputs, other links with a prescribed speed or torque."""
    meshes: float
    """Power lost in mechanisms other than variators and converters. [-]"""
    drag: float
    """Power lost to drag. [-]"""
    gear: float
    """Power loss measured for the whole gear (`Gear.loss`). [-]"""
    by_kind: Mapping[str, float]
    """Power lost in variators and in converters, if the case has any. [-]"""
    slips: Mapping[int, float]
    """Power lost in each shift element with a prescribed slip, by number. [-]"""


def ports(state: GearState) -> GearPorts:
    """Return the ports of a gear with losses.

    Speeds are relative to the input speed, torques to the input torque, powers to the input power.
    Torques and powers are NaN if the torques do not balance or the gear is self-locking.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
        >>> gear_ports = ports(solve(case).gear(1))
        >>> [(p.link, round(p.torque, 3), round(p.power, 3), p.way) for p in gear_ports.ports]
        [(1, 1.0, 1.0, 'in'), (3, 3.4, 0.971, 'out')]
        >>> round(gear_ports.meshes, 3), gear_ports.drag
        (0.029, 0.0)
    """
    case, gear, direction = state.case, state.gear, state.ideal.direction
    torques = state.lossy_torques
    acting = port_torques(case, gear, torques.holding, torques.on_first_link[-1])
    ends = [case.gear_input(gear), case.gear_output(gear)]
    stands = state.calculable and state.consistent
    outputs = {ends[1], *case.further_outputs(gear)}
    ports_of_gear = []
    for link in dict.fromkeys([*ends, *case.further_outputs(gear), *sorted(acting)]):
        torque = plain(acting.get(link, 0.0)) if stands else math.nan
        speed = plain(state.speeds[link - 1])
        entering = direction * plain(power(torque, speed))
        port_torque = -torque + 0.0 if link in outputs else torque
        ports_of_gear.append(
            Port(link, link in outputs, speed, port_torque, abs(entering), _way(entering))
        )
    losses: dict[str, list[float]] = {"": []}
    for mechanism, loss in zip(case.mechanisms, state.mechanism_losses, strict=True):
        losses.setdefault(mechanism.kind, []).append(plain(loss))
    lost = {kind: direction * math.fsum(each) + 0.0 for kind, each in losses.items()}
    drag = direction * plain(state.search.lossy.drag_losses) + 0.0
    whole = direction * plain(state.search.lossy.gear_losses) + 0.0
    slips = {n: direction * plain(state.search.lossy.slip_losses[n - 1]) + 0.0 for n in gear.slip}
    return GearPorts(ports_of_gear, lost.pop(""), drag, whole, lost, slips)


def _way(entering: float) -> Way:
    if math.isnan(entering) or abs(entering) <= NO_POWER:
        return ""
    return "in" if entering > 0 else "out"
