"""Results as the tables that every output format shows, in the order of the source."""

from __future__ import annotations

import numpy as np

from vstatics.statics.arrays import all_row_names
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.results import Results
from vstatics.tables.quantities import RELATIVE
from vstatics.tables.quantity import Table


def tables(results: Results) -> list[Table]:
    """All tables of the results of one case; some only where the case has what they speak of.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.statics.solve import solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = {table.quantity.name: table for table in tables(solve(case))}
    >>> found["torques"].rows, found["torques"].values.T
    (['T1', 'D1', 'Mx'], array([[-2.5,  1. ,  3.5]]))
    """
    case = results.case
    gears = [gear.name for gear in case.gears]
    names = all_row_names(case)
    filled = []
    for quantity in RELATIVE:
        if quantity.exists is not None and not quantity.exists(results):
            continue
        if quantity.columns == "devices":
            matrix = distribution_matrix(case) + 0.0
            filled.append(Table(quantity, case.link_names, case.devices, matrix))
            continue
        rows = [quantity.key] if quantity.rows == "one" else names[quantity.rows]
        array = np.asarray(results.existing(quantity.name), dtype=np.float64)
        filled.append(Table(quantity, rows, gears, array.reshape(len(gears), len(rows)).T))
    if case.load is None and not any(gear.load for gear in case.gears):
        return filled
    from vstatics.tables.with_units import physical

    return filled + physical(results, filled)
