"""Driving cycles, written as the rows of a trace."""

import math

from vstatics import Transmission
from vstatics.vehicle.operation.drive_cycle import CycleEnergy, DriveCycle, drive
from vstatics.vehicle.operation.gear_choice import GearChoice
from vstatics.vehicle.operation.trace import Trace, read_trace


def timed(rows: str) -> Trace:
    """Return a trace of times [s], speeds [m/s] and, in a third column, gears."""
    head = ["time [s]", "speed [m/s]", "gear"][: rows.partition("\n")[0].count(",") + 1]
    return read_trace(f"{','.join(head)}\n{rows}".encode(), "t.csv")


def around(speed: float, half: float, time: float = 1.0) -> str:
    """Return the rows of a step from ``speed - half`` to ``speed + half``."""
    return f"0,{speed - half}\n{time},{speed + half}"


def spent(energy: CycleEnergy) -> float:
    """Return the energy that engine or machine must give [J]."""
    return energy.wheels + energy.inertias + energy.brakes + math.fsum(energy.lost.values())


def cycled(case: Transmission, trace: Trace | str) -> DriveCycle:
    """Return the cycle of a case in the gears of a trace, which rows can give."""
    return drive(case, timed(trace) if isinstance(trace, str) else trace, GearChoice())
