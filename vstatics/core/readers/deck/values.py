"""Readers of the values in a field of a deck, which check the number of values."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache, partial
from typing import Generic, NamedTuple

from vstatics.core.errors import count_of
from vstatics.core.readers.deck.numbers import (
    DECIMAL_COMMA,
    NotANumberError,
    Number,
    Parse,
    Spot,
    Token,
    is_attempt,
    is_number,
    leading_numbers,
    numbers_alone,
    plain_numbers,
    real,
    repeated,
    starts_values,
    token_lines,
    value_lines,
    worked_out,
)
from vstatics.core.readers.deck.text import KEPT_CHARACTERS, Field, Scan

_CALCULATES = {sign: sign for sign in "%:/*+-"} | {"x": "*", "×": "*", "÷": "/"}
"""Signs after a number that continue a calculation, with the operators used in YAML."""
_DIGITS = tuple("0123456789")

STAND_IN = "-1"
"""Text that replaces an unreadable value. No link or other part has the number -1."""


class Values(NamedTuple, Generic[Number]):
    """Values of a field, with stand-ins for unreadable values."""

    numbers: list[Number]
    spots: Callable[[], list[Spot]]
    """Function that returns the place of each value, called only when places are needed."""
    unreadable: set[int]
    """Positions (from 0) of missing or unreadable values; all positions if there are too many
    values.
    """


class Wanted(NamedTuple):
    """Number and description of the values that a field must contain."""

    name: str
    label: Callable[[int], str]
    """Function from a position (from 0) to the label of a value, such as ``IAB(1)``."""
    need: int
    why: str
    """Name of the field that prescribes the number of values, such as ``KG``."""


def take(scan: Scan, field: Field, wanted: Wanted, parse: Parse[Number]) -> Values[Number]:
    """Read the values of a field, and add errors to `scan`."""
    plain = _plain(scan, field, wanted.need, parse)
    return _take_with_care(scan, field, wanted, parse) if plain is None else plain[0]


def _take_with_care(
    scan: Scan, field: Field, wanted: Wanted, parse: Parse[Number]
) -> Values[Number]:
    """Read a field token by token, because it contains errors or repeat counts."""
    ending = partial(_ending, scan, field)
    taker = _ValueReader(scan, (field.line, field.value + 1), wanted, parse, ending)
    return taker.take(token_lines(scan, field))


def take_rows(
    scan: Scan,
    field: Field,
    counts: Sequence[int],
    counted: str,
    parse: Parse[Number],
) -> Values[Number]:
    """Read the values of all gears: all on a line, or a line for each gear that has values."""
    plain = _plain(scan, field, sum(counts), parse)
    if plain is not None and (len(plain[1]) < 2 or plain[1] == [n for n in counts if n]):
        return plain[0]
    gears = [gear for gear, count in enumerate(counts, 1) if count]
    rows = _rows(scan, field, len(gears))
    if len(rows) < 2:
        names = list(row_labels(field.key, counts))
        wanted = Wanted(
            field.key, lambda n: names[n] if n < len(names) else field.key, len(names), counted
        )
        return _take_with_care(scan, field, wanted, parse)
    if len(rows) != len(gears):
        surplus = rows[len(gears) : len(gears) + 1]
        spot = surplus[0][0].spot if surplus else (rows[-1][-1].line, rows[-1][-1].after)
        expected = f"expected {len(gears)} (one for each gear with {counted} above 0)"
        end = "" if surplus else f" before {_ending(scan, field, spot[0] + 1)}"
        scan.error(f"{field.key}: read {len(rows)} lines of numbers{end}, {expected}", *spot)
        return stand_ins(field, sum(counts), parse)
    numbers: list[Number] = []
    spots = []
    unreadable: set[int] = set()
    for gear, tokens in zip(gears, rows, strict=True):
        wanted = _row(field.key, gear, counts[gear - 1], counted)
        taker = _ValueReader(scan, tokens[0].spot, wanted, parse, lambda _: "the end of the line")
        row = taker.take([tokens])
        unreadable.update(len(numbers) + position for position in row.unreadable)
        numbers.extend(row.numbers)
        spots.extend(row.spots())
    return Values(numbers, lambda: spots, unreadable)


def row_labels(key: str, counts: Sequence[int]) -> Iterator[str]:
    """Yield the labels of the values of each gear, such as ``NFRI(1,2)``."""
    for gear, count in enumerate(counts, 1):
        for position in range(1, count + 1):
            yield f"{key}({position},{gear})"


def stand_ins(field: Field | None, need: int, parse: Parse[Number]) -> Values[Number]:
    """Return stand-ins for the values of a missing or unreadable field."""
    spot = (field.line, field.column) if field else (0, 0)
    return Values([parse(STAND_IN)] * need, lambda: [spot] * need, set(range(need)))


_cached_plain_numbers = lru_cache(maxsize=2000)(plain_numbers)


def _plain(
    scan: Scan, field: Field, need: int, parse: Parse[Number]
) -> tuple[Values[Number], list[int]] | None:
    """Read a field of plain numbers fast; return the values and the number of values per line.

    The result is None unless the field contains exactly `need` plain numbers, followed only by
    prose on later lines. Other fields must be read token by token.
    """
    numbers: list[Number] = []
    counts = []
    for _, line, start, end in value_lines(scan, field):
        text = line[start:end]
        if len(numbers) == need:
            first = text.lstrip()[:1]
            if first and first in "+-.,0123456789":
                return None
            if first:
                break
            continue
        row = (_cached_plain_numbers if len(text) <= KEPT_CHARACTERS else plain_numbers)(
            text, parse
        )
        if row is None:
            return None
        if row:
            numbers += row
            counts.append(len(row))
    if len(numbers) != need:
        return None

    def spots() -> list[Spot]:
        return [token.spot for tokens in token_lines(scan, field) for token in tokens][:need]

    return Values(numbers, spots, set()), counts


def _rows(scan: Scan, field: Field, expected: int) -> list[list[Token]]:
    """Return the tokens of a field's lines of numbers, up to the first line of prose."""
    rows: list[list[Token]] = []
    for tokens in token_lines(scan, field):
        if not numbers_alone(tokens) and (len(rows) >= expected or not starts_values(tokens)):
            break
        rows.append(tokens)
    return rows


