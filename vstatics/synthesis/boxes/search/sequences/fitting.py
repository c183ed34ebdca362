"""Gear-set ratios at which targets, spread and steps are nearest to the middles of their ranges.

The Levenberg-Marquardt method minimises the squares of ln(i/target)/width for the targets, and of
ln(value/middle)/half-width for the spread and each step. Values outside their ranges are pulled
back more strongly in each turn (augmented Lagrangian). A range without upper end has no middle, and
does not count.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import (
    FIRST_TURNS,
    GIVEN_UP,
    LESS_BEYOND,
    MOST_BOX_STEPS,
    MOST_TURNS,
    PULL,
    Asked,
    damped_step,
    weigh,
    weighed,
)
from vstatics.synthesis.compiled import compiled_part, fill, put
from vstatics.synthesis.tolerances import (
    BEYOND_WIDTH,
    FIRST_DAMPING,
    LEAST_BOX_DAMPING,
    LEAST_BOX_STEP,
    LEAST_GAIN,
    NARROWEST_RANGE,
)

WIDTH_WITHOUT_MIDDLE = 0.1
"""Half-width that is assumed for a range without upper end. [-]"""


@compiled_part
def fitted_choice(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> float:
    """Minimise the squared errors near a point, with all gears of a choice within the ranges.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerator and denominator of each gear ratio at the corners of the bounds.
    length : int
        Number of gears chosen at the current point, including the targets.
    asked : Asked
    room : SequenceRoom
        Work arrays; `fit.logs` contains the starting point and receives the solution.

    Returns
    -------
    float
        Smallest sum of squared errors; infinity without a solution. [-]
    """
    fit, rows = room.fit, _find_rows(length, asked, room)
    fill(fit.pulls, 0.0)
    stiffness, before = 0.0, math.inf
    for turn in range(MOST_TURNS):
        total = _fitted(parts, length, asked, stiffness, room)
        beyond = 0.0
        for row in range(len(fit.errors)):
            error = fit.errors[row]
            beyond = max(beyond, error - room.rows[row, 3], room.rows[row, 2] - error)
        if total == math.inf or beyond <= BEYOND_WIDTH:
            return total
        if turn == 0 and total > rows:
            return math.inf  # some value is outside its range everywhere
        if turn > FIRST_TURNS + 1 and beyond > LESS_BEYOND * before:
            return math.inf
        stiffness, before = PULL, beyond
        if turn > 0:
            for row in range(len(fit.errors)):
                fit.pulls[row] = abs(_pulled(fit.errors[row], row, room))
    return math.inf


@compiled_part
def squares_at(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> float:
    """Return the sum of squared errors of a choice at the current point, regardless of ranges."""
    _find_rows(length, asked, room)
    weigh(room.fit.logs, asked, room.fit)
    return _errors(parts, length, asked, room, room.fit.trial)


@compiled_part
def _find_rows(length: int, asked: Asked, room: SequenceRoom) -> int:
    """Write the middle, half-width and range of each error to `rows`, and count the valid rows."""
    wanted, targets, count = room.wanted, len(asked.targets), 0
    steps = length - targets - 1
    for row in range(len(room.rows)):
        middle, half, low, high, counts = 0.0, WIDTH_WITHOUT_MIDDLE, -math.inf, 0.0, 0.0
        if row < targets:
            middle, half = math.log(abs(asked.targets[row])), asked.widths[row]
            low, high, counts = -1.0, 1.0, 1.0
        elif row <= targets + steps:
            least, most = wanted.spread if row == targets else wanted.steps
            middle, low, high = least, 0.0, math.inf
            if most < math.inf:
                middle, half = 0.5 * (least + most), max(0.5 * (most - least), NARROWEST_RANGE)
                high, counts = 0.5 * (most - least) / half, 1.0
                low = -high
        room.rows[row, 0] = middle
        room.rows[row, 1] = half
        room.rows[row, 2] = low
        room.rows[row, 3] = high
        room.rows[row, 4] = counts
        count += counts > 0
    return count


@compiled_part
def _pulled(error: float, row: int, room: SequenceRoom) -> float:
    """Return the signed distance of an error from its range, narrowed by the pull; 0 within."""
    pull = room.fit.pulls[row]
    above, below = error - room.rows[row, 3] + pull, room.rows[row, 2] - error + pull
    if above >= below:
        return float(max(above, 0.0))
    return -float(max(below, 0.0))


@compiled_part
def _fitted(
    parts: Floats, length: int, asked: Asked, stiffness: float, room: SequenceRoom
) -> float:
    """Minimise the penalised squared errors near a point; return their sum without penalties."""
    fit = room.fit
    least, most = math.log(asked.low), math.log(asked.high)
    weigh(fit.logs, asked, fit)
    best = _errors(parts, length, asked, room, fit.errors)
    if best < math.inf:
        best += _pull(fit.errors, stiffness, room)
    damping, is_new = FIRST_DAMPING, True
    for _ in range(MOST_BOX_STEPS):
        if best == math.inf or damping > GIVEN_UP:
            break
        if is_new:
            _find_slopes(parts, length, asked, room)
        _weigh_errors(stiffness, room)
        if damped_step(fit, least, most, damping) < LEAST_BOX_STEP:
            break
        weigh(fit.tried, asked, fit)
        value = _errors(parts, length, asked, room, fit.trial)
        if value < math.inf:
            value += _pull(fit.trial, stiffness, room)
        is_new = value <= best
        if not is_new:
            damping *= 10
            continue
        is_last = best - value <= LEAST_GAIN * best
        best = value
        put(fit.tried, fit.logs)
        put(fit.trial, fit.errors)
        damping = max(damping * 0.1, LEAST_BOX_DAMPING)
        if is_last:
            break
    return _squares(fit.errors, room) if best < math.inf else math.inf


@compiled_part
def _squares(errors: Floats, room: SequenceRoom) -> float:
    total = 0.0
    for row in range(len(errors)):
        total += room.rows[row, 4] * errors[row] ** 2
    return total


@compiled_part
def _pull(errors: Floats, stiffness: float, room: SequenceRoom) -> float:
    total = 0.0
    if stiffness > 0:
        for row in range(len(errors)):
            total += _pulled(errors[row], row, room) ** 2
    return stiffness * total


@compiled_part
def _errors(parts: Floats, length: int, asked: Asked, room: SequenceRoom, errors: Floats) -> float:
    """Calculate all errors at the current point, and return the sum of their squares.

    The sum is infinite if a gear has the wrong direction.
    """
    for gear in range(length):
        above, below = weighed(parts[room.point.chosen[gear]], room.fit.corner_weights)
        ratio = above / below
        if gear < len(asked.targets) and asked.targets[gear] < 0:
            ratio = -ratio
        if not 0 < ratio < math.inf:
            return math.inf
        room.gear_logs[gear] = math.log(ratio)
    _combine(room.gear_logs, length, asked, room, errors)
    for row in range(len(errors)):
        errors[row] -= room.rows[row, 0] / room.rows[row, 1]
    return _squares(errors, room)


@compiled_part
def _combine(logs: Floats, length: int, asked: Asked, room: SequenceRoom, errors: Floats) -> None:
    """Combine ln(i) of the gears, or their slopes, to targets, spread and steps, in half-widths."""
    targets = len(asked.targets)
    fill(errors, 0.0)
    for target in range(targets):
        errors[target] = logs[target]
    errors[targets] = logs[targets] - logs[length - 1]
    steps = length - targets - 1
    for step in range(steps):
        errors[targets + 1 + step] = logs[targets + step] - logs[targets + step + 1]
    if room.wanted.falling:
        for step in range(1, steps):
            above, below = errors[targets + 1 + step], errors[targets + step]
            errors[targets + steps + step] = above - below
    for row in range(len(errors)):
        errors[row] /= room.rows[row, 1]


@compiled_part
def _find_slopes(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> None:
    fit = room.fit
    weigh(fit.logs, asked, fit)
    for number in range(len(fit.logs)):
        for gear in range(length):
            part = parts[room.point.chosen[gear]]
            above, below = weighed(part, fit.corner_weights)
            over, under = weighed(part, fit.slopes[number])
            room.gear_logs[gear] = over / above - under / below
        _combine(room.gear_logs, length, asked, room, fit.jacobian[:, number])


@compiled_part
def _weigh_errors(stiffness: float, room: SequenceRoom) -> None:
    """Calculate both derivatives of half the sum of squared errors with respect to each error."""
    fit = room.fit
    for row in range(len(fit.errors)):
        error, counts = fit.errors[row], room.rows[row, 4]
        beyond = _pulled(error, row, room) if stiffness > 0 else 0.0
        fit.weights[row] = counts + (stiffness if beyond != 0 else 0.0)
        fit.forces[row] = counts * error + stiffness * beyond
