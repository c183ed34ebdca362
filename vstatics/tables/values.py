"""Results as the tables that every output format shows, in the order of the source."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.statics.arrays import all_row_names
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.physical import known_units
from vstatics.statics.results import Results
from vstatics.tables.quantities import RELATIVE, WITH_UNITS
from vstatics.tables.quantity import Quantity, Table


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
    shown = [*_existing(RELATIVE, results), *with_units(results)]
    if case.springs:
        from vstatics.tables.spring_words import among_springs  # costs start-up time

        shown = [*map(among_springs, shown)]
    for quantity in shown:
        if quantity.columns == "devices":
            matrix = distribution_matrix(case) + 0.0
            filled.append(Table(quantity, case.link_names, case.devices, matrix))
            continue
        kind = quantity.rows
        rows = [quantity.key] if kind == "one" else names[kind]
        array = np.asarray(results.existing(quantity.name), dtype=np.float64)
        filled.append(Table(quantity, rows, gears, array.reshape(len(gears), len(rows)).T))
    return filled


def with_units(results: Results) -> list[Quantity]:
    """Those in rpm, N*m and kW that the load of a case tells; none without a load."""
    units = known_units(results.case)
    return _existing([one for one in WITH_UNITS if one.unit in units], results)


def _existing(quantities: Sequence[Quantity], results: Results) -> list[Quantity]:
    return [one for one in quantities if one.exists is None or one.exists(results)]
