"""Test whether a code is the least of its class of equal schemes, and find its symmetries.

All orders of the gear sets are tried, set by set. An order is followed while its code agrees with
the given code, and dropped when its code is greater. If its code is less, the given code is not the
least. In this way, only few orders are examined to the end.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.synthesis.structures.arrays import MEMBERS, Codes

UNSEEN = 255
"""Placeholder for the new number of a link that has no new number yet."""
MOST_RENAMINGS = 400_000
"""Number of renamings that are followed at once, to limit memory."""


class Symmetries(NamedTuple):
    """Marks of least codes, and the renamings that leave the codes unchanged."""

    least: NDArray[np.bool_]
    """True for each least code, shape (schemes,)."""
    which: NDArray[np.intp]
    """Row of the code to which each renaming belongs, ascending, shape (renamings,)."""
    links: Codes
    """New number of each link in a renaming, shape (renamings, links)."""


class _Renamings(NamedTuple):
    """Incomplete orders of the gear sets, whose codes agree so far with the given codes."""

    which: NDArray[np.intp]
    """Row of the scheme of each renaming, shape (renamings,)."""
    used: NDArray[np.uint16]
    """Gear sets that are already placed in the order, as bits, shape (renamings,)."""
    links: Codes
    """New number of each link in a renaming, shape (renamings, links)."""
    next: NDArray[np.uint8]
    """Next new number of a link in each renaming, shape (renamings,)."""


def symmetries(codes: Codes, orders: tuple[tuple[int, ...], ...]) -> Symmetries:
    """Find the least codes, and the symmetries of each.

    Parameters
    ----------
    codes : array, shape (schemes, 3*sets)
        Codes of schemes (restricted growth strings).
    orders : tuple
        Equivalent orders of the members of a gear set.

    Examples
    --------
    >>> codes = np.array([[0, 1, 2, 0, 3, 4], [0, 1, 2, 3, 0, 4]], dtype=np.uint8)
    >>> found = symmetries(codes, ((0, 1, 2),))
    >>> found.least  # with exchanged sets, the second code becomes 0-1-2-1-3-4
    array([ True, False])
    >>> found.links.tolist()  # the sets of the first code can be exchanged
    [[0, 3, 4, 1, 2], [0, 1, 2, 3, 4]]
    """
    search = _RenamingSearch(codes, orders)
    schemes, links = len(codes), int(codes.max(initial=0)) + 1
    unseen = np.full((schemes, links), UNSEEN, np.uint8)
    none = np.zeros(schemes, np.uint16)
    search.follow(_Renamings(np.arange(schemes), none, unseen, none.astype(np.uint8)), 0)
    ends = _joined(search.ends)
    still = search.least[ends.which]
    order = np.argsort(ends.which[still], kind="stable")
    return Symmetries(search.least, ends.which[still][order], ends.links[still][order])


class _RenamingSearch:
    """Search for renamings that reduce or keep a code."""

    def __init__(self, codes: Codes, orders: tuple[tuple[int, ...], ...]) -> None:
        """Begin with every code as a candidate for the least."""
        self.sets = codes.shape[1] // MEMBERS
        self.members = codes.reshape(len(codes), self.sets, MEMBERS)
        self.orders = orders
        self.least = np.ones(len(codes), dtype=bool)
        self.ends: list[_Renamings] = []

    def follow(self, renamings: _Renamings, place: int) -> None:
        """Try every gear set at a position of the order, and follow renamings with equal codes."""
        if place == self.sets:
            self.ends.append(renamings)
            return
        for start in range(0, max(len(renamings.which), 1), MOST_RENAMINGS):
            part = _of_rows(renamings, slice(start, start + MOST_RENAMINGS))
            agree = [
                self._agreeing(part, place, number, order)
                for number in range(self.sets)
                for order in self.orders
            ]
            self.follow(_joined(agree), place + 1)

    def _agreeing(
        self, before: _Renamings, place: int, number: int, order: tuple[int, ...]
    ) -> _Renamings:
        """Extend renamings by a gear set at a position; return renamings that agree with the codes.

        If a code becomes less than the given code, the given code is not the least.
        """
        free = (before.used >> np.uint16(number)) & np.uint16(1) == 0
        rows = np.flatnonzero(free & self.least[before.which])
        counts = before.next[rows]
        for member, wanted in zip(order, range(MEMBERS), strict=True):
            which = before.which[rows]
            new = before.links[rows, self.members[which, number, member]]
            unseen = new == UNSEEN
            new = np.where(unseen, counts, new)
            there = self.members[which, place, wanted]
            self.least[which[new < there]] = False
            agrees = new == there
            rows, counts = rows[agrees], (counts + unseen)[agrees]
        after = _of_rows(before, rows)
        members = self.members[after.which]
        row = np.arange(len(rows))
        for member, wanted in zip(order, range(MEMBERS), strict=True):
            after.links[row, members[:, number, member]] = members[:, place, wanted]
        return after._replace(used=after.used | np.uint16(1 << number), next=counts)


def _of_rows(renamings: _Renamings, rows: slice | NDArray[np.intp]) -> _Renamings:
    return _Renamings._make(column[rows] for column in renamings)


def _joined(parts: list[_Renamings]) -> _Renamings:
    return _Renamings._make(map(np.concatenate, zip(*parts, strict=True)))
