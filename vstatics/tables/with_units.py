"""Tables in rpm, N*m and kW, for a case that tells its load."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.numerics.traced import plain
from vstatics.statics.matrix import held_links
from vstatics.statics.power import port_torques
from vstatics.statics.power import power as own_power
from vstatics.statics.results import Results
from vstatics.statics.torques import Torques
from vstatics.tables.quantities import WITH_UNITS
from vstatics.tables.quantity import Table

KW_OF_RPM_NM = math.pi / 30 / 1000
"""1 N*m at 1 rpm, in kW."""


def physical(results: Results, relative: Sequence[Table]) -> list[Table]:
    """The tables with units, made of those without."""
    by_name = {table.quantity.name: table for table in relative}
    gears = [gear.name for gear in results.case.gears]
    filled = []
    with np.errstate(over="ignore", invalid="ignore"):
        by_unit = scales(results)
        powers = dict(zip(("input_power_kW", "output_power_kW"), _ports(results), strict=True))
        for quantity in WITH_UNITS:
            scale = by_unit[quantity.unit]
            if np.isnan(scale).all() or (quantity.of and quantity.of not in by_name):
                continue
            values = by_name[quantity.of].values * scale if quantity.of else powers[quantity.name]
            rows = [quantity.key] if quantity.rows == "one" else by_name[quantity.of].rows
            finite = np.where(np.isfinite(values), values + 0.0, np.nan)
            filled.append(Table(quantity, rows, gears, finite.reshape(len(rows), len(gears))))
    return filled


def scales(results: Results) -> dict[str, Floats]:
    """By unit (rpm, Nm, kW): what a relative number of each gear is multiplied by.

    Arrays of shape (gears,), NaN where no load tells.

    When coasting the input link is driven: the torque on it is against its speed.
    """
    case = results.case
    loads = [case.gear_load(gear) for gear in case.gears]
    rpm = np.array([math.nan if load.speed is None else load.speed for load in loads])
    torque = np.array([math.nan if load.torque is None else load.torque for load in loads])
    if case.coast:
        torque = -torque
    return {"rpm": rpm, "Nm": torque, "kW": rpm * torque * KW_OF_RPM_NM}


def _ports(results: Results) -> tuple[Floats, Floats]:
    """Power that enters and that leaves by all links with an external torque, by gear [kW].

    With losses; drag apart. So what enters less what leaves is lost.
    """
    case = results.case
    power = np.zeros((len(case.gears), case.links + 1))
    for number, gear in enumerate(case.gears):
        speeds = results.speeds[number].tolist()
        held = results.lossy_holding_torques[number].tolist()
        torques = Torques(
            results.lossy_torques[number].tolist(),
            {link: held[link - 1] for link in held_links(case, gear)},
            consistent=True,
        )
        for link, torque in port_torques(case, gear, torques).items():
            power[number, link] = plain(own_power(torque, speeds[link - 1]))
    power *= scales(results)["kW"][:, np.newaxis]
    return np.maximum(power, 0.0).sum(axis=1), np.maximum(-power, 0.0).sum(axis=1)
