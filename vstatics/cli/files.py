"""What goes in and out of the program: files, standard streams, messages."""

from __future__ import annotations

import contextlib
import os
import stat
import sys
from collections.abc import Iterable

import click

from vstatics.errors import Place, Problem, ReadError

STDIN = "-"
STDIN_NAME = "<stdin>"
TOLD = 100
"""So many problems of a case are printed."""
CLOSED = "it is closed"


def read_input(file: str) -> tuple[bytes, str]:
    """The bytes of a file or of standard input, and the name to speak of it.

    Raises
    ------
    ReadError
        If it cannot be read.
    """
    name = STDIN_NAME if file == STDIN else file
    try:
        if file != STDIN:
            with open(file, "rb") as opened:  # noqa: PTH123
                return opened.read(), name
        if sys.stdin is not None:
            return sys.stdin.buffer.read(), name
        reason = CLOSED
    except OSError as error:
        reason = error.strerror or str(error)
    message = f"can't be read: {reason}"
    raise ReadError([Problem(message, place=Place(name, 0, 0))])


def show(problems: Iterable[Problem]) -> None:
    """Print problems to stderr, in the wording of a compiler, with the line and a caret."""
    told = list(problems)
    for problem in told[:TOLD]:
        say(str(problem))
        place = problem.place
        if place is not None and place.text.strip():
            shown, caret = _around(place)
            say(f"  {shown}\n  {caret}")
    if len(told) > TOLD:
        say(f"... and {len(told) - TOLD} more")


def say(line: str) -> None:
    """Print a line to stderr; the results do not suffer where that is not possible."""
    with contextlib.suppress(OSError):
        click.echo(line, err=True)


def _around(place: Place, width: int = 76) -> tuple[str, str]:
    """The part of a line around a place that fits on a terminal, and a caret below it."""
    column = min(place.column, len(place.text) + 1)
    start = max(0, column - width // 2) if len(place.text) > width else 0
    part = place.text[start : start + width]
    shown = "".join(letter if letter.isprintable() else " " for letter in part)
    return shown, " " * (column - 1 - start) + "^"


def write_output(text: str, output: str | None) -> None:
    """Write to a file, whole or not at all, or to stdout; always in UTF-8.

    Raises
    ------
    ReadError
        If it cannot be written.
    """
    data = text.encode(errors="backslashreplace")  # names of files may hold half characters
    name = "<stdout>" if output is None or output == STDIN else output
    try:
        if name != output:
            _print(data)
        elif output.startswith("/dev/"):  # /dev/stdout is not to be replaced, whatever it is
            with open(output, "ab") as opened:  # noqa: PTH123
                opened.write(data)
        else:
            _replace(os.path.realpath(output), data)
    except BrokenPipeError:
        raise  # the reader has seen enough; click ends quietly
    except OSError as error:
        message = f"can't be written: {error.strerror or error}"
        raise ReadError([Problem(message, place=Place(name, 0, 0))]) from None


def _print(data: bytes) -> None:
    if sys.stdout is None:
        raise OSError(CLOSED)
    click.echo(data, nl=False)
    sys.stdout.flush()


def _replace(path: str, data: bytes) -> None:
    """Write beside the file and move it into place; devices and pipes are written directly."""
    try:
        mode = os.stat(path).st_mode  # noqa: PTH116
    except FileNotFoundError:
        mode = None
    if mode is not None and not stat.S_ISREG(mode):
        with open(path, "wb") as opened:  # noqa: PTH123
            opened.write(data)
        return
    import tempfile  # costs start-up time

    handle, temporary = tempfile.mkstemp(prefix=".vstatics-", dir=os.path.dirname(path))  # noqa: PTH120
    try:
        with os.fdopen(handle, "wb") as opened:
            opened.write(data)
        os.chmod(temporary, stat.S_IMODE(mode) if mode else 0o666 & ~_umask())  # noqa: PTH101
        os.replace(temporary, path)  # noqa: PTH105
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)  # noqa: PTH108
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
