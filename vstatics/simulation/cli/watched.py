"""Supervision of a run: time limit, Ctrl-C and progress on the terminal."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

from vstatics.core.cli.shared.progress import done_text, telling
from vstatics.simulation.bounds import wall_limit


class RunWatch:
    """Progress of a run, and the reason to stop it.

    Parameters
    ----------
    file : str
        Name of the scenario in the progress line.
    duration : float
        Duration of the scenario. [s]
    limit : float, optional
        Wall-clock time after which the run is stopped. [s]
    """

    def __init__(self, file: str, duration: float, limit: float | None) -> None:
        self.file, self.duration, self.time = file, duration, 0.0
        self.interrupted = False
        """Whether Ctrl-C was pressed."""
        self.why = ""
        """Reason to stop the run; empty while the run goes on."""
        self.began = time.monotonic()
        self._limit = wall_limit(math.inf if limit is None else limit)

    def __call__(self, at: float) -> str:
        """Record the simulated time [s], and return the reason to stop, if any."""
        self.time = at
        if self.interrupted:
            self.why = "the run was stopped by Ctrl-C"
        else:
            self.why = self._limit(at)
        return self.why

    def said(self) -> str:
        """Return the progress line with the estimated remaining time; empty once a stop is due."""
        if self.why:
            return ""
        progress = done_text(self.time / self.duration, time.monotonic() - self.began)
        return f"{self.file}: {progress}" + ("" if self.time else ", Ctrl-C or --limit ends it")


@contextmanager
def watched(file: str, duration: float, limit: float | None, *, quiet: bool) -> Iterator[RunWatch]:
    """Watch a run: Ctrl-C stops the run at the next step, a second Ctrl-C immediately.

    Parameters
    ----------
    file : str
        Name of the scenario in the progress line.
    quiet : bool
        True if no progress is shown.
    """
    watch = RunWatch(file, duration, limit)
    is_main = threading.current_thread() is threading.main_thread()
    before = signal.getsignal(signal.SIGINT)

    def interrupt(*_: object) -> None:
        watch.interrupted = True
        signal.signal(signal.SIGINT, before)

    if is_main:
        signal.signal(signal.SIGINT, interrupt)
    try:
        with nullcontext() if quiet else telling(watch.said):
            yield watch
    finally:
        if is_main:
            signal.signal(signal.SIGINT, before)
