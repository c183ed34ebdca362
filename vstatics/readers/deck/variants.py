"""Decks that differ from the one before in numbers of their mechanisms only.

Of such a deck just the lines that changed are read, and what these numbers say is checked. For
anything else, a mistake say, there is no such short way: the deck is read as if it stood alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any

from vstatics.errors import CaseError
from vstatics.model.checks import doubts
from vstatics.model.transmission import Transmission
from vstatics.readers.deck.numbers import plain_numbers, real, value_lines
from vstatics.readers.deck.text import Scan

LONGEST = 20_000
"""Characters of a deck that is remembered."""


class KnownDeck:
    """A deck that was read without a word, whose variants may come next."""

    def __init__(self, found: Scan, case: Transmission, planets: Iterable[int]) -> None:
        """Remember its lines; `planets` are the mechanisms of UAQ, in their order."""
        self.found = found
        self.case = case
        self.planets = [number - 1 for number in planets]

    @cached_property
    def numbers(self) -> Mapping[int, tuple[str, Sequence[int]]]:
        """By lines that hold nothing but numbers of mechanisms: which, and of whom (from 0)."""
        every = range(len(self.case.mechanisms))
        known: dict[int, tuple[str, Sequence[int]]] = {}
        for key, part, owners in (
            ("IAB", "ratio", every),
            ("ETAI", "efficiency", every),
            ("UAQ", "planet_ratio", self.planets),
        ):
            field, left = self.found.fields.get(key), owners
            for line, text, start, _ in () if field is None else value_lines(self.found, field):
                numbers = plain_numbers(text[start:], real)
                if numbers is None:
                    break
                if start == 0:
                    known[line - 1] = part, left[: len(numbers)]
                left = left[len(numbers) :]
        return known

    def variant(self, lines: Sequence[str]) -> Transmission | None:
        """The case of a deck of these lines; None if it may differ in anything but numbers.

        Also where there is something to be said of it.
        """
        before = self.found.source.lines
        if len(lines) != len(before):
            return None
        mechanisms = list(self.case.mechanisms)
        for index, (line, old) in enumerate(zip(lines, before, strict=True)):
            if line == old:
                continue
            part, owners = self.numbers.get(index, ("", ()))
            numbers = plain_numbers(line, real)
            if not owners or numbers is None or len(numbers) != len(owners):
                return None
            for owner, number in zip(owners, numbers, strict=True):
                changed: dict[str, Any] = {part: number}
                mechanisms[owner] = mechanisms[owner]._replace(**changed)
        try:
            case = self.case.with_numbers(mechanisms)
        except CaseError:
            return None
        return None if any(doubts(case)) else case


def known_deck(found: Scan, case: Transmission, planets: Iterable[int]) -> KnownDeck | None:
    """A deck to be remembered; None if it is long, or counts its values otherwise than by words.

    Without repeat counts a deck has more characters than values, whatever its numbers.
    """
    lines = found.source.lines
    if sum(map(len, lines)) > LONGEST or any("*" in line for line in lines):
        return None
    return KnownDeck(found, case, planets)
