"""Files of numbers that a document names: which are read, and whether any is."""

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

_NOTED: ContextVar[set[str] | None] = ContextVar("noted files", default=None)
_ARE_READ: ContextVar[bool] = ContextVar("files are read", default=True)


@contextmanager
def noted_files() -> Iterator[set[str]]:
    """Note which files are read in this block, or would be if they were there.

    >>> with noted_files() as noted:
    ...     try:
    ...         csv_rows(Path("nowhere.csv"), 100, bool)
    ...     except OSError:
    ...         noted
    {'nowhere.csv'}
    """
    noted: set[str] = set()
    token = _NOTED.set(noted)
    try:
        yield noted
    finally:
        _NOTED.reset(token)


@contextmanager
def no_files() -> Iterator[None]:
    """Refuse in this block whatever file is named in a text, as it may be that of a stranger.

    >>> with no_files():
    ...     csv_rows(Path("/etc/passwd"), 100, bool)
    Traceback (most recent call last):
    ValueError: expected the points themselves: a text has no folder; ...
    """
    token = _ARE_READ.set(False)
    try:
        yield
    finally:
        _ARE_READ.reset(token)


def are_read() -> bool:
    """Whether files that a text names are read."""
    return _ARE_READ.get()


def csv_rows(
    file: Path, most: int, is_heading: Callable[[str], bool]
) -> list[tuple[int, list[str]]]:
    """Lines from the headings on that are not empty, each with its number.

    Parameters
    ----------
    file : Path
    most : int
        Of its bytes.
    is_heading : callable
        Whether a cell is a heading; lines above the first are titles.

    Raises
    ------
    OSError
    ValueError
        With what was expected.
    """
    if not are_read():
        hint = "`loads` reads files beside its `name`, if that has a folder"
        raise ValueError(f"expected the points themselves: a text has no folder; {hint}")
    noted = _NOTED.get()
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
