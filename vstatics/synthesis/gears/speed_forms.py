"""Speeds of a case as linear functions of as few free speeds as its equations permit.

The equations of mechanisms, and of springs at mean speeds, are the same for every combination of
shift elements, so they are eliminated only once. What remains is one short row for each shift
element, input and output.
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heapify, heappop, heappush
from typing import NamedTuple

import numpy as np

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.elimination import EXACTLY_ONE, FLOATS, Entry, Row, row_of
from vstatics.core.numerics.traced import absolute, plain
from vstatics.core.statics.matrix import columns
from vstatics.synthesis.tolerances import KEPT_PART

Pair = tuple[int, int]
"""Two links whose speed difference is wanted; 0 is the housing."""
NOTHING: Entry = (0.0, 0.0)
"""Exact zero as an entry of a row: the value, and the magnitude that bounds its error."""


class SpeedForms(NamedTuple):
    """Speed differences of pairs of links, as linear functions of the free speeds."""

    values: Floats
    """Coefficients of the linear functions, shape (pairs, free speeds). [-]"""
    sizes: Floats
    """Sum of the magnitudes from which each coefficient was calculated, shape of `values`. [-]

    The sums bound the rounding errors; see `core.numerics.elimination`.
    """
    doubtful: bool
    """True if too many digits were lost to recognise zeros reliably."""

    @property
    def free(self) -> int:
        """Number of free speeds: degrees of freedom of the train without shift elements."""
        return int(self.values.shape[-1])


class _GivenSpeed(NamedTuple):
    """Equation that gives the speed of a link as a function of other links' speeds."""

    number: int
    link: int
    entry: Entry
    others: Row


class FreeSpeeds:
    """Elimination of the speeds that depend on other speeds by mechanisms and springs of a case.

    Parameters
    ----------
    ratios : sequence of float, optional
        Basic ratios that replace the ratios of the case. [-]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> speeds = FreeSpeeds(case)
    >>> speeds.free, speeds.forms([(1, 0), (3, 0)]).values
    ([1, 2], array([[1.        , 0.        ],
           [0.28571429, 0.71428571]]))
    """

    def __init__(self, case: Transmission, ratios: Sequence[float] | None = None) -> None:
        """Eliminate the equations that hold for every combination of shift elements."""
        basic = [mechanism.ratio for mechanism in case.mechanisms]
        self.doubtful = False
        self._numbered: list[_GivenSpeed] = []
        self._pivots: dict[int, _GivenSpeed] = {}
        for column in columns(case, basic if ratios is None else ratios)[
            len(case.shift_elements) :
        ]:
            row = self._reduced(row_of(column, FLOATS))
            if row:  # the row determines one of its speeds
                link = max(row, key=lambda candidate: (abs(row[candidate][0]), -candidate))
                pivot = _GivenSpeed(len(self._numbered), link, row.pop(link), row)
                self._numbered.append(pivot)
                self._pivots[link] = pivot
        links = range(1, case.links + 1)
        self.free = [link for link in links if link not in self._pivots]
        """Links whose speeds are free."""

    def _reduced(self, row: Row) -> Row:
        """Eliminate the dependent speeds from a row, and remove zeros.

        No row of `_pivots` contains the link of an earlier row, so each row is used at most once.
        """
        left = {link: entry for link, entry in row.items() if entry[0]}
        met = [self._pivots[link].number for link in left if link in self._pivots]
        heapify(met)
        while met:
            pivot = self._numbered[heappop(met)]
            if pivot.link not in left:
                continue
            factor = FLOATS.quotient(left.pop(pivot.link), pivot.entry)
            for link, term in pivot.others.items():
                if link not in left and link in self._pivots:
                    heappush(met, self._pivots[link].number)
                entry = self._less(left.pop(link, NOTHING), factor, term)
                if entry[0]:
                    left[link] = entry
        return left

    def _less(self, entry: Entry, factor: Entry, term: Entry) -> Entry:
        """Return ``entry - factor * term``, and note a loss of digits."""
        less = FLOATS.less(entry, factor, term)
        larger = max(absolute(entry[0]), absolute(factor[0] * term[0]))
        self.doubtful |= bool(less[1] * KEPT_PART > larger)
        return less

    def forms(self, pairs: Sequence[Pair]) -> SpeedForms:
        """Return the speed differences of pairs of links as linear functions of the free speeds."""
        place = {link: index for index, link in enumerate(self.free)}
        values = np.zeros((len(pairs), len(place)))
        sizes = np.zeros_like(values)
        by_link: dict[int, Row] = {HOUSING: {}}
        for number, (first, second) in enumerate(pairs):
            for link in (first, second):
                if link not in by_link:
                    by_link[link] = self._reduced({link: (1.0, 1.0)})
            first_row, second_row = by_link[first], by_link[second]
            for link in dict.fromkeys([*first_row, *second_row]):
                pair = first_row.get(link, NOTHING), second_row.get(link, NOTHING)
                value, size = self._less(*pair, EXACTLY_ONE)
                values[number, place[link]], sizes[number, place[link]] = float(plain(value)), size
        return SpeedForms(values, sizes, self.doubtful)
