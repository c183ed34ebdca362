"""Input and output of the program: files, standard streams, messages."""

from __future__ import annotations

import contextlib
import itertools
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.core.errors import (
    CaseError,
    Problem,
    ReadError,
    excerpt,
    of_file,
    printable,
    spoken,
)
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
from vstatics.core.readers import format_of_name
from vstatics.core.suggestions import nearest

if TYPE_CHECKING:
    from vstatics.core.jobs.state_files import StateFolder

STDIN = "-"
MOST_SHOWN_PROBLEMS = 100
"""Largest number of problems of a case that are printed."""
MOST_SEARCHED = 1000
"""Largest number of files in a folder that are searched for a similar name."""
ALIKE, SHORT = 0.75, 0.66
"""Smallest similarity (0 to 1) of a name to be suggested, and its value for short names."""
CLOSED = "it is closed"


def file_name(file: str) -> str:
    """Return the name of an input file for messages."""
    return STDIN_NAME if file == STDIN else file


def read_input(
    file: str, most: int = DOCUMENT_BYTES, *, regular: bool = False
) -> tuple[bytes, str]:
    """Return the bytes of a file or of standard input, and the name of the file for messages.

    Parameters
    ----------
    file : str
    most : int
        Largest permitted size. [bytes]
    regular : bool
        True to refuse pipes and devices, because another file names the input.

    Raises
    ------
    ReadError
        If the file cannot be read, or is larger.
    """
    name = file_name(file)
    try:
        if file != STDIN:
            return read_file(file, most, regular=regular), name
        if sys.stdin is not None:
            return read_stream(sys.stdin.buffer, most), name
        reason = CLOSED
    except FileNotFoundError as error:
        reason = f"{error.strerror}{_nearest_file(file)}{_shipped(file)}"
    except IsADirectoryError as error:
        reason = f"{error.strerror}; expected a file, or for several files '{_pattern(file)}'"
    except OSError as error:
        raise ReadError([unreadable(name, error)]) from None
    except ValueError as error:  # the name contains a zero byte
        reason = str(error)
    raise ReadError([of_file("E006", name, f"cannot be read: {reason}")])


@contextlib.contextmanager
def problems_of_file(file: str, hint: str = "") -> Iterator[None]:
    """Run the block; raise its problems again with a hint, and with the whole file as place.

    Raises
    ------
    ReadError
    """
    try:
        yield
    except CaseError as error:
        raise ReadError(
            of_file(problem.id, file, problem.message + hint) for problem in error.problems
        ) from None


