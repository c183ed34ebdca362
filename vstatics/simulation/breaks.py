"""When something of a system bends or jumps in time, and what is large in it."""

from __future__ import annotations

import math

import numpy as np

from vstatics.simulation.curves import capacity_at, programme_at
from vstatics.simulation.formula import Formula
from vstatics.simulation.instants import Instant
from vstatics.simulation.laws import Points
from vstatics.simulation.margins import LargeSizes
from vstatics.simulation.system import MotionSystem


def break_times(system: MotionSystem) -> list[float]:
    """Times at which something bends or jumps, in order [s]."""
    times: set[float] = set()
    for contact in system.contacts:
        times.update(contact.programme.breaks())
    for spring in system.springs:
        times.update(spring.limit.breaks())
    for one in system.outside:
        if isinstance(one.law, Points) and one.law.over == "time":
            times.update(one.law.x)
        elif isinstance(one.law, Formula):
            times.update(one.law.breaks)
    return sorted(time for time in times if 0 < time < system.scenario.duration)


def large_sizes(system: MotionSystem, at: Instant) -> LargeSizes:
    """Speeds and torques that are large at the start."""
    speed = max(1.0, float(np.abs(at.speeds).max(initial=0.0)))
    torque = 1.0
    times = [at.time, *break_times(system)]
    for contact in system.contacts:
        held = [abs(capacity_at(contact, time)) for time in times]
        torque = max([torque, *(one for one in held if math.isfinite(one))])
    for spring in system.springs:
        limit = abs(programme_at(spring.limit, at.time))
        torque = max(torque, limit if math.isfinite(limit) else 0.0)
    for one in system.outside:
        if isinstance(one.law, Points):
            torque = max(torque, *map(abs, one.law.y))
    return LargeSizes(speed, torque)
