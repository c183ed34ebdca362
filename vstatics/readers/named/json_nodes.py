"""JSON text -> tree of nodes, with the places that the standard library drops."""

from __future__ import annotations

import re
from json import JSONDecodeError
from json.decoder import scanstring  # type: ignore[attr-defined]
from typing import NoReturn

from vstatics.readers.named.nodes import (
    MOST_DEEP,
    Found,
    Listing,
    Mapping,
    Node,
    Scalar,
    shown,
    well_formed,
)

_BLANKS = re.compile(r"[ \t\n\r]*")
_WORD = re.compile(r"[^\s,:{}\[\]\"]+|.?", re.DOTALL)
_LITERAL = re.compile(r"true|false|null|-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")


def json_tree(found: Found) -> Node:
    """The tree of a JSON text, taken strictly (RFC 8259).

    Raises
    ------
    ReadError
        If the text is not JSON, or nested without end.
    """
    scanner = _Scanner(found)
    node, at = scanner.value(scanner.skip(0), 1)
    end = scanner.skip(at)
    if end < len(scanner.text):
        scanner.refuse(end, "the end of the file")
    return node


class _Scanner:
    """Reads values of a text from an offset on; each gives the offset after it."""

    def __init__(self, found: Found) -> None:
        self.found = found
        self.text = found.text
        self.place = found.place

    def skip(self, at: int) -> int:
        blanks = _BLANKS.match(self.text, at)
        return blanks.end() if blanks else at

    def refuse(self, at: int, expected: str) -> NoReturn:
        word = _WORD.match(self.text, at)
        read = f"'{shown(word[0])}'" if word and word[0] else "the end of the file"
        self.found.stop(f"not JSON: read {read}, expected {expected}", *self.place(at))

    def value(self, at: int, depth: int) -> tuple[Node, int]:
        if depth > MOST_DEEP:
            message = f"nested deeper than {MOST_DEEP} levels, expected at most that"
            self.found.stop(message, *self.place(at))
        match self.text[at : at + 1]:
            case "{":
                return self.mapping(at, depth)
            case "[":
                return self.listing(at, depth)
            case '"':
                return self.string(at)
        word = _WORD.match(self.text, at)
        if not word or not _LITERAL.fullmatch(word[0]):
            self.refuse(at, "a value")
        return Scalar(word[0], *self.place(at)), word.end()

    def string(self, at: int) -> tuple[Scalar, int]:
        try:
            text, end = scanstring(self.text, at + 1)
        except JSONDecodeError as error:
            self.found.stop(f"not JSON: {error.msg}", *self.place(error.pos))
        if not well_formed(text):
            self.found.stop("half a character (a lone surrogate)", *self.place(at))
        return Scalar(text, *self.place(at), plain=False), end

    def listing(self, start: int, depth: int) -> tuple[Node, int]:
        items: list[Node] = []
        at = self.skip(start + 1)
        while self.text[at : at + 1] != "]" or items:
            item, at = self.value(at, depth + 1)
            items.append(item)
            at, more = self.comma(at, "]")
            if not more:
                break
        return Listing(items, *self.place(start)), at + 1

    def mapping(self, start: int, depth: int) -> tuple[Node, int]:
        entries: list[tuple[Scalar, Node]] = []
        at = self.skip(start + 1)
        while self.text[at : at + 1] != "}" or entries:
            if self.text[at : at + 1] != '"':
                self.refuse(at, "a key in double quotes")
            key, at = self.string(at)
            at = self.skip(at)
            if self.text[at : at + 1] != ":":
                self.refuse(at, "`:` after a key")
            value, at = self.value(self.skip(at + 1), depth + 1)
            entries.append((key, value))
            at, more = self.comma(at, "}")
            if not more:
                break
        return Mapping(entries, *self.place(start)), at + 1

    def comma(self, at: int, closing: str) -> tuple[int, bool]:
        """The offset of the next item, or of the closing bracket, and which it is."""
        at = self.skip(at)
        if self.text[at : at + 1] == ",":
            return self.skip(at + 1), True
        if self.text[at : at + 1] != closing:
            self.refuse(at, f"`,` or `{closing}`")
        return at, False
