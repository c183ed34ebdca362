"""Degrees of freedom of a train, and gears whose constraints leave the ratio unknown."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.traced import Number, plain
from vstatics.core.statics import matrix
from vstatics.core.statics.results import Results


def freedom(case: Transmission) -> int:
    """Return the degrees of freedom of the train without shift elements.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> freedom(Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])]))
    2
    """
    rows = matrix.speed_rows(case, Gear(), matrix_rows(case, case.gears[0]))[:-1]
    return elimination.solve(rows, case.links).missing


def given_constraints(gear: Gear) -> int:
    """Return the number of shift elements that carry torque and of prescribed speeds."""
    return len(gear.carrying) + 1 + len(gear.speeds)


def matrix_rows(case: Transmission, gear: Gear) -> list[matrix.Column]:
    """Return the equations of the mechanisms in a gear; see `matrix.rows`."""
    return matrix.rows(case, case.gear_ratios(gear))


def is_neutral(results: Results, number: int) -> bool:
    """Return whether missing constraints leave the ratio of a gear unknown."""
    is_undetermined = bool(results.missing[number]) and bool(np.isnan(results.ratio[number]))
    return is_undetermined and not results.tied_up[number] and not results.conflict[number]


def is_adrift(results: Results, number: int) -> bool:
    """Return whether a gear is neutral, and nothing supports its external torques."""
    return is_neutral(results, number) and not results.balanced[number]


def is_for_motion(case: Transmission, gear: Gear) -> bool:
    """Return whether a case only describes motion: inertias or masses, but no `gears` or load."""
    alone = len(case.gears) == 1 and gear == Gear(name="1")
    return alone and case.load is None and bool(case.inertias or case.masses)


def without_value(names: Sequence[str], values: Sequence[Number]) -> list[str]:
    """Return the names of the parts whose value is NaN."""
    return [name for name, value in zip(names, values, strict=True) if math.isnan(plain(value))]
