"""Readers of cases: one module or folder per format, text -> Transmission.

>>> text = "{links: 2, mechanisms: {D: {first: 1, second: 2, ratio: 3}}, gears: {low: , high: }}"
>>> format_of("case.yaml", text.encode())
'yaml'
>>> reading = read(text.encode(), "case.yaml")  # or ReadError, with all that is wrong, and where
>>> [gear.name for gear in reading.case.gears], reading.warnings
(['low', 'high'], [])

`load` reads a file. In both folders a text becomes values with their places, these a case;
`reading` ends what all do. `results` reads what was written as a result.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from os import PathLike, fspath
from os.path import splitext
from typing import Literal

from vstatics.model.transmission import Transmission
from vstatics.readers.reading import Reading

Format = Literal["deck", "yaml", "json"]

READERS: dict[Format, tuple[str, str]] = {
    "deck": ("vstatics.readers.deck.reader", "read"),
    "yaml": ("vstatics.readers.named.reader", "read_yaml"),
    "json": ("vstatics.readers.named.reader", "read_json"),
}
"""Module and function of each format; imported when needed, as YAML costs start-up time."""

SUFFIXES: dict[str, Format] = {
    ".dat": "deck",
    ".deck": "deck",
    ".lst": "deck",
    ".yaml": "yaml",
    ".yml": "yaml",
    ".json": "json",
}


def format_of_name(file: str) -> Format | None:
    """The format that the suffix of a file's name tells, if it does."""
    suffix = splitext(file)[1]  # noqa: PTH122 (importing pathlib costs as much as a solve)
    return SUFFIXES.get(suffix.lower())


def format_of(file: str, data: bytes) -> Format:
    """The format of a case: told by the suffix, else by the content."""
    named = format_of_name(file)
    if named is not None:
        return named
    from vstatics.readers.deck.text import holds_deck

    if data.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{":
        return "json"
    return "deck" if holds_deck(data) else "yaml"


def read(data: bytes, file: str, format: Format | None = None) -> Reading:  # noqa: A002
    """Read a case from bytes.

    Parameters
    ----------
    data : bytes
        The content of a file.
    file : str
        Its name, for messages and to tell the format.
    format : {"deck", "yaml", "json"}, optional
        The format, where it is known.

    Raises
    ------
    ReadError
        With every problem and its place.
    """
    wanted = format or format_of(file, data)
    if wanted not in READERS:
        raise ValueError(f"format {wanted!r}: expected one of {', '.join(READERS)}")
    module, function = READERS[wanted]
    reader: Callable[[bytes, str], Reading] = getattr(import_module(module), function)
    return reader(data, file)


def load(path: str | PathLike[str], *, format: Format | None = None) -> Transmission:  # noqa: A002
    """Read a case from a file: a Visual-Statics deck, YAML or JSON.

    Parameters
    ----------
    path : path-like
        The file.
    format : {"deck", "yaml", "json"}, optional
        The format; told by the suffix, else by the content, when not given.

    Raises
    ------
    ReadError
        With every problem and its place.
    ValueError
        If there is no such format.
    OSError
        If the file cannot be opened.
    """
    with open(path, "rb") as file:  # noqa: PTH123 (pathlib costs nothing less)
        return read(file.read(), fspath(path), format).case
