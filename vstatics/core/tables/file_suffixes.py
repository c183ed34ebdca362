"""Formats of output files and their suffixes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from os.path import splitext
from typing import TypeVar

Form = TypeVar("Form", bound=str)

SUFFIXES = {
    "listing": (".lst", ".txt", ".out"),
    "source": (".lst", ".txt", ".out"),
    "text": (".txt", ".lst", ".out"),
    "json": (".json",),
    "csv": (".csv",),
    "jsonl": (".jsonl", ".ndjson"),
    "github": (".txt",),
    "sarif": (".sarif", ".json"),
    "junit": (".xml",),
    "npz": (".npz",),
    "parquet": (".parquet",),
    "markdown": (".md",),
    "latex": (".tex",),
    "xlsx": (".xlsx",),
    "html": (".html", ".htm"),
    "svg": (".svg",),
    "png": (".png",),
    "pdf": (".pdf",),
}
"""Suffixes of each format; a result written to a directory has the first."""


def suffix_of(file: str) -> str:
    """Return the suffix of a file name, in lower case."""
    return splitext(file)[1].lower()  # noqa: PTH122 - pathlib costs start-up time


def format_of(file: str, formats: Iterable[Form]) -> Form | None:
    """Find the format, among some, of a file name's suffix.

    >>> format_of("a.NDJSON", ["json", "jsonl"]), format_of("a", ["text"])
    ('jsonl', None)
    """
    suffix = suffix_of(file)
    return next((form for form in formats if suffix in SUFFIXES[form]), None)


def known(formats: Sequence[str]) -> list[str]:
    """List the suffixes of some formats.

    >>> known(["listing", "csv"])
    ['.lst', '.txt', '.out', '.csv']
    """
    return list(dict.fromkeys(suffix for form in formats for suffix in SUFFIXES[form]))


def mismatch(form: str | None, file: str) -> str:
    """Return the message about a format that contradicts the suffix, or an empty text.

    >>> mismatch("csv", "a.json"), mismatch("csv", "a.csv"), mismatch("csv", "a")
    ('csv is not the format of a.json: expected .csv', '', '')
    """
    if not form or suffix_of(file) in ("", *SUFFIXES[form]):
        return ""
    return f"{form} is not the format of {file}: expected {' or '.join(SUFFIXES[form])}"
