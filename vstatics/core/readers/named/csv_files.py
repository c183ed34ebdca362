"""Files of numbers that a document names. The caller controls which files may be read."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from vstatics.core.jobs.input_files import read_file
from vstatics.core.readers.named.csv_rows import numbered_rows
from vstatics.core.readers.named.headings import without_titles
from vstatics.core.readers.named.nodes import encoding_of
from vstatics.core.readers.signs import with_plain_blanks

_RECORDED: ContextVar[set[str] | None] = ContextVar("noted files", default=None)
_ALLOWED: ContextVar[bool] = ContextVar("files are read", default=True)


@contextmanager
def noted_files() -> Iterator[set[str]]:
    """Collect the names of the files that the block reads or tries to read.

    >>> with noted_files() as noted:
    ...     try:
    ...         csv_rows(Path("nowhere.csv"), 100, bool)
    ...     except OSError:
    ...         noted
    {'nowhere.csv'}
    """
    noted: set[str] = set()
    token = _RECORDED.set(noted)
    try:
        yield noted
    finally:
        _RECORDED.reset(token)


@contextmanager
def no_files() -> Iterator[None]:
    """Refuse to read files that documents name within the block, because they may be untrusted.

    >>> with no_files():
    ...     csv_rows(Path("/etc/passwd"), 100, bool)
    Traceback (most recent call last):
    ValueError: expected the points themselves: a text has no folder; ...
    """
    token = _ALLOWED.set(False)
    try:
        yield
    finally:
        _ALLOWED.reset(token)


def are_read() -> bool:
    """Return whether files named in a document may be read."""
    return _ALLOWED.get()


def csv_rows(
    file: Path, most: int, is_heading: Callable[[str], bool]
) -> list[tuple[int, list[str]]]:
    """Return the headings and the rows below them of a file, each with a line number.

    Parameters
    ----------
    file : Path
    most : int
        Largest size of the file, in bytes.
    is_heading : callable
        Function that recognises a heading in a cell. Lines above the headings are titles.

    Raises
    ------
    OSError
        If the file cannot be read, or is larger.
    ValueError
        If the content is wrong; the message states the expected content.
    """
    if not are_read():
        hint = "`loads` reads files from the folder of `name`, if it has a folder"
        raise ValueError(f"expected the points themselves: a text has no folder; {hint}")
    noted = _RECORDED.get()
    if noted is not None:
        noted.add(str(file))
    data = read_file(file, most, regular=True)
    try:
        text = data.decode(encoding_of(data))
    except UnicodeDecodeError:
        raise ValueError("expected text in UTF-8") from None
    return list(
        numbered_rows(without_titles(io.StringIO(with_plain_blanks(text)).readlines(), is_heading))
    )
