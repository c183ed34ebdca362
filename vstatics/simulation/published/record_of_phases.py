"""Record of a motion by the published method."""

from __future__ import annotations

import math

import numpy as np

from vstatics.core.errors import Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import Message
from vstatics.simulation.record.motion import Energy, Event, Motion, Peak
from vstatics.simulation.system.curves import capacity_at
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import CLOSED_ENERGY


class TarasikRecord:
    """Instants, heat and events of a run by the published method."""

    def __init__(self, system: MotionSystem, speeds: Floats) -> None:
        self.system, self.first = system, speeds
        self.column = {
            index: contact.element
            for index, contact in enumerate(system.contacts)
            if contact.element is not None
        }
        count = len(system.case.shift_elements)
        self.times: list[float] = []
        self.speeds: list[Floats] = []
        self.torques: list[Floats] = []
        self.heats: list[Floats] = []
        self.work = 0.0
        self.heat = np.zeros(count)
        """Heat of shift elements up to the end of the last phase. [J]"""
        self.events: list[Event] = []

    def add(
        self, time: float, speeds: Floats, torque: float, clutch: int | None, state: Floats
    ) -> None:
        """Add an instant, unless it repeats the last instant without a jump of torque."""
        torques = np.full(len(self.heat), np.nan)
        for index, column in self.column.items():
            if capacity_at(self.system.contacts[index], time) == 0:
                torques[column] = 0.0
        heat = self.heat.copy()
        if clutch is not None:
            torques[self.column[clutch]] = torque
            heat[self.column[clutch]] += state[5]
        self.work = float(state[4])
        is_repeated = self.times and self.times[-1] == time
        if is_repeated and np.array_equal(self.torques[-1], torques, equal_nan=True):
            return
        self.times.append(time)
        self.speeds.append(speeds)
        self.torques.append(torques)
        self.heats.append(heat)

    def heat_of(self, clutch: int | None, heat: float) -> None:
        """Add the heat [J] of the clutch in a finished phase."""
        if clutch is not None:
            self.heat[self.column[clutch]] += heat

    def motion(self, problem: Problem | None) -> Motion:
        """Return the recorded motion; `problem` is the reason for an early stop."""
        case = self.system.case
        names = tuple(element.name for element in case.shift_elements)
        devices = (*names, *(mechanism.name for mechanism in case.mechanisms))
        speeds = np.array(self.speeds).reshape(len(self.times), case.links)
        rows = np.zeros((len(names), case.links))
        for index, column in self.column.items():
            rows[column] = self.system.contacts[index].row
        unknown = np.full((len(self.times), len(devices) - len(names)), np.nan)
        torques = np.array(self.torques).reshape(len(self.times), len(names))
        last = self.speeds[-1] if self.speeds else self.first
        mass = self.system.mass
        kinetic = float(last @ mass @ last - self.first @ mass @ self.first) / 2
        heat = dict(zip(names, map(float, self.heat), strict=True))
        balance = self.work - math.fsum(self.heat) - kinetic
        energy = Energy(self.work, heat, {}, {}, kinetic, 0.0, 0.0, balance)
        peaks = {}
        for column, name in enumerate(names):
            sizes = np.nan_to_num(np.abs(torques[:, column]))
            if sizes.any():
                row = int(sizes.argmax())
                peaks[name] = Peak(float(torques[row, column]), self.times[row])
        text = (
            f"the energy balance of the published equations leaves a remainder of {balance:.6g} J"
        )
        largest = max(abs(self.work), math.fsum(self.heat), abs(kinetic))
        closes = abs(balance) <= CLOSED_ENERGY * largest
        return Motion(
            time=np.array(self.times),
            links=tuple(case.link_names),
            elements=names,
            devices=devices,
            speeds=speeds,
            slips=speeds @ rows.T,
            torques=np.hstack([torques, unknown]),
            heat=np.array(self.heats).reshape(len(self.times), len(names)),
            events=tuple(self.events),
            energy=energy,
            peaks=peaks,
            messages=(Message("N610" if closes else "W610", text),),
            stopped=problem,
        )
