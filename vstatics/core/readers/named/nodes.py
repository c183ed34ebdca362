"""A document as a small tree of nodes, each with its place; what YAML and JSON share.

Scalars stay text as it is written: what a text means is told by where it stands,
so a gear may be called `on`, `1` or `1e3`. `Spots` know where the parts of a model stand.
"""

from __future__ import annotations

import codecs
from bisect import bisect_right
from collections.abc import Iterable
from functools import cached_property
from itertools import accumulate, islice
from typing import NamedTuple, NoReturn, TypeAlias

from vstatics.core.errors import Path, Place, Problem, ReadError, path_text
from vstatics.core.readers.reading import Source
from vstatics.core.readers.signs import with_plain_blanks
from vstatics.core.suggestions import nearest

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
        self.source = source
        self.problems: list[Problem] = []

    @cached_property
    def text(self) -> str:
        """The text with one sign at the end of each line; tables, which are long, need none."""
        return "\n".join(self.source.lines)

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *accumulate(len(line) + 1 for line in self.source.lines)]

    def place(self, offset: int) -> tuple[int, int]:
        """Line and column, from 1, of an offset in the text."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def add(
        self, message: str, line: int, column: int, path: Path = (), identity: str = "E107"
    ) -> None:
        """Keep an error; give up when there are too many."""
        self.problems.append(Problem(identity, message, path, self.source.place(line, column)))
        if len(self.problems) >= MOST_PROBLEMS:
            self.stop("too many errors, the rest is not read", 0, 1)

    def stop(self, message: str, line: int, column: int) -> NoReturn:
        """End with an error after which nothing can be read, and those before it."""
        raise ReadError(
            [*self.problems, Problem("E108", message, (), self.source.place(line, column))]
        )

    def hint(self, word: str, known: Iterable[str]) -> str:
        """The nearest known word, as long as looking for it costs little."""
        if len(self.problems) >= MOST_HINTS or len(word) > 60:
            return ""
        return nearest(word, islice(known, 1000))

    def check_depth(self, depth: int, line: int, column: int) -> None:
        """End where values are nested deeper than in any case."""
        if depth > MOST_DEEP:
            self.stop(f"nested deeper than {MOST_DEEP} levels, expected at most that", line, column)

    def check_characters(self, text: str, line: int, column: int) -> None:
        """End at a text without whole characters only; an escape can make half of one."""
        if any("\ud800" <= character <= "\udfff" for character in text):
            self.stop("half a character (a lone surrogate)", line, column)


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


def length(node: Node) -> str:
    """How many items a list has, in the words of a message; nothing of what is none."""
    return f"a list of {len(node.items)}" if isinstance(node, Listing) else ""


def encoding_of(data: bytes) -> str:
    """The encoding that the byte order mark of a text tells; UTF-8 without one.

    >>> encoding_of(b"a: 1"), encoding_of(codecs.BOM_UTF8)
    ('utf-8', 'utf-8-sig')
    """
    return next((name for mark, name in _MARKS if data.startswith(mark)), "utf-8")


def decode(data: bytes, file: str, expected: str = "a case") -> Found:
    """The text of a file in UTF-8, or in what its byte order mark tells.

    Raises
    ------
    ReadError
        At the first byte that is no text, or if there is no text at all.
    """
    encoding = encoding_of(data)
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        if b"\0" in data[: error.start] and encoding == "utf-8":
            message = f"a zero byte: this is no text, expected {expected}"
            Found(Source(file, "")).stop(message, 1, 1)
        found = Found(Source(file, data.decode(encoding, "replace")))
        before = Source(file, data[: error.start].decode(encoding, "ignore")).lines
        message = f"no {encoding.removesuffix('-sig').upper()} text: {error.reason}"
        message = f"{message} (byte {error.start + 1} of the file); save it in UTF-8"
        found.stop(message, len(before), len(before[-1]) + 1)
    found = Found(Source(file, with_plain_blanks(text)))
    if not text.strip():
        found.stop(f"the file is empty, expected {expected}", 1, 1)
    if "\0" in text:
        found.stop("a zero byte: this is no text", *found.place(found.text.find("\0")))
    return found


class Spot(NamedTuple):
    """A place in the model and in the document: what is said about it starts with `label`."""

    path: Path
    label: str
    node: Node

    def key(self, part: str | int, key: str, node: Node) -> Spot:
        """The value under a key, which is `part` to the model."""
        return Spot((*self.path, part), _joined(self.label, shown(key)), node)

    def item(self, part: str | int, number: int, node: Node) -> Spot:
        """An item of a list by its number from 1, which is `part` to the model."""
        return Spot((*self.path, part), f"{self.label}[{number}]", node)


class Spots:
    """The spots of a document by their paths.

    Attributes
    ----------
    unreadable : list of Path
        Where something could not be read, and a stand-in is in the model.
    """

    def __init__(self, found: Found) -> None:
        self.found = found
        self.unreadable: list[Path] = []
        self._spots: dict[Path, Spot] = {}

    def keep(self, spot: Spot, node: Node | None = None) -> None:
        """Remember a spot, or `node` as its place; the first one of a path counts."""
        self._spots.setdefault(spot.path, spot._replace(node=node or spot.node))

    def has(self, path: Path) -> bool:
        """Whether a part was read."""
        return path in self._spots

    def keys(self, path: Path) -> list[str]:
        """The keys of a mapping that was read; none if there is none."""
        node = self._spots[path].node if path in self._spots else None
        return [key.text for key, _ in node.entries] if isinstance(node, Mapping) else []

    def complain(
        self, spot: Spot, message: str, node: Node | None = None, identity: str = "E107"
    ) -> None:
        """Say what is wrong at a spot, or at a `node` of it."""
        at = node or spot.node
        text = f"{spot.label}: {message}" if spot.label else message
        self.found.add(text, at.line, at.column, spot.path, identity)

    def refuse(self, spot: Spot, message: str) -> None:
        """Say why a spot cannot be read."""
        self.complain(spot, message)
        self.unreadable.append(spot.path)

    def tell(self, path: Path, message: str) -> None:
        """Say what is wrong with a part of the model, of which that need say nothing then."""
        self.found.problems.append(self.locate(Problem("E109", message, path)))
        self.unreadable.append(path)

    def missing(self, spot: Spot, key: str) -> None:
        """Say that a key is missing; where it would stand is where its record starts."""
        self.complain(self._spots[spot.path], f"`{key}` is missing", identity="E191")
        self.unreadable.append((*spot.path, key))

    def place(self, path: Path) -> Place:
        """Where a part stands that was read."""
        node = self._spots[path].node
        return self.found.source.place(node.line, node.column)

    def locate(self, problem: Problem) -> Problem:
        """Give a problem of the model its place, and its label before the message."""
        if problem.place is not None:
            return problem
        known = problem.path
        while known not in self._spots:
            known = known[:-1]  # the root is always there
        label = _joined(self._spots[known].label, path_text(problem.path[len(known) :]))
        return problem._replace(
            message=f"{label}: {problem.message}" if label else problem.message,
            place=self.place(known),
        )


def _joined(label: str, part: str) -> str:
    dot = "." if label and part and not part.startswith("[") else ""
    return f"{label}{dot}{part}"
