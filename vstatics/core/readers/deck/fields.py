"""The fields of a deck as lists of the length that the sizes say."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate, pairwise

from vstatics.core.errors import Path, Problem
from vstatics.core.readers.deck.numbers import Number, integer, loose_count
from vstatics.core.readers.deck.places import Places, label_in
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.deck.text import Scan
from vstatics.core.readers.deck.values import (
    Values,
    Wanted,
    row_labels,
    stand_ins,
    take,
    take_rows,
    values_in_words,
)
from vstatics.core.suggestions import nearest


class Fields:
    """Gives the values of fields; notes what is wrong, and where everything stands."""

    def __init__(self, found: Scan, capacity: int) -> None:
        """Start from the fields that were found in a text of `capacity` characters."""
        self.found = found
        self.capacity = capacity
        """No size or count is larger than the text has characters."""
        self.places = Places(found.source)
        self.hidden: list[Path] = []
        """Parts of the model that hold stand-ins."""
        self.unreadable: set[str] = set()
        """Values that are stand-ins."""

    def error(self, label: str, message: str) -> None:
        """Note an error at a value that was read."""
        self.found.error(f"{label}: {message}", *self.places.spots[label])

    def size(self, key: str, what: str, lowest: int) -> int | None:
        """A size that must be there; None if it cannot be used."""
        if key not in self.found.fields:
            self._missing(key, f"`{key}=` and the number of {what}")
            return None
        size = self._scalar(key)
        if size is not None and size < lowest:
            self.error(key, f"read {size}, expected {lowest} or more {what}")
            return None
        return size if size is not None and self._fits(key, size) else None

    def or_guess(self, size: int | None, key: str, part: str) -> int:
        """A size, or when it is unknown the length of a list that it fixes."""
        if size is not None:
            return size
        guess = min(loose_count(self.found, key), self.capacity)
        if not guess:
            self.hidden.append((part,))
        return guess

    def optional(self, key: str, default: int, allowed: range, expected: str) -> int | None:
        """A field of one value that may be left out; None if it cannot be used."""
        if key not in self.found.fields:
            return default
        value = self._scalar(key)
        if value is not None and value not in allowed:
            self.error(key, f"read {value}, expected {expected}")
            return None
        return value

    def numbers(
        self, key: str, need: int, why: str, parse: Callable[[str], Number]
    ) -> list[Number]:
        """A list of numbers."""
        return self._list(key, need, why, parse).numbers

    def counts(self, key: str, gears: int, *, required: bool) -> list[int]:
        """How many values each gear has in another field; -1 where it cannot be told."""
        if key not in self.found.fields and not required:
            message = f"{key} is missing: taken as 0; a cut file looks the same"
            place = self.found.source.place(*self._end())
            self.found.problems.append(Problem("W101", message, place=place))
            return [0] * gears
        values = self._list(key, gears, "NP", integer)
        counts, total = values.numbers, 0
        if not values.unreadable and min(counts, default=0) >= 0 and sum(counts) <= self.capacity:
            return counts
        for position, count in enumerate(counts):
            label = f"{key}({position + 1})"
            total += max(count, 0)
            if position in values.unreadable:
                counts[position] = -1
            elif count < 0:
                self.error(label, f"read {count}, expected a count, 0 or more")
                counts[position] = -1
            elif not self._fits(label, total):
                return [-1] * gears
        return counts

    def rows(
        self, key: str, counts: Sequence[int], counted: str, parse: Callable[[str], Number]
    ) -> tuple[list[list[Number]], set[int]]:
        """The values of each gear, as many as `counts` says, and the gears that have stand-ins."""
        gears = len(counts)
        if min(counts, default=0) < 0:
            return [[] for _ in counts], set(range(1, gears + 1))
        need, field = sum(counts), self.found.fields.get(key)
        if field is not None:
            values = take_rows(self.found, field, counts, counted, parse)
            self.places.named.append((row_labels(key, counts), values.spots))
        elif not need:
            return [[] for _ in counts], set()
        else:
            values = stand_ins(None, need, parse)
            self._missing(key, f"{values_in_words(need)} ({counted})")
        ends = [0, *accumulate(counts)]
        unreadable = {
            gear
            for gear, (start, end) in enumerate(pairwise(ends), 1)
            if values.unreadable and not values.unreadable.isdisjoint(range(start, end))
        }
        return [values.numbers[start:end] for start, end in pairwise(ends)], unreadable

    def _list(
        self, key: str, need: int, why: str, parse: Callable[[str], Number]
    ) -> Values[Number]:
        """The values of a list; what could not be read is hidden from the model's checks."""
        field = self.found.fields.get(key)

        def label(position: int) -> str:
            return label_in(key, position + 1)

        if field is not None:
            values = take(self.found, field, Wanted(key, label, need, why), parse)
            self.places.named.append((map(label, range(need)), values.spots))
        else:
            values = stand_ins(None, need, parse)
            if need:
                self._missing(key, f"{values_in_words(need)} ({why})")
        self.unreadable.update(map(label, values.unreadable))
        if key in FIELDS:
            part, member, *_ = FIELDS[key]
            self.hidden += [(part, position + 1, member) for position in values.unreadable]
        return values

    def _scalar(self, key: str) -> int | None:
        """The value of a field of one value; None if it is unreadable."""
        field = self.found.fields[key]
        values = take(self.found, field, Wanted(key, lambda _: key, 1, ""), integer)
        self.places.named.append(([key], values.spots))
        return None if values.unreadable else values.numbers[0]

    def _fits(self, label: str, size: int) -> bool:
        """Whether the file can hold so many; an error if not."""
        if size > self.capacity:
            cannot = f"the file has {self.capacity} characters and cannot hold so many"
            self.error(label, f"read {size}, expected fewer: {cannot}")
        return size <= self.capacity

    def _missing(self, key: str, expected: str) -> None:
        name, hint = key.partition("(")[0], ""
        if name in self.found.broken:
            return  # it is there, and its fault was told
        for word, line in self.found.unknown.items():
            if nearest(word, [name]):
                hint = f"; line {line} starts with `{word}`, which is no field"
                break
        self.found.error(f"{key} is missing: expected {expected}{hint}", *self._end())

    def _end(self) -> tuple[int, int]:
        """The end of the input."""
        line = self.found.last
        return line, len(self.found.source.lines[line - 1]) + 1
