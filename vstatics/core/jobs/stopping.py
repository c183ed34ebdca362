"""Ctrl-C and SIGTERM as an exception, so that nothing is left half written."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

ENDING = (signal.SIGINT, signal.SIGTERM)
AGAIN = (signal.SIGALRM,) if hasattr(signal, "setitimer") else ()
"""Of a timer, where a system has one."""
SIGNAL_DELAY = 0.001
"""So long a signal waits that comes while a module is imported. [s]"""


class StoppedError(BaseException):
    """The process was asked to end by a signal."""

    def __init__(self, number: int) -> None:
        """Keep the number of the signal."""
        self.signal = number


class Stop:
    """What signal came, if one did."""

    error: StoppedError | None = None

    def check(self) -> None:
        """Raise it once more, if it came.

        Python drops an exception that comes while an object is taken down.

        Raises
        ------
        StoppedError
            If there was a signal.
        """
        if self.error is not None:
            raise self.error


@contextmanager
def stoppable() -> Iterator[Stop]:
    """Make SIGINT and SIGTERM raise `StoppedError` in this block.

    In the middle of an import it is raised behind that: modules that are half imported, and
    classes half made, turn it into errors of other kinds.

    >>> try:
    ...     with stoppable() as stop:
    ...         signal.raise_signal(signal.SIGTERM)
    ... except StoppedError as stopped:
    ...     stopped.signal == signal.SIGTERM
    True
    """
    stop = Stop()
    if threading.current_thread() is not threading.main_thread():
        yield stop  # only the main thread is told of signals
        return
    later = False

    def come(number: int, frame: FrameType | None) -> None:
        nonlocal later
        if number in ENDING:
            stop.error = StoppedError(number)
        later = bool(AGAIN) and _is_import(frame)
        if later:
            signal.setitimer(signal.ITIMER_REAL, SIGNAL_DELAY)
        else:
            stop.check()

    def dropped(what: sys.UnraisableHookArgs) -> None:
        if not isinstance(what.exc_value, StoppedError):
            tell(what)

    tell, sys.unraisablehook = sys.unraisablehook, dropped
    before = {number: signal.signal(number, come) for number in (*ENDING, *AGAIN)}
    try:
        yield stop
    finally:
        if later:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)
        sys.unraisablehook = tell
    if later:
        stop.check()


def _is_import(frame: FrameType | None) -> bool:
    """Whether a module is being imported."""
    while frame is not None:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            return True
        frame = frame.f_back
    return False
