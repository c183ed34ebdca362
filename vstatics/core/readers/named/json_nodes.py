"""JSON text to tree of nodes with places, which Python's `json` does not provide."""

from __future__ import annotations

import re
from collections.abc import Iterator
from json import JSONDecodeError
from json.decoder import scanstring  # type: ignore[attr-defined]
from typing import NoReturn

from vstatics.core.readers.named.nodes import DocumentText, Listing, Mapping, Node, Scalar, shown

_BLANKS = re.compile(r"[ \t\n\r]*")
_WORD = re.compile(r"[^\s,:{}\[\]\"]+|.?", re.DOTALL)
_LITERAL = re.compile(r"true|false|null|-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")


def json_tree(document: DocumentText) -> Node:
    """Return the tree of a JSON text, strictly by RFC 8259.

    Raises
    ------
    ReadError
        If the text is not JSON, or is nested too deeply.
    """
    scanner = _Scanner(document)
    scanner.skip()
    node = scanner.value(1)
    scanner.skip()
    if scanner.sign:
        scanner.refuse("the end of the file")
    return node


class _Scanner:
    """Recursive parser of JSON, which reads from left to right."""

    def __init__(self, document: DocumentText) -> None:
        self.document = document
        self.text = document.text
        self.at = 0

    @property
    def sign(self) -> str:
        """Next character; empty at the end of the text."""
        return self.text[self.at : self.at + 1]

    @property
    def place(self) -> tuple[int, int]:
        return self.document.place(self.at)

    def skip(self, signs: int = 0) -> None:
        """Advance beyond a number of characters and the following blanks."""
        blanks = _BLANKS.match(self.text, self.at + signs)
        self.at = blanks.end() if blanks else self.at + signs

    def refuse(self, expected: str) -> NoReturn:
        word = _WORD.match(self.text, self.at)
        read = f"'{shown(word[0])}'" if word and word[0] else "the end of the file"
        self.document.stop(f"not JSON: read {read}, expected {expected}", *self.place)

    def value(self, depth: int) -> Node:
        place = self.place
        self.document.check_depth(depth, *place)
        match self.sign:
            case "{":
                return Mapping([self.entry(depth) for _ in self.inside("}")], *place)
            case "[":
                return Listing([self.value(depth + 1) for _ in self.inside("]")], *place)
            case '"':
                return self.string()
        word = _WORD.match(self.text, self.at)
        if not word or not _LITERAL.fullmatch(word[0]):
            self.refuse("a value")
        self.at = word.end()
        return Scalar(word[0], *place)

    def string(self) -> Scalar:
        place = self.place
        try:
            text, self.at = scanstring(self.text, self.at + 1)
        except JSONDecodeError as error:
            self.document.stop(f"not JSON: {error.msg}", *self.document.place(error.pos))
        self.document.check_characters(text, *place)
        return Scalar(text, *place, plain=False)

    def entry(self, depth: int) -> tuple[Scalar, Node]:
        if self.sign != '"':
            self.refuse("a key in double quotes")
        key = self.string()
        self.skip()
        if self.sign != ":":
            self.refuse("`:` after a key")
        self.skip(1)
        return key, self.value(depth + 1)

    def inside(self, closing: str) -> Iterator[None]:
        """Yield before each item in brackets, then move past the closing bracket."""
        self.skip(1)
        more = self.sign != closing
        while more:
            yield
            self.skip()
            more = self.sign == ","
            if more:
                self.skip(1)
                if self.sign == closing:
                    self.refuse("no `,` before it")
            elif self.sign != closing:
                self.refuse(f"`,` or `{closing}`")
        self.at += 1
