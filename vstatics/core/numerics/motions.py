"""Free motions: all solutions of homogeneous linear equations, as functions of free unknowns.

Equations with two unknowns (from shafts and gear pairs) form trees, which are solved in linear
time. `elimination` solves the remaining equations.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.elimination import in_free_unknowns

Form = Mapping[int, float]
"""Coefficients of a homogeneous equation, by index of the unknown."""


def free_motions(equations: Sequence[Form], unknowns: int) -> Floats:
    """Return all solutions of homogeneous equations, as columns.

    Returns
    -------
    ndarray, shape (unknowns, free)
        Each column has the value 1 for one free unknown, and 0 for the other free unknowns.

    Examples
    --------
    Two gears of ratio -2, and a separate third body:

    >>> free_motions([{0: 1.0, 1: 2.0}], 3)
    array([[ 1. ,  0. ],
           [-0.5,  0. ],
           [ 0. ,  1. ]])

    Three gears of equal size that mesh with one another cannot rotate:

    >>> free_motions([{0: 1.0, 1: 1.0}, {1: 1.0, 2: 1.0}, {0: 1.0, 2: 1.0}], 3).shape
    (3, 0)
    """
    tree = _Tree(unknowns)
    left = [equation for equation in equations if not tree.takes(equation)]
    roots, by_root = tree.followed()
    reduced = [_by_roots(equation, by_root) for equation in left]
    of_roots = in_free_unknowns(reduced, len(roots))
    free = sorted({column for row in of_roots for column in row})
    place = {column: index for index, column in enumerate(free)}
    solutions = np.zeros((unknowns, len(free)))
    for unknown, (root, factor) in enumerate(by_root):
        for column, value in of_roots[root].items() if root >= 0 else ():
            solutions[unknown, place[column]] = factor * value
    return solutions


def values_of(forms: Sequence[Form], unknowns: int) -> Floats:
    """Return the coefficients as a matrix of shape (forms, unknowns)."""
    rows = np.zeros((len(forms), unknowns))
    for row, form in zip(rows, forms, strict=True):
        for unknown, coefficient in form.items():
            row[unknown] += coefficient
    return rows


class _Tree:
    """Trees of unknowns connected by equations with two unknowns.

    An equation with a single unknown requires that the unknown is 0.
    """

    def __init__(self, unknowns: int) -> None:
        self.parent: list[int] = list(range(unknowns))
        self.factor: list[float] = [1.0] * unknowns
        """Value of each unknown divided by the value of its parent."""
        self.still: set[int] = set()
        """Roots of trees whose unknowns are all 0."""

    def root(self, unknown: int) -> tuple[int, float]:
        """Return the root of an unknown's tree, and the unknown divided by the root."""
        path, factor = [], 1.0
        while self.parent[unknown] != unknown:
            path.append(unknown)
            unknown = self.parent[unknown]
        for passed in reversed(path):
            factor *= self.factor[passed]
            self.parent[passed], self.factor[passed] = unknown, factor
        return unknown, factor

    def takes(self, form: Form) -> bool:
        """Add an equation to the trees; return False for a closed loop, which is not added."""
        terms = [(unknown, part) for unknown, part in form.items() if part]
        if len(terms) == 1:
            root, _ = self.root(terms[0][0])
            self.still.add(root)
            return True
        if len(terms) != 2:
            return not terms
        (first, a), (second, b) = terms
        (left, of_left), (right, of_right) = self.root(first), self.root(second)
        if left == right:
            return left in self.still
        self.parent[right], self.factor[right] = left, -(a * of_left) / (b * of_right)
        if right in self.still:
            self.still.add(left)
        return True

    def followed(self) -> tuple[list[int], list[tuple[int, float]]]:
        """Return the roots that can be nonzero, and root index and factor of each unknown.

        The index is -1 for unknowns that are 0.
        """
        by_root = [self.root(unknown) for unknown in range(len(self.parent))]
        roots = [
            root for root in dict.fromkeys(root for root, _ in by_root) if root not in self.still
        ]
        place = {root: index for index, root in enumerate(roots)}
        return roots, [(place.get(root, -1), factor) for root, factor in by_root]


def _by_roots(form: Form, by_root: Sequence[tuple[int, float]]) -> dict[int, tuple[float, ...]]:
    """Return an equation in terms of roots. Terms stay separate, so that rounding is visible."""
    terms: dict[int, tuple[float, ...]] = {}
    for unknown, part in form.items():
        root, factor = by_root[unknown]
        if root >= 0:
            terms[root] = (*terms.get(root, ()), part * factor)
    return terms
