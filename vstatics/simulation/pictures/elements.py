"""Times at which the shift elements of a run stick, or slip under torque."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.tolerances import NO_RUN_TORQUE, SAME_RUN_SPEED
from vstatics.simulation.record.motion import Motion


class ElementStates(NamedTuple):
    """Periods of slip under torque, and of sticking, of a shift element."""

    name: str
    element: int
    """Index of the shift element in `Motion.elements`."""
    slips: tuple[Span, ...]
    """Start and end of each period of slip under torque. [s]"""
    sticks: tuple[Span, ...]


def loaded(motion: Motion) -> list[tuple[int, str]]:
    """Return index and name of the shift elements that carry torque at any time."""
    carries = carrying(motion)
    return [(place, name) for place, name in enumerate(motion.elements) if carries[place]]


def carrying(motion: Motion) -> Booleans:
    """Return a flag for each component: True if it ever carries torque above rounding noise."""
    peaks = np.fmax.reduce(np.abs(motion.torques), axis=0, initial=0.0)
    carries: Booleans = peaks > NO_RUN_TORQUE * peaks.max(initial=0.0)
    return carries


def states(motion: Motion) -> list[ElementStates]:
    """Return the periods in which shift elements slip or stick under torque.

    A shift element without torque, or with drag torque alone, counts as disengaged.
    """
    fastest = np.abs(motion.speeds).max(initial=0.0)
    listed = []
    for place, name in loaded(motion):
        torques, slips = _gripped(motion, place), np.abs(motion.slips[:, place])
        if torques.any():
            carries = torques[:-1] + torques[1:] > SAME_RUN_SPEED * torques.max()
            near = SAME_RUN_SPEED * max(fastest, slips.max())
            moves = np.maximum(slips[:-1], slips[1:]) > near  # slip at either end of an interval
            slipping, sticking = (
                tuple(spans(motion.time, carries & some)) for some in (moves, ~moves)
            )
            listed.append(ElementStates(name, place, slipping, sticking))
    return listed


def _gripped(motion: Motion, place: int) -> Floats:
    """Return the torque magnitude of a shift element without its drag torque [N*m]."""
    name, torques = motion.elements[place], np.abs(motion.torques[:, place])
    capacities = motion.beside.get("capacities", {}).get(name)
    if capacities is None:
        return torques
    case = motion.case
    if case and case.shift_elements[place].is_freewheel:  # a freewheel can overrun at any capacity
        sticks = motion.beside["sticks"][name] > 0
        return np.where(sticks | (torques > capacities * (1 - SAME_RUN_SPEED)), torques, 0.0)
    return np.minimum(torques, capacities)


def spans(time: Floats, holds: Booleans) -> Iterator[Span]:
    """Yield start and end of each period of a state; `holds` has a flag per interval of `time`.

    >>> list(spans(np.array([0.0, 1.0, 1.0, 3.0]), np.array([True, False, True])))
    [(0.0, 1.0), (1.0, 3.0)]
    """
    edges = np.flatnonzero(np.diff(np.r_[False, holds, False]))
    for start, end in edges.reshape(-1, 2):
        if time[end] > time[start]:
            yield float(time[start]), float(time[end])
