"""Losses of a gear under given signs of the power flow: torques, efficiency, balance.

With losses the internal ratio u of a mechanism becomes ``u * efficiency**x`` in the
torque system; x is +1 where power enters by the first link, seen from the third, and
-1 where it leaves by it (closed form of the published test: docs/method.md).
All arrays have the variants as their last axis.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics import matrix
from vstatics.arrays import Booleans, Floats, Integers
from vstatics.model import HOUSING, Gear, Transmission
from vstatics.speeds import TIE
from vstatics.torques import solve_torques


class Flow(NamedTuple):
    """A gear without losses: what decides where power enters each mechanism."""

    case: Transmission
    gear: Gear
    ratios: Floats
    efficiencies: Floats
    speeds: Floats
    """(links, variants)."""
    motion: Floats
    """(mechanisms, variants): speed of the first link against the third, 0 if a tie."""
    torques: Floats
    """(devices + 1, variants)."""
    holding: Floats
    """(links, variants)."""

    def part(self, chosen: Integers) -> Flow:
        """The flow of some variants; one may be chosen more than once."""
        arrays = [value[:, chosen] for value in self[2:]]
        return Flow(self.case, self.gear, *arrays)

    @property
    def direction(self) -> int:
        """+1, or -1 when coasting: all flows turn."""
        return -1 if self.case.coast else 1


class Lossy(NamedTuple):
    """A gear with losses under one set of signs for each variant (last axis)."""

    signs: Floats
    """(mechanisms, variants): the exponents x of the efficiencies."""
    torques: Floats
    """(devices + 1, variants). [-]"""
    holding: Floats
    """(links, variants). [-]"""
    flow: Floats
    """(mechanisms, variants): sign of the power by the first link, +1, 0, -1 or NaN."""
    losses: Floats
    """(mechanisms, variants), power. [-]"""
    efficiency: Floats
    """(variants,). [-]"""
    balance: Floats
    """(variants,): external power less losses. [-]"""
    admissible: Booleans
    """(variants,): the signs agree with the flow."""


def loaded(flow: Flow, ratios: Floats, torques: Floats, holding: Floats) -> Floats:
    """Torque on the first link of each mechanism, 0 where it is a tie.

    It is a tie when on each of its links the mechanism's torque is nothing beside the
    other torques there: so a stage of a large ratio is measured by its own links.
    """
    case, gear = flow.case, flow.gear
    elements = len(case.shift_elements)
    found: Floats = torques[elements:-1].copy()
    if _all_large(flow, ratios, torques, holding):
        return found
    columns = matrix.columns(case, ratios)
    acting: list[list[tuple[int, Floats]]] = [[] for _ in range(case.links + 1)]
    for device, column in enumerate(columns):
        for link, (value, _) in column.items():
            acting[link].append((device, np.abs(value * torques[device])))
    acting[case.gear_output(gear)].append((-1, np.abs(torques[-1])))
    for link, torque in matrix.external_torques(case, gear).items():
        acting[link].append((-1, np.full(torques.shape[1], abs(torque))))
    for link in matrix.held_links(case, gear):
        acting[link].append((-1, np.abs(holding[link - 1])))
    for number, mechanism in enumerate(case.mechanisms):
        tie = np.ones(torques.shape[1], dtype=np.bool_)
        for link in mechanism.links:
            if link != HOUSING:
                own = [size for device, size in acting[link] if device == elements + number]
                rest = [size for device, size in acting[link] if device != elements + number]
                largest = np.fmax.reduce(rest) if rest else np.zeros(torques.shape[1])
                tie &= own[0] <= TIE * largest
        found[number, tie] = 0.0
    return found


def _all_large(flow: Flow, ratios: Floats, torques: Floats, holding: Floats) -> bool:
    """Whether each torque is 0 or large beside all others, so that there can be no tie."""
    size = np.abs(torques[len(flow.case.shift_elements) : -1])
    third = np.abs(ratios - 1)
    smallest = np.minimum(np.minimum(np.abs(ratios), 1.0), np.where(third == 0, 1.0, third))
    external = max(map(abs, matrix.external_torques(flow.case, flow.gear).values()))
    acting = np.fmax(np.fmax.reduce(np.abs(torques)), np.fmax.reduce(np.abs(holding)))
    largest = np.fmax(acting * (1 + np.abs(ratios)), external)
    largest = np.fmax.reduce(largest) if largest.size else largest
    return bool(((size == 0) | (size * smallest > TIE * largest)).all())


def powers(flow: Flow, torques: Floats, holding: Floats) -> Floats:
    """Power that enters by each port: shape (links, variants); 0 where there is none."""
    case, gear = flow.case, flow.gear
    external = np.zeros_like(flow.speeds)
    for link, torque in matrix.external_torques(case, gear).items():
        external[link - 1] = torque
    for link in matrix.held_links(case, gear):
        external[link - 1] = holding[link - 1]
    external[case.gear_output(gear) - 1] -= torques[-1]
    return power(external, flow.speeds)


def power(torque: Floats, speed: Floats) -> Floats:
    """Torque times speed, or power times a share.

    It is 0 where one of them is 0, even if the other does not exist.
    """
    product: Floats = np.where((torque == 0) | (speed == 0), 0.0, torque * speed)
    return product


def _efficiency(flow: Flow, torques: Floats, entering: Floats) -> Floats:
    """Efficiency by the ports, which the flow without losses divides in two.

    With one input and one output it is ``Mx_lossy/Mx``, or its inverse when coasting.
    Otherwise power out by power in, each port on the side of its flow without losses;
    a port without any counts on neither.
    """
    if not flow.gear.speeds and not flow.gear.torques:
        ratio: Floats = torques[-1] / flow.torques[-1]
        return ratio if flow.direction > 0 else 1 / ratio
    side = powers(flow, flow.torques, flow.holding) * flow.direction
    received = np.sum(np.where(side > 0, entering, 0.0), axis=0)
    given = -np.sum(np.where(side < 0, entering, 0.0), axis=0)
    unknown = np.isnan(side).any(axis=0)
    efficiency: Floats = np.where(unknown, np.nan, given / received)
    return efficiency


def attempt(flow: Flow, signs: Floats) -> Lossy:
    """Torques with losses under given signs, and whether the signs agree with the flow.

    A set of signs is admissible when the loss of every mechanism is not negative, which
    is the same as: its sign is that of its flow, or its flow is 0; and when the
    efficiency is above 0 (where there is one without losses).
    """
    ratios = flow.ratios * flow.efficiencies**signs
    torques, holding, _ = solve_torques(flow.case, flow.gear, ratios)
    by_first = power(loaded(flow, ratios, torques, holding), flow.motion)
    losses = power(by_first, 1 - flow.efficiencies**signs)
    entering = powers(flow, torques, holding)
    efficiency = _efficiency(flow, torques, entering)
    agrees = (by_first * signs * flow.direction >= 0) | (flow.efficiencies == 1)
    passes = (efficiency > 0) & np.isfinite(efficiency)
    if not passes.all():
        passes |= ~_passes_power(flow)
    return Lossy(
        signs=signs,
        torques=torques,
        holding=holding,
        flow=np.sign(by_first * flow.direction),
        losses=losses,
        efficiency=efficiency,
        balance=np.sum(entering, axis=0) - np.sum(losses, axis=0),
        admissible=agrees.all(axis=0) & passes,
    )


def _passes_power(flow: Flow) -> Booleans:
    """Whether the gear has an efficiency without losses, which is then 1."""
    entering = powers(flow, flow.torques, flow.holding)
    return np.isfinite(_efficiency(flow, flow.torques, entering))
