"""Detection of formula corners that a motion reaches again and again."""

from __future__ import annotations

import math
from collections import Counter, deque
from typing import NamedTuple

import numpy as np

from vstatics.simulation.events.margins import Awaited
from vstatics.simulation.tolerances import AHEAD, FINE_SWING, NO_PROGRESS, NOT_ZERO, SLIDING

_PASSED = 4
"""Number of arrivals at a bend in quick succession after which the bend is ignored for a while."""
_SWITCHES = 8
"""Number of arrivals at a jump after which a motion can slide along the jump."""
_DOUBLINGS = 3
"""Number of compared periods, in each of which the number of arrivals doubles."""
_FIRST_DOUBLING = 3
"""Number of such periods left out at first, because the first arrivals are irregular."""
_LONGER = 1.2
"""Ratio of durations up to which a period counts as no longer than the period before."""
_MOST_MEETINGS = 1e3
"""Number of arrivals at a jump above which a run would take too long."""


class CornerPlace(NamedTuple):
    """Identity of a formula corner, at which two compared numbers are equal."""

    corner: int
    """Index in `FormulaCorners.all`."""
    number: int
    """Index in `Corner.compared`."""


class CornerMeetings:
    """Record of the times at which a motion reaches formula corners.

    Parameters
    ----------
    span : float
        Time scale of the scenario; times closer than a small fraction of it are near. [s]
    """

    def __init__(self, span: float) -> None:
        self.span = span
        self.times: dict[CornerPlace, deque[float]] = {}
        self.counts: Counter[CornerPlace] = Counter()
        self.swings: dict[CornerPlace, float] = {}
        """Swing about each jump during its first arrivals, in the unit of the compared numbers."""
        self.doublings: dict[CornerPlace, list[float]] = {}
        """Times of the arrivals with the numbers 1, 2, 4, 8, ... [s]"""

    def note(self, place: CornerPlace, time: float) -> None:
        """Record an arrival at a corner at a time [s]."""
        self.times.setdefault(place, deque(maxlen=_SWITCHES)).append(time)
        self.counts[place] += 1
        if self.counts[place].bit_count() == 1:
            self.doublings.setdefault(place, []).append(time)

    def latest(self, time: float) -> list[CornerPlace]:
        """Return the corners reached right before a time [s], latest first."""
        met = {place: times[-1] for place, times in self.times.items()}
        near = (place for place in met if time - met[place] <= AHEAD * self.span)
        return sorted(near, key=met.__getitem__, reverse=True)

    def hastens(self, place: CornerPlace, time: float, end: float) -> bool:
        """Return whether a jump is reached ever faster, so that the run cannot reach the end.

        A cycle of constant period needs twice the time for each doubling of the number of arrivals.
        If no doubling takes longer than the doubling before, the number of arrivals grows at least
        exponentially.
        """
        doublings = self.doublings[place]
        if doublings[-1] < time or len(doublings) <= _FIRST_DOUBLING + _DOUBLINGS:
            return False
        spans = np.diff(doublings[-_DOUBLINGS - 2 :])
        if (spans[1:] > _LONGER * spans[:-1]).any():
            return False
        more = (end - time) / max(spans[-1], NOT_ZERO)
        return bool(len(doublings) - 1 + more > math.log2(_MOST_MEETINGS))

    def is_passed(self, place: CornerPlace, time: float) -> bool:
        """Return whether a bend was reached too often and needs no event for a while.

        A formula is continuous at a bend, so the run can go on without stopping there.
        """
        times = [*self.times.get(place, ())][-_PASSED:]
        return len(times) == _PASSED and time - times[0] <= _PASSED * AHEAD * self.span

    def switches(self, place: CornerPlace, judged: Awaited, *, hastens: bool) -> bool:
        """Return whether both sides of a jump drive the motion back to the jump again and again.

        Parameters
        ----------
        place : CornerPlace
        judged : Awaited
            Latest state of the comparison.
        hastens : bool
            True if the motion reaches the jump faster and faster.
        """
        times = self.times[place]
        length = times[-1] - times[0]
        if len(times) < _SWITCHES:
            return False
        swing = judged.change * length / (_SWITCHES - 1) / (AHEAD * self.span)
        quick = length <= NO_PROGRESS * self.span
        first = self.swings.setdefault(place, swing)
        if hastens and swing <= SLIDING * max(first, judged.size):
            return True
        return swing <= (SLIDING if quick else FINE_SWING) * judged.size
