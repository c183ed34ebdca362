"""Limit of the wall-clock time of a run, and estimate of its total time."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TypeAlias

Guard: TypeAlias = Callable[[float], str]
"""Callback that receives the simulated time [s] and returns a reason to stop, or an empty text."""


def wall_limit(seconds: float) -> Guard:
    """Return a callback that stops a run after a wall-clock time.

    Parameters
    ----------
    seconds : float
        Time limit from now on. [s]

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
    """Estimator of the processor time of a whole run, from a trial run stopped early.

    Processor time is used, because other processes can delay the first steps of a run.

    Parameters
    ----------
    duration : float
        Simulated duration of the whole run. [s]
    seconds : float
        Processor time after which the trial run is stopped. The time begins at the first step,
        because imports before it take time. [s]
    """

    def __init__(self, duration: float, seconds: float) -> None:
        self.duration, self.seconds = duration, seconds
        self._first = math.inf
        self._half = self._last = (0.0, 0.0)
        """Pairs (processor time, simulated time) at half of the trial, and at its end. [s]"""

    def __call__(self, at: float) -> str:
        """Record the simulated time, and stop the run at the end of the trial."""
        now = time.process_time()
        self._first = min(self._first, now)
        self._last = now - self._first, at
        if self._last[0] < 0.5 * self.seconds:
            self._half = self._last
        return "its pace is known" if self._last[0] >= self.seconds else ""

    @property
    def needed(self) -> float:
        """Estimated processor time of the whole run [s]; 0 if it ended within the trial."""
        if self._last[0] < self.seconds:
            return 0.0
        (began, half), (taken, at) = self._half, self._last
        left = self.duration - at
        return taken + (taken - began) * left / (at - half) if at > half else math.inf
