"""Excerpt of a text that contains a formula, to locate errors in the full text."""

from __future__ import annotations

import re
from typing import NamedTuple

from vstatics.core.errors import Place, ReadError


class Excerpt(NamedTuple):
    """Part of a text, such as the argument of an option."""

    text: str
    option: str
    start: int = 0
    stop: int = -1
    """Offset of the end of the part; the end of the text if negative."""

    @property
    def end(self) -> int:
        """Offset of the end of the part."""
        return len(self.text) if self.stop < 0 else self.stop

    @property
    def part(self) -> str:
        """Text of the part."""
        return self.text[self.start : self.end]

    def end_of(self, pattern: re.Pattern[str], at: int) -> int:
        """Return the offset after a match of a pattern at offset `at`, else `at` itself."""
        match = pattern.match(self.text, at, self.end)
        return match.end() if match else at

    def has(self, sign: str, at: int) -> bool:
        """Return whether the part continues with the given characters at an offset."""
        return self.text.startswith(sign, at, self.end)

    def error(self, message: str, at: int) -> ReadError:
        """Return an error located at an offset in the text, from 0."""
        return ReadError("E105", message, place=self.place(at))

    def place(self, at: int) -> Place:
        """Return the place (line and column) of an offset in the text."""
        return Place(self.option, 1, at + 1, self.text)
