"""Choice among sets of engaged shift elements that give the same gear ratio."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import combinations, pairwise

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.tolerances import SAME_BOX_RATIO, SECOND_MOTION, STILL_SPEED

Engaged = tuple[int, ...]
"""Indices of the engaged shift elements of a gear, ascending."""


def equal_sets(box: FoundBox) -> tuple[tuple[Engaged, ...], ...]:
    """Return, for each gear, all sets of engaged shift elements that give the gear ratio.

    Parameters
    ----------
    box : FoundBox

    Returns
    -------
    tuple, shape (gears,)
        Sets of each gear in ascending order, all of equal size, including the gearbox's own set.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 3, 1, ((2, HELD), (0, 2), (0, 3), (1, 3)),
    ...                (-2.0,), ((0, 2), (1, 2)), 0.0)
    >>> equal_sets(box)  # direct drive, with the gear set locked up or free
    (((0, 2),), ((0, 3), (1, 2), (1, 3), (2, 3)))
    """
    gears = [tuple(sorted(engaged)) for engaged in box.gears]
    sets = list(combinations(range(len(box.elements)), len(gears[0])))
    ratios = set_ratios(box, sets)
    place = {engaged: number for number, engaged in enumerate(sets)}
    alternatives = []
    for gear in gears:
        ratio = ratios[place[gear]]
        equal = np.abs(ratios - ratio) <= SAME_BOX_RATIO * np.abs(ratio)
        equal[place[gear]] = True
        alternatives.append(tuple(sets[number] for number in np.flatnonzero(equal).tolist()))
    return tuple(alternatives)


def set_ratios(box: FoundBox, sets: Sequence[Engaged]) -> Floats:
    """Calculate the ratio of a gearbox with each set of shift elements engaged.

    Parameters
    ----------
    box : FoundBox
    sets : sequence of tuple

    Returns
    -------
    ndarray, shape (sets,)
        Ratios; NaN if the ratio is undefined, or links can rotate independently of the input. [-]
    """
    links = box.links
    held = [] if box.held is None else [box.held]
    rows = np.zeros((len(box.ratios) + len(held), links))
    for row, (sun, carrier, ring), ratio in zip(rows, box.scheme.sets, box.ratios, strict=False):
        row[[sun, ring, carrier]] = 1.0, -ratio, ratio - 1.0
    for row, link in zip(rows[len(box.ratios) :], held, strict=True):
        row[link] = 1.0
    elements = np.zeros((len(box.elements), links))
    for row, (first, second) in zip(elements, box.elements, strict=True):
        row[first] = 1.0
        if second != HELD:
            row[second] = -1.0
    # Each row is a possible motion with no shift element engaged.
    basis = np.linalg.svd(rows)[2][len(rows) :]
    engaged = (elements @ basis.T)[np.array(sets, np.intp)]
    if engaged.shape[1] != len(basis) - 1:
        return np.full(len(sets), np.nan)
    _, sizes, turned = np.linalg.svd(engaged)
    speeds = turned[:, -1] @ basis
    inputs, outputs = speeds[:, box.input], speeds[:, box.output]
    turns = np.minimum(np.abs(inputs), np.abs(outputs)) > STILL_SPEED * np.abs(speeds).max(axis=1)
    is_one = sizes[:, -1] > SECOND_MOTION  # valid because rows of `elements` are not longer than 2
    with np.errstate(all="ignore"):
        return np.asarray(np.where(turns & is_one, inputs / outputs, np.nan))


def all_of(numbers: Engaged) -> int:
    """Return indices as bits of an integer.

    >>> bin(all_of((0, 3)))
    '0b1001'
    """
    return sum(1 << number for number in numbers)


Way = tuple[tuple[float, ...], tuple[Engaged, ...]]
"""Cost of the gears up to some gear, and the engaged shift elements of each of these gears."""


def chosen_sets(
    ranges: Sequence[Sequence[Sequence[Engaged]]],
    elements: int,
    cost: Callable[[Engaged], tuple[float, float]],
    used_in: Callable[[Engaged], int] = all_of,
) -> tuple[Engaged, ...]:
    """Choose the engaged shift elements of each gear so that shifts exchange few elements.

    Dynamic programming minimises first the number of shifts that release several shift elements,
    then the number of released elements, then the sum of the costs. Every element is engaged in
    some gear, if possible.

    Parameters
    ----------
    ranges : sequence, shape (ranges, gears)
        Candidate sets of engaged elements of each gear; consecutive gears of a range are
        neighbours.
    elements : int
        Number of shift elements.
    cost : callable
        Function that returns two costs of a set, the more important one first.
    used_in : callable
        Function that returns, as bits, the elements of a set that count as used; by default all.

    Returns
    -------
    tuple
        Chosen set of each gear, for the gears of all ranges.

    Examples
    --------
    >>> gears = [[(0, 1)], [(2, 3), (1, 2)], [(2, 3)]]
    >>> chosen_sets([gears], 4, lambda one: (0.0, 0.0))
    ((0, 1), (1, 2), (2, 3))
    """
    # Each key consists of the last gear's set, and of all elements used until then, as bits.
    ways: dict[tuple[Engaged, int], Way] = {((), 0): ((0.0, 0.0, 0.0, 0.0), ())}
    for sets in (sets for gears in ranges for sets in ((), *gears)):
        after: dict[tuple[Engaged, int], Way] = {}
        for (last, used), (before, way) in ways.items():
            for engaged in sets:
                released = len(set(last) - set(engaged))
                added = (float(released > 1), float(released), *cost(engaged))
                total = tuple(a + b for a, b in zip(before, added, strict=True))
                _keep(after, (engaged, used | used_in(engaged)), (total, (*way, engaged)))
            if not sets:  # the first gear of a range follows no gear: nothing is released
                _keep(after, ((), used), (before, way))
        ways = after
    everything = all_of(tuple(range(elements)))
    most = max((used for _, used in ways), key=lambda used: (used == everything, used.bit_count()))
    return min(way for (_, used), way in ways.items() if used == most)[1]


def _keep(ways: dict[tuple[Engaged, int], Way], key: tuple[Engaged, int], way: Way) -> None:
    if key not in ways or way < ways[key]:
        ways[key] = way


def is_single(gears: Sequence[Collection[object]]) -> bool:
    """Return whether neighbouring gears differ by exchange of a single shift element.

    >>> is_single([(0, 1), (1, 2), (2, 3)]), is_single([(0, 1), (2, 3)])
    (True, False)
    """
    return all(len(set(lower) ^ set(upper)) <= 2 for lower, upper in pairwise(gears))
