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


def read_input(file: str) -> tuple[bytes, str]:
    """The bytes of a file or of standard input, and the name to speak of it.

    Raises
    ------
    ReadError
        If it cannot be read.
    """
    if file == STDIN:
        return sys.stdin.buffer.read(), STDIN_NAME
    try:
        with open(file, "rb") as opened:  # noqa: PTH123
            return opened.read(), file
    except OSError as error:
        message = f"can't be read: {error.strerror or error}; expected a file with a case"
        raise ReadError([Problem(message, place=Place(file, 0, 0))]) from None


def show(problems: Iterable[Problem]) -> None:
    """Print problems to stderr, in the wording of a compiler, with the line and a caret."""
    for problem in problems:
        click.echo(str(problem), err=True)
        place = problem.place
        if place is not None and place.text.strip():
            shown, caret = _around(place)
            click.echo(f"  {shown}\n  {caret}", err=True)


def _around(place: Place, width: int = 76) -> tuple[str, str]:
    """The part of a line around a place that fits on a terminal, and a caret below it."""
    text = "".join(letter if letter.isprintable() else " " for letter in place.text)
    column = min(place.column, len(text) + 1)
    start = max(0, column - width // 2) if len(text) > width else 0
    return text[start : start + width], " " * (column - 1 - start) + "^"


def write_output(text: str, output: str | None) -> None:
    """Write to a file, whole or not at all, or to stdout; always in UTF-8."""
    data = text.encode()
    try:
        if output is None or output == STDIN:
            click.echo(data, nl=False)
        else:
            _replace(os.path.realpath(output), data)
    except BrokenPipeError:
        raise  # the reader has seen enough; click ends quietly
    except OSError as error:
        message = f"can't be written: {error.strerror or error}"
        problem = Problem(message, place=Place(output or "<stdout>", 0, 0))
        raise ReadError([problem]) from None


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

    folder, name = os.path.split(path)
    handle, temporary = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
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
