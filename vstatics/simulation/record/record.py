"""What is kept of a run while it goes on, torques of devices too, and the motion made of it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import groupby
from typing import NamedTuple

import numpy as np

from vstatics.errors import Problem
from vstatics.numerics.arrays import Floats, first_largest, largest
from vstatics.numerics.tolerances import LAST_BITS
from vstatics.simulation.events.impacts import kinetic_energy
from vstatics.simulation.events.instants import Instant, Jump
from vstatics.simulation.events.margins import Margins
from vstatics.simulation.events.pieces import TimeStep
from vstatics.simulation.record.account import element_heat, energy_account
from vstatics.simulation.record.motion import Event, Motion, Peak, Reached
from vstatics.simulation.scenario.laws import Road
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem, between
from vstatics.simulation.tolerances import (
    LEAST_SPREAD,
    SAME_TIME,
    SAME_VALUES,
    SHARED_TORQUE,
)
from vstatics.statics.result_arrays import Message


class Kept(NamedTuple):
    """An instant that is kept."""

    time: float
    margins: Margins
    state: Floats


class Record:
    """A run so far."""

    def __init__(self, system: MotionSystem, start: Instant, step: float | None) -> None:
        self.system, self.start, self.every = system, start, step
        self.events: list[Event] = []
        self.impact = 0.0
        self.joined: set[int] = set()
        """Contacts that have just joined by an impact."""
        self.messages: list[Message] = []
        self.kept: list[Kept] = []
        self.time = start.time
        self.energy_scale = max(kinetic_energy(system, start.speeds), 1.0)
        self.worked, self.stored = 0.0, 0.0
        case = system.case
        self.devices = (*case.devices, *(one.name for one in system.converters))
        self.peaks = np.zeros(len(self.devices))
        self.peak_times = np.zeros(len(self.devices))
        self.targets = [
            (link - 1, speed)
            for link, speeds in system.scenario.targets.items()
            for speed in speeds
        ]
        self.reached: dict[tuple[int, float], tuple[float, float]] = {}

    @property
    def turnover(self) -> float:
        """The energy of which a balance is what is left: all that passed, or was stored [J].

        Net work says nothing: what one torque gives another may take.
        """
        return max(self.worked, self.stored)

    def jumps(self, time: float, jump: Jump) -> None:
        """Twists that changed at once."""
        self.impact += jump.energy
        text = (
            f"link {jump.link} has no inertia: at {time:.6g} s the torques on it jump, and it "
            "turns at once to where they balance"
        )
        self.messages.append(Message("warning", text))

    def begin(self, margins: Margins, state: Floats) -> None:
        """A piece begins."""
        equations = margins.equations
        self.kept.append(Kept(equations.time, margins, state))
        self.time = equations.time
        scale = max(
            kinetic_energy(self.system, equations.speeds(equations.time, state)),
            largest(state[equations.works]),
        )
        self.energy_scale = max(self.energy_scale, scale)
        self._store(equations, equations.time, state)
        self._peak(np.array([equations.time]), state[:, None])

    def step(self, step: TimeStep, end: float, state: Floats) -> None:
        """A step, or the part of it up to an event."""
        margins = self.kept[-1].margins
        made = []
        if self.every:
            number = math.floor(step.start / self.every * (1 + SAME_TIME)) + 1
            while number * self.every < end * (1 - SAME_TIME):
                time = number * self.every
                made.append(Kept(time, margins, step.exact(time)))
                number += 1
        made += [
            Kept(float(step.times[place]), margins, step.states[:, place])
            for place in np.flatnonzero(step.marks & (step.times < end))
        ]
        self.kept += sorted(made, key=lambda one: one.time)
        self.kept.append(Kept(end, margins, state))
        self.time = end
        works = margins.equations.works.start
        self.worked += float(np.abs(state - step.first)[works:].sum())
        self._store(margins.equations, end, state)
        self._peak(np.array([end]), state[:, None])
        self._targets(step, end, state, margins.equations)

    def _store(self, equations: Equations, time: float, state: Floats) -> None:
        """Note the energy that is stored, if it is larger than before."""
        kinetic = kinetic_energy(self.system, equations.speeds(time, state))
        self.stored = max(self.stored, kinetic + equations.elastic_energy(state))

    def sample(self, step: TimeStep, times: Floats, states: Floats) -> None:
        """Instants within a step, for peaks."""
        if not len(times):
            return
        torques = self._peak(times, states)
        if len(times) < 3:
            return
        sizes = np.abs(torques)
        top = first_largest(sizes)
        inner = (top > 0) & (top < len(times) - 1)
        for device in np.flatnonzero(inner & (sizes.max(axis=0) >= np.abs(self.peaks) * 0.999)):
            place = int(top[device])
            self._refine(step, times[place], times[place + 1] - times[place - 1], int(device))

    def _refine(self, step: TimeStep, time: float, width: float, device: int) -> None:
        """Note the top of a torque near an instant, by parabolas through three."""
        for spread in (0.5 * width, 0.02 * width, LEAST_SPREAD * width):
            near = np.clip(time + spread * np.array([-1.0, 0.0, 1.0]), step.start, step.end)
            sizes = np.abs(self._peak(near, step.between(near))[:, device])
            bend = sizes[0] - 2 * sizes[1] + sizes[2]
            if bend >= 0:
                return
            time = float(near[1] + 0.5 * (sizes[0] - sizes[2]) / bend * spread)
            time = min(max(time, step.start), step.end)

    def _peak(self, times: Floats, states: Floats) -> Floats:
        """Note torques that are larger than before."""
        torques = device_torques(self.kept[-1].margins, times, states).T
        top = first_largest(np.abs(torques))
        columns = np.arange(torques.shape[1])
        highest = torques[top, columns]
        larger = np.abs(highest) > np.abs(self.peaks) * (1 + LAST_BITS)
        self.peaks[larger] = highest[larger]
        self.peak_times[larger] = times[top][larger]
        return torques

    def _targets(self, step: TimeStep, end: float, state: Floats, equations: Equations) -> None:
        """Note when links reach speeds that are asked for."""
        for link, speed in self.targets:
            if (link, speed) in self.reached:
                continue

            def short(time: float, link: int = link, speed: float = speed) -> float:
                at = state if time == end else step.between(np.array([time]))[:, 0]
                return float(equations.speeds(time, at)[link]) - speed

            first, last = short(step.start), short(end)
            if first == 0 or (first < 0) != (last < 0):
                from scipy.optimize import brentq

                time = step.start if first == 0 else float(brentq(short, step.start, end))
                at = step.between(np.array([time]))[:, 0]
                angle = float(at[equations.angles][equations.layout.angles.index(link)])
                self.reached[link, speed] = time, angle

    def motion(self, stopped: Problem | None) -> Motion:
        """All of it."""
        system = self.system
        elements = system.case.shift_elements
        rows = system.rows(between(one.first, one.second, len(system.names)) for one in elements)
        times, speeds, torques, heat = [], [], [], []
        for margins, group in groupby(self.kept, key=lambda one: one.margins):
            same = list(group)
            at = np.array([one.time for one in same])
            states = np.array([one.state for one in same]).T
            times.append(at)
            speeds.append(margins.equations.speeds_at(at, states).T)
            torques.append(device_torques(margins, at, states).T)
            heat.append(element_heat(margins.equations, states).T)
        all_times, all_speeds, all_torques, all_heat = map(
            np.concatenate, (times, speeds, torques, heat)
        )
        kept = _different(all_times, all_speeds, all_torques)
        at_links = all_speeds[kept]
        shared = shared_torques(one.margins for one in self.kept)
        last = self.kept[-1]
        return Motion(
            all_times[kept],
            system.names,
            tuple(one.name for one in elements),
            self.devices,
            at_links,
            at_links @ rows.T,
            all_torques[kept],
            all_heat[kept],
            tuple(self.events),
            energy_account(self.start, self.time, last.margins.equations, last.state, self.impact),
            {
                name: Peak(float(torque), float(time))
                for name, torque, time in zip(
                    self.devices, self.peaks, self.peak_times, strict=True
                )
            },
            tuple(self._reached()),
            tuple(dict.fromkeys([*self.messages, *shared])),
            stopped,
        )

    def _reached(self) -> list[Reached]:
        radius = {
            link - 1: law.radius
            for link, law in self.system.scenario.torques
            if isinstance(law, Road)
        }
        made = []
        for link, speed in self.targets:
            time, angle = self.reached.get((link, speed), (math.nan, math.nan))
            distance = angle * radius.get(link, math.nan)
            made.append(Reached(self.system.names[link], speed, time, angle, distance))
        return made


def _different(times: Floats, speeds: Floats, torques: Floats) -> Floats:
    """Which instants stand: an instant stands twice only where something jumps."""
    kept = np.ones(len(times), dtype=bool)
    for number in np.flatnonzero(np.diff(times) == 0) + 1:
        same = all(
            np.allclose(one[number - 1], one[number], rtol=SAME_VALUES, atol=SAME_VALUES)
            for one in (speeds, torques)
        )
        kept[number] = not same
    return kept


def device_torques(margins: Margins, times: Floats, states: Floats) -> Floats:
    """Torques of all devices at several times, shape (devices, times) [N*m]."""
    equations = margins.equations
    _, ports = equations.acting_at(times, states)
    held = margins.split(times, equations.structure.torques @ ports, ports)
    system, layout = equations.system, equations.layout
    count = len(system.case.devices)
    made = np.zeros((count + len(system.converters), len(times)))
    row_of = {
        one.of: row
        for row, one in enumerate(equations.structure.multipliers)
        if one.kind == "contact"
    }
    for index, contact in enumerate(system.contacts):
        device = contact.while_open if contact.element is None else contact.element
        if device is not None:
            row = row_of.get(index)
            made[device] += ports[layout.contacts + index] if row is None else held[row]
    for index, mesh in enumerate(system.meshes):
        made[mesh.device] = held[index]
    for index, spring in enumerate(system.springs):
        made[spring.device] = ports[layout.springs + index]
    made[count:] = ports[layout.pumps : layout.pumps + len(system.converters)]
    return made


def shared_torques(pieces: Iterable[Margins]) -> list[Message]:
    """What shares a torque that nothing determines, each set of elements once."""
    found = []
    seen: set[tuple[int, ...]] = set()
    for margins in pieces:
        if not margins.shared:
            continue
        equations = margins.equations
        structure, contacts = equations.structure, equations.system.contacts
        sharing = tuple(
            one.of
            for row, one in enumerate(structure.multipliers)
            if one.kind == "contact"
            and contacts[one.of].element is not None
            and largest(structure.redundant[row]) > SHARED_TORQUE
        )
        if len(sharing) < 2 or sharing in seen:
            continue
        seen.add(sharing)
        names = ", ".join(contacts[index].name for index in sharing)
        text = (
            f"{names} hold together more than is needed (first at {equations.time:.6g} s): how "
            "they share the torque is open, shown is the split of least norm"
        )
        found.append(Message("note", text))
    return found
