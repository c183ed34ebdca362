"""What a run has beside its columns, for those who look at it: what sticks, capacities, losses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.simulation.record.account import heat_and_losses
from vstatics.simulation.record.changes import PieceMotion
from vstatics.simulation.record.rows import roads_of
from vstatics.simulation.scenario.laws import Road
from vstatics.simulation.scenario.programme import friction_at
from vstatics.simulation.system.curves import programme_along
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, Contact
from vstatics.simulation.system.values import outside_torques

Tables: TypeAlias = Mapping[str, Mapping[str, Floats]]
"""Columns by table and row."""


def beside(motion: PieceMotion, times: Floats, states: Floats) -> Tables:
    """At some times of a piece.

    `sticks` of shift elements (1: it does), their `capacities` [N*m], `heat` and `losses` of all
    by name [J], `vehicle_acceleration` of links with a road [m/s^2], `output_torque` that the
    train gives to the output link [N*m].
    """
    equations, roads = motion.equations, roads_of(motion.equations.system.scenario)
    rates, torques = equations.acting_at(times, states)
    heat, losses = heat_and_losses(equations, states)
    names = [one.name for one in equations.system.case.shift_elements]
    structure = equations.structure
    accelerated: Floats = structure.free @ (structure.accelerations @ torques)
    if any(structure.light[link - 1].any() for link in roads):
        accelerated = motion.accelerations(times, states)
    capacities = _capacities(equations, times, states, rates, torques)
    return {
        "sticks": {
            name: np.full(len(times), float(sticks))
            for name, sticks in zip(names, _sticks(equations), strict=True)
        },
        "capacities": dict(zip(names, capacities, strict=True)),
        "heat": heat,
        "losses": losses,
        "vehicle_acceleration": {
            equations.system.names[link - 1]: _of_vehicle(
                road, accelerated[link - 1], equations.speeds_at(times, states)[link - 1]
            )
            for link, road in roads.items()
        },
        "output_torque": {"": _output_torque(equations, accelerated, torques)},
    }


def joined(parts: Sequence[Tables]) -> Tables:
    """Tables one behind the other."""
    return {
        table: {row: np.concatenate([part[table][row] for part in parts]) for row in rows}
        for table, rows in parts[0].items()
    }


def chosen(tables: Tables, kept: Booleans) -> Tables:
    """Tables at some of their times."""
    return {
        table: {row: column[kept] for row, column in rows.items()} for table, rows in tables.items()
    }


def _sticks(equations: Equations) -> Iterator[bool]:
    """Of each shift element."""
    system, states = equations.system, equations.states
    contacts = dict(zip(map(id, system.contacts), states.held, strict=True))
    springs = dict(zip(map(id, system.springs), states.springs, strict=True))
    for index in range(len(system.case.shift_elements)):
        of = system.by_element[index]
        yield contacts[id(of)] if isinstance(of, Contact) else springs[id(of)] == "stick"


def _capacities(
    equations: Equations, times: Floats, states: Floats, rates: Floats, torques: Floats
) -> Iterator[Floats]:
    """Of each shift element: what it carries while it slips, what it can while it sticks."""
    system, does = equations.system, equations.states
    looks = any(one.programme.look is not None for one in system.may_slip)
    seen = equations.seen_at(times, states, rates, torques) if looks else None
    at = equations.ports.inside(times)
    found: dict[int, Floats] = {}
    devices = zip(system.may_slip, (*does.contacts, *does.springs), strict=True)
    for port, (device, state) in enumerate(devices, equations.layout.contacts):
        if device.element is None:
            continue
        if state in SIGNS and not (isinstance(device, Contact) and device.one_way):
            found[device.element] = np.abs(torques[port])
            continue
        found[device.element] = programme_along(device.programme, at, seen)
        if isinstance(device, Contact) and device.friction is not None:
            found[device.element] = found[device.element] * friction_at(device.friction)
        if isinstance(device, Contact) and state == "stick":
            found[device.element] = device.static * found[device.element]
    return (found[index] for index in range(len(system.case.shift_elements)))


def _of_vehicle(road: Road, acceleration: Floats, turning: Floats) -> Floats:
    """The acceleration of a vehicle by that of its link [m/s^2], which turns so fast [rad/s]."""
    if road.wheel is None:
        return road.radius * acceleration
    slope, _ = road.wheel.turning_slopes(road.wheel.velocity(turning))
    made: Floats = acceleration / slope
    return made


def _output_torque(equations: Equations, accelerations: Floats, torques: Floats) -> Floats:
    """That elements and mechanisms give to the output link; where none is at it, springs.

    Of the balance of the link: its inertia takes what all that acts from outside leaves.
    """
    system, layout = equations.system, equations.layout
    link = system.case.output - 1
    own = (system.heavy != 0).sum(axis=1) == 1
    inertia = float((system.inertias * own) @ system.heavy[:, link] ** 2)
    made: Floats = -(outside_torques(equations)[link] @ torques)
    if inertia:
        made = made + inertia * accelerations[link]
    own_springs = len(system.case.devices) - len(system.case.springs)
    bent = [*enumerate(system.springs, layout.springs)]
    inner = [mesh.row[link] for mesh in system.meshes]
    inner += [one.row[link] for one in system.contacts if one.element is not None]
    inner += [one.row[link] for _, one in bent if one.device < own_springs]
    if any(inner):
        for port, spring in bent:
            if spring.device >= own_springs:
                made = made + spring.row[link] * torques[port]
    return made
