"""Which code is the least of its class, and by which renamings it becomes itself.

The least code of a class is found set by set: another order of the sets whose codes agree so
far is followed further, one that is greater is left, one that is less shows that the code
isn't the least. So few of all orders are looked at, whatever their number.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.synthesis.structures.arrays import MEMBERS, Codes

UNSEEN = 255
"""The new number of a link that has none so far."""
MOST_RENAMINGS = 400_000
"""So many are followed at once, for the sake of memory."""


class Symmetries(NamedTuple):
    """Which codes are least, and the renamings that leave these as they are."""

    least: NDArray[np.bool_]
    """Shape (schemes,)."""
    which: NDArray[np.intp]
    """The row that each renaming is of, ascending, shape (renamings,)."""
    links: Codes
    """The new number of each link, shape (renamings, links)."""


class _Renamings(NamedTuple):
    """Some sets of schemes in another order, where their code agrees so far."""

    which: NDArray[np.intp]
    """The scheme of each."""
    used: NDArray[np.uint16]
    """The sets that have a place, as bits."""
    links: Codes
    """The new number of each link, shape (renamings, links)."""
    next: NDArray[np.uint8]
    """The next new number."""


def symmetries(codes: Codes, orders: tuple[tuple[int, ...], ...]) -> Symmetries:
    """Whether codes are the least of their classes, with the symmetries of those that are.

    Parameters
    ----------
    codes : array, shape (schemes, 3*sets)
        Restricted growth strings.
    orders : tuple
        The orders of the members of a set that are not told apart.

    Examples
    --------
    >>> codes = np.array([[0, 1, 2, 0, 3, 4], [0, 1, 2, 3, 0, 4]], dtype=np.uint8)
    >>> found = symmetries(codes, ((0, 1, 2),))
    >>> found.least  # with its sets in the other order the second one is 0-1-2-1-3-4
    array([ True, False])
    >>> found.links.tolist()  # the two sets of the first one change places
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
    """The search for renamings that make a code less, or leave it as it is."""

    def __init__(self, codes: Codes, orders: tuple[tuple[int, ...], ...]) -> None:
        """Begin with every code as the least."""
        self.sets = codes.shape[1] // MEMBERS
        self.members = codes.reshape(len(codes), self.sets, MEMBERS)
        self.orders = orders
        self.least = np.ones(len(codes), dtype=bool)
        self.ends: list[_Renamings] = []

    def follow(self, renamings: _Renamings, place: int) -> None:
        """Put every set in a place, and follow further what agrees there."""
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
        """Those whose code agrees with a set in this place; one that is less is noted."""
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
    """Some of them; a copy where the rows are numbers."""
    return _Renamings._make(one[rows] for one in renamings)


def _joined(parts: list[_Renamings]) -> _Renamings:
    """All of them; there is at least one part."""
    return _Renamings._make(map(np.concatenate, zip(*parts, strict=True)))
