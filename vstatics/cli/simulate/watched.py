"""A run that is watched: by the clock, by Ctrl-C, and by whoever waits for it."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from vstatics.cli.frame import files
from vstatics.cli.frame.estimates import duration_text
from vstatics.simulation.bounds import Guard, wall_limit

FIRST_WORD, LONGEST_SILENCE = 5.0, 60.0
"""A run says after so long how far it is, then each time after twice as long, to this. [s]"""


class RunWatch:
    """What is known of a run while it goes on, and why it is to stop.

    Parameters
    ----------
    duration : float
        Of what is simulated. [s]
    limit : float, optional
        So long the run may take. [s]
    """

    def __init__(self, duration: float, limit: float | None) -> None:
        self.duration, self.time = duration, 0.0
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
        """How far the run is, and how long it will take if it goes on so."""
        taken, part = time.monotonic() - self.began, self.time / self.duration
        told = f"{100 * part:.3g} % after {duration_text(taken)}"
        if not part:
            return f"{told}, Ctrl-C or --limit ends it"
        return f"{told}, about {duration_text(taken / part - taken)} left"


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
    watch, ended = RunWatch(duration, limit), threading.Event()

    def tell() -> None:
        wait = FIRST_WORD
        while not ended.wait(wait):
            if not watch.why:
                files.say(f"{file}: {watch.said()}")
            wait = min(2 * wait, LONGEST_SILENCE)

    if not quiet:
        threading.Thread(target=tell, daemon=True).start()
    is_main = threading.current_thread() is threading.main_thread()
    before = signal.getsignal(signal.SIGINT)

    def come(*_: object) -> None:
        watch.interrupted = True
        signal.signal(signal.SIGINT, before)

    if is_main:
        signal.signal(signal.SIGINT, come)
    try:
        yield watch
    finally:
        ended.set()
        if is_main:
            signal.signal(signal.SIGINT, before)
