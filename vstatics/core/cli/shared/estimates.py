"""Estimates of time and size, which --dry-run prints, and a check of free disk space."""

from __future__ import annotations

import contextlib
import math
import os
import stat
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.files import STDOUT, is_stream

if TYPE_CHECKING:
    from vstatics.core.tables.answer import Answer


class CommandEstimate(NamedTuple):
    """Estimates of time, size and other numbers before a command runs.

    Examples
    --------
    >>> print(CommandEstimate({"boxes": "36"}, {}, 90, jobs=4).text("text"), end="")
    boxes  36
    time   about 1.5 minutes with 4 jobs
    """

    said: Mapping[str, str]
    """Estimates other than the time as text, by label."""
    answer: Answer
    """Record for JSON, which includes the time in seconds."""
    seconds: float
    jobs: int = 1
    at_least: bool = False
    """True if the estimated time is a lower limit, and the command can take much longer."""

    @property
    def rows(self) -> dict[str, str]:
        """All estimates as text, including the time, by label."""
        processes = f" with {self.jobs} jobs" if self.jobs > 1 else ""
        more = " or more" if self.at_least else ""
        return {**self.said, "time": f"about {duration_text(self.seconds)}{more}{processes}"}

    def text(self, form: str | None, least: int = 0) -> str:
        """Return JSON, or lines whose labels have at least `least` characters."""
        if form in ("json", "jsonl"):
            from vstatics.core.tables.answer import as_json

            return as_json(self.answer, form)
        wide = max(least, *map(len, self.rows)) + 2
        return "".join(f"{name:{wide}}{text}\n" for name, text in self.rows.items())


def size_text(length: float) -> str:
    """Return a size in bytes as a short text with unit.

    >>> size_text(999), size_text(1.3e9)
    ('999 bytes', '1.3 GB')
    """
    units = ("bytes", "kB", "MB", "GB", "TB", "PB", "EB")
    power = min(int(math.log10(max(length, 1)) / 3), len(units) - 1)
    return f"{length / 1000**power:.3g} {units[power]}"


def duration_text(seconds: float) -> str:
    """Return a duration as a short text with unit.

    >>> duration_text(0.2), duration_text(90), duration_text(9000), duration_text(1e8)
    ('a second', '1.5 minutes', '2.5 hours', '3.17 years')
    """
    if seconds < 1:
        return "a second"
    if seconds < 60:
        return f"{seconds:.0f} s"
    if seconds < 3600:
        return f"{seconds / 60:.2g} minutes"
    days = seconds / 3600 / 24
    if days < 4:
        return f"{seconds / 3600:.3g} hours"
    return f"{days:.3g} days" if days < 1000 else f"{days / 365.25:.3g} years"


def about(number: float) -> str:
    """Return a number as text, rounded to three digits.

    >>> about(785_512.3), about(2.03e22)
    ('about 786000', 'about 2.03e+22')
    """
    if number >= 1e15:
        return f"about {number:.3g}"
    return f"about {float(f'{number:.3g}'):.0f}"


def check_room(size: float, output: str | None, expected: str) -> None:
    """Raise an error if the output would be larger than the free disk space.

    Parameters
    ----------
    size : float
        Estimated size. [bytes]
    output : str, optional
    expected : str
        Words in the message for what the user can do instead.

    Raises
    ------
    ReadError
    """
    free = free_room(output)
    if free is not None and size > free:
        name = "<stdout>" if output is None or output == STDOUT else output
        message = f"needs about {size_text(size)}, but only {size_text(free)} are free there"
        raise ReadError([of_file("E005", name, f"{message}: expected {expected}")])


def free_room(output: str | None) -> int | None:
    """Return the free disk space for an output file [bytes]; None for a stream."""
    from shutil import disk_usage

    # Failures are ignored here, because writing the output reports them.
    with contextlib.suppress(OSError, ValueError, AttributeError, TypeError):
        if output is None or output == STDOUT:
            stdout = sys.stdout.fileno()
            return disk_usage(stdout).free if stat.S_ISREG(os.fstat(stdout).st_mode) else None
        if not is_stream(output):
            return disk_usage(os.path.dirname(output) or os.curdir).free  # noqa: PTH120
    return None
