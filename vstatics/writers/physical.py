"""Tables in rpm, N*m and kW, for a case that tells its load."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from vstatics.arrays import Floats
from vstatics.results import TABLES, Results

if TYPE_CHECKING:
    from vstatics.writers.tables import Table

KW_OF_RPM_NM = math.pi / 30 / 1000
"""1 N*m at 1 rpm, in kW."""


def physical(results: Results, relative: Mapping[str, Table]) -> dict[str, Table]:
    """The tables with units, by their names.

    Parameters
    ----------
    relative : mapping of name to Table
        The tables without units.
    """
    from vstatics.writers.tables import Table

    scales = _scales(results)
    gears = [gear.name for gear in results.case.gears]
    made = {}
    for shape in TABLES:
        if shape.of in relative and shape.unit:
            base = relative[shape.of]
            values = base.values * scales[shape.unit]
        elif shape.unit and not shape.of:
            base = relative["ETA"]
            part = np.ones(len(gears)) if shape.name == "input_power_kW" else _output(results)
            values = (part * scales["kW"])[np.newaxis]
        else:
            continue
        if not np.isnan(scales[shape.unit]).all():
            rows = base.rows if shape.of else [shape.name]
            made[shape.name] = Table(shape, rows, gears, values + 0.0)
    return made


def _scales(results: Results) -> dict[str, Floats]:
    """By unit: what a relative number of each gear is multiplied by, NaN where no load tells."""
    case = results.case
    loads = [case.gear_load(gear) for gear in case.gears]
    rpm = np.array([math.nan if load.speed is None else load.speed for load in loads])
    torque = np.array([math.nan if load.torque is None else load.torque for load in loads])
    return {"rpm": rpm, "Nm": torque, "kW": rpm * torque * KW_OF_RPM_NM}


def _output(results: Results) -> Floats:
    """Power given to the load of the output, with losses, relative to the input power."""
    case = results.case
    outputs = [case.gear_output(gear) - 1 for gear in case.gears]
    speeds = results.speeds[np.arange(len(outputs)), outputs]
    power: Floats = results.lossy_torques[:, -1] * speeds
    return power
