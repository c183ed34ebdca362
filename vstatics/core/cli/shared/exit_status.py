"""Exit statuses of all commands."""

from __future__ import annotations

DONE = 0
FAILED = 1
"""Status if a case has an error, a gear is impossible, or an output is incomplete."""
WRONG_USE = 2
"""Status of wrong use of the command line, equal to the status of click."""
EMPTY = 3
"""Status of a sweep without rows, with --fail-empty."""


def stopped_by(signal: int) -> int:
    """Return the exit status of a process stopped by a signal, as in shells.

    >>> stopped_by(2), stopped_by(15)
    (130, 143)
    """
    return 128 + signal
