"""When each shift element of a run sticks or slips under torque."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.pictures.sheet.labels import Span
from vstatics.pictures.sheet.tolerances import NO_RUN_TORQUE, SAME_RUN_SPEED
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

    An element that carries none is open; so is one that is at rest without torque.
    """
    return [_states(motion, place, name) for place, name in loaded(motion)]


def _states(motion: Motion, place: int, name: str) -> ElementStates:
    """Between two instants an element slips if it does at either of them."""
    torques, slips = np.abs(motion.torques[:, place]), np.abs(motion.slips[:, place])
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
