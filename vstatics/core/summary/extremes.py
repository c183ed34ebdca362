"""Largest values and smallest torque margins in any gear, with the gears."""

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

PLANETS, SLIPS, TORQUES, LOSSY_TORQUES = (
    "planet_speeds",
    "slip_speeds",
    "torques",
    "lossy_torques",
)


def quantity(name: str, *, loaded: bool) -> Quantity:
    """Return the quantity called `name`, in rpm or N*m if `loaded`."""
    return in_unit(BY_NAME[name]) if loaded else BY_NAME[name]


class Largest(NamedTuple):
    """Value of largest magnitude in a row of a result table."""

    row: str
    value: float
    """Signed value; NaN if the row has no value in any gear."""
    gear: str
    """First gear that has the value; empty if the value is 0 or NaN."""


def largest(results: Results) -> dict[str, list[Largest]]:
    """Return the largest values in any gear of a case, by name of the result table.

    The tables contain speeds of planets, slip speeds of disengaged shift elements, and torques on
    shift elements without and with losses. Gears without torques are ignored. With an operating
    point there are also tables in rpm and N*m.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> values = largest(solve(case))
    >>> values["torques"][1]
    Largest(row='B', value=-2.5, gear='1')
    >>> list(values)
    ['planet_speeds', 'slip_speeds', 'torques', 'lossy_torques']
    """
    by_name = {}
    for table in tables(results):
        name = table.quantity.name
        kind = table.quantity.of or name
        if kind == PLANETS:
            by_name[name] = _of(table, table.values)
        elif kind == SLIPS:
            by_name[name] = _of(table, np.where(_joined(results), np.nan, table.values))
        elif kind in (TORQUES, LOSSY_TORQUES):
            elements = table.values[: len(results.case.shift_elements)]
            # tied-up gears, for example, have no torques
            loaded = results.holds.T & results.calculable
            by_name[name] = _of(table, np.where(loaded, elements, np.nan))
    return by_name


def _joined(results: Results) -> Booleans:
    """Return flags of shift elements whose links rotate together, shape (shift elements, gears)."""
    joined = results.holds.T.copy()
    for place, gear in enumerate(results.case.gears):
        joined[[number - 1 for number in gear.slipping], place] = False
    return joined


def overall(lines: Sequence[Largest]) -> Largest | None:
    """Return the largest value of all rows; None without values."""
    known = [line for line in lines if not math.isnan(line.value)]
    return max(known, key=lambda line: abs(line.value)) if known else None


def _of(table: Table, values: Floats) -> list[Largest]:
    return [
        _largest(name, row, table.columns)
        for name, row in zip(table.rows, values, strict=False)  # ignores rows of mechanisms
    ]


def _largest(name: str, row: Floats, gears: Sequence[str]) -> Largest:
    sizes = np.abs(row)
    if np.isnan(sizes).all():
        return Largest(name, math.nan, "")
    top = np.nanmax(sizes)
    first = int(np.argmax(sizes >= top * (1 - SAME_RATIO)))  # comparisons with NaN are false
    return Largest(name, float(row[first]), gears[first] if top > 0 else "")


class Margin(NamedTuple):
    """Torque margins of a shift element whose torque capacity is known."""

    element: str
    capacity: float
    """Torque capacity relative to the input torque of the case. [-]"""
    by_gear: Sequence[float]
    """Capacity divided by torque in each gear; NaN if disengaged or without torque. [-]"""
    least: float
    gear: str
    """First gear with the smallest margin; empty if the shift element never carries torque."""


def margins(results: Results) -> list[Margin]:
    """Return the margins ``capacity/|M|`` of engaged shift elements in the gears of a case.

    M is the torque at the operating point of the gear. Of the values without and with losses, the
    larger is taken.

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
    lines = []
    for number, element in enumerate(case.shift_elements):
        if not element.capacity:  # without an operating point, a capacity in N*m is 0
            continue
        with np.errstate(all="ignore"):
            ratios = element.capacity / torques[:, number]
        by_gear = np.where(carrying[:, number], ratios, np.nan).tolist()
        least = min((margin for margin in by_gear if math.isfinite(margin)), default=math.nan)
        first = [n for n, margin in enumerate(by_gear) if margin <= least * (1 + SAME_RATIO)]
        gear = case.gears[first[0]].name if first else ""
        margin = by_gear[first[0]] if first else math.nan
        lines.append(Margin(element.name, element.capacity, by_gear, margin, gear))
    return lines


class Needed(NamedTuple):
    """Required torque capacity of a shift element."""

    element: str
    capacity: float
    """Largest torque times reserve, relative to the input torque of the case or, without that, to
    the largest input torque of the gears. [-]
    """
    gear: str
    """First gear with the largest torque; empty if the shift element never carries torque."""
    capacity_Nm: float  # noqa: N815
    """Required capacity [N*m]; NaN without an input torque."""


def needed_capacities(results: Results, reserve: float) -> list[Needed]:
    """Return the largest torque on each shift element, as in `margins`, times a reserve.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2], name="low"), Gear([1])])
    >>> needed_capacities(solve(case), 1.2)[1]
    Needed(element='B', capacity=3.0, gear='low', capacity_Nm=nan)
    """
    case = results.case
    by_gear = [case.gear_load(gear).torque_size for gear in case.gears]
    common = (case.load and case.load.torque_size) or (max(by_gear) if all(by_gear) else 0.0)
    torques, carrying = carried_torques(results, common)
    sizes, unit = np.where(carrying, torques, 0.0), common or math.nan
    capacities = []
    for element, column in zip(case.shift_elements, sizes.T, strict=True):
        top = float(column.max(initial=0.0))
        first = int(np.argmax(column >= top * (1 - SAME_RATIO)))
        gear = case.gears[first].name if top > 0 else ""
        capacities.append(Needed(element.name, top * reserve, gear, top * reserve * unit))
    return capacities
