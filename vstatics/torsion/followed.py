"""What homogeneous equations leave free, for many variants of them that go the same way.

The rank of the first variant is known, from entries that tell by themselves when they are zero
(`numerics.motions`). Others are solved for the same unknowns by the same equations. Where that
is well conditioned and the other equations hold too their rank is the same; where it is not,
the variant has to be looked at alone.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers

LOST_PIVOT = 1e-6
"""A pivot below this part of that of the first variant may be one that is zero."""
RESIDUE = 1e-11
"""A sum below this part of the largest coefficient times the largest unknown is zero."""


class FollowedMotions(NamedTuple):
    """Solutions of variants.

    Attributes
    ----------
    motions : ndarray, shape (variants, unknowns, free)
        In each column one of the free unknowns is 1, the others of these 0.
    free, others : ndarray of int
        Which unknowns are left free, in the order of the columns, and which follow.
    safe : ndarray, shape (variants,)
        Whether a variant goes as the first does; of others the motions say nothing.
    """

    motions: Floats
    free: Integers
    others: Integers
    safe: Booleans


def followed_motions(equations: Floats, free: int) -> FollowedMotions:
    """What equations leave free in many variants.

    Parameters
    ----------
    equations : ndarray, shape (variants, equations, unknowns)
    free : int
        How many unknowns are free in the first variant.

    Examples
    --------
    Two wheels of ratio -2 and of -4, and a pair of equations whose rank is another:

    >>> equations = np.array([[[1.0, 2.0], [2.0, 4.0]], [[1.0, 4.0], [2.0, 8.0]],
    ...                       [[1.0, 4.0], [2.0, 9.0]]])
    >>> found = followed_motions(equations, 1)
    >>> found.motions[:2, :, 0].tolist(), found.safe.tolist()
    ([[1.0, -0.5], [1.0, -0.25]], [True, True, False])
    """
    variants, _, unknowns = equations.shape
    rows, others = _pivots(equations[0], unknowns - free)
    open_ones = np.setdiff1d(np.arange(unknowns), others)
    motions = np.zeros((variants, unknowns, free))
    motions[:, open_ones, np.arange(free)] = 1.0
    safe = np.ones(variants, np.bool_)
    if len(rows):
        block = equations[:, rows[:, None], others]
        with np.errstate(all="ignore"):
            sizes = np.abs(block).max(axis=2)
            sizes = np.maximum(sizes, sizes[0])  # a row that is nearly nothing counts as that
            shares = np.abs(np.linalg.det(block)) / sizes.prod(axis=1)
            safe = shares > LOST_PIVOT * shares[0]
        block[~safe] = block[0]
        motions[:, others] = -np.linalg.solve(block, equations[:, rows[:, None], open_ones])
    largest = np.abs(equations).max(axis=2, keepdims=True, initial=0.0)
    sizes = largest * np.abs(motions).max(axis=1, keepdims=True, initial=0.0)
    safe &= (np.abs(equations @ motions) <= RESIDUE * sizes).all(axis=(1, 2))
    return FollowedMotions(motions, open_ones, others, safe)


def _pivots(matrix: Floats, rank: int) -> tuple[Integers, Integers]:
    """Equations and unknowns of a regular block, by elimination with the largest pivot."""
    left = matrix / np.maximum(np.abs(matrix).max(axis=1, keepdims=True, initial=0.0), 1e-300)
    rows, columns = [], []
    for _ in range(rank):
        row, column = np.unravel_index(int(np.argmax(np.abs(left))), left.shape)
        rows.append(row)
        columns.append(column)
        left = left - np.outer(left[:, column], left[row]) / left[row, column]
        left[row] = 0.0
        left[:, column] = 0.0
    return np.array(rows, np.int64), np.array(columns, np.int64)
