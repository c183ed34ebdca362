"""Tables of the results in all output formats, in the order of the published listing.

For a case with springs, the headings mention springs.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.statics.matrix import structural_matrix
from vstatics.core.statics.physical import known_units
from vstatics.core.statics.result_arrays import all_row_names
from vstatics.core.statics.results import Results
from vstatics.core.tables.quantities import RELATIVE, WITH_UNITS, Quantity, Table


def tables(results: Results) -> list[Table]:
    """Return all tables that exist for the results of a case.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.core.statics.solve import solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> by_name = {table.quantity.name: table for table in tables(solve(case))}
    >>> by_name["torques"].rows, by_name["torques"].values.T
    (['T1', 'D1', 'Mx'], array([[-2.5,  1. ,  3.5]]))
    """
    case = results.case
    gears = [gear.name for gear in case.gears]
    names = case.derived(all_row_names)
    filled = []
    shown = [*_existing(RELATIVE, results), *with_units(results)]
    if case.springs:
        shown = [*map(among_springs, shown)]
    for quantity in shown:
        if quantity.columns == "devices":
            matrix = structural_matrix(case) + 0.0
            filled.append(Table(quantity, case.link_names, case.devices, matrix))
            continue
        kind = quantity.rows
        rows = [quantity.name] if kind == "one" else names[kind]
        array = np.asarray(results.existing(quantity.name), dtype=np.float64)
        filled.append(Table(quantity, rows, gears, array.reshape(len(gears), len(rows)).T))
    return filled


def places(table: Table) -> list[tuple[str, str, str | None]]:
    """Return table, row and gear of each value, for outputs with a value on each line.

    The distribution matrix does not depend on the gear. Its rows are ``link:device``.
    """
    key, of_matrix = table.quantity.name, table.quantity.columns == "devices"
    return [
        (key, f"{row}:{column}", None) if of_matrix else (key, row, column)
        for row in table.rows
        for column in table.columns
    ]


def with_units(results: Results) -> list[Quantity]:
    """Return the quantities in rpm, N*m and kW for which the case has an operating point."""
    units = known_units(results.case)
    return _existing([quantity for quantity in WITH_UNITS if quantity.unit in units], results)


def _existing(quantities: Sequence[Quantity], results: Results) -> list[Quantity]:
    return [item for item in quantities if item.exists is None or item.exists(results)]


WORDS = {
    "KLG = KL + KG": "KLG = KL + KG + KSPR",
    "mechanisms and output": "mechanisms, springs and output",
    "the elements and of the output": "the elements, of springs and of the output",
}
"""Words in headings, and what a case with springs has instead."""


def among_springs(quantity: Quantity) -> Quantity:
    """Return a quantity with headings that mention springs.

    >>> from vstatics.core.tables.quantities import BY_NAME
    >>> among_springs(BY_NAME["torques"]).members[0]
    'Torques of mechanisms, springs and output, KLG1 = KLG + 1, without losses'
    """
    members = quantity.members
    return quantity._replace(
        heading=_worded(quantity.heading),
        members=None if members is None else (_worded(members[0]), _worded(members[1])),
    )


def _worded(heading: str) -> str:
    for words, replacement in WORDS.items():
        heading = heading.replace(words, replacement)
    return heading
