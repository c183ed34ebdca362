"""What all gears together leave of a cell, by planes.

A gear is at its target where a polynomial that is linear in the ratio of each set is near 0. How
far such a polynomial is from a plane is told at the corners of the cell. So the ratios of sets
solve a system of linear equations, each within a known width; least squares tell a part of the
cell in which all solutions are, or that there is none.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.ranges import has_one_sign
from vstatics.synthesis.tolerances import LEAST_STIFFNESS, PLANE_ROUNDING


class PlaneRoom(NamedTuple):
    """Room for planes; a cell is from -1 to 1 along the ratio of each set."""

    own: Integers
    """The ratio that a target has for its own, below 0 where there are several, shape
    (targets,)."""
    values: Floats
    """A polynomial at the corners, shape (corners,)."""
    planes: Floats
    """Each plane over its width: the slope along each ratio, and the middle, shape (targets,
    sets + 1)."""
    system: Floats
    """The normal equations and their inverse, shape (sets, 2 sets)."""
    solving: Floats
    """What makes ratios of sets from the planes, shape (sets, targets)."""
    middle: Floats
    """The solution, shape (sets,)."""
    errors: Floats
    """How far each plane is from it, over its width, shape (targets,)."""


def plane_room(targets: int, sets: int) -> PlaneRoom:
    """Room for so many targets."""
    return PlaneRoom(
        own=np.zeros(targets, np.int64),
        values=np.zeros(2**sets),
        planes=np.zeros((targets, sets + 1)),
        system=np.zeros((sets, 2 * sets)),
        solving=np.zeros((sets, targets)),
        middle=np.zeros(sets),
        errors=np.zeros(targets),
    )


@compiled
def planes_leave(parts: Floats, least: Floats, most: Floats, room: PlaneRoom, left: Floats) -> bool:
    """Make what is left of a cell less by all targets with a ratio of their own together.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators at the corners of the cell.
    least, most : array, shape (targets,)
        Between which a target is met. [-]
    room : PlaneRoom
        `own` tells the ratios.
    left : array, shape (sets, 2)
        Shares of the cell.

    Returns
    -------
    bool
        Whether there may be a solution.

    Examples
    --------
    1 + p and 1 + 2 p with p from 1 to 3 are 3 and 5 for one p, 3 and 6 for none:

    >>> parts = np.array([[[2.0, 4.0], [1.0, 1.0]], [[3.0, 7.0], [1.0, 1.0]]])
    >>> room, left = plane_room(2, 1), np.array([[0.0, 1.0]])
    >>> room.own[:] = 0, 1
    >>> bool(planes_leave(parts, np.array([2.9, 4.9]), np.array([3.1, 5.1]), room, left))
    True
    >>> left.round(3).tolist()
    [[0.47, 0.53]]
    >>> bool(planes_leave(parts, np.array([2.9, 5.9]), np.array([3.1, 6.1]), room, left))
    False
    """
    count = 0
    for target in range(len(least)):
        ratio = room.own[target]
        if ratio >= 0 and _is_plane(parts[ratio], least[target], most[target], room, count):
            count += 1
    planes = room.planes[:count]
    _find_system(planes, room.system)
    _solve(planes, room)
    return _narrow(planes, room, left) and _may_meet(planes, room)


@compiled
def _narrow(planes: Floats, room: PlaneRoom, left: Floats) -> bool:
    """Take from a cell what is farther from the solution of the planes than their widths allow."""
    count, sets = len(planes), len(left)
    for number in range(sets):
        middle, apart = 0.0, PLANE_ROUNDING
        solving = room.solving[number]
        for row in range(count):
            middle -= solving[row] * planes[row, sets]
            apart += abs(solving[row])
        for other in range(sets):  # what the planes don't tell
            total = 1.0 if other == number else 0.0
            for row in range(count):
                total -= solving[row] * planes[row, other]
            apart += abs(total)
        room.middle[number] = middle
        left[number, 0] = max(left[number, 0], 0.5 * (1 + middle - apart))
        left[number, 1] = min(left[number, 1], 0.5 * (1 + middle + apart))
        if left[number, 0] > left[number, 1]:
            return False
    return True


@compiled
def _may_meet(planes: Floats, room: PlaneRoom) -> bool:
    """Whether the planes may have a point in common.

    They have none if their errors, weighed, add to more than their widths do: Farkas' lemma, with
    the errors of least squares as weights.
    """
    count, sets = len(planes), len(room.middle)
    within = apart = 0.0
    for row in range(count):
        error = planes[row, sets]
        for number in range(sets):
            error += planes[row, number] * room.middle[number]
        room.errors[row] = error
        within += abs(error)
        apart += error * planes[row, sets]
    for number in range(sets):
        total = 0.0
        for row in range(count):
            total += room.errors[row] * planes[row, number]
        within += abs(total)
    return apart <= within * (1 + PLANE_ROUNDING)


@compiled
def _is_plane(part: Floats, least: float, most: float, room: PlaneRoom, row: int) -> bool:
    """Find the plane that a gear is near to; whether there is one.

    Of N/D = i it is that of N - i D, or D - N/i, whichever quotient has no pole in the cell.
    """
    over, under = part
    if not has_one_sign(under):
        if not has_one_sign(over):
            return False
        over, under = under, over
        least, most = 1 / most, 1 / least
    values, plane = room.values, room.planes[row]
    corners, sets = len(values), len(plane) - 1
    wanted = 0.5 * (least + most)
    size = 0.0
    plane[:] = 0.0
    for corner in range(corners):
        values[corner] = over[corner] - wanted * under[corner]
        size = max(size, abs(under[corner]))
        plane[sets] += values[corner]
        for number in range(sets):
            plane[number] += values[corner] if (corner >> number) & 1 else -values[corner]
    for place in range(sets + 1):
        plane[place] /= corners
    low = high = 0.0
    for corner in range(corners):
        value = values[corner] - plane[sets]
        for number in range(sets):
            value -= plane[number] if (corner >> number) & 1 else -plane[number]
        low = min(low, value)
        high = max(high, value)
    plane[sets] += 0.5 * (low + high)
    width = 0.5 * (high - low) + 0.5 * (most - least) * size
    if width <= 0:
        return False
    for place in range(sets + 1):
        plane[place] /= width
    return True


@compiled
def _find_system(planes: Floats, system: Floats) -> None:
    """The damped normal equations, with what their inverse begins from beside them."""
    sets = len(system)
    largest = 0.0
    for one in range(sets):
        for other in range(sets):
            total = 0.0
            for row in range(len(planes)):
                total += planes[row, one] * planes[row, other]
            system[one, other] = total
            system[one, sets + other] = 1.0 if one == other else 0.0
        largest = max(largest, system[one, one])
    for one in range(sets):
        system[one, one] += LEAST_STIFFNESS * largest if largest > 0 else 1.0


@compiled
def _solve(planes: Floats, room: PlaneRoom) -> None:
    """What makes ratios of sets from the planes by least squares: a damped pseudoinverse."""
    system, sets = room.system, len(room.system)
    for pivot in range(sets):  # positive definite: no pivots are looked for
        factor = 1 / system[pivot, pivot]
        for column in range(2 * sets):
            system[pivot, column] *= factor
        for row in range(sets):
            if row != pivot:
                factor = system[row, pivot]
                for column in range(2 * sets):
                    system[row, column] -= factor * system[pivot, column]
    for one in range(sets):
        for row in range(len(planes)):
            total = 0.0
            for other in range(sets):
                total += system[one, sets + other] * planes[row, other]
            room.solving[one, row] = total
