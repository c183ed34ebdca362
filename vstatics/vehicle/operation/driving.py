"""Python function `cycle`, which drives a case with a vehicle through a driving cycle."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal

from vstatics.core.arguments import naming, refusing
from vstatics.core.jobs.input_files import TABLE_BYTES, read_file
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.drive_cycle import DriveCycle, drive
from vstatics.vehicle.operation.fuel_map import FuelMap, read_fuel_map
from vstatics.vehicle.operation.gear_choice import GearChoice
from vstatics.vehicle.operation.shifting import read_shifts
from vstatics.vehicle.operation.trace import Trace, read_trace

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission


@refusing(Transmission="vstatics.core.model.transmission")
@naming
def cycle(  # noqa: PLR0913
    case: Transmission,
    trace: str | os.PathLike[str] | Trace,
    *,
    least_speed: float | None = None,
    shifts: str = "",
    strategy: Literal["least-loss"] | None = None,
    fuel: str | os.PathLike[str] | FuelMap | None = None,
) -> DriveCycle:
    """Drive a case with a `vehicle` through a driving cycle.

    Parameters
    ----------
    case : Transmission
    trace : path-like or Trace
        Table with the columns time [s], speed [km/h], and optionally gear, and slope (sine of the
        angle) or grade (rise divided by horizontal distance) [-].
    least_speed : float, optional
        Least engine speed: choose the highest gear that reaches it. If no gear does, choose the
        lowest gear that does not exceed the last engine speed. [rad/s]
    shifts : str, optional
        Road speeds of upshifts and downshifts: ``"1-2: 15 km/h/12 km/h, 2-3: ..."``.
    strategy : {"least-loss"}, optional
        Choose in each step the gear that needs the least energy of engine or battery, within full
        load and with the engine at `least_speed` (by default its first full-load point) or faster.
    fuel : path-like or FuelMap, optional
        CSV with the columns speed, torque and fuel; the file that a case names is not read.

    Returns
    -------
    DriveCycle
        Energies and losses [J], fuel [g], steps, and messages.

    Raises
    ------
    CaseError
        If the case has no vehicle, or a gear is not in the case or has no torques.
    ReadError
        If a file has errors, with every problem and its position.
    OSError
        If a file cannot be opened.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0, 0.8, name="pair")], [Gear(name="1")],
    ...                     vehicle=Vehicle(1000, 0.5))
    >>> trace = read_trace(b"time [s],speed [km/h],gear\\n0,0,1\\n10,36,1\\n", "t.csv")
    >>> round(cycle(case, trace).energy.engine, 6)
    62500.0
    """
    Vehicle.needed(case)  # a case without a vehicle fails before any file is read
    trace_read = trace if isinstance(trace, Trace) else read_trace(*_read(trace))
    fuel_map = fuel if fuel is None or isinstance(fuel, FuelMap) else read_fuel_map(*_read(fuel))
    choice = GearChoice(least_speed, read_shifts(shifts) if shifts else (), strategy is not None)
    return drive(case, trace_read, choice, fuel_map)


def _read(path: str | os.PathLike[str]) -> tuple[bytes, str]:
    return read_file(path, TABLE_BYTES), os.fspath(path)
