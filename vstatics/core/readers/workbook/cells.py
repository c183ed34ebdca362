"""Gives the cells of the sheets of a workbook, bounded in number whatever the file holds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from vstatics.core.errors import CellPlace, Place, Problem, ReadError, of_file, quoted
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.readers.workbook.parts import PackedParts

MOST_ROWS, MOST_COLUMNS = 10_000, 500
"""Of a sheet."""
MOST_SHEET_CELLS = 200_000
"""Bound of the cells of a sheet, also of those without a value."""
MOST_CHARACTERS = 32_767
"""Of a cell."""
_PLACE = re.compile(r"\$?([A-Za-z]{1,3})\$?(\d{1,7})")
_DATE = "d"


class ReadCell(NamedTuple):
    """A cell that says something."""

    text: str
    """As it stands there; of numbers and switches as YAML has them."""
    row: int
    column: int


class ReadSheet(NamedTuple):
    """The cells of a sheet by rows, without those that are empty."""

    name: str
    rows: list[list[ReadCell]]


def read_sheets(data: bytes, file: str, wanted: Iterable[str]) -> list[ReadSheet]:
    """The cells of some sheets of a workbook, and names of all others, which have no rows.

    Raises
    ------
    ReadError
        If it is no workbook, is larger than any case, or has cells that say nothing.
    """
    try:
        parts = PackedParts(data)
    except Exception as error:  # noqa: BLE001 - whatever a file that is none holds
        raise _no_workbook(file, error) from None
    wanted, read, problems = {*wanted}, [], list[Problem]()
    for name, path in parts.sheets.items():
        sheet = _SheetElements(CellPlace.of(Place(file, 1, 1), name), parts, problems)
        if name in wanted and path:
            try:
                parts.parse(path, sheet.start, sheet.end, sheet.text)
            except ReadError:
                raise
            except Exception as error:  # noqa: BLE001 - likewise
                raise _no_workbook(file, error, name) from None
        read.append(ReadSheet(name, [row for row in sheet.rows if row]))
    if problems:
        raise ReadError(problems)
    return read


def _no_workbook(file: str, error: Exception, sheet: str = "") -> ReadError:
    told = " ".join(str(error).split()) or type(error).__name__
    of = f"sheet {quoted(sheet)}: " if sheet else ""
    return ReadError([of_file("E117", file, f"can't be read as a workbook: {of}{told}")])


class _SheetElements:
    """The cells of a sheet, as its elements come."""

    def __init__(self, place: CellPlace, parts: PackedParts, problems: list[Problem]) -> None:
        self.rows: list[list[ReadCell]] = []
        self._place, self._parts, self._problems = place, parts, problems
        self._row = self._column = self._cells = 0
        self._about: Mapping[str, str] = {}
        """Of the cell that is being read."""
        self._said: dict[str, list[str]] = {}
        """Value, formula and text of it."""
        self._inside: list[str] = []

    def start(self, name: str, given: Mapping[str, str]) -> None:
        """Begin an element."""
        self._inside.append(name)
        if name == "row":
            self._begin_row(int(given.get("r", self._row + 1)))
        elif name == "c":
            self._begin_cell(given)
        elif name in ("v", "f", "t"):
            self._said.setdefault(name, [])
        elif name == "mergeCell":
            self._merged(given.get("ref", ""))

    def text(self, read: str) -> None:
        """Keep a text of the cell."""
        if self._inside[-1] in ("v", "f", "t") and "rPh" not in self._inside:
            self._said[self._inside[-1]].append(read)

    def end(self, name: str) -> None:
        """End an element."""
        self._inside.pop()
        if name == "c":
            try:
                text = self._value()
            except ValueError as error:
                self._tell(str(error), self._row, self._column)
                return
            if text:
                self.rows[-1].append(ReadCell(text, self._row, self._column))

    def _begin_row(self, number: int) -> None:
        if number <= self._row:
            raise ValueError(f"row {number} is not in order")
        self._row, self._column = number, 0
        self._check()
        self.rows.append([])

    def _begin_cell(self, given: Mapping[str, str]) -> None:
        place = _PLACE.fullmatch(given.get("r", ""))
        column = _column_of(place[1]) if place else self._column + 1
        if column <= self._column or not self.rows:
            raise ValueError(f"cell {given.get('r', '')} is not in order")
        self._about, self._said = given, {}
        self._column = column
        self._cells += 1
        self._check()

    def _check(self) -> None:
        if self._row > MOST_ROWS or self._column > MOST_COLUMNS:
            raise ValueError(f"expected at most {MOST_ROWS} rows and {MOST_COLUMNS} columns")
        if self._cells > MOST_SHEET_CELLS:
            raise ValueError(f"expected at most {MOST_SHEET_CELLS} cells")

    def _value(self) -> str:
        """What the cell says, nothing where it is empty.

        Raises
        ------
        ValueError
            If it says nothing to a case.
        """
        kind = self._about.get("t", "n")
        value = "".join(self._said.get("t" if kind == "inlineStr" else "v", ()))
        if not value:
            if "f" in self._said:
                message = "a formula without its value: save the file in a spreadsheet program"
                raise ValueError(message)
            return ""
        if kind == "e":
            raise ValueError(f"read {value}, expected a number or a text")
        if kind == "s":
            return self._parts.texts[_index(value)].strip()
        if kind == "b":
            return "true" if value.strip() == "1" else "false"
        if kind in ("str", "inlineStr"):
            return value.strip()
        number = _number(value) if kind == "n" else value
        style = self._about.get("s", "0")
        if kind == _DATE or (style != "0" and _index(style) in self._parts.dates):
            read = f"read a date or time, {self._parts.date(value)}"
            hint = "a fraction is a text, '78/30, or a formula, =78/30"
            raise ValueError(f"{read}, expected a number or a text; {hint}")
        return number

    def _merged(self, ref: str) -> None:
        """Cells that are one: only the first of them has a value, the others would be empty."""
        first, _, last = ref.partition(":")
        place = _PLACE.fullmatch(first)
        if place and last:
            message = (
                f"{ref} are merged into one cell, expected a value in each: unmerge and fill them"
            )
            self._tell(message, int(place[2]), _column_of(place[1]))

    def _tell(self, message: str, row: int, column: int) -> None:
        at = CellPlace.of(self._place._replace(line=row, column=column), self._place.sheet)
        self._problems.append(Problem("E118", message, (), at))
        if len(self._problems) >= MOST_PROBLEMS:
            raise ReadError(self._problems)


def _column_of(letters: str) -> int:
    """The number of a column from 1.

    >>> _column_of("A"), _column_of("XFD")
    (1, 16384)
    """
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _number(text: str) -> str:
    """A number as Python writes it.

    >>> _number("-3.5"), _number("1E3"), _number("97")
    ('-3.5', '1000.0', '97')
    """
    is_whole = text.strip("-+ ").isdecimal()
    try:
        return repr(int(text) if is_whole and len(text) < 400 else float(text))
    except ValueError:
        raise ValueError(f"read {quoted(text[:40])}, expected a number") from None


def _index(text: str) -> int:
    """A number of a shared text or a format, from 0.

    Raises
    ------
    LookupError
        If it is something else: the workbook is damaged.
    """
    if not (text.isascii() and text.isdecimal() and len(text) < 10):
        raise LookupError(f"there is no text or format {quoted(text[:40])}")
    return int(text)
