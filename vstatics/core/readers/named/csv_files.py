"""Files of numbers that a document names. The caller controls which files may be read."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from vstatics.core.jobs.input_files import read_file
from vstatics.core.readers.named.nodes import text_of
from vstatics.core.readers.signs import with_plain_blanks

_RECORDED: ContextVar[set[str] | None] = ContextVar("noted files", default=None)
_ALLOWED: ContextVar[bool] = ContextVar("files are read", default=True)


@contextmanager
def noted_files() -> Iterator[set[str]]:
    """Collect the names of the files that the block reads or tries to read.

    >>> with noted_files() as noted:
    ...     try:
    ...         lines_of(Path("nowhere.csv"), 100)
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
    """Within the block, refuse to read files that documents name, because these can be untrusted.

    >>> with no_files():
    ...     lines_of(Path("/etc/passwd"), 100)
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


def lines_of(file: Path, most: int) -> list[str]:
    """Return the lines of a file of at most `most` bytes, with plain blanks.

    Raises
    ------
    OSError
        If the file cannot be read, or is larger.
    ValueError
        If files must not be read (`are_read`), or the file is not a text.
    """
    if not are_read():
        hint = "`loads` reads files from the folder of `name`, if it has a folder"
        raise ValueError(f"expected the points themselves: a text has no folder; {hint}")
    noted = _RECORDED.get()
    if noted is not None:
        noted.add(str(file))
    data = read_file(file, most, regular=True)
    try:
        text = text_of(data)
    except UnicodeDecodeError:
        raise ValueError("expected text in UTF-8") from None
    return io.StringIO(with_plain_blanks(text)).readlines()
