"""Tree of nodes with places, shared by YAML, JSON and workbooks.

A single value (scalar) is a text as written. Its meaning depends on its position in the document,
so that a gear can have the name `on`, `1` or `1e3`. `Spots` maps the parts of the model to their
places in the document.
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
MOST_HINTS = 20  # each hint compares a word with all known names
UNIT, NUMBER, NAME, SHAPE, CONTRADICTION = "E124", "E125", "E126", "E127", "E107"
"""Ids of errors in values: wrong unit, number or name, wrong type of node, contradictory keys."""
DASH_HINT = "; write a blank after the dash of each item, such as `- A`"
TWICE, MISSING, UNKNOWN_KEY = "E192", "E191", "E190"
"""Ids of errors in keys: repeated, missing and unknown keys."""
_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
BYTE_ORDER_MARKS = (  # UTF-32 first, because its little-endian mark begins like the mark of UTF-16
    (codecs.BOM_UTF32_LE, "utf-32", "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32", "utf-32-be"),
    (codecs.BOM_UTF8, "utf-8-sig", "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16", "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16", "utf-16-be"),
)
"""Byte order marks, each with the encoding of a text with and without the mark."""


class Scalar(NamedTuple):
    """Single value as written; `plain` is True if it has no quotes."""

    text: str
    line: int
    column: int
    plain: bool = True


class Listing(NamedTuple):
    """List of values."""

    items: list[Node]
    line: int
    column: int


class Mapping(NamedTuple):
    """Pairs of key and value in order, including duplicate keys."""

    entries: list[tuple[Scalar, Node]]
    line: int
    column: int


Node: TypeAlias = Scalar | Listing | Mapping


class DocumentText:
    """Text of a document, with warnings and up to `MOST_PROBLEMS` problems found in the text."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.problems: list[Problem] = []
        self.warnings: list[Problem] = []

    @cached_property
    def text(self) -> str:
        """Text with uniform line endings, created only when needed because tables can be long."""
        return "\n".join(self.source.lines)

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *accumulate(len(line) + 1 for line in self.source.lines)]

    def place(self, offset: int) -> tuple[int, int]:
        """Return line and column, from 1, of an offset in the text."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def add(
        self, message: str, line: int, column: int, path: Path = (), identity: str = SHAPE
    ) -> None:
        """Add an error, and stop reading if there are too many errors."""
        self.problems.append(Problem(identity, message, path, self.source.place(line, column)))
        if len(self.problems) >= MOST_PROBLEMS:
            self.stop("too many errors, the rest is not read", 0, 1)

    def stop(self, message: str, line: int, column: int) -> NoReturn:
        """Add an error that makes further reading impossible, and raise all errors."""
        raise ReadError(
            [*self.problems, Problem("E108", message, (), self.source.place(line, column))]
        )

    def mapping(self, root: Node, expected: str) -> Mapping:
        """Return the root of the document, or stop if it is not a mapping."""
        if not isinstance(root, Mapping):
            self.stop(f"read {what(root)}, expected {expected}", root.line, root.column)
        return root

    def hint(self, word: str, known: Iterable[str]) -> str:
        """Return a hint with the most similar known word. The number of hints is limited."""
        if len(self.problems) >= MOST_HINTS or len(word) > 60:
            return ""
        return nearest(word, islice(known, 1000))

    def check_depth(self, depth: int, line: int, column: int) -> None:
        """Stop if values are nested more deeply than any case requires."""
        if depth > MOST_DEEP:
            self.stop(
                f"nested deeper than {MOST_DEEP} levels, expected at most this depth", line, column
            )

    def check_characters(self, text: str, line: int, column: int) -> None:
        """Stop at a lone surrogate (half of a character), which escape sequences can create."""
        if not text.isascii() and any("\ud800" <= character <= "\udfff" for character in text):
            self.stop("read half a character (a lone surrogate)", line, column)


def is_null(node: Node) -> bool:
    """Return whether a node is an empty value."""
    return isinstance(node, Scalar) and node.plain and node.text in _NULLS


def shown(text: str) -> str:
    r"""Return a text on a single line, shortened, for a message.

    >>> shown("6R"), shown("a" * 50), shown("two" + chr(10) + "lines")
    ('6R', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...', 'two\\nlines')
    """
    short = text[:40] + "..." if len(text) > 43 else text
    return short if short.isprintable() else repr(short)[1:-1]


def what(node: Node) -> str:
    """Return words for a node in a message, such as `a list`."""
    match node:
        case Mapping():
            return "a mapping"
        case Listing():
            return "a list"
        case _ if is_null(node):
            return "nothing"
    return f"'{shown(node.text)}'"


def length(node: Node) -> str:
    """Return words for the length of a list in a message; empty for other nodes."""
    return f"a list of {len(node.items)}" if isinstance(node, Listing) else ""


_WORKBOOKS = (b"PK\3\4", b"\xd0\xcf\x11\xe0")
"""First bytes of workbooks in the formats XLSX and XLS."""


def encoding_of(data: bytes) -> str:
    """Return the encoding of a text from the byte order mark, or UTF-8 without a mark.

    >>> encoding_of(b"a: 1"), encoding_of(codecs.BOM_UTF8)
    ('utf-8', 'utf-8-sig')
    """
    return next(
        (encoding for mark, encoding, _ in BYTE_ORDER_MARKS if data.startswith(mark)), "utf-8"
    )


def text_of(data: bytes) -> str:
    """Return a text in UTF-8, or in the encoding of the byte order mark, without this mark.

    Programs that add a mark to a text with a mark cause several marks, which are all left out.

    >>> text_of(2 * codecs.BOM_UTF8 + b"links: 3")
    'links: 3'
    """
    return data.decode(encoding_of(data)).lstrip("\ufeff")


def decode(data: bytes, file: str, expected: str = "a case") -> DocumentText:
    """Decode a text in UTF-8, or in the encoding of the byte order mark.

    Raises
    ------
    ReadError
        At the first byte that cannot be decoded, or if the file is a workbook or empty.
    """
    encoding = encoding_of(data)
    if data.startswith(_WORKBOOKS):
        message = f"read a workbook or archive, not a text, expected {expected}"
        DocumentText(Source(file, "")).stop(f"{message}; save a table as CSV", 1, 1)
    try:
        text = text_of(data)
    except UnicodeDecodeError as error:
        if b"\0" in data[: error.start] and encoding == "utf-8":
            DocumentText(Source(file, "")).stop(
                f"read a zero byte, so this is not a text, expected {expected}", 1, 1
            )
        document = DocumentText(Source(file, data.decode(encoding, "replace")))
        before = Source(file, data[: error.start].decode(encoding, "ignore")).lines
        message = f"not valid {encoding.removesuffix('-sig').upper()}: {error.reason}"
        message = f"{message} (byte {error.start + 1} of the file); save it in UTF-8"
        document.stop(message, len(before), len(before[-1]) + 1)
    document = DocumentText(Source(file, with_plain_blanks(text)))
    if not text.strip():
        document.stop(f"the file is empty, expected {expected}", 1, 1)
    if "\0" in text:
        document.stop(
            "read a zero byte, so this is not a text", *document.place(document.text.find("\0"))
        )
    return document


class Spot(NamedTuple):
    """Value of a document: its path in the model, its node, and a label that begins messages."""

    path: Path
    label: str
    node: Node

    def key(self, part: str | int, key: str, node: Node) -> Spot:
        """Return the spot of the value under a key; `part` is the name of the key in the model."""
        return Spot((*self.path, part), _joined(self.label, shown(key)), node)

    def item(self, part: str | int, number: int, node: Node) -> Spot:
        """Return the spot of the list item `number` (from 1); `part` is its number in the model."""
        return Spot((*self.path, part), f"{self.label}[{number}]", node)


class Spots:
    """Spots of a document by path.

    Attributes
    ----------
    unreadable : list of Path
        Paths of unreadable values, for which the model contains stand-ins.
    """

    def __init__(self, document: DocumentText) -> None:
        self.document = document
        self.unreadable: list[Path] = []
        self._spots: dict[Path, Spot] = {}

    def keep(self, spot: Spot, node: Node | None = None) -> None:
        """Store a spot unless its path is known; if given, `node` determines the place."""
        self._spots.setdefault(spot.path, spot._replace(node=node) if node else spot)

    def has(self, path: Path) -> bool:
        """Return whether the document contains a part of the model."""
        return path in self._spots

    def keys(self, path: Path) -> list[str]:
        """Return the keys of the mapping at a path; empty without a mapping."""
        node = self._spots[path].node if path in self._spots else None
        return [key.text for key, _ in node.entries] if isinstance(node, Mapping) else []

    def complain(
        self, spot: Spot, message: str, node: Node | None = None, identity: str = SHAPE
    ) -> None:
        """Add an error at a spot, or at another `node`."""
        at = node or spot.node
        text = f"{spot.label}: {message}" if spot.label else message
        self.document.add(text, at.line, at.column, spot.path, identity)

    def refuse(self, spot: Spot, message: str, identity: str = SHAPE) -> None:
        """Add an error at a spot, and mark the value as unreadable."""
        self.complain(spot, message, identity=identity)
        self.unreadable.append(spot.path)

    def tell(self, path: Path, message: str) -> None:
        """Add an error at a part of the model, which checks of the model then ignore."""
        self.document.problems.append(self.locate(Problem("E109", message, path)))
        self.unreadable.append(path)

    def missing(self, spot: Spot, key: str, instead: str = "") -> None:
        """Add an error for a missing key, located at the start of the mapping.

        `instead` continues the message, and names another way to give the value.
        """
        self.complain(self._spots[spot.path], f"`{key}` is missing{instead}", identity=MISSING)
        self.unreadable.append((*spot.path, key))

    def place(self, path: Path) -> Place:
        """Return the place in the document of a part of the model."""
        node = self._spots[path].node
        return self.document.source.place(node.line, node.column)

    def locate(self, problem: Problem) -> Problem:
        """Return a problem of the model with the place in the document and the label."""
        if problem.place is not None:
            return problem
        known = problem.path
        while known not in self._spots:
            known = known[:-1]  # ends at the root at the latest
        label = _joined(self._spots[known].label, path_text(problem.path[len(known) :]))
        return problem._replace(
            message=f"{label}: {problem.message}" if label else problem.message,
            place=self.place(known),
        )


def _joined(label: str, part: str) -> str:
    dot = "." if label and part and not part.startswith("[") else ""
    return f"{label}{dot}{part}"
