"""What the command needs before anything else is imported: the package imports this first.

Ctrl-C ends the program without a trace: Python would raise `KeyboardInterrupt` in the middle
of an import, where nobody catches it yet. Garbage is collected less often: an import makes
much and leaves none. Where the package is a library nothing is done.
"""

from __future__ import annotations

import _signal  # type: ignore[import-not-found] # without the enums of `signal`: at once
import gc
import os
import sys

PROGRAM = "vstatics"
NEW_OBJECTS = 100_000
"""After so many Python looks for garbage; after 700, as by default, that is a tenth of a start."""


def is_command(argument: str, command_line: list[str]) -> bool:
    """Whether this process is the command, by ``sys.argv[0]`` and ``sys.orig_argv``.

    >>> is_command("/usr/bin/vstatics", []), is_command("script.py", ["python", "script.py"])
    (True, False)
    >>> is_command("-m", ["python", "-m", "vstatics", "run"])
    True
    """
    if argument == "-m":  # while Python looks for the module
        return PROGRAM in command_line[command_line.index("-m") + 1 :][:1]
    return os.path.splitext(os.path.basename(argument))[0] == PROGRAM  # noqa: PTH119, PTH122


def end_without_a_trace() -> None:
    """Let Ctrl-C end the process at once, with the status that shells give it."""
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
        _signal.signal(_signal.SIGINT, lambda number, _: os._exit(128 + number))


if is_command(sys.argv[0] if sys.argv else "", sys.orig_argv):
    end_without_a_trace()
    gc.set_threshold(NEW_OBJECTS)
