"""Results as the tables that every output format shows, in the order of the source."""

from __future__ import annotations

from typing import Any

import numpy as np

from vstatics.statics.arrays import row_names
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.results import TABLES, Results
from vstatics.tables.table import Table


def tables(results: Results) -> list[Table]:
    """All tables of the results of one case; some only where the case has what they speak of."""
    case = results.case
    gears = [gear.name for gear in case.gears]
    values: dict[str, Any] = {
        "W": results.speeds,
        "WSAT": results.planet_speeds,
        "WFRI": results.slip_speeds,
        "AMLG": results.torques,
        "AMLGP": results.lossy_torques,
        "ETA": results.efficiency,
        "IX": results.power_sign,
        "ratio": results.ratio,
        "idle": results.existing("idle"),
        "losses": results.losses,
        "power_balance": results.power_balance,
        "consistent": results.existing("consistent"),
        "locked": results.existing("locked"),
        "AMWZ": results.holding_torques,
        "AMWZP": results.lossy_holding_torques,
    }
    if np.isnan(results.holding_torques).all():
        del values["AMWZ"], values["AMWZP"]
    if case.has_drag:
        values["drag_losses"] = results.drag_losses
    if case.freewheels:
        values["holds"] = results.holds
    if row_names(case, "meshes"):
        values["mesh_torques"] = results.mesh_torques
        values["lossy_mesh_torques"] = results.lossy_mesh_torques
    made = []
    for shape in TABLES:
        names = row_names(case, shape.rows) or [shape.name]
        if shape.name == "AJK":
            names = list(case.link_names)
            made.append(Table(shape, names, case.devices, distribution_matrix(case) + 0.0))
        elif shape.name in values:
            names = [shape.name] if shape.rows == "one" else row_names(case, shape.rows)
            array = np.asarray(values[shape.name], dtype=np.float64)
            by_gear = array.reshape(len(gears), len(names)).T
            made.append(Table(shape, names, gears, by_gear))
    if case.load is None and not any(gear.load for gear in case.gears):
        return made
    from vstatics.tables.units import physical

    units = physical(results, {table.shape.name: table for table in made})
    return [*made, *units.values()]
