"""Formats of the output of a sweep: how its pieces look, and how they become one file."""

from __future__ import annotations

from os.path import splitext
from typing import Literal

Format = Literal["csv", "jsonl", "npz", "parquet"]

SUFFIXES: dict[str, Format] = {
    ".csv": "csv",
    ".jsonl": "jsonl",
    ".ndjson": "jsonl",
    ".npz": "npz",
    ".parquet": "parquet",
}
TEXTS: tuple[Format, ...] = ("csv", "jsonl")
"""Formats whose pieces are text; those of the others are columns of numbers."""


def format_of_name(file: str) -> Format | None:
    """The format that the suffix of a file's name tells, if it does.

    >>> format_of_name("out.NDJSON"), format_of_name("out.txt")
    ('jsonl', None)
    """
    return SUFFIXES.get(splitext(file)[1].lower())  # noqa: PTH122 (pathlib costs start-up time)
