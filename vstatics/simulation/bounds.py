"""How long a run may take by the clock on the wall, and how long it would take."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TypeAlias

Guard: TypeAlias = Callable[[float], str]
"""Is told how far a run is [s], again and again; says why it is to stop there, or nothing."""


def wall_limit(seconds: float) -> Guard:
    """Stops a run that takes longer.

    Parameters
    ----------
    seconds : float
        From now on. [s]

    Examples
    --------
    >>> wall_limit(0.0)(1.5)
    'the run was stopped by --limit 0 s'
    """
    end = time.monotonic() + seconds

    def watch(_: float) -> str:
        return f"the run was stopped by --limit {seconds:g} s" if time.monotonic() >= end else ""

    return watch


class Pace:
    """How fast a run comes on, of one that is stopped after some seconds.

    Parameters
    ----------
    duration : float
        Of the run. [s]
    seconds : float
        After which it is stopped. [s]
    """

    def __init__(self, duration: float, seconds: float) -> None:
        self.duration, self.seconds = duration, seconds
        self.began = time.monotonic()
        self.half = self.time = 0.0
        self.is_known = False
        """Whether it took so long that it was stopped."""

    def __call__(self, at: float) -> str:
        """Keep how far the run is; stop it when that is known."""
        self.time, taken = at, time.monotonic() - self.began
        if taken < 0.5 * self.seconds:
            self.half = at
        self.is_known = taken >= self.seconds
        return "its pace is known" if self.is_known else ""

    @property
    def needed(self) -> float:
        """What the whole run takes, by the second half of what was tried; 0 if it ended [s]."""
        if not self.is_known:
            return 0.0
        covered, left = self.time - self.half, self.duration - self.time
        return self.seconds + 0.5 * self.seconds * left / covered if covered > 0 else math.inf
