"""What goes in and out of the program: files, standard streams, messages."""

from __future__ import annotations

import contextlib
import itertools
import os
import shlex
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.core.errors import CaseError, Problem, ReadError, excerpt, of_file, printable
from vstatics.core.jobs.files import (
    STDIN_NAME,
    STDOUT,
    Write,
    is_stream,
    opened,
    replacing,
    unwritable,
)
from vstatics.core.jobs.input_files import DOCUMENT_BYTES, read_file, read_stream, unreadable
from vstatics.core.suggestions import nearest

if TYPE_CHECKING:
    from vstatics.core.jobs.state_files import StateFolder

STDIN = "-"
MOST_SHOWN_PROBLEMS = 100
"""So many problems of a case are printed."""
MOST_SEARCHED = 1000
"""So many files of a folder are looked at for one that may be meant."""
ALIKE, SHORT = 0.75, 0.66
"""So near the name of one that may be meant is, from 0 to 1; of three letters one may differ."""
CLOSED = "it is closed"


def read_input(
    file: str, most: int = DOCUMENT_BYTES, *, regular: bool = False
) -> tuple[bytes, str]:
    """Return the bytes of a file or of standard input, and its name for messages.

    Parameters
    ----------
    file : str
    most : int
        Bound of its size. [bytes]
    regular : bool
        Whether it must be a regular file, as another file names it.

    Raises
    ------
    ReadError
        If it cannot be read, or is larger.
    """
    name = STDIN_NAME if file == STDIN else file
    try:
        if file != STDIN:
            return read_file(file, most, regular=regular), name
        if sys.stdin is not None:
            return read_stream(sys.stdin.buffer, most), name
        reason = CLOSED
    except FileNotFoundError as error:
        reason = f"{error.strerror}{_nearest_file(file)}{_shipped(file)}"
    except IsADirectoryError as error:
        pattern = os.path.join(file, "**", "*.yaml")  # noqa: PTH118
        reason = f"{error.strerror}; expected a file, or of several a pattern, '{pattern}'"
    except OSError as error:
        raise ReadError([unreadable(name, error)]) from None
    except ValueError as error:  # a name that holds a zero byte
        reason = str(error)
    raise ReadError([of_file("E006", name, f"can't be read: {reason}")])


@contextlib.contextmanager
def problems_of_file(file: str, hint: str = "") -> Iterator[None]:
    """Tell problems as those of a file as a whole, with a hint behind each.

    Raises
    ------
    ReadError
    """
    try:
        yield
    except CaseError as error:
        raise ReadError(
            of_file(one.id, file, one.message + hint) for one in error.problems
        ) from None


def _nearest_file(file: str) -> str:
    """A hint that names the file of its folder that is nearest to one that is not there.

    Suffixes make names alike that are not, so those are near whose stems are.
    """
    from difflib import get_close_matches  # costs start-up time

    folder, name = os.path.split(file)
    try:
        with os.scandir(folder or os.curdir) as entries:
            some = itertools.islice(entries, MOST_SEARCHED)
            stems = {one.name: _stem(one.name) for one in some if one.is_file()}
        if os.path.islink(file):  # noqa: PTH114
            return f"; it is a link to {os.readlink(file)}, which is not there"  # noqa: PTH115
    except OSError:
        return ""
    asked = _stem(name)
    cutoff = ALIKE if len(asked) > 3 else SHORT
    near = get_close_matches(asked, {*stems.values()}, n=10, cutoff=cutoff)
    return nearest(name, [one for one, stem in stems.items() if stem in near])


def _stem(name: str) -> str:
    return os.path.splitext(name)[0].casefold()  # noqa: PTH122


def _shipped(file: str) -> str:
    """How one gets a file that comes with the program, if this is the name of one.

    >>> _shipped("../tarasik-box.yaml"), _shipped("mine.yaml")
    ('; `vstatics new ../tarasik-box.yaml -t tarasik-box` writes the shipped case', '')
    """
    from vstatics.core.examples import example_files

    path, suffix = os.path.splitext(file)  # noqa: PTH122
    path = path.replace(os.sep, "/").removeprefix("cases/")
    names = [path] + [os.path.basename(path)] * (suffix == ".yaml")  # noqa: PTH119
    name = next((one for one in names if one in example_files()), None)
    if name is None:
        return ""
    return f"; `vstatics new {shlex.quote(file)} -t {name}` writes the shipped case"


def show(problems: Iterable[Problem]) -> None:
    """Print problems to stderr, in the wording of a compiler, with the line and a caret."""
    all_of_them = list(problems)
    for problem in all_of_them[:MOST_SHOWN_PROBLEMS]:
        say(str(problem))
        place = problem.place
        if place is not None and place.text.strip():
            for line in excerpt(place):
                say(f"  {line}")
    if len(all_of_them) > MOST_SHOWN_PROBLEMS:
        say(f"... and {len(all_of_them) - MOST_SHOWN_PROBLEMS} more")


