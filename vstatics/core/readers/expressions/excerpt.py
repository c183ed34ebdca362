"""The part of a text that is read, and the places in it."""

from __future__ import annotations

import re
from typing import NamedTuple

from vstatics.core.errors import Place, ReadError


class Excerpt(NamedTuple):
    """A text, the option that it was given to, and the part of it that is read."""

    text: str
    option: str
    start: int = 0
    stop: int = -1
    """The end of the text if below 0."""

    @property
    def end(self) -> int:
        """Where the part ends."""
        return len(self.text) if self.stop < 0 else self.stop

    @property
    def part(self) -> str:
        """The part that is read."""
        return self.text[self.start : self.end]

    def end_of(self, pattern: re.Pattern[str], at: int) -> int:
        """Where what matches a pattern here ends; the place itself if nothing does."""
        match = pattern.match(self.text, at, self.end)
        return match.end() if match else at

    def has(self, sign: str, at: int) -> bool:
        """Whether a sign stands here."""
        return self.text.startswith(sign, at, self.end)

    def error(self, message: str, at: int) -> ReadError:
        """An error at an offset into the text, from 0."""
        return ReadError("E105", message, place=self.place(at))

    def place(self, at: int) -> Place:
        """The place of an offset into the text."""
        return Place(self.option, 1, at + 1, self.text)
