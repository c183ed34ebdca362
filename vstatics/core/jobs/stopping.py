"""Ctrl-C and SIGTERM as an exception, so that outputs stay complete or absent."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import FrameType
from typing import Any

ENDING = (signal.SIGINT, signal.SIGTERM)
AGAIN = (signal.SIGALRM,) if hasattr(signal, "setitimer") else ()
"""Timer signal; empty on systems without timers."""
SIGNAL_DELAY = 0.001
"""Delay after which a signal during an import is raised again. [s]"""


class StoppedError(BaseException):
    """Exception raised in the main thread when a signal ends the process."""

    def __init__(self, number: int) -> None:
        self.signal = number


class Stop:
    """Record of a received signal."""

    error: StoppedError | None = None

    def check(self) -> None:
        """Raise the error again if a signal was received.

        Python can have dropped the error, for example if the signal occurred in a finaliser.

        Raises
        ------
        StoppedError
            If a signal was received.
        """
        if self.error is not None:
            raise self.error


@contextmanager
def stoppable() -> Iterator[Stop]:
    """Make SIGINT and SIGTERM raise `StoppedError` within the block.

    A signal during an import raises the error after the import, because partly imported modules
    would cause other errors. An error that Python drops in a finaliser is raised again.

    >>> try:
    ...     with stoppable() as stop:
    ...         signal.raise_signal(signal.SIGTERM)
    ... except StoppedError as stopped:
    ...     stopped.signal == signal.SIGTERM
    True
    """
    stop = Stop()
    if threading.current_thread() is not threading.main_thread():
        yield stop  # other threads cannot handle signals
        return

    def receive(number: int, frame: FrameType | None) -> None:
        if number in ENDING:
            stop.error = StoppedError(number)
        if stop.error is None:  # the timer belongs to an outer block or another program
            _call(before[signal.Signals(number)], number, frame)
        elif AGAIN and _is_import(frame):
            _set_timer(SIGNAL_DELAY)
        else:
            stop.check()

    def report_dropped(unraisable: sys.UnraisableHookArgs) -> None:
        if isinstance(unraisable.exc_value, StoppedError):
            _set_timer(SIGNAL_DELAY)  # the finaliser ends before the next signal
        else:
            hook(unraisable)

    hook, sys.unraisablehook = sys.unraisablehook, report_dropped
    numbers = (*ENDING, *AGAIN)
    before = dict(zip(numbers, map(signal.getsignal, numbers), strict=True))
    _set_handlers(dict.fromkeys(numbers, receive))
    try:
        yield stop
    finally:
        waiting = stop.error is not None and _set_timer(0)
        _set_handlers(before)
        sys.unraisablehook = hook
    if waiting:
        stop.check()


def _set_handlers(handlers: Mapping[signal.Signals, Any]) -> None:
    for number, handler in handlers.items():
        signal.signal(number, handler)


def _call(handler: Any, number: int, frame: FrameType | None) -> None:
    if callable(handler):
        handler(number, frame)


def _set_timer(delay: float) -> bool:
    """Set the timer to a delay in seconds (0: stop it), and return whether it was running."""
    return bool(AGAIN) and signal.setitimer(signal.ITIMER_REAL, delay)[0] > 0


def _is_import(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            return True
        frame = frame.f_back
    return False
