"""The largest values over all gears and the least margins of capacity, each with its gear."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.statics.carried import carried_torques
from vstatics.core.statics.results import Results
from vstatics.core.tables.quantities import BY_NAME, Quantity, Table, in_unit
from vstatics.core.tables.values import tables

PLANETS, SLIPS, TORQUES, LOSSY_TORQUES = "WSAT", "WFRI", "AMLG", "AMLGP"


def quantity(key: str, *, loaded: bool) -> Quantity:
    """One of these four, or what it is with a load."""
    return in_unit(BY_NAME[key]) if loaded else BY_NAME[key]


class Largest(NamedTuple):
    """The value of a row that is the largest one without its sign."""

    row: str
    value: float
    """With its sign; NaN where there is none in any gear."""
    gear: str
    """The first gear with it; empty where the value is 0 or there is none."""


def largest(results: Results) -> dict[str, list[Largest]]:
    """The largest values over all gears of one case, by the name of the table.

    Speeds of planets, slip speeds of open shift elements, torques of engaged ones without
    and with losses where the gear can run; with a load all of them in rpm and N*m, too.
    Rows are those of the tables, so what the case draws has its own.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> found = largest(solve(case))
    >>> found["AMLG"][1]
    Largest(row='B', value=-2.5, gear='1')
    >>> list(found)
    ['WSAT', 'WFRI', 'AMLG', 'AMLGP']
    """
    by_key = {}
    for table in tables(results):
        key = table.quantity.key
        kind = BY_NAME[table.quantity.of or key].key
        if kind == PLANETS:
            by_key[key] = _of(table, table.values)
        elif kind == SLIPS:
            by_key[key] = _of(table, np.where(results.holds.T, np.nan, table.values))
        elif kind in (TORQUES, LOSSY_TORQUES):
            own = table.values[: len(results.case.shift_elements)]
            loaded = results.holds.T & results.calculable  # a gear that is tied up has no flow
            by_key[key] = _of(table, np.where(loaded, own, np.nan))
    return by_key


def overall(lines: Sequence[Largest]) -> Largest | None:
    """The largest of all rows."""
    known = [line for line in lines if not math.isnan(line.value)]
    return max(known, key=lambda line: abs(line.value)) if known else None


def _of(table: Table, values: Floats) -> list[Largest]:
    return [
        _largest(name, row, table.columns)
        for name, row in zip(table.rows, values, strict=False)  # rows of mechanisms left out
    ]


def _largest(name: str, row: Floats, gears: Sequence[str]) -> Largest:
    sizes = np.abs(row)
    if np.isnan(sizes).all():
        return Largest(name, math.nan, "")
    top = np.nanmax(sizes)
    first = int(np.argmax(sizes >= top * (1 - SAME_RATIO)))  # a comparison with NaN is false
    return Largest(name, float(row[first]), gears[first] if top > 0 else "")


class Margin(NamedTuple):
    """The margins of a shift element that has a capacity."""

    element: str
    capacity: float
    """Relative to the input torque of the case. [-]"""
    by_gear: Sequence[float]
    """Capacity by torque; NaN where the element is open or carries nothing. [-]"""
    least: float
    gear: str
    """The first gear with the least; empty if there is none."""


def margins(results: Results) -> list[Margin]:
    """Capacity by torque, ``capacity/|M|``, in the gears of one case where an element is engaged.

    M is the larger of the torques without and with losses, to be on the safe side. In
    a gear with a load of its own, M is that of this load.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B", capacity=4)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2], name="low"), Gear([1])])
    >>> margins(solve(case))
    [Margin(element='B', capacity=4.0, by_gear=[1.6, nan], least=1.6, gear='low')]
    """
    case = results.case
    torques, carrying = carried_torques(results, case.load.torque_size if case.load else 0.0)
    return [
        _margin(results, element.name, element.capacity, torques[:, number], carrying[:, number])
        for number, element in enumerate(case.shift_elements)
        if element.capacity  # one with a unit, without a load, is 0 of it
    ]


class Needed(NamedTuple):
    """What a shift element must be able to carry."""

    element: str
    capacity: float
    """Its largest torque with the reserve, relative to the input torque of the case, or the
    largest of the gears if they alone have one. [-]"""
    gear: str
    """The first gear with the largest torque; empty if it carries nothing."""
    capacity_Nm: float  # noqa: N815
    """The same with the load [N*m]; NaN where a gear has none."""


def needed_capacities(results: Results, reserve: float) -> list[Needed]:
    """The largest torque of each shift element, times a reserve; torques as of `margins`.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2], name="low"), Gear([1])])
    >>> needed_capacities(solve(case), 1.2)[1]
    Needed(element='B', capacity=3.0, gear='low', capacity_Nm=nan)
    """
    case = results.case
    own = [case.gear_load(gear).torque_size for gear in case.gears]
    common = (case.load and case.load.torque_size) or (max(own) if all(own) else 0.0)
    torques, carrying = carried_torques(results, common)
    sizes, unit = np.where(carrying, torques, 0.0), common or math.nan
    found = []
    for element, column in zip(case.shift_elements, sizes.T, strict=True):
        top = float(column.max(initial=0.0))
        first = int(np.argmax(column >= top * (1 - SAME_RATIO)))
        gear = case.gears[first].name if top > 0 else ""
        found.append(Needed(element.name, top * reserve, gear, top * reserve * unit))
    return found


def _margin(
    results: Results, name: str, capacity: float, torques: Floats, carrying: Booleans
) -> Margin:
    with np.errstate(all="ignore"):
        margins = np.where(carrying, capacity / torques, np.nan).tolist()
    known = [number for number, margin in enumerate(margins) if math.isfinite(margin)]
    if not known:
        return Margin(name, capacity, margins, math.nan, "")
    least = min(margins[number] for number in known)
    first = next(number for number in known if margins[number] <= least * (1 + SAME_RATIO))
    return Margin(name, capacity, margins, margins[first], results.case.gears[first].name)
