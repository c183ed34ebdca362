"""Test whether a code is the least of its class, and its symmetries.

The least code of a class is found set by set over all orders of the sets. An order is followed
while its code agrees with the given code, and dropped when it is greater; when it is less, the
given code is not the least. Few orders are examined in this way.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.synthesis.structures.arrays import MEMBERS, Codes

UNSEEN = 255
"""New number of a link without a number."""
MOST_RENAMINGS = 400_000
"""Number of renamings that are followed at once, because of memory."""


class Symmetries(NamedTuple):
    """Least codes, and the renamings that leave least codes unchanged."""

    least: NDArray[np.bool_]
    """True for least codes, shape (schemes,)."""
    which: NDArray[np.intp]
    """Row of the code of each renaming, ascending, shape (renamings,)."""
    links: Codes
    """New number of each link, shape (renamings, links)."""


class _Renamings(NamedTuple):
    """Partial orders of the sets of schemes whose codes agree so far."""

    which: NDArray[np.intp]
    """Scheme of each renaming, shape (renamings,)."""
    used: NDArray[np.uint16]
    """Sets with a place, as bits, shape (renamings,)."""
    links: Codes
    """New number of each link, shape (renamings, links)."""
    next: NDArray[np.uint8]
    """Next new number, shape (renamings,)."""


def symmetries(codes: Codes, orders: tuple[tuple[int, ...], ...]) -> Symmetries:
    """Find the least codes and the symmetries of each.

    Parameters
    ----------
    codes : array, shape (schemes, 3*sets)
        Restricted growth strings.
    orders : tuple
        Equivalent orders of the members of a set.

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
        """Start with every code as the least."""
        self.sets = codes.shape[1] // MEMBERS
        self.members = codes.reshape(len(codes), self.sets, MEMBERS)
        self.orders = orders
        self.least = np.ones(len(codes), dtype=bool)
        self.ends: list[_Renamings] = []

    def follow(self, renamings: _Renamings, place: int) -> None:
        """Try every set at a place of the order; follow the renamings whose codes agree there."""
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
        """Extend renamings by a set at a place, as far as the codes agree with the given codes.

        A code that becomes less than the given code shows that the given code is not the least.
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
