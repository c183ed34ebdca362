"""Between which the ratios of a cell, and the steps between them, are.

A step i/j is a quotient of products of polynomials that are linear in each ratio of a set, so it
is at most quadratic in each. In Bernstein's form of both products, a sum over pairs of corners for
each coefficient, it lies between the quotients of coefficients (Narkawicz, Garloff, Smith,
Munoz: Reliable Computing 17, 2012): much nearer than what the ends of i and of j say apart, since
both move together.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.compiled import compiled, fill
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.sequences.room import ChoiceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked


@compiled
def ends_of(part: Floats) -> tuple[float, float]:
    """Between which ln(i) is in a cell; infinity and less where it is never forward.

    Parameters
    ----------
    part : array, shape (2, corners)
        Numerator and denominator.

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


@compiled
def find_bounds(cell: Floats, count: int, asked: Asked, room: ChoiceRoom, sums: Floats) -> int:
    """Which targets each ratio reaches in a cell, between which it is, and each step.

    Parameters
    ----------
    cell : array, shape (ratios, 2, corners)
    count : int
        Of ratios.
    asked : Asked
    room : ChoiceRoom
        Takes what is found.
    sums : array, shape (2, 3**sets)
        Scratch.

    Returns
    -------
    int
        So many ratios may be forward.
    """
    forward = 0
    for ratio in range(count):
        room.reach[ratio] = reached(cell[ratio, 0], cell[ratio, 1], asked.least, asked.most)
        low, high = ends_of(cell[ratio])
        room.ends[ratio, 0] = low
        room.ends[ratio, 1] = high
        forward += low <= high
    _find_steps(cell, count, room, sums)
    return forward


@compiled
def _find_steps(cell: Floats, count: int, room: ChoiceRoom, sums: Floats) -> None:
    """Between which each step is in a cell, as far as gears can be one behind the other."""
    for one in range(count):
        for other in range(one + 1, count):
            low, high = -math.inf, math.inf
            if not (_is_forward(one, room) and _is_forward(other, room)):
                low, high = high, low
            elif _is_bounded(one, room) and _is_bounded(other, room):
                low, high = _step(cell[one], cell[other], sums)
            else:  # one goes through 0 or infinity
                low = _less(room.ends[one, 0], room.ends[other, 1], -math.inf)
                high = _less(room.ends[one, 1], room.ends[other, 0], math.inf)
            room.steps[one, other, 0] = low
            room.steps[one, other, 1] = high
            room.steps[other, one, 0] = -high
            room.steps[other, one, 1] = -low


@compiled
def _less(one: float, other: float, unknown: float) -> float:
    """The difference of two ends, unknown if one of them is infinite."""
    is_known = -math.inf < one < math.inf and -math.inf < other < math.inf
    return one - other if is_known else unknown


@compiled
def _is_forward(ratio: int, room: ChoiceRoom) -> bool:
    return bool(room.ends[ratio, 0] <= room.ends[ratio, 1])


@compiled
def _is_bounded(ratio: int, room: ChoiceRoom) -> bool:
    return bool(-math.inf < room.ends[ratio, 0] and room.ends[ratio, 1] < math.inf)


@compiled
def _step(one: Floats, other: Floats, sums: Floats) -> tuple[float, float]:
    """Between which ln(i/j) is in a cell where neither goes through 0 or infinity."""
    corners = one.shape[1]
    fill(sums[0], 0.0)
    fill(sums[1], 0.0)
    first = 0
    for corner in range(corners):
        second = 0
        for another in range(corners):
            sums[0, first + second] += one[0, corner] * other[1, another]
            sums[1, first + second] += one[1, corner] * other[0, another]
            second += _gap(another)
        first += _gap(corner)
    least, most = extremes(sums[0], sums[1])
    return math.log(least), math.log(most)


@compiled
def _gap(corner: int) -> int:
    """From the bits of a number, read with base 3, to those of the next."""
    low, power = 0, 1
    while corner & 1:
        low += power
        power *= 3
        corner >>= 1
    return power - low
