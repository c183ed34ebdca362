"""Ratios of sets for which the gears of a box come nearest to their targets.

Numerators and denominators of the gears are known at the corners of the bounds; between them
they are linear in each ratio, so these are their values and their slopes everywhere. Least
squares of ln(i/target)/width by Levenberg and Marquardt, on the logarithms of the ratios, with
all gears within their widths; what is at a bound and wants to go on stays there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.compiled import compiled, put
from vstatics.synthesis.tolerances import (
    BEYOND_WIDTH,
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
PULL = 1e4
"""How much the square of what is beyond a width counts, against that of an error. [-]"""
MOST_TURNS = 40
"""So often what is beyond its width is pulled back by more."""
FIRST_TURNS = 3
LESS_BEYOND = 0.9
"""After the first turns less must be beyond each time; it never will be where this is not so."""


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
    pulls: Floats
    """By how much more than it is beyond its width an error is pulled back, shape (targets,)."""
    forces: Floats
    """See `_weigh_errors`, shape (targets,)."""
    weights: Floats
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
        pulls=np.zeros(targets),
        forces=np.zeros(targets),
        weights=np.zeros(targets),
        own=np.zeros(2**sets),
        slopes=np.zeros((sets, 2**sets)),
        system=np.zeros((sets, sets + 1)),
    )


@compiled
def fitted_within(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom) -> float:
    """The least sum of squares near a point that leaves all gears within their widths.

    What is beyond its width is pulled back by more and more, as augmented Lagrangians do. A sum
    of squares that is greater than the number of gears has one beyond wherever it is.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerator and denominator of each ratio at the corners of the bounds.
    chosen : array, shape (targets,)
        The ratio of each target.
    asked : Asked
    room : FitRoom
        `logs` tell where to begin, and where it ended.

    Returns
    -------
    float
        Infinity where there is none.

    Examples
    --------
    Of 1 + p and 1 + 2 p, to be 4 and 8 within such widths, the first is at an end of its range:

    >>> targets, widths = np.array([4.0, 8.0]), np.array([0.11, 0.02])
    >>> parts = np.array([[[2.4, 6.0], [1.0, 1.0]], [[3.8, 11.0], [1.0, 1.0]]])
    >>> room = fit_room(2, 1)
    >>> asked = Asked(targets, targets, targets, widths, 1.4, 5.0)
    >>> bool(fitted_within(parts, np.array([0, 1]), asked, room) < 2)
    True
    >>> round(4 * math.exp(0.11), 9) == round(1 + math.exp(room.logs[0]), 9)
    True
    """
    count = len(asked.targets)
    room.pulls[:] = 0.0
    total = fitted(parts, chosen, asked, 0.0, room)
    beyond = farthest(room.errors) - 1.0
    if total == math.inf or beyond <= 0:
        return total
    if total > count:
        return math.inf
    for turn in range(MOST_TURNS):
        if fitted(parts, chosen, asked, PULL, room) == math.inf:
            return math.inf
        before = beyond
        beyond = farthest(room.errors) - 1.0
        if beyond <= BEYOND_WIDTH:
            return _squares(room.errors)
        if turn > FIRST_TURNS and beyond > LESS_BEYOND * before:
            return math.inf
        for target in range(count):
            pull = abs(room.errors[target]) - 1.0 + room.pulls[target]
            room.pulls[target] = max(pull, 0.0)
    return math.inf


@compiled
def farthest(errors: Floats) -> float:
    """The size of the largest."""
    found = 0.0
    for error in errors:
        found = max(found, abs(error))
    return found


@compiled
def _squares(errors: Floats) -> float:
    """Their sum of squares."""
    found = 0.0
    for error in errors:
        found += error**2
    return found


@compiled
def fitted(parts: Floats, chosen: Integers, asked: Asked, stiffness: float, room: FitRoom) -> float:
    """The least sum of squares of ln(i/target)/width near a point; infinity where there is none.

    With a stiffness so much of the squares of what is beyond a width, and its pull, is added.

    Parameters
    ----------
    parts, chosen, asked, room
        Of `fitted_within`.
    stiffness : float

    Examples
    --------
    >>> four = np.array([4.0])  # i = 1 + p shall be 4
    >>> room = fit_room(1, 1)
    >>> room.logs[0] = np.log(2.0)
    >>> parts = np.array([[[2.4, 6.0], [1.0, 1.0]]])
    >>> asked = Asked(four, four, four, np.ones(1), 1.4, 5.0)
    >>> bool(fitted(parts, np.array([0]), asked, 0.0, room) < 1e-20)
    True
    >>> round(float(np.exp(room.logs[0])), 9)
    3.0
    """
    least, most = math.log(asked.low), math.log(asked.high)
    weigh(room.logs, asked, room)
    best = _errors(parts, chosen, asked, room, room.errors)
    if best == math.inf:
        return best
    best += _pull(room.errors, stiffness, room)
    _slopes(parts, chosen, asked, room)
    damping = FIRST_DAMPING
    for _ in range(MOST_BOX_STEPS):
        _weigh_errors(room, stiffness)
        if damped_step(room, least, most, damping) < LEAST_BOX_STEP:
            return best
        weigh(room.tried, asked, room)
        value = _errors(parts, chosen, asked, room, room.trial)
        value += _pull(room.trial, stiffness, room)
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
def _pull(errors: Floats, stiffness: float, room: FitRoom) -> float:
    """What is added to the sum of squares for what is beyond its width."""
    total = 0.0
    if stiffness > 0:
        for target in range(len(errors)):
            total += max(abs(errors[target]) - 1.0 + room.pulls[target], 0.0) ** 2
    return stiffness * total


@compiled
def weigh(logs: Floats, asked: Asked, room: FitRoom) -> None:
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
def weighed(part: Floats, weights: Floats) -> tuple[float, float]:
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
        above, below = weighed(parts[chosen[target]], room.own)
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
        above, below = weighed(part, room.own)
        for number in range(room.slopes.shape[0]):
            over, under = weighed(part, room.slopes[number])
            room.jacobian[target, number] = (over / above - under / below) / asked.widths[target]


@compiled
def damped_step(room: FitRoom, least: float, most: float, damping: float) -> float:
    """Go by damped normal equations of errors that have their weights; the largest step.

    The next logarithms, within these bounds, are `tried`; what a bound holds stays there.
    """
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
    largest = 0.0
    for number in range(sets):
        wanted = min(max(room.logs[number] + step[number], least), most)
        largest = max(largest, abs(wanted - room.logs[number]))
        room.tried[number] = wanted
    return largest


@compiled
def _weigh_errors(room: FitRoom, stiffness: float) -> None:
    """Half the derivatives of the sum of squares by the errors, the first and the second."""
    for target in range(len(room.errors)):
        error = room.errors[target]
        beyond = abs(error) - 1.0 + room.pulls[target]
        is_pulled = stiffness > 0 and beyond > 0
        room.weights[target] = 1.0 + stiffness if is_pulled else 1.0
        room.forces[target] = error
        if is_pulled:
            room.forces[target] += stiffness * math.copysign(beyond, error)


@compiled
def _find_system(room: FitRoom, least: float, most: float, damping: float) -> None:
    """The damped normal equations; what a bound holds stays where it is."""
    count, sets = room.jacobian.shape
    system, moves = room.system, room.tried
    for row in range(sets):
        slope = 0.0
        for target in range(count):
            slope += room.jacobian[target, row] * room.forces[target]
        held_low = room.logs[row] <= least and slope > 0
        held_high = room.logs[row] >= most and slope < 0
        moves[row] = 0.0 if held_low or held_high else 1.0
        system[row, sets] = -slope * moves[row]
    for row in range(sets):
        for column in range(sets):
            total = 0.0
            for target in range(count):
                both = room.jacobian[target, row] * room.jacobian[target, column]
                total += room.weights[target] * both
            system[row, column] = total * moves[row] * moves[column]
        system[row, row] *= 1 + damping
        system[row, row] += LEAST_DIAGONAL if moves[row] else 1.0
