"""Reduction of a cell of gear-set ratios by all targets together, with planes as bounds.

A gear meets its target (a wanted ratio) where a polynomial that is linear in each gear-set ratio is
near 0. The values at the corners of the cell bound the distance of the polynomial from a plane. So
the gear-set ratios solve a system of linear equations, each within a known width. Least squares
give a part of the cell that contains all solutions, or prove that no solution exists.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.synthesis.boxes.search.engaged import integers
from vstatics.synthesis.boxes.search.ranges import has_one_sign
from vstatics.synthesis.compiled import compiled_part, fill, shared
from vstatics.synthesis.tolerances import LEAST_STIFFNESS, PLANE_ROUNDING


@shared
class PlaneRoom(NamedTuple):
    """Work arrays for planes; a cell extends from -1 to 1 along each gear-set ratio."""

    only_ratios: Integers
    """Index of the only gear ratio that can meet each target, shape (targets,); else negative."""
    values: Floats
    """Values of a polynomial at the corners, shape (corners,). [-]"""
    planes: Floats
    """Planes divided by their widths: slope along each gear-set ratio, then the value in the middle
    of the cell, shape (targets, sets + 1).
    """
    system: Floats
    """Normal equations and the inverse matrix, shape (sets, 2 sets)."""
    solving: Floats
    """Pseudoinverse of the slopes of the planes, shape (sets, targets)."""
    middle: Floats
    """Least-squares solution of the gear-set ratios, shape (sets,)."""
    errors: Floats
    """Distance of each plane from the solution, divided by the plane's width, shape (targets,)."""


def plane_room(targets: int, sets: int) -> PlaneRoom:
    """Return work arrays for a number of targets and gear sets."""
    return PlaneRoom(
        only_ratios=integers(targets),
        values=np.zeros(2**sets),
        planes=np.zeros((targets, sets + 1)),
        system=np.zeros((sets, 2 * sets)),
        solving=np.zeros((sets, targets)),
        middle=np.zeros(sets),
        errors=np.zeros(targets),
    )


@compiled_part
def planes_leave(parts: Floats, least: Floats, most: Floats, room: PlaneRoom, left: Floats) -> bool:
    """Cut off parts of a cell in which targets with a single possible gear ratio are missed.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of the gear ratios at the corners of the cell.
    least, most : array, shape (targets,)
        Range of gear ratios that meet each target. [-]
    room : PlaneRoom
        Work arrays; `only_ratios` contains the gear ratio of each target.
    left : array, shape (sets, 2)
        Start and end along each gear-set ratio, in fractions of the cell; reduced in place.

    Returns
    -------
    bool
        False if the cell contains no solution.

    Examples
    --------
    For p from 1 to 3, 1 + p = 3 and 1 + 2 p = 5 have a common solution; 1 + p = 3 and 1 + 2 p = 6
    do not:

    >>> parts = np.array([[[2.0, 4.0], [1.0, 1.0]], [[3.0, 7.0], [1.0, 1.0]]])
    >>> room, left = plane_room(2, 1), np.array([[0.0, 1.0]])
    >>> room.only_ratios[:] = 0, 1
    >>> bool(planes_leave(parts, np.array([2.9, 4.9]), np.array([3.1, 5.1]), room, left))
    True
    >>> left.round(3).tolist()
    [[0.47, 0.53]]
    >>> bool(planes_leave(parts, np.array([2.9, 5.9]), np.array([3.1, 6.1]), room, left))
    False
    """
    count = 0
    for target in range(len(least)):
        ratio = room.only_ratios[target]
        if ratio >= 0 and _is_plane(parts[ratio], least[target], most[target], room, count):
            count += 1
    planes = room.planes[:count]
    _find_system(planes, room.system)
    _solve(planes, room)
    return _narrow(planes, room, left) and _may_meet(planes, room)


@compiled_part
def _narrow(planes: Floats, room: PlaneRoom, left: Floats) -> bool:
    count, sets = len(planes), len(left)
    for number in range(sets):
        middle, apart = 0.0, PLANE_ROUNDING
        solving = room.solving[number]
        for row in range(count):
            middle -= solving[row] * planes[row, sets]
            apart += abs(solving[row])
        for other in range(sets):  # the part of the ratio that the planes leave undetermined
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


@compiled_part
def _may_meet(planes: Floats, room: PlaneRoom) -> bool:
    """Return whether a point can be near all planes, within their widths.

    No such point exists if the weighted errors of the planes exceed their weighted widths (Farkas'
    lemma, with the least-squares errors as weights).
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


@compiled_part
def _is_plane(part: Floats, least: float, most: float, room: PlaneRoom, row: int) -> bool:
    """Find the plane that approximates a target's equation in a cell; return False without a plane.

    The equation N/D = i is used as N - i D or D - N/i, so that the quotient has no pole in the
    cell.
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
    fill(plane, 0.0)
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


@compiled_part
def _find_system(planes: Floats, system: Floats) -> None:
    sets = len(system)
    largest = 0.0
    for first in range(sets):
        for second in range(sets):
            total = 0.0
            for row in range(len(planes)):
                total += planes[row, first] * planes[row, second]
            system[first, second] = total
            system[first, sets + second] = 1.0 if first == second else 0.0
        largest = max(largest, system[first, first])
    for first in range(sets):
        system[first, first] += LEAST_STIFFNESS * largest if largest > 0 else 1.0


@compiled_part
def _solve(planes: Floats, room: PlaneRoom) -> None:
    system, sets = room.system, len(room.system)
    for pivot in range(sets):  # the matrix is positive definite, so pivoting is not needed
        factor = 1 / system[pivot, pivot]
        for column in range(2 * sets):
            system[pivot, column] *= factor
        for row in range(sets):
            if row != pivot:
                factor = system[row, pivot]
                for column in range(2 * sets):
                    system[row, column] -= factor * system[pivot, column]
    for number in range(sets):
        for row in range(len(planes)):
            total = 0.0
            for other in range(sets):
                total += system[number, sets + other] * planes[row, other]
            room.solving[number, row] = total
