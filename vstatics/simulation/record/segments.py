"""The pieces of a run, and its columns at some instants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from vstatics.core.numerics.arrays import Floats, first_largest
from vstatics.simulation.events.margins import Margins
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.record.account import element_heat
from vstatics.simulation.record.asked import TABLES, Moments
from vstatics.simulation.record.changes import PieceMotion
from vstatics.simulation.record.converters import turbine
from vstatics.simulation.record.curves import Curves
from vstatics.simulation.record.motion import Peak
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem, between


class Piece:
    """What is kept of a run while the same things stick and slip."""

    def __init__(self, margins: Margins, time: float, state: Floats) -> None:
        self.margins = margins
        self.times = [time]
        """Points of integration, multiples of a step. [s]"""
        self.states = [state]
        self.steps: list[tuple[TimeStep, float]] = []
        """Each with the time up to which it holds."""

    @property
    def motion(self) -> PieceMotion:
        """What moves, from when till when."""
        end = self.steps[-1][1] if self.steps else self.times[-1]
        return PieceMotion(self.margins.equations, self.times[0], end)

    def add(self, time: float, state: Floats) -> None:
        """Keep an instant."""
        self.times.append(time)
        self.states.append(state)


class MotionColumns:
    """The columns of a motion, one behind the other.

    Parameters
    ----------
    system : MotionSystem
    asked : mapping of str to sequence of str
        Rows of tables that somebody asks for.
    """

    def __init__(self, system: MotionSystem, asked: Mapping[str, Sequence[str]]) -> None:
        self.asked = asked
        elements = system.case.shift_elements
        links = len(system.names)
        self.devices = device_names(system)
        self.rows = system.rows(between(one.first, one.second, links) for one in elements)
        sizes = (links, len(elements), len(self.devices), *map(len, asked.values()), len(elements))
        ends = np.cumsum((0, *sizes)).tolist()
        self.kinds = [slice(*pair) for pair in pairwise(ends)]
        """Speeds, slips, torques, tables that are asked for, heat."""
        self.speeds, self.slips, self.torques, *_, self.heat = self.kinds

    def at(self, piece: Piece, times: Floats, states: Floats) -> Floats:
        """All at several times of a piece, shape (columns, times)."""
        margins, equations = piece.margins, piece.margins.equations
        speeds = equations.speeds_at(times, states)
        slips = self.rows @ speeds
        rates, ports = equations.acting_at(times, states)
        held = margins.split(times, states, rates, ports)
        torques = device_torques(equations, ports, held)
        at = Moments(piece.motion, times, states, speeds, slips, torques, ports)
        asked = [TABLES[table].make(at, rows) for table, rows in self.asked.items()]
        return np.vstack([speeds, slips, torques, *asked, element_heat(equations, states)])

    def curves(self, piece: Piece, steps: Sequence[tuple[TimeStep, float]]) -> Curves:
        """The columns of the parts of steps; the last part goes to where the steps end."""
        (first, _), (last, end) = steps[0], steps[-1]
        size = len(first.nodes)
        times = np.concatenate([one.times for one, _ in steps]).reshape(-1, size)
        states = np.hstack([first.first[:, None], *(one.states for one, _ in steps)])
        begins = np.append(first.start, times[:-1, -1])
        parts = max(1, int((begins < end).sum()))
        begins, times, states = begins[:parts], times[:parts], states[:, : parts * size + 1]
        if end < times[-1, -1]:
            times[-1] = begins[-1] + (end - begins[-1]) * first.nodes
            states[:, -size:] = last.between(times[-1])
        values = self.at(piece, np.append(begins[0], times), states)
        nodes = np.arange(parts)[:, None] * size + np.arange(size + 1)
        places = (0.0, *first.nodes.tolist())
        return Curves(begins, times[:, -1] - begins, places, values[:, nodes])


def peaks(devices: Sequence[str], times: Floats, torques: Floats) -> Mapping[str, Peak]:
    """The largest torque of each device, the first where several are as large."""
    top = first_largest(np.abs(torques))
    return {
        name: Peak(float(torques[place, device]), float(times[place]))
        for device, (name, place) in enumerate(zip(devices, top.tolist(), strict=True))
    }


def device_torques(equations: Equations, ports: Floats, held: Floats) -> Floats:
    """Torques of all devices, shape (devices, times) [N*m].

    Parameters
    ----------
    equations : Equations
    ports, held : ndarray, shape (ports, times) and (multipliers, times)
        Torques of ports, and those that follow from what holds. [N*m]
    """
    system, layout = equations.system, equations.layout
    count = len(system.case.devices)
    made = np.zeros((len(device_names(system)), ports.shape[1]))
    row_of = {
        one.of: row
        for row, one in enumerate(equations.structure.multipliers)
        if one.kind == "contact"
    }
    for index, contact in enumerate(system.contacts):
        if contact.device is not None:
            row = row_of.get(index)
            made[contact.device] += ports[layout.contacts + index] if row is None else held[row]
    structure = equations.structure
    by_planets = system.rows(mesh.planets for mesh in system.meshes)
    by_planets = by_planets @ structure.free @ structure.accelerations
    for index, mesh in enumerate(system.meshes):
        made[mesh.device] = held[index] + by_planets[index] @ ports
    for index, spring in enumerate(system.springs):
        made[spring.device] += ports[layout.springs + index]
    for index, variator in enumerate(system.variators):
        torque = variator.reference * held[row_of[variator.contact]]
        made[variator.device] = torque + ports[layout.variators + index]
    pumped = count + len(system.converters)
    end = pumped + len(system.converters)
    made[count:pumped] = ports[layout.pumps : layout.turbines]
    made[pumped:end] = 0.0 - ports[layout.turbines : layout.sensors]
    given = [index for index, one in enumerate(system.contacts) if one.is_given]
    made[end:] = -held[[row_of[index] for index in given]]
    return made


def device_names(system: MotionSystem) -> tuple[str, ...]:
    """What has a torque: devices, converters, their turbines, links whose speeds are given."""
    given = (one.name for one in system.contacts if one.is_given)
    converters = [one.name for one in system.converters]
    return (*system.case.devices, *converters, *map(turbine, converters), *given)
