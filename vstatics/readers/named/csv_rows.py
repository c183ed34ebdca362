"""Rows of CSV files beside a case or a scenario, bounded."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

_NOTED: ContextVar[set[str] | None] = ContextVar("noted files", default=None)


@contextmanager
def noted_files() -> Iterator[set[str]]:
    """Note which files are read in this block, or would be if they were there.

    >>> with noted_files() as noted:
    ...     try:
    ...         csv_rows(Path("nowhere.csv"), 100)
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


def csv_rows(file: Path, most: int) -> list[tuple[int, list[str]]]:
    """Lines that are not empty, each with its number.

    Parameters
    ----------
    file : Path
    most : int
        Of its bytes.

    Raises
    ------
    OSError
    ValueError
        With what was expected.
    """
    noted = _NOTED.get()
    if noted is not None:
        noted.add(str(file))
    with file.open("rb") as opened:
        data = opened.read(most + 1)
    if len(data) > most:
        raise ValueError(f"expected a file of {most // 1000} kB at most")
    return list(numbered_rows(io.StringIO(data.decode("utf-8-sig"))))


def numbered_rows(lines: Iterable[str]) -> Iterator[tuple[int, list[str]]]:
    """Rows that are not empty, each with the number of its last line.

    Raises
    ------
    ValueError
        With what was expected.
    """
    rows = csv.reader(lines)
    try:
        for row in rows:
            if row:
                yield rows.line_num, row
    except csv.Error as error:
        raise ValueError(f"expected CSV: {error}") from None
