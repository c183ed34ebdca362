"""When each shift element of a run sticks or slips under torque."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.tolerances import NO_RUN_TORQUE, SAME_RUN_SPEED
from vstatics.simulation.record.motion import Motion


class ElementStates(NamedTuple):
    """When a shift element slips under torque, and when it sticks."""

    name: str
    element: int
    """Its place."""
    slips: tuple[Span, ...]
    """From when till when. [s]"""
    sticks: tuple[Span, ...]


def loaded(motion: Motion) -> list[tuple[int, str]]:
    """Shift elements that carry torque at any time, with their places."""
    carries = carrying(motion)
    return [(place, name) for place, name in enumerate(motion.elements) if carries[place]]


def carrying(motion: Motion) -> Booleans:
    """Of each device, whether it carries torque at any time; less than rounding is none."""
    peaks = np.fmax.reduce(np.abs(motion.torques), axis=0, initial=0.0)
    made: Booleans = peaks > NO_RUN_TORQUE * peaks.max(initial=0.0)
    return made


def states(motion: Motion) -> list[ElementStates]:
    """When elements slip and stick, of those that carry torque.

    An element that carries none, or drags alone, is open; so is one at rest without torque.
    """
    gripped = [(place, name, _gripped(motion, place)) for place, name in loaded(motion)]
    return [_states(motion, *element) for element in gripped if element[2].any()]


def _gripped(motion: Motion, place: int) -> Floats:
    """The torque of a shift element at each instant without its drag, by magnitude [N*m]."""
    name, torques = motion.elements[place], np.abs(motion.torques[:, place])
    capacities = motion.beside.get("capacities", {}).get(name)
    if capacities is None:
        return torques
    case = motion.case
    if case and case.shift_elements[place].is_freewheel:  # it overruns whatever it can carry
        sticks = motion.beside["sticks"][name] > 0
        return np.where(sticks | (torques > capacities * (1 - SAME_RUN_SPEED)), torques, 0.0)
    return np.minimum(torques, capacities)


def _states(motion: Motion, place: int, name: str, torques: Floats) -> ElementStates:
    """Between two instants an element slips if it does at either of them."""
    slips = np.abs(motion.slips[:, place])
    carries = torques[:-1] + torques[1:] > SAME_RUN_SPEED * torques.max()
    near = SAME_RUN_SPEED * max(np.abs(motion.speeds).max(initial=0.0), slips.max())
    moves = np.maximum(slips[:-1], slips[1:]) > near
    slipping = tuple(spans(motion.time, carries & moves))
    return ElementStates(name, place, slipping, tuple(spans(motion.time, carries & ~moves)))


def spans(time: Floats, holds: Booleans) -> Iterator[Span]:
    """From when till when something holds that is known between instants.

    >>> list(spans(np.array([0.0, 1.0, 1.0, 3.0]), np.array([True, False, True])))
    [(0.0, 1.0), (1.0, 3.0)]
    """
    edges = np.flatnonzero(np.diff(np.r_[False, holds, False]))
    for start, end in edges.reshape(-1, 2):
        if time[end] > time[start]:
            yield float(time[start]), float(time[end])
