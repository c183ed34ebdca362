"""Ctrl-C and SIGTERM as an exception, so that nothing is left half written."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn


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

    def come(number: int, _: object) -> NoReturn:
        stop.error = StoppedError(number)
        raise stop.error

    def dropped(what: sys.UnraisableHookArgs) -> None:
        if not isinstance(what.exc_value, StoppedError):
            tell(what)

    tell, sys.unraisablehook = sys.unraisablehook, dropped
    before = {number: signal.signal(number, come) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        sys.unraisablehook = tell
