"""Gear-set ratios at which the gears of a gearbox are nearest to their targets.

Numerators and denominators of the gear ratios are known at the corners of the bounds. They are
linear in each gear-set ratio, so their values and slopes follow everywhere. The method is
Levenberg-Marquardt on ln(i/target)/width as a function of the logarithms of the gear-set ratios,
with all gears within their widths. A gear-set ratio at a bound stays there while its slope points
outwards.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.synthesis.compiled import compiled_part, fill, put, shared
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
"""Largest number of Levenberg-Marquardt steps in a fit."""
GIVEN_UP = 1e8
"""Damping above which a fit is aborted. [-]"""
PULL = 1e4
"""Weight of the squared excess of an error over its tolerance (width), relative to a squared error.
[-]
"""
MOST_TURNS = 40
"""Largest number of times that the pull on errors beyond their tolerance is increased."""
FIRST_TURNS = 3
"""Number of turns after which the excess of errors must shrink by `LESS_BEYOND` in each turn."""
LESS_BEYOND = 0.9
"""Largest permitted quotient of the excess of errors over their tolerance in successive turns. [-]
"""


@shared
class Asked(NamedTuple):
    """Wanted ratios with tolerance ranges, and bounds of gear-set ratios."""

    targets: Floats
    """Wanted ratios of the gears, shape (targets,). [-]"""
    least: Floats
    """Lower ends of the ranges of gear ratios that meet the targets, shape (targets,). [-]"""
    most: Floats
    """Upper ends of the ranges of gear ratios that meet the targets, shape (targets,). [-]"""
    widths: Floats
    """Largest deviation |ln(i/target)| for each target, shape (targets,). [-]"""
    low: float
    """Lower bound of ring teeth divided by sun teeth. [-]"""
    high: float
    """Upper bound of ring teeth divided by sun teeth. [-]"""


@shared
class FitRoom(NamedTuple):
    """Work arrays for a fit of gear-set ratios."""

    logs: Floats
    """Logarithms of ring teeth divided by sun teeth at the current point, shape (sets,). [-]"""
    errors: Floats
    """Errors ln(i/target)/width at the point `logs`, shape (targets,). [-]"""
    jacobian: Floats
    """Derivatives of the errors with respect to the logarithms, shape (targets, sets). [-]"""
    tried: Floats
    """Logarithms after a trial step from `logs`, shape (sets,). [-]"""
    trial: Floats
    """Errors at the point `tried`, shape (targets,). [-]"""
    pulls: Floats
    """Amount by which each target's width is narrowed, in widths, shape (targets,). [-]"""
    forces: Floats
    """First derivative of half the sum of squared errors with respect to each error, shape
    (targets,). [-]
    """
    weights: Floats
    """Second derivative of half the sum of squared errors with respect to each error, shape
    (targets,). [-]
    """
    corner_weights: Floats
    """Weights of the corners in interpolation, with sum 1, shape (corners,). [-]"""
    slopes: Floats
    """Derivatives of the corner weights with respect to the logarithms, shape (sets, corners). [-]
    """
    system: Floats
    """Normal equations, shape (sets, sets + 1)."""


def fit_room(targets: int, sets: int) -> FitRoom:
    """Return work arrays for a number of targets and gear sets."""
    return FitRoom(
        logs=np.zeros(sets),
        errors=np.zeros(targets),
        jacobian=np.zeros((targets, sets)),
        tried=np.zeros(sets),
        trial=np.zeros(targets),
        pulls=np.zeros(targets),
        forces=np.zeros(targets),
        weights=np.zeros(targets),
        corner_weights=np.zeros(2**sets),
        slopes=np.zeros((sets, 2**sets)),
        system=np.zeros((sets, sets + 1)),
    )


