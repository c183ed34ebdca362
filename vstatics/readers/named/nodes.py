"""A document as a small tree of nodes, each with its place; what YAML and JSON share.

Scalars stay text as it is written: what a text means is told by where it stands,
so a gear may be called `on`, `1` or `1e3`.
"""

from __future__ import annotations

import codecs
from bisect import bisect_right
from collections.abc import Iterable
from itertools import accumulate, islice
from typing import NamedTuple, NoReturn, TypeAlias

from vstatics.errors import Path, Place, Problem, ReadError, nearest
from vstatics.readers.reading import Source

MOST_DEEP = 16
MOST_PROBLEMS = 100
MOST_HINTS = 20  # a hint compares with every known name
_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
_MARKS = (  # the longer ones first: that of UTF-32 starts like that of UTF-16
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


class Scalar(NamedTuple):
    """A single value as it is written; `plain` if it stands without quotes."""

    text: str
    line: int
    column: int
    plain: bool = True


class Listing(NamedTuple):
    """Values in order."""

    items: list[Node]
    line: int
    column: int


class Mapping(NamedTuple):
    """Keys and values in order, duplicate keys included."""

    entries: list[tuple[Scalar, Node]]
    line: int
    column: int


Node: TypeAlias = Scalar | Listing | Mapping


class Found:
    """The problems found in a text, up to as many as a person would read."""

    def __init__(self, source: Source) -> None:
        """Start without problems."""
        self.source = source
        self.text = "\n".join(source.lines)
        self.problems: list[Problem] = []
        self._starts = [0, *accumulate(len(line) + 1 for line in source.lines)]

    def place(self, offset: int) -> tuple[int, int]:
        """Line and column, from 1, of an offset in the text."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def add(self, message: str, line: int, column: int, path: Path = ()) -> None:
        """Keep an error; give up when there are too many."""
        self.problems.append(Problem(message, path, self.source.place(line, column)))
        if len(self.problems) >= MOST_PROBLEMS:
            raise ReadError(
                [*self.problems, Problem("too many errors, the rest is not read", (), self._file())]
            )

    def stop(self, message: str, line: int, column: int) -> NoReturn:
        """End with an error after which nothing can be read, and those before it."""
        raise ReadError([*self.problems, Problem(message, (), self.source.place(line, column))])

    def hint(self, word: str, known: Iterable[str]) -> str:
        """The nearest known word, as long as looking for it costs little."""
        if len(self.problems) >= MOST_HINTS or len(word) > 60:
            return ""
        return nearest(word, islice(known, 1000))

    def _file(self) -> Place:
        return self.source.place(0)


def is_null(node: Node) -> bool:
    """Whether nothing stands where a value could."""
    return isinstance(node, Scalar) and node.plain and node.text in _NULLS


def shown(text: str) -> str:
    r"""A text on one line, shortened, for a message.

    >>> shown("6R"), shown("a" * 50), shown("two" + chr(10) + "lines")
    ('6R', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...', 'two\\nlines')
    """
    short = text[:40] + "..." if len(text) > 43 else text
    return short if short.isprintable() else repr(short)[1:-1]


def what(node: Node) -> str:
    """What was read, in the words of a message."""
    match node:
        case Mapping():
            return "a mapping"
        case Listing():
            return "a list"
        case _ if is_null(node):
            return "nothing"
    return f"'{shown(node.text)}'"


def well_formed(text: str) -> bool:
    """Whether a text holds whole characters only; an escape can make half of one."""
    return not any("\ud800" <= character <= "\udfff" for character in text)


def decode(data: bytes, file: str) -> Found:
    """The text of a file in UTF-8, or in what its byte order mark tells.

    Raises
    ------
    ReadError
        At the first byte that is no text, or if there is no text at all.
    """
    encoding = next((name for mark, name in _MARKS if data.startswith(mark)), "utf-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        found = Found(Source(file, data.decode(encoding, "replace")))
        before = Source(file, data[: error.start].decode(encoding, "ignore")).lines
        message = f"no {encoding.removesuffix('-sig').upper()} text: {error.reason}"
        message = f"{message} (byte {error.start + 1} of the file)"
        found.stop(message, len(before), len(before[-1]) + 1)
    found = Found(Source(file, text))
    if not text.strip():
        found.stop("the file is empty, expected a case", 1, 1)
    zero = found.text.find("\0")
    if zero >= 0:
        found.stop("a zero byte: this is no text", *found.place(zero))
    return found
