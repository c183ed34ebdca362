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
"""Suffixes of each format. Results in a directory have the first suffix."""


def suffix_of(file: str) -> str:
    """Return the suffix of a file name, in lower case."""
    return splitext(file)[1].lower()  # noqa: PTH122 - pathlib costs start-up time


def format_of(file: str, formats: Iterable[Form]) -> Form | None:
    """Return the format among `formats` that the suffix of a file name belongs to, or None.

    >>> format_of("a.NDJSON", ["json", "jsonl"]), format_of("a", ["text"])
    ('jsonl', None)
    """
    suffix = suffix_of(file)
    return next((form for form in formats if suffix in SUFFIXES.get(form, ())), None)


def known(formats: Sequence[str]) -> list[str]:
    """Return the suffixes of several formats.

    >>> known(["listing", "csv"])
    ['.lst', '.txt', '.out', '.csv']
    """
    return list(dict.fromkeys(suffix for form in formats for suffix in SUFFIXES[form]))


def mismatch(form: str | None, file: str) -> str:
    """Return a message if a format contradicts the suffix of a file name, else an empty text.

    >>> mismatch("csv", "a.json"), mismatch("csv", "a.csv"), mismatch("csv", "a")
    ('csv is not the format of a.json: expected .csv', '', '')
    """
    if not form or suffix_of(file) in ("", *SUFFIXES[form]):
        return ""
    return f"{form} is not the format of {file}: expected {' or '.join(SUFFIXES[form])}"