@compiled_part
def fitted_within(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom) -> float:
    """Minimise the squared errors near a point, with all gear ratios within the wanted ranges.

    Errors beyond their widths are pulled back more strongly in each turn, as in the method of
    augmented Lagrangians. If the smallest sum of squares exceeds the number of gears, some gear is
    always beyond its width.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerator and denominator of each gear ratio at the corners of the bounds.
    chosen : array, shape (targets,)
        Index of the gear ratio of each target.
    asked : Asked
    room : FitRoom
        Work arrays; `logs` contains the starting point and receives the solution.

    Returns
    -------
    float
        Smallest sum of squares; infinity without a solution. [-]

    Examples
    --------
    With 1 + p = 4 and 1 + 2 p = 8 wanted, the first ratio ends at the end of its range:

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
    fill(room.pulls, 0.0)
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


@compiled_part
def farthest(errors: Floats) -> float:
    """Return the largest absolute error."""
    largest = 0.0
    for error in errors:
        largest = max(largest, abs(error))
    return largest


@compiled_part
def _squares(errors: Floats) -> float:
    total = 0.0
    for error in errors:
        total += error**2
    return total


@compiled_part
def fitted(parts: Floats, chosen: Integers, asked: Asked, stiffness: float, room: FitRoom) -> float:
    """Minimise the sum of squares of ln(i/target)/width, starting from the point `room.logs`.

    Parameters
    ----------
    parts, chosen, asked, room
        As for `fitted_within`.
    stiffness : float
        Weight of squared errors beyond their widths, including the pulls. [-]

    Returns
    -------
    float
        Smallest sum of squares, including weighted squares beyond the widths; infinity without a
        solution. [-]

    Examples
    --------
    >>> four = np.array([4.0])  # 1 + p = 4
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


@compiled_part
def _pull(errors: Floats, stiffness: float, room: FitRoom) -> float:
    total = 0.0
    if stiffness > 0:
        for target in range(len(errors)):
            total += max(abs(errors[target]) - 1.0 + room.pulls[target], 0.0) ** 2
    return stiffness * total


@compiled_part
def weigh(logs: Floats, asked: Asked, room: FitRoom) -> None:
    """Calculate the corner weights at a point, and their derivatives."""
    sets = len(logs)
    fill(room.corner_weights, 1.0)
    for slopes in room.slopes:
        fill(slopes, 1.0)
    width = asked.high - asked.low
    for number in range(sets):
        size = math.exp(logs[number])
        part, slope = (size - asked.low) / width, size / width
        for corner in range(len(room.corner_weights)):
            is_high = (corner >> number) & 1
            value = part if is_high else 1.0 - part
            room.corner_weights[corner] *= value
            for other in range(sets):
                if other != number:
                    room.slopes[other, corner] *= value
                else:
                    room.slopes[other, corner] *= slope if is_high else -slope


@compiled_part
def weighed(part: Floats, weights: Floats) -> tuple[float, float]:
    """Interpolate numerator and denominator between the corners with given weights."""
    above = below = 0.0
    for corner in range(len(weights)):
        above += weights[corner] * part[0, corner]
        below += weights[corner] * part[1, corner]
    return above, below


@compiled_part
def _errors(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom, errors: Floats) -> float:
    """Calculate the error ln(i/target)/width of every gear; return the sum of squares.

    The sum is infinite if a gear has the wrong direction.
    """
    total = 0.0
    for target in range(len(asked.targets)):
        above, below = weighed(parts[chosen[target]], room.corner_weights)
        quotient = above / (below * asked.targets[target])
        if not 0 < quotient < math.inf:
            return math.inf
        errors[target] = math.log(quotient) / asked.widths[target]
        total += errors[target] ** 2
    return total


@compiled_part
def _slopes(parts: Floats, chosen: Integers, asked: Asked, room: FitRoom) -> None:
    for target in range(len(chosen)):
        part = parts[chosen[target]]
        above, below = weighed(part, room.corner_weights)
        for number in range(room.slopes.shape[0]):
            over, under = weighed(part, room.slopes[number])
            room.jacobian[target, number] = (over / above - under / below) / asked.widths[target]


@compiled_part
def damped_step(room: FitRoom, least: float, most: float, damping: float) -> float:
    """Calculate a damped step from the weighted errors, and return the largest component.

    `tried` receives the new logarithms, clipped to the bounds.
    """
    _find_system(room, least, most, damping)
    system, step = room.system, room.tried
    sets = len(step)
    for pivot in range(sets):  # the matrix is positive definite, so pivoting is not needed
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


@compiled_part
def _weigh_errors(room: FitRoom, stiffness: float) -> None:
    """Calculate both derivatives of half the sum of squared errors with respect to each error."""
    for target in range(len(room.errors)):
        error = room.errors[target]
        beyond = abs(error) - 1.0 + room.pulls[target]
        is_pulled = stiffness > 0 and beyond > 0
        room.weights[target] = 1.0 + stiffness if is_pulled else 1.0
        room.forces[target] = error
        if is_pulled:
            room.forces[target] += stiffness * math.copysign(beyond, error)


@compiled_part
def _find_system(room: FitRoom, least: float, most: float, damping: float) -> None:
    """Set up the damped normal equations. A gear-set ratio held by a bound does not move."""
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
