"""Lists of values in the fields of a deck, with the prescribed lengths."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import accumulate, pairwise

from vstatics.core.errors import Path, Problem, count_of
from vstatics.core.readers.deck.numbers import Number, Parse, Spot, integer, loose_count
from vstatics.core.readers.deck.places import Places, label_in
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.deck.text import LISTS, SCALARS, Scan
from vstatics.core.readers.deck.values import (
    Values,
    Wanted,
    row_labels,
    stand_ins,
    take,
    take_rows,
)
from vstatics.core.suggestions import nearest

_LIKE_FIELD = r"\s*\(?[A-Z]{2,7}(?:\s*=\s*[-+]?[0-9.]+\s*|\s*\([^()]*\).*,\s*[IJK]\s*=\s*1\s*,.*)"
"""Pattern of a line that looks like a field, with any name."""


class Fields:
    """Reader of fields, which collects errors and places, and replaces unreadable values."""

    def __init__(self, scan: Scan, capacity: int) -> None:
        """Start with the fields of a scanned deck; `capacity` is the length of the text."""
        self.scan = scan
        self.capacity = capacity
        """Number of characters of the text, which limits every size and count."""
        self.places = Places(scan.source)
        self.hidden: list[Path] = []
        """Paths of stand-ins in the model.

        Problems of the model at these paths are not reported.
        """
        self.unreadable: set[str] = set()
        """Labels of unreadable values, such as ``NZF(1,2)``."""

    def error(self, label: str, message: str) -> None:
        """Add an error at the place of a value."""
        self.scan.error(f"{label}: {message}", *self.places.spots[label])

    def size(self, key: str, what: str, lowest: int) -> int | None:
        """Read a required size; return `None` for a missing or wrong value."""
        if key not in self.scan.fields:
            self._missing(key, f"`{key}=` and the number of {what}")
            return None
        size = self._scalar(key)
        if size is not None and size < lowest:
            self.error(key, f"read {size}, expected {lowest} or more {what}")
            return None
        return size if size is not None and self._fits(key, size) else None

    def or_guess(self, size: int | None, key: str, part: str) -> int:
        """Return a size; if unknown, an estimate from the length of a list of this size."""
        if size is not None:
            return size
        guess = min(loose_count(self.scan, key), self.capacity)
        if not guess:
            self.hidden.append((part,))
        return guess

    def optional(self, key: str, default: int, allowed: range, expected: str) -> int | None:
        """Read an optional field with a single value; return `None` for a wrong value."""
        if key not in self.scan.fields:
            return default
        value = self._scalar(key)
        if value is not None and value not in allowed:
            self.error(key, f"read {value}, expected {expected}")
            return None
        return value

    def numbers(self, key: str, need: int, why: str, parse: Parse[Number]) -> list[Number]:
        """Read the list `key`, which must contain `need` numbers."""
        return self._list(key, need, why, parse).numbers

    def counts(self, key: str, gears: int, *, required: bool) -> list[int]:
        """Read a list with a count for each gear; -1 if unreadable."""
        if key not in self.scan.fields and not required:
            message = f"{key} is missing and read as 0; a file that was cut off looks the same"
            place = self.scan.source.place(*self._end())
            self.scan.problems.append(Problem("W101", message, place=place))
            return [0] * gears
        values = self._list(key, gears, "NP", integer)
        counts, total = values.numbers, 0
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
        self, key: str, counts: Sequence[int], counted: str, parse: Parse[Number]
    ) -> tuple[list[list[Number]], set[int]]:
        """Return the values of each gear, and numbers of gears with unreadable values."""
        gears = len(counts)
        if min(counts, default=0) < 0:
            return [[] for _ in counts], set(range(1, gears + 1))
        need, field = sum(counts), self.scan.fields.get(key)
        if field is not None:
            values = take_rows(self.scan, field, counts, counted, parse)
            self.places.named.append((row_labels(key, counts), values.spots))
        elif not need:
            return [[] for _ in counts], set()
        else:
            values = stand_ins(None, need, parse)
            self._missing(key, f"{count_of('value', need)} ({counted})")
        ends = [0, *accumulate(counts)]
        unreadable = {
            gear
            for gear, (start, end) in enumerate(pairwise(ends), 1)
            if values.unreadable and not values.unreadable.isdisjoint(range(start, end))
        }
        return [values.numbers[start:end] for start, end in pairwise(ends)], unreadable

    def _list(self, key: str, need: int, why: str, parse: Parse[Number]) -> Values[Number]:
        """Read a list, and hide problems of the model at values that could not be read."""
        field = self.scan.fields.get(key)

        def label(position: int) -> str:
            return label_in(key, position + 1)

        if field is not None:
            values = take(self.scan, field, Wanted(key, label, need, why), parse)
            self.places.named.append((map(label, range(need)), values.spots))
        else:
            values = stand_ins(None, need, parse)
            if need:
                self._missing(key, f"{count_of('value', need)} ({why})")
        self.unreadable.update(map(label, values.unreadable))
        if key in FIELDS:
            part, member, *_ = FIELDS[key]
            self.hidden += [(part, position + 1, member) for position in values.unreadable]
        return values

    def _scalar(self, key: str) -> int | None:
        """Read a field with a single value; return `None` for an unreadable value."""
        field = self.scan.fields[key]
        values = take(self.scan, field, Wanted(key, lambda _: key, 1, ""), integer)
        self.places.named.append(([key], values.spots))
        return None if values.unreadable else values.numbers[0]

    def _fits(self, label: str, size: int) -> bool:
        """Return whether the text can contain `size` values; report an error if it is too short."""
        if size > self.capacity:
            cannot = f"the file has {self.capacity} characters and cannot hold as many values"
            self.error(label, f"read {size}, expected a smaller number: {cannot}")
        return size <= self.capacity

    def warn_of_unknown(self) -> None:
        """Add a warning for each line that looks like a field but has an unknown name."""
        for word, line in self.scan.unknown.items():
            if re.fullmatch(_LIKE_FIELD, self.scan.source.lines[line - 1]):
                hint = nearest(word, [*SCALARS, *LISTS])
                message = f"read `{word}`, expected the name of a field; the line is ignored{hint}"
                place = self.scan.source.place(line, 1)
                self.scan.problems.append(Problem("W103", message, place=place))

    def _missing(self, key: str, expected: str) -> None:
        name, hint = key.partition("(")[0], ""
        if name in self.scan.broken:
            return  # an error in the field has already been reported
        for word, line in self.scan.unknown.items():
            if nearest(word, [name]):
                hint = f"; line {line} starts with `{word}`, which is not a field"
                del self.scan.unknown[word]
                break
        if self.scan.result and not hint:
            hint = f"; the deck ends where results begin, at line {self.scan.result}"
        self.scan.error(f"{key} is missing: expected {expected}{hint}", *self._end())

    def _end(self) -> Spot:
        """Return line and column of the end of the input."""
        line = self.scan.last
        return line, len(self.scan.source.lines[line - 1]) + 1
