"""Formats of the output of a sweep: how its pieces look, and how they become one file."""

from __future__ import annotations

from os.path import splitext
from typing import Literal

Format = Literal["csv", "jsonl", "npz", "parquet", "markdown", "latex", "xlsx"]

SUFFIXES: dict[str, Format] = {
    ".csv": "csv",
    ".jsonl": "jsonl",
    ".ndjson": "jsonl",
    ".npz": "npz",
    ".parquet": "parquet",
    ".md": "markdown",
    ".tex": "latex",
    ".xlsx": "xlsx",
}
TEXTS: tuple[Format, ...] = ("csv", "jsonl")
"""Formats whose pieces are text; those of the others are columns of numbers."""
MOST_ROWS: dict[Format, int] = {"markdown": 10_000, "latex": 10_000, "xlsx": 100_000}
"""Of the formats that people read, which are made in memory."""


def format_of_name(file: str) -> Format | None:
    """The format that the suffix of a file's name tells, if it does.

    >>> format_of_name("out.NDJSON"), format_of_name("out.txt")
    ('jsonl', None)
    """
    return SUFFIXES.get(splitext(file)[1].lower())  # noqa: PTH122 (pathlib costs start-up time)