def _pattern(folder: str) -> str:
    """Return the pattern of the cases in a folder that have the most frequent suffix."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        names = [entry.name for entry in itertools.islice(entries, MOST_SEARCHED)]
        suffixes = Counter(os.path.splitext(name)[1] for name in names if format_of_name(name))  # noqa: PTH122
        for suffix, _ in suffixes.most_common(1):
            return os.path.join(folder, "**", f"*{suffix}")  # noqa: PTH118
    return os.path.join(folder, "**", "*.yaml")  # noqa: PTH118


def _nearest_file(file: str) -> str:
    """Return a hint with the most similar file in the folder.

    Names are compared without suffix, because equal suffixes make different names similar.
    """
    from difflib import get_close_matches  # costs start-up time

    folder, name = os.path.split(file)
    try:
        with os.scandir(folder or os.curdir) as entries:
            first_entries = itertools.islice(entries, MOST_SEARCHED)
            stems = {entry.name: _stem(entry.name) for entry in first_entries if entry.is_file()}
        if os.path.islink(file):  # noqa: PTH114
            return f"; it is a link to {os.readlink(file)}, which does not exist"  # noqa: PTH115
    except OSError:
        return ""
    asked = _stem(name)
    cutoff = ALIKE if len(asked) > 3 else SHORT
    near = get_close_matches(asked, {*stems.values()}, n=10, cutoff=cutoff)
    return nearest(name, [file_name for file_name, stem in stems.items() if stem in near])


def _stem(name: str) -> str:
    return os.path.splitext(name)[0].casefold()  # noqa: PTH122


def _shipped(file: str) -> str:
    """Return a hint with the command that writes a shipped case, if the file has its name.

    >>> _shipped("../tarasik-box.yaml"), _shipped("mine.yaml")
    ('; `vstatics new ../tarasik-box.yaml -t tarasik-box` writes the shipped case', '')
    >>> _shipped("umdm.dat")
    '; `vstatics new umdm.yaml -t umdm` writes the shipped case'
    """
    from vstatics.core.examples import example_files

    path, suffix = os.path.splitext(file)  # noqa: PTH122
    path = path.replace(os.sep, "/").removeprefix("cases/")
    names = [path] + [os.path.basename(path)] * (suffix == ".yaml")  # noqa: PTH119
    name = next((candidate for candidate in names if candidate in example_files()), None)
    if name is None:
        return ""
    import shlex  # costs start-up time

    shipped = os.path.splitext(example_files()[name].path)[0]  # noqa: PTH122
    if not os.path.exists(f"{shipped}{suffix}"):  # noqa: PTH110
        file = f"{os.path.splitext(file)[0]}.yaml"  # noqa: PTH122
    return f"; `vstatics new {shlex.quote(file)} -t {name}` writes the shipped case"


def show(problems: Iterable[Problem]) -> None:
    """Print problems to stderr like a compiler, with the faulty line and a caret."""
    all_problems = list(problems)
    for problem in all_problems[:MOST_SHOWN_PROBLEMS]:
        say(str(problem))
        place = problem.place
        if place is not None and place.text.strip():
            for line in excerpt(place):
                say(f"  {line}")
    if len(all_problems) > MOST_SHOWN_PROBLEMS:
        say(f"... and {len(all_problems) - MOST_SHOWN_PROBLEMS} more")


def say(line: str) -> None:
    """Print a line to stderr, with control characters escaped. A closed stderr is ignored."""
    with contextlib.suppress(OSError):
        _speakers[-1](printable(line))


_speakers: list[Callable[[str], None]] = [partial(click.echo, err=True)]
"""Stack of functions that print a line. The last function is used."""


@contextlib.contextmanager
def speaking(speaker: Callable[[str], None]) -> Iterator[None]:
    """Run the block, in which `say` calls `speaker` to print a line."""
    _speakers.append(speaker)
    try:
        yield
    finally:
        _speakers.remove(speaker)


def spare(inputs: Iterable[str], output: str | None) -> None:
    """Raise an error if the output would overwrite an input.

    Raises
    ------
    UsageError
    """
    if output is None or is_stream(output):
        return
    for file in inputs:
        with contextlib.suppress(OSError, ValueError, AttributeError):  # some inputs are not files
            read = sys.stdin.fileno() if file == STDIN else file
            if os.path.samestat(os.stat(read), os.stat(output)):  # noqa: PTH116
                message = f"{output} is what is read, and would be overwritten"
                raise click.UsageError(f"{message}; expected another output")


def refuse_existing(output: str) -> None:
    """Raise an error if the output is an existing file, which can contain edits of the user.

    Raises
    ------
    ReadError
    """
    if not is_stream(output) and os.path.lexists(output):
        message = "already exists, expected the name of a new file"
        raise ReadError([of_file("E016", output, message)])


def write_output(text: str, output: str | None) -> None:
    """Write a text in UTF-8 to a file, completely or not at all, or to stdout.

    Raises
    ------
    ReadError
        If the output cannot be written.
    """
    write_data(encoded(text), output)


def write_data(data: bytes, output: str | None) -> None:
    """Write bytes to a file, completely or not at all, or to stdout."""
    with stream(output) as write:
        write(data)


def write_pages(pages: Sequence[bytes], output: str | None, *, quiet: bool = False) -> None:
    """Write each page of a picture to a file, or a single page to a stream.

    The names of the files after the first are printed unless `quiet` is True.

    Raises
    ------
    ReadError
        If a page cannot be written, or would overwrite a file that is not a page of a picture.
    """
    if output is None or is_stream(output):
        [data] = pages
        write_data(data, output)
        return
    from vstatics.core.jobs.page_files import page_name, replace_pages  # costs start-up time

    try:
        replace_pages(output, pages)
    except OSError as error:
        raise ReadError([unwritable(output, error)]) from None
    if len(pages) > 1 and not quiet:
        further = (page_name(output, number) for number in range(2, len(pages) + 1))
        say(f"{output} continues in {spoken(further)}")


def write_coloured(text: str) -> None:
    """Write a text from `SafeConsole`, which is already escaped, to stdout.

    Raises
    ------
    ReadError
        If stdout cannot be written to.
    """
    with stream(None, coloured=True) as write:
        write(text.encode(errors="backslashreplace"))


@contextlib.contextmanager
def stream(
    output: str | None, *, coloured: bool = False, folder: StateFolder | None = None
) -> Iterator[Write]:
    """Yield a function that writes data in pieces to stdout, a device or a file.

    A file gets its name at the end of the block. Until then its content is in a temporary file, in
    `folder` or in the folder of the output.

    Raises
    ------
    ReadError
        If the output cannot be written.
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
        raise  # the pipe is closed, after which click ends quietly
    except OSError as error:
        raise ReadError([unwritable(output, error)]) from None


def encoded(text: str, *, as_is: bool = False) -> bytes:
    r"""Return a text in UTF-8, with control characters escaped unless `as_is` is True.

    >>> encoded("\x1b[2J"), encoded("\x1b[2J", as_is=True)
    (b'\\u001b[2J', b'\x1b[2J')
    """
    return text.encode(errors="backslashreplace") if as_is else printable(text, lines=True).encode()


def read_names(file: str) -> list[str]:
    r"""Return the names in a list of files, which are on separate lines or end with NUL.

    Blanks around a line are removed. Empty lines and lines that begin with # are ignored.

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
    names = [os.fsdecode(name_bytes) for name_bytes in named if name_bytes]
    if not names:
        say(f"{name}: names no file")
    return names


def _print(data: bytes | memoryview, *, coloured: bool) -> None:
    """Write to stdout without a buffer. Data for a terminal are escaped unless `coloured`."""
    if sys.stdout is None:
        raise OSError(CLOSED)
    if sys.stdout.isatty() and not coloured:
        data = encoded(bytes(data).decode(errors="backslashreplace"))
    click.echo(bytes(data), nl=False)
    sys.stdout.flush()
