"""Tables of a run for pictures and the report, such as capacities and losses over time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.simulation.record.account import heat_and_losses
from vstatics.simulation.record.moments import Moments
from vstatics.simulation.record.row_names import roads_of
from vstatics.simulation.scenario.laws import Road
from vstatics.simulation.scenario.programme import friction_at
from vstatics.simulation.system.curves import programme_along
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, Contact, Elastic
from vstatics.simulation.system.values import outside_torques

Tables: TypeAlias = Mapping[str, Mapping[str, Floats]]
"""Values over time, by names of table and row."""


def picture_tables(at: Moments) -> Tables:
    """Return the tables for pictures and the report at times between two events.

    - `sticks`: 1 for each sticking shift element, 0 for others;
    - `capacities` of shift elements [N*m];
    - `heat` and `losses`, by name [J];
    - `vehicle_acceleration` of links with a road [m/s^2];
    - `output_torque`, which the gear train gives to the output link [N*m].
    """
    equations, torques, roads = at.equations, at.ports, roads_of(at.system.scenario)
    heat, losses = heat_and_losses(equations, at.states)
    names = [element.name for element in equations.system.case.shift_elements]
    sticks = {device.element: state in ("stick", "rigid") for device, state in _states(equations)}
    structure = equations.structure
    accelerated: Floats = structure.free @ (structure.accelerations @ torques)
    if any(structure.light[link - 1].any() for link in roads):
        accelerated = at.accelerations()
    return {
        "sticks": {
            name: np.full(len(at.times), float(sticks[index])) for index, name in enumerate(names)
        },
        "capacities": dict(zip(names, _capacities(at), strict=True)),
        "heat": heat,
        "losses": losses,
        "vehicle_acceleration": {
            equations.system.names[link - 1]: _of_vehicle(
                road, accelerated[link - 1], at.speeds[link - 1]
            )
            for link, road in roads.items()
        },
        "output_torque": {"": _output_torque(equations, accelerated, torques)},
    }


class PictureTables(Mapping[str, Mapping[str, Floats]]):
    """Tables for pictures and the report, calculated when first read: most runs are not drawn.

    Parameters
    ----------
    earlier : mapping of str to mapping of str to ndarray
        Tables of the earlier parts of a run, if any.
    moments : sequence of Moments
        Later parts of the run.
    selected : ndarray of bool
        Mask of the times of all parts.
    """

    def __init__(self, earlier: Tables, moments: Sequence[Moments], selected: Booleans) -> None:
        self._parts = earlier, moments, selected

    @cached_property
    def _tables(self) -> Tables:
        earlier, moments, selected = self._parts
        with np.errstate(all="ignore"):  # as in the run
            return chosen(joined(earlier, moments), selected)

    def __getitem__(self, table: str) -> Mapping[str, Floats]:
        return self._tables[table]

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)

    def __reduce__(self) -> tuple[type, tuple[Tables]]:
        return dict, (self._tables,)


def joined(earlier: Tables, moments: Sequence[Moments]) -> Tables:
    """Return the tables of the earlier parts of a run, joined in time with those of later parts."""
    parts = [*([earlier] if earlier else []), *map(picture_tables, moments)]
    return {
        table: {row: np.concatenate([part[table][row] for part in parts]) for row in rows}
        for table, rows in parts[0].items()
    }


def chosen(tables: Tables, selected: Booleans) -> Tables:
    """Return tables at the selected times."""
    return {
        table: {row: column[selected] for row, column in rows.items()}
        for table, rows in tables.items()
    }


def _states(equations: Equations) -> list[tuple[Contact | Elastic, str]]:
    """Return all contacts and springs, each with its state."""
    states = equations.states
    devices = equations.system.may_slip
    return [*zip(devices, (*states.contacts, *states.springs), strict=True)]


def _capacities(at: Moments) -> Iterator[Floats]:
    """Yield the torque capacity of each shift element: static if sticking, otherwise kinetic."""
    equations, system = at.equations, at.system
    seen = None
    if any(device.programme.look is not None for device in system.may_slip):
        rates, _ = equations.acting_at(at.times, at.states)
        seen = equations.seen_at(at.times, at.states, rates, at.ports)
    times = equations.ports.inside(at.times)
    capacities: dict[int, Floats] = {}
    for port, (device, state) in enumerate(_states(equations), equations.layout.contacts):
        if device.element is None:
            continue
        if state in SIGNS and not (isinstance(device, Contact) and device.one_way):
            capacities[device.element] = np.abs(at.ports[port])
            continue
        capacity = programme_along(device.programme, times, seen)
        if isinstance(device, Contact):
            if device.friction is not None:
                capacity = capacity * friction_at(device.friction)
            if state == "stick":
                capacity = device.static * capacity
        capacities[device.element] = capacity
    return (capacities[index] for index in range(len(system.case.shift_elements)))


def _of_vehicle(road: Road, acceleration: Floats, turning: Floats) -> Floats:
    """Convert the acceleration of a link that drives the vehicle from [rad/s^2] to [m/s^2]."""
    if road.wheel is None:
        return road.radius * acceleration
    slope, _ = road.wheel.turning_slopes(road.wheel.velocity(turning))
    return acceleration / slope


def _output_torque(equations: Equations, accelerations: Floats, torques: Floats) -> Floats:
    """Return the torque that the gear train gives to the output link [N*m].

    It is the inertia torque of the link minus the external torques on it. Torques of springs are
    external if the link belongs to a gear set or shift element. Otherwise the springs connect the
    gear train with the link, and their torques are part of the result.
    """
    system, layout = equations.system, equations.layout
    link = system.case.output - 1
    alone = (system.heavy != 0).sum(axis=1) == 1
    inertia = float((system.inertias * alone) @ system.heavy[:, link] ** 2)
    torque: Floats = -(outside_torques(equations)[link] @ torques)
    if inertia:
        torque = torque + inertia * accelerations[link]
    first_spring = len(system.case.devices) - len(system.case.springs)
    springs = [*enumerate(system.springs, layout.springs)]
    inner = [mesh.row[link] for mesh in system.meshes]
    inner += [device.row[link] for device in system.contacts if device.element is not None]
    inner += [device.row[link] for _, device in springs if device.device < first_spring]
    if any(inner):
        for port, spring in springs:
            if spring.device >= first_spring:
                torque = torque + spring.row[link] * torques[port]
    return torque
