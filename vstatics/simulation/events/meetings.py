"""Corners of formulas that are met again and again within a moment."""

from __future__ import annotations

from collections import deque
from copy import deepcopy
from typing import NamedTuple

from vstatics.simulation.events.margins import Awaited
from vstatics.simulation.tolerances import AHEAD, NO_PROGRESS, SLIDING

_PASSED = 4
"""Times that a bend is met within a moment until it counts as passed."""
_SWITCHES = 8
"""Times that a jump is met within a moment until it counts as switching without end."""


class CornerPlace(NamedTuple):
    """A corner among those of a system."""

    corner: int
    """Index of the corner."""
    number: int
    """Index among the numbers with which it is compared."""


class CornerMeetings:
    """When corners were met lately.

    Parameters
    ----------
    span : float
        Time by parts of which instants are near. [s]
    """

    def __init__(self, span: float) -> None:
        self.span = span
        self.times: dict[CornerPlace, deque[float]] = {}

    def copy(self) -> CornerMeetings:
        """Return the same meetings, which go on by themselves."""
        return deepcopy(self)

    def note(self, place: CornerPlace, time: float) -> None:
        """Note that a corner is met at a time [s]."""
        self.times.setdefault(place, deque(maxlen=_SWITCHES)).append(time)

    def is_passed(self, place: CornerPlace, time: float) -> bool:
        """Return whether a bend needs no watch for a while, as it was met too often.

        Its formula has the same value on both sides, so the run may go on without a stop there.
        """
        times = [*self.times.get(place, ())][-_PASSED:]
        return len(times) == _PASSED and time - times[0] <= _PASSED * AHEAD * self.span

    def switches(self, place: CornerPlace, judged: Awaited, within: float) -> bool:
        """Return whether a jump is met without end: each side drives the motion to the other.

        Parameters
        ----------
        place : CornerPlace
        judged : Awaited
            As it was judged last.
        within : float
            Time of the look-ahead. [s]
        """
        times = self.times[place]
        length = times[-1] - times[0]
        if len(times) < _SWITCHES or length > NO_PROGRESS * self.span:
            return False
        swing = judged.change * length / (_SWITCHES - 1) / within
        return swing <= SLIDING * judged.size
