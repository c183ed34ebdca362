"""Ranges of the gear ratios in a cell of gear-set ratios, and of the step ratios between them.

A step ratio i/j is a quotient of products of polynomials that are linear in each gear-set ratio, so
each product is quadratic in each. In Bernstein form, with the products as sums over pairs of
corners, the step ratio is between the quotients of the coefficients (Narkawicz, Garloff, Smith,
Munoz: Reliable Computing 17, 2012). This range is much narrower than the quotient of the separate
ranges of i and j, which vary together.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.sequences.room import ChoiceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.compiled import compiled_part, fill


@compiled_part
def ends_of(part: Floats) -> tuple[float, float]:
    """Return the range of ln(i) in a cell; infinity and -infinity if i is never positive.

    Parameters
    ----------
    part : array, shape (2, corners)
        Numerator and denominator of the gear ratio i at the corners of the cell.

    Examples
    --------
    >>> import numpy as np
    >>> ends_of(np.array([[1.0, 2.0], [1.0, 1.0]]))[0], ends_of(np.array([[-1.0, -2], [1, 1]]))
    (0.0, (inf, -inf))
    """
    low, high = -math.inf, math.inf
    if has_one_sign(part[1]):
        least, most = extremes(part[0], part[1])
        low = math.log(least) if least > 0 else -math.inf
        high = math.log(most) if most > 0 else -math.inf
    elif has_one_sign(part[0]):
        least, most = extremes(part[1], part[0])
        high = -math.log(least) if least > 0 else math.inf
        low = -math.log(most) if most > 0 else math.inf
    if low == math.inf or high == -math.inf:
        return math.inf, -math.inf
    return low, high


@compiled_part
def find_bounds(cell: Floats, count: int, asked: Asked, room: ChoiceRoom, sums: Floats) -> int:
    """Calculate the targets and range of each gear ratio in a cell, and the range of each step.

    Parameters
    ----------
    cell : array, shape (ratios, 2, corners)
    count : int
        Number of gear ratios.
    asked : Asked
    room : ChoiceRoom
        Work arrays, which receive the results.
    sums : array, shape (2, 3**sets)
        Work array.

    Returns
    -------
    int
        Number of gear ratios that can be positive (forward).
    """
    forward = 0
    for ratio in range(count):
        room.reach[ratio] = reached(cell[ratio, 0], cell[ratio, 1], asked.least, asked.most)
        low, high = ends_of(cell[ratio])
        room.ends[ratio, 0] = low
        room.ends[ratio, 1] = high
        forward += low <= high
    for upper in range(count):
        for lower in range(upper + 1, count):
            low, high = -math.inf, math.inf
            if not (_is_forward(upper, room) and _is_forward(lower, room)):
                low, high = high, low
            elif _is_bounded(upper, room) and _is_bounded(lower, room):
                low, high = _step(cell[upper], cell[lower], sums)
            else:  # one of the ratios has a zero or a pole in the cell
                low = _less(room.ends[upper, 0], room.ends[lower, 1], -math.inf)
                high = _less(room.ends[upper, 1], room.ends[lower, 0], math.inf)
            room.steps[upper, lower, 0] = low
            room.steps[upper, lower, 1] = high
            room.steps[lower, upper, 0] = -high
            room.steps[lower, upper, 1] = -low
    return forward


@compiled_part
def _less(minuend: float, subtrahend: float, unknown: float) -> float:
    """Return the difference of two ends of ranges, or `unknown` if an end is infinite."""
    is_known = -math.inf < minuend < math.inf and -math.inf < subtrahend < math.inf
    return minuend - subtrahend if is_known else unknown


@compiled_part
def _is_forward(ratio: int, room: ChoiceRoom) -> bool:
    return bool(room.ends[ratio, 0] <= room.ends[ratio, 1])


@compiled_part
def _is_bounded(ratio: int, room: ChoiceRoom) -> bool:
    return bool(-math.inf < room.ends[ratio, 0] and room.ends[ratio, 1] < math.inf)


@compiled_part
def _step(dividend: Floats, divisor: Floats, sums: Floats) -> tuple[float, float]:
    """Return the range of ln(i/j) in a cell where neither gear ratio has a zero or a pole."""
    corners = dividend.shape[1]
    fill(sums[0], 0.0)
    fill(sums[1], 0.0)
    first = 0
    for first_corner in range(corners):
        second = 0
        for second_corner in range(corners):
            sums[0, first + second] += dividend[0, first_corner] * divisor[1, second_corner]
            sums[1, first + second] += dividend[1, first_corner] * divisor[0, second_corner]
            second += _gap(second_corner)
        first += _gap(first_corner)
    least, most = extremes(sums[0], sums[1])
    return math.log(least), math.log(most)


@compiled_part
def _gap(corner: int) -> int:
    """Return the increment from a corner to the next, with the bits of corners as base-3 digits."""
    low, power = 0, 1
    while corner & 1:
        low += power
        power *= 3
        corner >>= 1
    return power - low
