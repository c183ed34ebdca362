"""Ratios of sets with which the gears of a choice are nearest to the middles of what is wanted.

Least squares of ln(i/target)/width of the targets, and of ln(what is/middle)/half-width of the
spread and of each step, with all of them within their ranges: by Levenberg and Marquardt, what is
beyond is pulled back by more and more, as augmented Lagrangians do. What has no end has no middle.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.compiled import compiled, fill, put
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
from vstatics.synthesis.tolerances import (
    BEYOND_WIDTH,
    FIRST_DAMPING,
    LEAST_BOX_DAMPING,
    LEAST_BOX_STEP,
    LEAST_GAIN,
    NARROWEST_RANGE,
)

UNIT = 0.1
"""In place of the half-width of what has no middle. [-]"""


@compiled
def fitted_choice(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> float:
    """The least sum of squares near a point with all gears of a choice within their ranges.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerator and denominator of each ratio at the corners of the bounds.
    length : int
        So many gears are chosen at the point, with those of the targets.
    asked : Asked
    room : SequenceRoom
        `fit.logs` tell where to begin, and where it ended.

    Returns
    -------
    float
        Infinity where there is none.
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
            return math.inf  # one is beyond its range wherever it is
        if turn > FIRST_TURNS + 1 and beyond > LESS_BEYOND * before:
            return math.inf
        stiffness, before = PULL, beyond
        if turn > 0:
            for row in range(len(fit.errors)):
                fit.pulls[row] = abs(_pulled(fit.errors[row], row, room))
    return math.inf


@compiled
def squares_at(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> float:
    """The sum of squares of a choice at the logarithms of the fit, within its ranges or not."""
    _find_rows(length, asked, room)
    weigh(room.fit.logs, asked, room.fit)
    return _errors(parts, length, asked, room, room.fit.trial)


@compiled
def _find_rows(length: int, asked: Asked, room: SequenceRoom) -> int:
    """What each error is measured by, into `rows`; how many count."""
    wanted, targets, count = room.wanted, len(asked.targets), 0
    steps = length - targets - 1
    for row in range(len(room.rows)):
        middle, half, low, high, counts = 0.0, UNIT, -math.inf, 0.0, 0.0
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


@compiled
def _pulled(error: float, row: int, room: SequenceRoom) -> float:
    """By how much an error is beyond its range with its pull, at the end that is nearer, signed."""
    pull = room.fit.pulls[row]
    above, below = error - room.rows[row, 3] + pull, room.rows[row, 2] - error + pull
    if above >= below:
        return float(max(above, 0.0))
    return -float(max(below, 0.0))


@compiled
def _fitted(
    parts: Floats, length: int, asked: Asked, stiffness: float, room: SequenceRoom
) -> float:
    """The least sum of squares near a point, with such a stiffness; that of the errors alone."""
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


@compiled
def _squares(errors: Floats, room: SequenceRoom) -> float:
    """The sum of squares of the errors that count."""
    total = 0.0
    for row in range(len(errors)):
        total += room.rows[row, 4] * errors[row] ** 2
    return total


@compiled
def _pull(errors: Floats, stiffness: float, room: SequenceRoom) -> float:
    """What is added to it for what is beyond its range."""
    total = 0.0
    if stiffness > 0:
        for row in range(len(errors)):
            total += _pulled(errors[row], row, room) ** 2
    return stiffness * total


@compiled
def _errors(parts: Floats, length: int, asked: Asked, room: SequenceRoom, found: Floats) -> float:
    """All errors at the weights of the corners; the sum of squares, infinity without a gear."""
    for gear in range(length):
        above, below = weighed(parts[room.point.chosen[gear]], room.fit.own)
        ratio = above / below
        if gear < len(asked.targets) and asked.targets[gear] < 0:
            ratio = -ratio
        if not 0 < ratio < math.inf:
            return math.inf
        room.gear_logs[gear] = math.log(ratio)
    _combine(room.gear_logs, length, asked, room, found)
    for row in range(len(found)):
        found[row] -= room.rows[row, 0] / room.rows[row, 1]
    return _squares(found, room)


@compiled
def _combine(logs: Floats, length: int, asked: Asked, room: SequenceRoom, found: Floats) -> None:
    """What each error is by the logarithms of ratios, or their slopes; over its half-width."""
    targets = len(asked.targets)
    fill(found, 0.0)
    for target in range(targets):
        found[target] = logs[target]
    found[targets] = logs[targets] - logs[length - 1]
    steps = length - targets - 1
    for step in range(steps):
        found[targets + 1 + step] = logs[targets + step] - logs[targets + step + 1]
    if room.wanted.falling:
        for step in range(1, steps):
            above, below = found[targets + 1 + step], found[targets + step]
            found[targets + steps + step] = above - below
    for row in range(len(found)):
        found[row] /= room.rows[row, 1]


@compiled
def _find_slopes(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> None:
    """Derivatives of all errors by the logarithms of the ratios of sets."""
    fit = room.fit
    weigh(fit.logs, asked, fit)
    for number in range(len(fit.logs)):
        for gear in range(length):
            part = parts[room.point.chosen[gear]]
            above, below = weighed(part, fit.own)
            over, under = weighed(part, fit.slopes[number])
            room.gear_logs[gear] = over / above - under / below
        _combine(room.gear_logs, length, asked, room, fit.jacobian[:, number])


@compiled
def _weigh_errors(stiffness: float, room: SequenceRoom) -> None:
    """Half the derivatives of the sum of squares by the errors, the first and the second."""
    fit = room.fit
    for row in range(len(fit.errors)):
        error, counts = fit.errors[row], room.rows[row, 4]
        beyond = _pulled(error, row, room) if stiffness > 0 else 0.0
        fit.weights[row] = counts + (stiffness if beyond != 0 else 0.0)
        fit.forces[row] = counts * error + stiffness * beyond
