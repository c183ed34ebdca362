"""Grouping of found gearboxes: ranks of figures, families, cores and the Pareto list."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.least_form import identity
from vstatics.synthesis.tolerances import EQUAL_FIGURES, SAME_FITTED_RATIO


def core_of(box: FoundBox) -> tuple[Any, ...]:
    """Return the key of a gearbox's core: the data of the form in `least_box`, without clutches.

    Gearboxes of a core that also have equal ratios differ only in how gear sets are locked up.

    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, -1), (0, 1)), (-2.0,),
    ...                ((0,), (1,)), 0.0)
    >>> core_of(box) == core_of(box._replace(elements=((2, -1), (1, 2))))
    True
    """
    return (*identity(box)[:-1], tuple(box.brakes))


def numbered(keys: Iterable[Hashable]) -> list[int]:
    """Return a number for each key, equal for equal keys, from 1 in order of appearance.

    >>> numbered("abac")
    [1, 2, 1, 3]
    """
    numbers: dict[Hashable, int] = {}
    return [numbers.setdefault(key, len(numbers) + 1) for key in keys]


def places(values: Floats) -> Integers:
    """Return the rank of each value among the different values; NaN has the rank 0.

    Parameters
    ----------
    values : ndarray, shape (boxes,)
        A figure of each gearbox.

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
    """Return the family number of each gearbox, from 1. Gearboxes with equal ratios are a family.

    Parameters
    ----------
    ratios : ndarray, shape (boxes, gears)
        Gear ratios. [-]

    Examples
    --------
    >>> families(np.array([[3.0, 1.0], [2.0, 1.0], [3.0, 1.0 + 1e-9]]))
    [1, 2, 1]
    """
    groups = [np.arange(len(ratios))]
    sizes = np.log(np.abs(ratios))
    before = 0
    while len(groups) > before:  # if a gearbox leaves a group, a gap can open between the others
        before = len(groups)
        for gear in sizes.T:
            groups = [part for group in groups for part in _parted(group, gear)]
    family = np.empty(len(ratios), np.intp)
    for number, group in enumerate(sorted(groups, key=min), 1):
        family[group] = number
    return family.tolist()


def _parted(group: Any, sizes: Floats) -> list[Any]:
    """Split a group of gearboxes where the sorted ratios of a gear have a gap."""
    if len(group) == 1:
        return [group]
    ordered = group[np.argsort(sizes[group], kind="stable")]
    gaps = np.flatnonzero(np.diff(sizes[ordered]) > SAME_FITTED_RATIO) + 1
    return np.split(ordered, gaps)


def pareto(figures: Floats | Integers) -> Booleans:
    """Return a mask of the rows that no other row dominates.

    A row dominates another row if it is better in one column and not worse in all others.

    Parameters
    ----------
    figures : ndarray, shape (boxes, figures)
        Figures of the gearboxes, of which smaller values are better.

    Returns
    -------
    ndarray, shape (boxes,)

    Examples
    --------
    >>> pareto(np.array([[1.0, 3.0], [2.0, 2.0], [2.0, 3.0], [2.0, 2.0], [3.0, 1.0]]))
    array([ True,  True, False,  True,  True])
    """
    rows, which = np.unique(figures, axis=0, return_inverse=True)  # rows in ascending order
    is_best = np.zeros(len(rows), np.bool_)
    front = np.empty_like(rows)
    size = 0
    for number, row in enumerate(rows):  # only earlier rows can dominate a row
        if not (front[:size] <= row).all(axis=1).any():
            is_best[number] = True
            front[size] = row
            size += 1
    return np.asarray(is_best[which.reshape(-1)])
