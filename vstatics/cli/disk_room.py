"""Whether there is room for what a command will write, before it begins."""

from __future__ import annotations

import contextlib
import os
import stat
import sys

from vstatics.cli.amounts import size_text
from vstatics.errors import ReadError, of_file
from vstatics.jobs.files import STDOUT, is_stream


def check_room(size: float, output: str | None, expected: str) -> None:
    """Refuse an output that its disk has no room for.

    Parameters
    ----------
    size : float
        About how large it will be. [bytes]
    output : str, optional
    expected : str
        What to ask for in its place.

    Raises
    ------
    ReadError
    """
    free = free_room(output)
    if free is not None and size > free:
        name = "<stdout>" if output is None or output == STDOUT else output
        message = f"would have about {size_text(size)}, but {size_text(free)} are free there"
        raise ReadError([of_file(name, f"{message}: expected {expected}")])


def free_room(output: str | None) -> int | None:
    """What is free where an output goes [bytes]; None unless it goes to a file, as stdout may."""
    from shutil import disk_usage

    # what can't be told here is told when the output is to be written
    with contextlib.suppress(OSError, ValueError, AttributeError, TypeError):
        if output is None or output == STDOUT:
            stdout = sys.stdout.fileno()
            return disk_usage(stdout).free if stat.S_ISREG(os.fstat(stdout).st_mode) else None
        if not is_stream(output):
            return disk_usage(os.path.dirname(output) or os.curdir).free  # noqa: PTH120
    return None
