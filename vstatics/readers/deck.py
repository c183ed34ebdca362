"""Reader of the deck: the input format of the published Visual-Statics example.

The rules are in docs/formats.md. `deck_text` finds the fields, `deck_values` their
values; here they become a transmission.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import count
from typing import Any

from vstatics.errors import Path, Place, Problem, ReadError, nearest
from vstatics.model import Gear, Mechanism, ShiftElement
from vstatics.readers.deck_numbers import Number, integer, loose_count, real
from vstatics.readers.deck_places import Places
from vstatics.readers.deck_text import Named, Scan, scan, texts
from vstatics.readers.deck_values import Values, Wanted, stand_ins, take, take_rows
from vstatics.readers.reading import Reading, Source, finish

KINDS = "J (link), F (shift element), D (mechanism), P (gear) or T (title)"
EXPECTED = {
    "KJG": "the number of links",
    "KL": "the number of shift elements",
    "KG": "the number of mechanisms",
    "NP": "the number of gears",
}


def read(data: bytes, file: str) -> Reading:
    """Read a deck, or a printed report that starts with one.

    Parameters
    ----------
    data : bytes
        The text in UTF-8, Windows-1251, CP866 or KOI8-R.
    file : str
        The name of the file, for messages.

    Raises
    ------
    ReadError
        With all that is wrong, each with its place.
    """
    best: Reading | ReadError | None = None
    fewest = (0, 0)
    for text, damage in texts(data, file):
        try:
            result: Reading | ReadError = _read_text(text, file, damage)
        except ReadError as error:
            result = error
        problems = result.warnings if isinstance(result, Reading) else result.problems
        score = sum(problem.severity == "error" for problem in problems), len(problems)
        if best is None or score < fewest:
            best, fewest = result, score
        if fewest == (0, 0):
            break
    assert best is not None  # noqa: S101 - `texts` gives one text at least, or raises
    if isinstance(best, ReadError):
        raise best
    return best


def _read_text(text: str, file: str, damage: Iterable[Problem]) -> Reading:
    source = Source(file, text)
    found = scan(source)
    if not text.strip() or not found.fields:
        message = "no field of a deck found, expected `KJG=` first"
        if not text.strip():
            message = "the file is empty, expected a deck that starts with `KJG=`"
        raise ReadError([Problem(message, place=Place(file, 1, 1))])
    found.problems.extend(damage)
    deck = _Deck(found, len(text))
    parts = deck.parts()
    return finish(parts, found.problems, deck.hidden, deck.places.locate)


class _Deck:
    """Turns the fields of a deck into the arguments of `Transmission`."""

    def __init__(self, found: Scan, capacity: int) -> None:
        self.found = found
        self.capacity = capacity
        """No size or count is larger than the text has characters."""
        self.places = Places(found.source)
        self.hidden: list[Path] = []

    def parts(self) -> dict[str, Any]:
        """All arguments; what could not be read is noted and holds a stand-in."""
        links, elements = self._size("KJG", 2), self._size("KL", 0)
        mechanisms, gears = self._size("KG", 0), self._size("NP", 1)
        sizes = {"J": links, "F": elements, "D": mechanisms, "P": gears}
        names = self._names(sizes)
        if elements is None:
            elements = self._guess("NZF(I,1)", ("shift_elements",))
        if mechanisms is None:
            mechanisms = self._guess("NZD(I,1)", ("mechanisms",))
        if gears is None:
            gears = self._guess("KFRI", ("gears",))
        parts: dict[str, Any] = {
            "shift_elements": self._elements(elements, names),
            "mechanisms": self._mechanisms(mechanisms, names),
            "gears": self._gears(gears, names),
            "idle": "exact" if self._choice("IDLE", "published", "exact") else "published",
            "coast": bool(self._choice("COAST", "driving", "coasting")),
            "name": names.get("T", ""),
            "input": self._port("INP", ("input",), 1),
            "output": self._port("IOUT", ("output",), 0),
        }
        if sizes["F"] is None and not elements:
            self.hidden += [("gears", gear, "engaged") for gear in range(1, gears + 1)]
        if None in sizes.values():
            self.hidden += [("links",), ("input",), ("output",)]
        parts["links"] = links if links is not None else _above_all(parts)
        if links is not None and any(name.startswith("J") for name in names):
            numbers = range(1, links + 1)
            parts["link_names"] = [names.get(f"J{link}", str(link)) for link in numbers]
        return parts

    # Values of fields.

    def _error(self, label: str, message: str) -> None:
        self.found.error(f"{label}: {message}", *self.places.spots[label])

    def _missing(self, key: str, what: str = "") -> None:
        expected = f"expected {EXPECTED.get(key, what)}"
        name = key.partition("(")[0]
        for word, line in self.found.unknown.items():
            if nearest(word, [name]):
                expected += f"; line {line} starts with `{word}`"
                break
        line = self.found.last
        column = len(self.found.source.lines[line - 1]) + 1
        self.found.error(f"{key} is missing: {expected}", line, column)

    def _values(
        self,
        key: str,
        need: int,
        why: str,
        parse: Callable[[str], Number],
        paths: Callable[[int], Path],
    ) -> Values[Number]:
        """The values of a list, numbered from 1; `paths` tells which part each is."""
        field = self.found.fields.get(key)

        def label(position: int) -> str:
            name, _, index = key.partition("(I,")
            return f"{name}({position + 1},{index}" if index else f"{name}({position + 1})"

        if field is None:
            if need:
                self._missing(key, f"{need} values ({why})")
            values = stand_ins(field, need, parse)
        else:
            if key in ("INP(I)", "IOUT(I)"):
                key = key.removesuffix("(I)")
            values = take(self.found, field, Wanted(key, label, need, why), parse)
            self.places.spots.update(zip(map(label, range(need)), values.spots, strict=True))
        self.hidden += [paths(position + 1) for position in values.unreadable]
        return values

    def _scalar(self, key: str) -> int | None:
        """The value of a field of one value; None if it is missing or unreadable."""
        field = self.found.fields.get(key)
        if field is None:
            return None
        self.places.spots[key] = field.line, field.column
        values = take(self.found, field, Wanted(key, lambda _: key, 1, ""), integer)
        self.places.spots[key] = values.spots[0]
        return None if values.unreadable else values.numbers[0]

    def _size(self, key: str, lowest: int) -> int | None:
        size = self._scalar(key)
        if key not in self.found.fields:
            self._missing(key)
        elif size is not None and size < lowest:
            self._error(key, f"read {size}, expected at least {lowest}")
            size = None
        elif size is not None and not self._fits(key, size):
            size = None
        return size

    def _fits(self, label: str, size: int) -> bool:
        if size > self.capacity:
            message = f"a file of {self.capacity} characters cannot hold so many"
            self._error(label, f"read {size}, but {message}")
        return size <= self.capacity

    def _guess(self, key: str, part: Path) -> int:
        """A size that could not be read, from the list that it is for."""
        size = min(loose_count(self.found, key), self.capacity)
        if not size:
            self.hidden.append(part)
        return size
