"""Ratios of sets for which the gears of a box come nearest to their targets.

Numerators and denominators of the gears are known at the corners of the bounds; between them
they are linear in each ratio, so these are their values and their slopes everywhere. Least
squares of ln(i/target) by Levenberg and Marquardt, on the logarithms of the ratios; what is
at a bound and wants to go on stays there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.tolerances import (
    FIRST_DAMPING,
    LEAST_BOX_DAMPING,
    LEAST_BOX_STEP,
    LEAST_DIAGONAL,
    LEAST_GAIN,
    LEAST_SUM_OF_SQUARES,
)

MOST_BOX_STEPS = 60
GIVEN_UP = 1e8
"""No step is tried with more damping. [-]"""


class Asked(NamedTuple):
    """What is asked of a box."""

    targets: Floats
    """Shape (targets,). [-]"""
    least: Floats
    """Between which a target is met, shape (targets,). [-]"""
    most: Floats
    widths: Floats
    """The largest |ln(i/target)| of each, shape (targets,). [-]"""
    low: float
    """Bounds of ring teeth/sun teeth. [-]"""
    high: float


class FitRoom(NamedTuple):
    """Room for a fit."""

    logs: Floats
    """Logarithms of ring teeth/sun teeth: where it begins and ends, shape (sets,). [-]"""
    errors: Floats
    """ln(i/target)/width in the end, shape (targets,). [-]"""
    jacobian: Floats
    """Their derivatives by the logarithms, shape (targets, sets)."""
    tried: Floats
    """The next logarithms, shape (sets,)."""
    trial: Floats
    """Errors there, shape (targets,)."""
    own: Floats
    """How the corners weigh, shape (corners,); their sum is 1."""
    slopes: Floats
    """Derivatives of the weights by the logarithms, shape (sets, corners)."""
    system: Floats
    """Normal equations, shape (sets, sets + 1)."""


def fit_room(targets: int, sets: int) -> FitRoom:
    """Room for so many targets and sets."""
    return FitRoom(
        logs=np.zeros(sets),
        errors=np.zeros(targets),
        jacobian=np.zeros((targets, sets)),
        tried=np.zeros(sets),
        trial=np.zeros(targets),
        own=np.zeros(2**sets),
        slopes=np.zeros((sets, 2**sets)),
        system=np.zeros((sets, sets + 1)),
    )


@compiled
def fitted(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom) -> float:
    """The least sum of squares of ln(i/target)/width near a point; infinity where there is none.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerator and denominator of each ratio at the corners of the bounds.
    chosen : array, shape (targets,)
        The ratio of each target.
    asked : Asked
    room : FitRoom
        `logs` tell where to begin, and where it ended.

    Examples
    --------
    >>> four = np.array([4.0])  # i = 1 + p shall be 4
    >>> room = fit_room(1, 1)
    >>> room.logs[0] = np.log(2.0)
    >>> parts = np.array([[[2.4, 6.0], [1.0, 1.0]]])
    >>> asked = Asked(four, four, four, np.ones(1), 1.4, 5.0)
    >>> bool(fitted(parts, np.array([0]), asked, room) < 1e-20)
    True
    >>> round(float(np.exp(room.logs[0])), 9)
    3.0
    """
    least, most = math.log(asked.low), math.log(asked.high)
    sets = len(room.logs)
    _weigh(room.logs, asked, room)
    best = _errors(parts, chosen, asked, room, room.errors)
    if best == math.inf:
        return best
    _slopes(parts, chosen, asked, room)
    damping = FIRST_DAMPING
    for _ in range(MOST_BOX_STEPS):
        _step(room, least, most, damping)
        step = 0.0
        for number in range(sets):
            wanted = min(max(room.logs[number] + room.tried[number], least), most)
            step = max(step, abs(wanted - room.logs[number]))
            room.tried[number] = wanted
        if step < LEAST_BOX_STEP:
            return best
        _weigh(room.tried, asked, room)
        value = _errors(parts, chosen, asked, room, room.trial)
        if value > best:
            damping *= 10
            if damping > GIVEN_UP:
                return best
            continue
        is_last = best - value <= LEAST_GAIN * best or value < LEAST_SUM_OF_SQUARES
        best = value
        put(room.tried, room.logs)
        put(room.trial, room.errors)
        if is_last:
            return best
        damping = max(damping * 0.1, LEAST_BOX_DAMPING)
        _slopes(parts, chosen, asked, room)
    return best


@compiled
def _weigh(logs: Floats, asked: Asked, room: FitRoom) -> None:
    """How the corners weigh at a point, and how that changes with the logarithm of each ratio."""
    sets = len(logs)
    room.own[:] = 1.0
    room.slopes[:] = 1.0
    width = asked.high - asked.low
    for number in range(sets):
        size = math.exp(logs[number])
        part, slope = (size - asked.low) / width, size / width
        for corner in range(len(room.own)):
            is_high = (corner >> number) & 1
            value = part if is_high else 1.0 - part
            room.own[corner] *= value
            for other in range(sets):
                if other != number:
                    room.slopes[other, corner] *= value
                else:
                    room.slopes[other, corner] *= slope if is_high else -slope


@compiled
def _weighed(part: Floats, weights: Floats) -> tuple[float, float]:
    """Numerator and denominator by their values at the corners, each with its weight."""
    above = below = 0.0
    for corner in range(len(weights)):
        above += weights[corner] * part[0, corner]
        below += weights[corner] * part[1, corner]
    return above, below


@compiled
def _errors(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom, found: Floats) -> float:
    """ln(i/target)/width of every gear; the sum of squares, infinity with another sign of one."""
    total = 0.0
    for target in range(len(asked.targets)):
        above, below = _weighed(parts[chosen[target]], room.own)
        quotient = above / (below * asked.targets[target])
        if not 0 < quotient < math.inf:
            return math.inf
        found[target] = math.log(quotient) / asked.widths[target]
        total += found[target] ** 2
    return total


@compiled
def _slopes(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom) -> None:
    """Derivatives of ln(i)/width of every gear by the logarithms of the ratios of sets."""
    for target in range(len(chosen)):
        part = parts[chosen[target]]
        above, below = _weighed(part, room.own)
        for number in range(room.slopes.shape[0]):
            over, under = _weighed(part, room.slopes[number])
            room.jacobian[target, number] = (over / above - under / below) / asked.widths[target]


@compiled
def _step(room: FitRoom, least: float, most: float, damping: float) -> None:
    """The step of damped normal equations into `tried`, of what is not held by a bound."""
    _find_system(room, least, most, damping)
    system, step = room.system, room.tried
    sets = len(step)
    for pivot in range(sets):  # positive definite: no pivots are looked for
        for row in range(pivot + 1, sets):
            factor = system[row, pivot] / system[pivot, pivot]
            for column in range(pivot, sets + 1):
                system[row, column] -= factor * system[pivot, column]
    for row in range(sets - 1, -1, -1):
        total = system[row, sets]
        for column in range(row + 1, sets):
            total -= system[row, column] * step[column]
        step[row] = total / system[row, row]


@compiled
def _find_system(room: FitRoom, least: float, most: float, damping: float) -> None:
    """The damped normal equations; what a bound holds stays where it is."""
    count, sets = room.jacobian.shape
    system, moves = room.system, room.tried
    for row in range(sets):
        slope = 0.0
        for target in range(count):
            slope += room.jacobian[target, row] * room.errors[target]
        held_low = room.logs[row] <= least and slope > 0
        held_high = room.logs[row] >= most and slope < 0
        moves[row] = 0.0 if held_low or held_high else 1.0
        system[row, sets] = -slope * moves[row]
    for row in range(sets):
        for column in range(sets):
            total = 0.0
            for target in range(count):
                total += room.jacobian[target, row] * room.jacobian[target, column]
            system[row, column] = total * moves[row] * moves[column]
        system[row, row] *= 1 + damping
        system[row, row] += LEAST_DIAGONAL if moves[row] else 1.0
