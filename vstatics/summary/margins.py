"""How much more than the torque of each gear a shift element could carry."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.results import Results
from vstatics.summary.order import SAME


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
    """Capacity by torque, ``capacity/|M|``, in the gears where an element is engaged.

    M is the larger of the torques without and with losses, to be on the safe side. In
    a gear with a load of its own, M is that of this load.

    Parameters
    ----------
    results : Results
        Of one case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B", capacity=4)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2], name="low"), Gear([1])])
    >>> margins(solve(case))
    [Margin(element='B', capacity=4.0, by_gear=[1.6, nan], least=1.6, gear='low')]
    """
    case = results.case
    count = len(case.shift_elements)
    both = np.abs(results.torques[:, :count]), np.abs(results.lossy_torques[:, :count])
    torques = np.fmax(*both) * _loads(results)[:, np.newaxis]
    carrying = results.holds & (np.fmax(*both) > SAME)  # relative to the input torque
    return [
        _margin(results, element.name, element.capacity, torques[:, number], carrying[:, number])
        for number, element in enumerate(case.shift_elements)
        if element.capacity is not None
    ]


def _margin(
    results: Results, name: str, capacity: float, torques: Floats, carrying: Booleans
) -> Margin:
    with np.errstate(all="ignore"):
        found = np.where(carrying, capacity / torques, np.nan).tolist()
    known = [number for number, margin in enumerate(found) if math.isfinite(margin)]
    if not known:
        return Margin(name, capacity, found, math.nan, "")
    least = min(found[number] for number in known)
    first = next(number for number in known if found[number] <= least * (1 + SAME))
    return Margin(name, capacity, found, found[first], results.case.gears[first].name)


def _loads(results: Results) -> Floats:
    """The input torque of each gear by that of the case; 1 where one of them is not told."""
    case = results.case
    common = None if case.load is None else case.load.torque
    own = (case.gear_load(gear).torque for gear in case.gears)
    return np.array([abs(torque / common) if torque and common else 1.0 for torque in own])
