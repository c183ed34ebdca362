"""Which elements a found box engages where several sets of them give the ratio of a gear."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import combinations, pairwise

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.tolerances import SAME_BOX_RATIO, SECOND_MOTION, STILL_SPEED

Engaged = tuple[int, ...]
"""Numbers of elements from 0, ascending."""


def equal_sets(box: FoundBox) -> tuple[tuple[Engaged, ...], ...]:
    """For each gear the sets of elements that give its ratio, all of one size.

    Parameters
    ----------
    box : FoundBox

    Returns
    -------
    tuple, shape (gears,)
        Of sets in ascending order; that of the box is among them.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 3, 1, ((2, HELD), (0, 2), (0, 3), (1, 3)),
    ...                (-2.0,), ((0, 2), (1, 2)), 0.0)
    >>> equal_sets(box)  # direct drive, with the set locked or not
    (((0, 2),), ((0, 3), (1, 2), (1, 3), (2, 3)))
    """
    own = [tuple(sorted(one)) for one in box.gears]
    sets = list(combinations(range(len(box.elements)), len(own[0])))
    ratios = set_ratios(box, sets)
    place = {one: number for number, one in enumerate(sets)}
    found = []
    for one in own:
        equal = np.abs(ratios - ratios[place[one]]) <= SAME_BOX_RATIO * np.abs(ratios[place[one]])
        equal[place[one]] = True
        found.append(tuple(sets[number] for number in np.flatnonzero(equal).tolist()))
    return tuple(found)


def set_ratios(box: FoundBox, sets: Sequence[Engaged]) -> Floats:
    """The ratio of the box with each of some sets of elements engaged, all of one size.

    Parameters
    ----------
    box : FoundBox
    sets : sequence of tuple

    Returns
    -------
    ndarray, shape (sets,)
        NaN where there is none, or where some link may turn besides. [-]
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
    basis = np.linalg.svd(rows)[2][len(rows) :]  # motions with nothing engaged, in rows
    engaged = (elements @ basis.T)[np.array(sets, np.intp)]
    if engaged.shape[1] != len(basis) - 1:
        return np.full(len(sets), np.nan)
    _, sizes, turned = np.linalg.svd(engaged)
    speeds = turned[:, -1] @ basis
    inputs, outputs = speeds[:, box.input], speeds[:, box.output]
    turns = np.minimum(np.abs(inputs), np.abs(outputs)) > STILL_SPEED * np.abs(speeds).max(axis=1)
    is_one = sizes[:, -1] > SECOND_MOTION  # of rows no longer than 2, on an orthonormal basis
    with np.errstate(all="ignore"):
        return np.asarray(np.where(turns & is_one, inputs / outputs, np.nan))


def all_of(numbers: Engaged) -> int:
    """Elements as bits.

    >>> bin(all_of((0, 3)))
    '0b1001'
    """
    return sum(1 << number for number in numbers)


Way = tuple[tuple[float, ...], tuple[Engaged, ...]]
"""What some gears cost, and the set of each."""


def chosen_sets(
    ranges: Sequence[Sequence[Sequence[Engaged]]],
    elements: int,
    cost: Callable[[Engaged], tuple[float, float]],
    used_in: Callable[[Engaged], int] = all_of,
) -> tuple[Engaged, ...]:
    """One set for each gear, so that few elements change between neighbours.

    First the number of shifts with more than one element that goes is least, then that of all
    elements that go, then the sum of the costs. Each element is used in some gear, if that can
    be.

    Parameters
    ----------
    ranges : sequence, shape (ranges, gears)
        The sets to choose from, of gears that are neighbours one after the other.
    elements : int
        Their number.
    cost : callable
        What each set costs, the more important first.
    used_in : callable
        The elements of a set that count as used, as bits; all of them when not given.

    Returns
    -------
    tuple
        Of all ranges in turn.

    Examples
    --------
    >>> gears = [[(0, 1)], [(2, 3), (1, 2)], [(2, 3)]]
    >>> chosen_sets([gears], 4, lambda one: (0.0, 0.0))
    ((0, 1), (1, 2), (2, 3))
    """
    # by the last set and, as bits, all elements engaged so far
    ways: dict[tuple[Engaged, int], Way] = {((), 0): ((0.0, 0.0, 0.0, 0.0), ())}
    for sets in (sets for gears in ranges for sets in ((), *gears)):
        after: dict[tuple[Engaged, int], Way] = {}
        for (last, used), (before, way) in ways.items():
            for one in sets:
                gone = len(set(last) - set(one))
                added = (float(gone > 1), float(gone), *cost(one))
                total = tuple(a + b for a, b in zip(before, added, strict=True))
                _keep(after, (one, used | used_in(one)), (total, (*way, one)))
            if not sets:  # another range begins: nothing goes
                _keep(after, ((), used), (before, way))
        ways = after
    everything = all_of(tuple(range(elements)))
    most = max((used for _, used in ways), key=lambda used: (used == everything, used.bit_count()))
    return min(way for (_, used), way in ways.items() if used == most)[1]


def _keep(ways: dict[tuple[Engaged, int], Way], key: tuple[Engaged, int], way: Way) -> None:
    """Note a way, if it is less than that which comes to the same."""
    if key not in ways or way < ways[key]:
        ways[key] = way


def is_single(gears: Sequence[Collection[object]]) -> bool:
    """Whether one element changes between neighbours.

    >>> is_single([(0, 1), (1, 2), (2, 3)]), is_single([(0, 1), (2, 3)])
    (True, False)
    """
    return all(len(set(one) ^ set(other)) <= 2 for one, other in pairwise(gears))
