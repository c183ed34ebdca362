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
    """How fast a run comes on, of one that is stopped after some seconds of the processor.

    Where others work beside it, a run waits before its first steps, too: by the clock they would
    seem to come on by nothing.

    Parameters
    ----------
    duration : float
        Of the run. [s]
    seconds : float
        After which it is stopped, from its first step on: what comes before may be imports. [s]
    """

    def __init__(self, duration: float, seconds: float) -> None:
        self.duration, self.seconds = duration, seconds
        self._first = math.inf
        self._half = self._last = (0.0, 0.0)
        """After how long the run was where. [s]"""

    def __call__(self, at: float) -> str:
        """Keep how far the run is; stop it when its pace is known."""
        now = time.process_time()
        self._first = min(self._first, now)
        self._last = now - self._first, at
        if self._last[0] < 0.5 * self.seconds:
            self._half = self._last
        return "its pace is known" if self.is_known else ""

    @property
    def is_known(self) -> bool:
        """Whether it took so long that it was stopped."""
        return self._last[0] >= self.seconds

    @property
    def needed(self) -> float:
        """What the whole run takes, by the second half of what was tried; 0 if it ended [s]."""
        if not self.is_known:
            return 0.0
        (began, half), (taken, at) = self._half, self._last
        left = self.duration - at
        return taken + (taken - began) * left / (at - half) if at > half else math.inf
