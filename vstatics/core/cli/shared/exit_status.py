"""The exit statuses of all commands."""

from __future__ import annotations

DONE = 0
FAILED = 1
"""A case is in error, or a gear of it can't be; an output was not written to its end."""
WRONG_USE = 2
"""Of the command line; `cli` tells click to leave with it."""
EMPTY = 3
"""Of a sweep without rows, with --fail-empty."""


def stopped_by(signal: int) -> int:
    """That of a process that a signal asked to end, as shells have it.

    >>> stopped_by(2), stopped_by(15)
    (130, 143)
    """
    return 128 + signal