def _row(key: str, gear: int, need: int, counted: str) -> Wanted:
    """Return the description of the values of a gear, which has a separate line."""

    def label(position: int) -> str:
        return f"{key}({position + 1},{gear})"

    return Wanted(label(0), label, need, f"{counted}({gear})")


def _ending(scan: Scan, field: Field, line: int) -> str:
    """Return words for the text after the values: prose, a field, or the end."""
    lines = scan.source.lines
    if field.end is not None:
        return f"'{lines[field.line - 1][field.end - 1 :].strip()[:30]}'"
    while line <= scan.last and not lines[line - 1].strip():
        line += 1
    if line > scan.last:
        return "the end of the input"
    return f"'{lines[line - 1].strip()[:30]}' in line {line}"


class _ValueReader(Generic[Number]):
    """Reader of the values of a field, token by token."""

    def __init__(
        self,
        scan: Scan,
        start: Spot,
        wanted: Wanted,
        parse: Parse[Number],
        ending: Callable[[int], str],
    ) -> None:
        self.scan, self.wanted, self.ending = scan, wanted, ending
        self.parse: Parse[Number] = parse
        self.need = wanted.need
        self.numbers: list[Number] = []
        self.spots: list[Spot] = []
        self.unreadable: set[int] = set()
        self.start = self.end = start
        self.total = 0
        self.surplus: Token | None = None
        self.after_comma = True
        self.failed = False
        self.complete_at = 0
        """Number of the line on which the field is complete, counting mistyped values."""

    def take(self, lines: Iterable[list[Token]]) -> Values[Number]:
        """Read all values, and check the number of values."""
        for tokens in lines:
            later = tokens[0].line > self.start[0]
            if later and self.total >= self.need and not numbers_alone(tokens):
                break
            if (later and not starts_values(tokens)) or not self._line(tokens):
                break
        if not self.failed and self.total != self.need:
            self._count()
        missing = range(len(self.numbers), self.need)
        self.unreadable.update(missing)
        self.numbers.extend([self.parse(STAND_IN)] * len(missing))
        self.spots.extend([self.start] * len(missing))
        return Values(self.numbers, lambda: self.spots, self.unreadable)

    def _line(self, tokens: list[Token]) -> bool:
        """Read the values of a line; return whether the next line can contain further values."""
        for position, token in enumerate(tokens):
            if token.text == ",":
                if not self._comma(token):
                    return False
                continue
            self.after_comma = False
            try:
                count, number = repeated(token, self.parse)
            except NotANumberError as error:
                if self.total >= self.need and not is_number(token):
                    self._check_behind(tokens[:position], tokens[position:])
                    return False  # prose after the last value
                if self.total < self.need and not self._wrong(token, error, tokens[position:]):
                    return False
                count, number = 1, self.parse(STAND_IN)
            needed = min(count, max(self.need - self.total, 0))
            self.numbers.extend([number] * needed)
            self.spots.extend([token.spot] * needed)
            self.total += count
            self.end = token.line, token.after
            if self.total > self.need and self.surplus is None:
                self.surplus = token
        return True

    def _check_behind(self, before: list[Token], behind: list[Token]) -> None:
        """Report an operator after the last value, which would otherwise be read as prose."""
        if self.parse is not real or not before or before[-1].text == ",":
            return
        sign = behind[0].text[0]
        operand = behind[0].text[1:] or "".join(token.text for token in behind[1:2])
        if sign not in _CALCULATES or (sign != "%" and operand.lstrip("+-.")[:1] not in _DIGITS):
            return
        shown = f"{before[-1].text} {sign}" + f" {operand}" * (sign != "%")
        hint = ""
        with suppress(NotANumberError):
            second = "" if sign == "%" else repr(real(operand))
            number = worked_out(f"{real(before[-1].text)!r} {_CALCULATES[sign]} {second}")
            hint = f": write {number:.12g}"
        label = self.wanted.label(self.total - 1)
        self._fail(f"{label}: read '{shown[:60]}', expected a number{hint}", before[-1])

    def _comma(self, token: Token) -> bool:
        if self.after_comma and self.total < self.need:
            what = "two commas with nothing between" if self.total else "nothing before the comma"
            label, hint = self.wanted.label(self.total), self._hint(token.line)
            self._fail(f"{label}: {what}, expected a number{hint}", token)
            return False
        self.after_comma = True
        return True

    def _wrong(self, token: Token, error: NotANumberError, unread: list[Token]) -> bool:
        """Report a token that is not a number; return whether values can follow."""
        hint = self._hint(token.line) if token.text in "+-" else ""
        label = self.wanted.label(self.total)
        self._fail(f"{label}: read '{token.text[:30]}', {error}{hint}", token)
        if not is_attempt(token):
            return False
        if self.complete_at != token.line:
            left = sum(max(leading_numbers([token]), 1) for token in unread if token.text != ",")
            if left != self.need - self.total:
                return False
            self.complete_at = token.line
        self.unreadable.add(len(self.numbers))
        return True

    def _fail(self, message: str, token: Token) -> None:
        self.scan.error(message, *token.spot)
        self.failed = True

    def _count(self) -> None:
        """Report too few or too many values."""
        expected = (
            f"expected {self.need} ({self.wanted.why})" if self.wanted.why else "expected one"
        )
        read = f"read {count_of('value', self.total)}"
        if self.surplus is None:
            label = self.wanted.label(self.total)
            end = self.ending(self.end[0] + 1)
            hint = self._hint(self.end[0] + 1)
            self.scan.error(f"{label}: {read} before {end}, {expected}{hint}", *self.end)
        else:
            hint = self._hint(self.surplus.line)
            self.scan.error(f"{self.wanted.name}: {read}, {expected}{hint}", *self.surplus.spot)
            self.unreadable.update(range(self.need))

    def _hint(self, last: int) -> str:
        """Return a hint about decimal commas, if the lines contain any."""
        first, column = self.start
        lines = self.scan.source.lines[first - 1 : last]
        lines[0] = lines[0][column - 1 :]
        likely = self.parse is real and any(re.search(DECIMAL_COMMA, line) for line in lines)
        return "; write a decimal point, not a decimal comma" if likely else ""