def say(line: str) -> None:
    """Print a line to stderr, made safe; results do not suffer where that is not possible."""
    with contextlib.suppress(OSError):
        _speakers[-1](printable(line))


_speakers: list[Callable[[str], None]] = [partial(click.echo, err=True)]
"""The last one prints: a bar on the terminal puts itself here, so that lines go above it."""


@contextlib.contextmanager
def speaking(speaker: Callable[[str], None]) -> Iterator[None]:
    """Let `speaker` print the lines for `say`, for a while."""
    _speakers.append(speaker)
    try:
        yield
    finally:
        _speakers.remove(speaker)


def spare(inputs: Iterable[str], output: str | None) -> None:
    """Refuse an output that would write over what the command reads.

    Raises
    ------
    UsageError
    """
    if output is None or is_stream(output):
        return
    for one in inputs:
        with contextlib.suppress(OSError, ValueError, AttributeError):  # one of them is no file
            read = sys.stdin.fileno() if one == STDIN else one
            if os.path.samestat(os.stat(read), os.stat(output)):  # noqa: PTH116
                message = f"{output} is what is read, and would be overwritten"
                raise click.UsageError(f"{message}; expected another output")


def refuse_existing(output: str) -> None:
    """Refuse to write a case over a file, which may have been edited; streams are none.

    Raises
    ------
    ReadError
    """
    if not is_stream(output) and os.path.lexists(output):
        message = "is there already; expected the name of a new file"
        raise ReadError([of_file("E016", output, message)])


def write_output(text: str, output: str | None) -> None:
    """Write to a file, whole or not at all, or to stdout; always in UTF-8.

    Raises
    ------
    ReadError
        If it cannot be written.
    """
    write_data(encoded(text), output)


def write_data(data: bytes, output: str | None) -> None:
    """Write what is no text, or is encoded already; as `write_output`."""
    with stream(output) as write:
        write(data)


def write_pages(pages: Sequence[bytes], output: str | None) -> None:
    """Write the pages of a picture, each to its file, all or none; to a stream there is one.

    Raises
    ------
    ReadError
        If one cannot be written, or would overwrite a file of others.
    """
    if output is None or is_stream(output):
        [data] = pages
        write_data(data, output)
        return
    from vstatics.core.jobs.page_files import replace_pages  # costs start-up time

    try:
        replace_pages(output, pages)
    except OSError as error:
        raise ReadError([unwritable(output, error)]) from None


def write_coloured(text: str) -> None:
    """Write to stdout what `SafeConsole` has made: it has escaped all but its own colours.

    Raises
    ------
    ReadError
        If it cannot be written.
    """
    with stream(None, coloured=True) as write:
        write(text.encode(errors="backslashreplace"))


@contextlib.contextmanager
def stream(
    output: str | None, *, coloured: bool = False, folder: StateFolder | None = None
) -> Iterator[Write]:
    """Write bit by bit: to stdout or a device at once, to a file that is there at the end.

    Until then the file is in a folder; in its own, if none is given.

    Raises
    ------
    ReadError
        If it cannot be written.
    """
    try:
        if output is None or output == STDOUT:
            yield partial(_print, coloured=coloured)
        else:
            if is_stream(output):
                way = opened(output)
            else:
                way = replacing(output) if folder is None else folder.replacing_output(output)
            with way as write:
                yield write
    except BrokenPipeError:
        raise  # the reader has seen enough; click ends quietly
    except OSError as error:
        raise ReadError([unwritable(output, error)]) from None


def encoded(text: str, *, as_is: bool = False) -> bytes:
    r"""A text in UTF-8, safe to print; or as it is, but for half characters in names of files.

    >>> encoded("\x1b[2J"), encoded("\x1b[2J", as_is=True)
    (b'\\u001b[2J', b'\x1b[2J')
    """
    return text.encode(errors="backslashreplace") if as_is else printable(text, lines=True).encode()


def read_names(file: str) -> list[str]:
    r"""The names in a list of files: one a line, or ended by NUL as `find -print0` does.

    Lines are taken without blanks around them; what is empty or begins with # names nothing.

    Raises
    ------
    ReadError
        If the list cannot be read.
    """
    data, name = read_input(file)
    data = data.removeprefix(b"\xef\xbb\xbf")
    if b"\0" in data:
        named = data.split(b"\0")
    else:
        named = [line.strip() for line in data.split(b"\n") if not line.lstrip().startswith(b"#")]
    names = [os.fsdecode(one) for one in named if one]
    if not names:
        say(f"{name}: names no file")
    return names


def _print(data: bytes | memoryview, *, coloured: bool) -> None:
    """Write to stdout at once; data that are written as they are become safe at a terminal."""
    if sys.stdout is None:
        raise OSError(CLOSED)
    if sys.stdout.isatty() and not coloured:
        data = encoded(bytes(data).decode(errors="backslashreplace"))
    click.echo(bytes(data), nl=False)
    sys.stdout.flush()
