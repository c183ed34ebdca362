"""Pieces of a run between two events, and the recorded columns at instants of a piece."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from vstatics.core.numerics.arrays import Floats, first_largest
from vstatics.simulation.events.margins import Margins
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.record.account import element_heat
from vstatics.simulation.record.asked import TABLES
from vstatics.simulation.record.converters import turbine
from vstatics.simulation.record.curves import Curves
from vstatics.simulation.record.moments import Moments
from vstatics.simulation.record.motion import Peak
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem, between


class Piece:
    """Piece of a run, in which the sticking contacts and thus the equations do not change."""

    def __init__(self, margins: Margins, time: float, state: Floats) -> None:
        self.margins = margins
        self.times = [time]
        """Start, ends of parts of time steps, and multiples of the requested interval. [s]"""
        self.states = [state]
        self.steps: list[tuple[TimeStep, float]] = []
        """Time steps, each with the time until which it is valid. [s]"""

    def add(self, time: float, state: Floats) -> None:
        """Add an instant and its state to the end of the piece."""
        self.times.append(time)
        self.states.append(state)


class MotionColumns:
    """Order and calculation of the recorded columns of a run.

    Parameters
    ----------
    system : MotionSystem
    asked : mapping of str to sequence of str
        Names of the rows of each additional table.
    """

    def __init__(self, system: MotionSystem, asked: Mapping[str, Sequence[str]]) -> None:
        self.asked = asked
        elements = system.case.shift_elements
        links = len(system.names)
        self.devices = device_names(system)
        self.rows = system.rows(
            between(element.first, element.second, links) for element in elements
        )
        sizes = (links, len(elements), len(self.devices), *map(len, asked.values()), len(elements))
        ends = np.cumsum((0, *sizes)).tolist()
        self.kinds = [slice(*pair) for pair in pairwise(ends)]
        """Slices of columns: speeds, slips, torques, each additional table, heat."""
        self.speeds, self.slips, self.torques, *_, self.heat = self.kinds

    def moments(self, piece: Piece, times: Floats, states: Floats) -> Moments:
        """Return the state of the run at times of a piece."""
        margins, equations = piece.margins, piece.margins.equations
        speeds = equations.speeds_at(times, states)
        rates, ports = equations.acting_at(times, states)
        held = margins.split(times, states, rates, ports)
        torques = device_torques(equations, ports, held)
        begin, end = piece.times[0], piece.times[-1]
        known = times, states, speeds, self.rows @ speeds, torques, ports
        return Moments(equations, begin, end, *known)

    def at(self, at: Moments) -> Floats:
        """Return all columns, shape (columns, times)."""
        asked = [TABLES[table].make(at, rows) for table, rows in self.asked.items()]
        heat = element_heat(at.equations, at.states)
        return np.concatenate([at.speeds, at.slips, at.torques, *asked, heat])

    def curves(self, piece: Piece, steps: Sequence[tuple[TimeStep, float]]) -> Curves:
        """Return the columns over all parts of time steps; an event can shorten the last part."""
        (first, _), (last, end) = steps[0], steps[-1]
        size = len(first.nodes)
        times = np.concatenate([step.times for step, _ in steps]).reshape(-1, size)
        states = np.hstack([first.first[:, None], *(step.states for step, _ in steps)])
        begins = np.append(first.start, times[:-1, -1])
        parts = max(1, int((begins < end).sum()))
        begins, times, states = begins[:parts], times[:parts], states[:, : parts * size + 1]
        if end < times[-1, -1]:
            times[-1] = begins[-1] + (end - begins[-1]) * first.nodes
            states[:, -size:] = last.between(times[-1])
        values = self.at(self.moments(piece, np.append(begins[0], times), states))
        nodes = np.arange(parts)[:, None] * size + np.arange(size + 1)
        places = (0.0, *first.nodes.tolist())
        return Curves(begins, times[:, -1] - begins, places, values[:, nodes])


def peaks(devices: Sequence[str], times: Floats, torques: Floats) -> Mapping[str, Peak]:
    """Return the largest torque of each component, and when it first occurs."""
    top = first_largest(np.abs(torques))
    return {
        name: Peak(float(torques[place, device]), float(times[place]))
        for device, (name, place) in enumerate(zip(devices, top.tolist(), strict=True))
    }


def device_torques(equations: Equations, ports: Floats, held: Floats) -> Floats:
    """Return the torques of all components, shape (components, times) [N*m].

    Parameters
    ----------
    equations : Equations
    ports, held : ndarray, shape (ports, times) and (multipliers, times)
        Torques of ports, and constraint torques. [N*m]
    """
    system, layout = equations.system, equations.layout
    torques = np.zeros((len(system.case.devices), ports.shape[1]))
    row_of = equations.structure.contact_rows
    for index, contact in enumerate(system.contacts):
        if contact.device is not None:
            row = row_of.get(index)
            torques[contact.device] += ports[layout.contacts + index] if row is None else held[row]
    devices = [mesh.device for mesh in system.meshes]
    torques[devices] = held[: len(devices)] + equations.by_planets @ ports
    for index, spring in enumerate(system.springs):
        torques[spring.device] += ports[layout.springs + index]
    for index, variator in enumerate(system.variators):
        variator_torque = variator.reference * held[row_of[variator.contact]]
        torques[variator.device] = variator_torque + ports[layout.variators + index]
    given = [row_of[index] for index, contact in enumerate(system.contacts) if contact.is_given]
    if not (given or system.converters):
        return torques
    pumps = ports[layout.pumps : layout.turbines]
    turbines = 0.0 - ports[layout.turbines : layout.sensors]
    return np.concatenate([torques, pumps, turbines, -held[given]])


def device_names(system: MotionSystem) -> tuple[str, ...]:
    """Return the names of the torques: of components, converters, turbines, and given speeds."""
    given = (contact.name for contact in system.contacts if contact.is_given)
    converters = [converter.name for converter in system.converters]
    return (*system.case.devices, *converters, *map(turbine, converters), *given)
