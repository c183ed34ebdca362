"""Ratios that the tooth numbers of a gear set can have, each once, sorted in a tree of halves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers, counted
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.rows import TooManyError

MOST_TEETH_ROWS = 1_000_000
"""Largest number of rows of tooth numbers of a gear set that are kept in memory."""


class TeethTable(NamedTuple):
    """Rows of tooth numbers of a gear set, grouped by ratios.

    Rows with equal ratios form a group (`place`). The groups are ordered so that each node of the
    tree, and both its halves, are contiguous.
    """

    layout: TeethLayout
    is_whole: bool
    """True if the table contains all possible rows."""
    total: int
    """Total number of choices of tooth numbers, number of planets and modules."""
    rows: Integers
    """Different rows of tooth numbers, grouped by ratios, shape (rows, wheels + 1 + components)."""
    starts: Integers
    """Index of the first row of each group, then the number of rows, shape (groups + 1,)."""
    ratios: Floats
    """Different ratios of the gear set, shape (groups, ratios). [-]"""
    nodes: Integers
    """First group, end, and both halves (-1 for a single group) of each node, shape (nodes, 4)."""
    low: Floats
    """Smallest ratios in each node, shape (nodes, ratios). [-]"""
    high: Floats
    """Largest ratios in each node, shape (nodes, ratios). [-]"""

    @property
    def different(self) -> Integers:
        """Number of rows in each group, shape (groups,)."""
        return np.diff(self.starts)


def teeth_table(
    layout: TeethLayout, pieces: Iterable[Integers], counts: Sequence[int]
) -> TeethTable:
    """Return the table of rows of tooth numbers that are given in pieces.

    Parameters
    ----------
    layout : TeethLayout
    pieces : iterable of ndarray
        Rows of tooth numbers, as yielded by `TeethRows.pieces`.
    counts : sequence of int
        Numbers of planets in order of preference; of rows with equal tooth numbers, one is kept.
    """
    pieces_read: list[Integers] = []
    total = 0
    is_whole = True
    try:
        for piece in pieces:
            pieces_read.append(piece)
            total += len(piece)
            if total > MOST_TEETH_ROWS:
                is_whole = False
                break
    except TooManyError:
        is_whole = False
    width = len(layout.wheels) + 2 + max(layout.component)
    rows = np.concatenate([np.zeros((0, width), np.int32), *pieces_read])
    wheels = len(layout.wheels)
    # Of rows with equal tooth numbers, the row with the preferred number of planets is kept.
    rank = np.zeros(max(counts) + 1, np.int64)
    rank[list(counts)] = range(len(counts))
    keys = [rank[rows[:, wheels]], *rows[:, :wheels].T[::-1]]
    rows = rows[np.lexsort(keys)]
    is_new = np.ones(len(rows), np.bool_)
    is_new[1:] = (np.diff(rows[:, :wheels], axis=0) != 0).any(axis=1)
    rows = rows[is_new]
    ratios = of_rows(layout, rows)
    place = np.zeros(len(ratios), np.int64)
    for column in ratios.T:
        _, numbers = np.unique(column, return_inverse=True)
        both = place * (numbers.max(initial=0) + 1) + numbers
        place = np.unique(both, return_inverse=True)[1].astype(np.int64)
    order = np.argsort(place, kind="stable")
    sizes = np.bincount(place, minlength=int(place.max(initial=-1)) + 1)
    firsts = np.cumsum(sizes) - sizes
    unique = ratios[order][firsts]
    in_halves, nodes, low, high = _halves(unique)
    sizes = sizes[in_halves]
    which, within = counted(sizes)
    starts = np.concatenate([[0], np.cumsum(sizes)])
    rows = rows[order][firsts[in_halves][which] + within]
    nodes_of = (unique[in_halves], nodes, low, high)
    return TeethTable(layout, is_whole, total, rows, starts, *nodes_of)


def of_rows(layout: TeethLayout, rows: Integers) -> Floats:
    """Return the ratios of rows, rounded so that equal ratios are equal numbers."""
    ratios = np.empty((len(rows), len(layout.ratios)))
    for number, ratio in enumerate(layout.ratios):
        above, below = np.ones(len(rows)), np.ones(len(rows))
        for wheel, power in ratio.powers.items():
            if power > 0:
                above = above * rows[:, wheel].astype(np.float64) ** power
            else:
                below = below * rows[:, wheel].astype(np.float64) ** -power
        ratios[:, number] = ratio.sign * above / below
    return ratios


def _halves(ratios: Floats) -> tuple[Integers, Integers, Floats, Floats]:
    """Return an order of groups, and nodes with their bounds, halved along the widest ratio.

    >>> order, nodes, low, high = _halves(np.array([[3.0], [1.0], [2.0]]))
    >>> order.tolist(), nodes.tolist()
    ([1, 2, 0], [[0, 3, 1, 2], [0, 2, 3, 4], [2, 3, -1, -1], [0, 1, -1, -1], [1, 2, -1, -1]])
    """
    order: Integers = np.arange(len(ratios))
    sizes = np.log(np.abs(ratios))
    level: Integers = np.array([[0, len(ratios)]], np.int64)[: len(ratios)]
    nodes, count = [np.zeros((0, 4), np.int64)], 0
    lows, highs = [ratios[:0]], [ratios[:0]]
    while len(level):
        starts = level[:, 0]
        lows.append(_reduced(np.minimum, ratios[order], level))
        highs.append(_reduced(np.maximum, ratios[order], level))
        widths = _reduced(np.maximum, sizes[order], level) - _reduced(
            np.minimum, sizes[order], level
        )
        split = level[:, 1] - starts > 1
        order = _sorted_within(order, sizes, level, widths.argmax(axis=1))
        middle = (level.sum(axis=1) + 1) // 2
        first = count + len(level) + 2 * (np.cumsum(split) - split)
        children = np.where(split[:, np.newaxis], np.stack([first, first + 1], axis=1), -1)
        nodes.append(np.concatenate([level, children], axis=1))
        count += len(level)
        below = np.stack([starts, middle, middle, level[:, 1]], axis=1)[split]
        level = below.reshape(-1, 2)
    return order, np.concatenate(nodes), np.concatenate(lows), np.concatenate(highs)


def _reduced(function: np.ufunc, values: Floats, level: Integers) -> Floats:
    """Return the minima or maxima of values between the starts and ends of nodes of a level."""
    bounds = level.ravel()
    inside = np.concatenate([values, values[-1:]])
    return function.reduceat(inside, bounds, axis=0)[::2]


def _sorted_within(order: Integers, sizes: Floats, level: Integers, widest: Integers) -> Integers:
    """Return the order with each node of a level sorted by the ratio with the widest range."""
    sorted_order = order.copy()
    of_part, more = counted(level[:, 1] - level[:, 0])
    places = level[of_part, 0] + more
    key = sizes[order[places], widest[of_part]]
    sorted_order[places] = order[places][np.lexsort((key, of_part))]
    return sorted_order
