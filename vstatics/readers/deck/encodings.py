"""The encodings of decks: UTF-8, or what Russian programs wrote before it."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.errors import Place, Problem, ReadError
from vstatics.readers.reading import Source


def texts(data: bytes, file: str) -> Iterator[tuple[str, list[Problem]]]:
    """The text of a file in each encoding that is possible, the likeliest first.

    Raises
    ------
    ReadError
        If the file holds no text.
    """
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _unreadable(file, "the file is UTF-16 text, expected UTF-8: save it as UTF-8")
    if b"\0" in data:
        message = "the file is binary, expected a deck as text: save it as text in UTF-8"
        raise _unreadable(file, message)
    data = data.rstrip(b"\x1a")  # the end of a text for DOS
    try:
        yield data.decode("utf-8-sig"), []
    except UnicodeDecodeError as error:
        for encoding in ("cp1251", "cp866", "koi8-r"):
            try:
                yield data.decode(encoding), []
            except UnicodeDecodeError:  # CP1251 lacks one byte
                continue
        yield _damaged(data, error.start, file)


def _unreadable(file: str, message: str) -> ReadError:
    return ReadError([Problem(message, place=Place(file, 1, 1))])


def _damaged(data: bytes, start: int, file: str) -> tuple[str, list[Problem]]:
    """The text as UTF-8 with a fault, so that a cut file does not read as gibberish."""
    before = Source(file, data[:start].decode("utf-8-sig")).lines
    text = data.decode("utf-8-sig", errors="replace")
    message = f"byte 0x{data[start]:02X} is no UTF-8 here: the file is damaged or cut"
    return text, [
        Problem(message, place=Source(file, text).place(len(before), len(before[-1]) + 1))
    ]
