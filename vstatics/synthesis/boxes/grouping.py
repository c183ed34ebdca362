"""Found boxes side by side: places of their figures, families, cores, the Pareto list."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.least_form import identity
from vstatics.synthesis.tolerances import EQUAL_FIGURES, SAME_FITTED_RATIO


def core_of(box: FoundBox) -> tuple[Any, ...]:
    """What boxes of one core share in the form of `least_box`: all but their clutches.

    Where they also have equal ratios they differ by the way in which sets are locked.

    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, -1), (0, 1)), (-2.0,),
    ...                ((0,), (1,)), 0.0)
    >>> core_of(box) == core_of(box._replace(elements=((2, -1), (1, 2))))
    True
    """
    return (*identity(box)[:-1], tuple(box.brakes))


def numbered(keys: Iterable[Hashable]) -> list[int]:
    """A number from 1 for each key, the same for equal ones, as they come.

    >>> numbered("abac")
    [1, 2, 1, 3]
    """
    numbers: dict[Hashable, int] = {}
    return [numbers.setdefault(key, len(numbers) + 1) for key in keys]


def places(values: Floats) -> Integers:
    """The place of each value among those that differ; one that does not exist is 0.

    Parameters
    ----------
    values : ndarray, shape (boxes,)
        A figure of each box.

    Examples
    --------
    >>> places(np.array([0.5, 0.25, 0.25 + 1e-9]))
    array([1, 0, 0])
    """
    known = np.nan_to_num(values)
    order = np.argsort(known, kind="stable")
    gaps = np.diff(known[order]) > EQUAL_FIGURES * (1 + np.abs(known[order][:-1]))
    places = np.empty(len(values), np.int64)
    places[order] = np.concatenate([[0], np.cumsum(gaps)])
    return places


def families(ratios: Floats) -> list[int]:
    """The family of each row of ratios, numbered as they come.

    Parameters
    ----------
    ratios : ndarray, shape (boxes, gears)
        [-]

    Examples
    --------
    >>> families(np.array([[3.0, 1.0], [2.0, 1.0], [3.0, 1.0 + 1e-9]]))
    [1, 2, 1]
    """
    groups = [np.arange(len(ratios))]
    sizes = np.log(np.abs(ratios))
    before = 0
    while len(groups) > before:  # a box that goes may have filled a gap between others
        before = len(groups)
        for gear in sizes.T:
            groups = [part for group in groups for part in _parted(group, gear)]
    family = np.empty(len(ratios), np.intp)
    for number, group in enumerate(sorted(groups, key=min), 1):
        family[group] = number
    return family.tolist()


def _parted(group: Any, sizes: Floats) -> list[Any]:
    """A group of boxes, parted where the sizes of a gear have a gap."""
    if len(group) == 1:
        return [group]
    ordered = group[np.argsort(sizes[group], kind="stable")]
    gaps = np.flatnonzero(np.diff(sizes[ordered]) > SAME_FITTED_RATIO) + 1
    return np.split(ordered, gaps)


def pareto(figures: Floats | Integers) -> Booleans:
    """Which rows no other row is better than in one column, and not worse in any.

    Parameters
    ----------
    figures : ndarray, shape (boxes, figures)
        The less the better.

    Returns
    -------
    ndarray, shape (boxes,)

    Examples
    --------
    >>> pareto(np.array([[1.0, 3.0], [2.0, 2.0], [2.0, 3.0], [2.0, 2.0], [3.0, 1.0]]))
    array([ True,  True, False,  True,  True])
    """
    rows, which = np.unique(figures, axis=0, return_inverse=True)  # the less stand first
    is_best = np.zeros(len(rows), np.bool_)
    front = np.empty_like(rows)
    size = 0
    for number, own in enumerate(rows):  # whoever is better than a row stands before it
        if not (front[:size] <= own).all(axis=1).any():
            is_best[number] = True
            front[size] = own
            size += 1
    return np.asarray(is_best[which.reshape(-1)])
