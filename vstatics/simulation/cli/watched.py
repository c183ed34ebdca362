"""A run that is watched: by the clock, by Ctrl-C, and by whoever waits for it."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

from vstatics.core.cli.shared.progress import done_text, telling
from vstatics.simulation.bounds import Guard, wall_limit


class RunWatch:
    """What is known of a run while it goes on, and why it is to stop.

    Parameters
    ----------
    file : str
        To speak of it.
    duration : float
        Of what is simulated. [s]
    limit : float, optional
        So long the run may take. [s]
    """

    def __init__(self, file: str, duration: float, limit: float | None) -> None:
        self.file, self.duration, self.time = file, duration, 0.0
        self.interrupted = False
        """Whether Ctrl-C came."""
        self.why = ""
        """Why it stops."""
        self.began = time.monotonic()
        self._limit: Guard | None = None if limit is None else wall_limit(limit)

    def __call__(self, at: float) -> str:
        """Keep how far the run is; why it is to stop there."""
        self.time = at
        if self.interrupted:
            self.why = "the run was stopped by Ctrl-C"
        elif self._limit is not None:
            self.why = self._limit(at)
        return self.why

    def said(self) -> str:
        """How far the run is, and how long it will take if it goes on so; nothing at its end."""
        if self.why:
            return ""
        told = done_text(self.time / self.duration, time.monotonic() - self.began)
        return f"{self.file}: {told}" + ("" if self.time else ", Ctrl-C or --limit ends it")


@contextmanager
def watched(file: str, duration: float, limit: float | None, *, quiet: bool) -> Iterator[RunWatch]:
    """Watch a run: Ctrl-C stops it at the next step, once more at once; progress is told.

    Parameters
    ----------
    file : str
        To speak of it.
    quiet : bool
        Whether no progress is told.
    """
    watch = RunWatch(file, duration, limit)
    is_main = threading.current_thread() is threading.main_thread()
    before = signal.getsignal(signal.SIGINT)

    def come(*_: object) -> None:
        watch.interrupted = True
        signal.signal(signal.SIGINT, before)

    if is_main:
        signal.signal(signal.SIGINT, come)
    try:
        with nullcontext() if quiet else telling(watch.said):
            yield watch
    finally:
        if is_main:
            signal.signal(signal.SIGINT, before)
