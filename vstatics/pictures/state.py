"""What pictures show of a gear: all that they read of how it was calculated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.model.transmission import HOUSING, Gear, Transmission
from vstatics.statics.results import Results

TIED_UP, CONFLICT = "tied up", "conflict of freewheels"
LOCKED, MISSING = "locked by friction", "not determined"


class Joined(NamedTuple):
    """The links that engaged elements join to the input, the output and the housing."""

    input: frozenset[int]
    output: frozenset[int]
    housing: frozenset[int]


class PictureState(NamedTuple):
    """A gear as pictures show it."""

    input: int
    """Its link."""
    output: int
    gear: Gear
    """With the freewheels that hold among the engaged elements."""
    faults: Sequence[str]
    """What keeps it from being calculated."""
    ratio: float
    """[-]"""
    speeds: Sequence[float]
    """By link, the housing first; NaN where it is free. [-]"""
    joined: Joined
    holds: Sequence[bool]
    """By shift element: whether it is engaged, or a freewheel that holds."""
    is_idle: Sequence[bool]
    """By mechanism: whether it transmits no power, as far as the gear exists."""
    is_loaded: Sequence[bool]
    """By mechanism: whether it carries torque, or one that is not known."""


def state_of(results: Results, number: int) -> PictureState:
    """The state of a gear.

    Parameters
    ----------
    results : Results
        Of one case.
    number : int
        From 1.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> state.speeds[:3], state.joined.housing
    ([0.0, 1.0, 0.0], frozenset({0, 2}))
    """
    index, case = number - 1, results.case
    gear = results.settled.gears[index]
    marks = (
        (TIED_UP, results.tied_up),
        (CONFLICT, results.conflict),
        (LOCKED, results.locked),
        (MISSING, results.missing),
    )
    torques = results.torques[index, len(case.shift_elements) : -1]
    return PictureState(
        case.gear_input(gear),
        case.gear_output(gear),
        gear,
        [fault for fault, mark in marks if mark[index]],
        float(results.ratio[index]),
        [0.0, *results.speeds[index].tolist()],
        _joined(case, gear),
        results.holds[index].tolist(),
        (results.idle[index] & results.calculable[index]).tolist(),
        (np.nan_to_num(torques, nan=1.0) != 0).tolist(),
    )


def _joined(case: Transmission, gear: Gear) -> Joined:
    pairs = [case.shift_elements[one - 1][:2] for one in gear.engaged]

    def with_(link: int) -> frozenset[int]:
        found = {link}
        for _ in pairs:
            for pair in pairs:
                if found & set(pair):
                    found |= set(pair)
        return frozenset(found)

    return Joined(with_(case.gear_input(gear)), with_(case.gear_output(gear)), with_(HOUSING))
