"""Reader of the cells in the sheets of a workbook, with limits on their number."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from vstatics.core.errors import CellPlace, Place, Problem, ReadError, of_file, quoted
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.readers.workbook.parts import PackedParts

MOST_ROWS, MOST_COLUMNS = 10_000, 500
"""Maximum number of rows and columns of a sheet, up to the last cell with a value."""
MOST_SHEET_CELLS = 200_000
"""Maximum number of cells of a sheet, including cells without a value."""
MOST_CELL_CHARACTERS = 32_767
"""Maximum number of characters of a cell, as in Excel."""
_PLACE = re.compile(r"\$?([A-Za-z]{1,3})\$?(\d{1,7})")
_DATE = "d"


class ReadCell(NamedTuple):
    """Cell with a value."""

    text: str
    """Text of the cell, with numbers and booleans written as in YAML."""
    row: int
    column: int


class ReadSheet(NamedTuple):
    """Cells of a sheet by rows, without empty cells."""

    name: str
    rows: list[list[ReadCell]]


def read_sheets(data: bytes, file: str, wanted: Iterable[str]) -> list[ReadSheet]:
    """Read the cells of the sheets `wanted` of a workbook. Other sheets have no rows.

    Capitals in the name of a sheet do not matter, nor do blanks around the name.

    Raises
    ------
    ReadError
        If the file is not a workbook, is too large, or contains cells that cannot be read.
    """
    try:
        parts = PackedParts(data)
    except Exception as error:  # noqa: BLE001 (damaged files raise many classes of errors)
        raise _no_workbook(file, error) from None
    wanted, read, problems = {*wanted}, list[ReadSheet](), list[Problem]()
    for title, path in parts.sheets.items():
        sheet = _SheetElements(CellPlace.of(Place(file, 1, 1), title), parts, problems)
        meant = title.strip().lower()
        known = {*parts.sheets, *(other.name for other in read)}
        name = meant if meant in wanted - known else title
        if name in wanted and path:
            try:
                parts.parse(path, sheet.start, sheet.end, sheet.text)
            except ReadError:
                raise
            except Exception as error:  # noqa: BLE001 (as above)
                raise _no_workbook(file, error, title) from None
        read.append(ReadSheet(name, [row for row in sheet.rows if row]))
    if problems:
        raise ReadError(problems)
    return read


def _no_workbook(file: str, error: Exception, sheet: str = "") -> ReadError:
    reason = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, (zipfile.BadZipFile, KeyError)):
        reason = "it is damaged or has another format; save it as .xlsx in a spreadsheet program"
    of = f"sheet {quoted(sheet)}: " if sheet else ""
    return ReadError([of_file("E117", file, f"cannot be read as a workbook: {of}{reason}")])


class _SheetElements:
    """Handler of the XML elements of a sheet, which collects the cells."""

    def __init__(self, place: CellPlace, parts: PackedParts, problems: list[Problem]) -> None:
        self.rows: list[list[ReadCell]] = []
        self._place, self._parts, self._problems = place, parts, problems
        self._row = self._column = self._cells = 0
        self._attributes: Mapping[str, str] = {}
        """Attributes of the current cell."""
        self._contents: dict[str, list[str]] = {}
        """Value, formula and text of the current cell."""
        self._inside: list[str] = []

    def start(self, name: str, given: Mapping[str, str]) -> None:
        """Handle the start of an element."""
        self._inside.append(name)
        if name == "row":
            self._begin_row(int(given.get("r", self._row + 1)))
        elif name == "c":
            place = _PLACE.fullmatch(given.get("r", ""))
            column = _column_of(place[1]) if place else self._column + 1
            if column <= self._column or not self.rows:
                raise ValueError(f"cell {given.get('r', '')} is not in order")
            self._attributes, self._contents = given, {}
            self._column = column
            self._cells += 1
            if self._cells > MOST_SHEET_CELLS:
                raise ValueError(f"expected at most {MOST_SHEET_CELLS} cells")
        elif name in ("v", "f", "t"):
            self._contents.setdefault(name, [])
        elif name == "mergeCell":
            self._merged(given.get("ref", ""))

    def text(self, read: str) -> None:
        """Add a piece of text to the current cell."""
        if self._inside[-1] in ("v", "f", "t") and "rPh" not in self._inside:
            self._contents[self._inside[-1]].append(read)

    def end(self, name: str) -> None:
        """Handle the end of an element."""
        self._inside.pop()
        if name == "c":
            try:
                text = self._value()
            except ValueError as error:
                self._report(str(error), self._row, self._column)
                return
            if text and (self._row > MOST_ROWS or self._column > MOST_COLUMNS):
                raise ValueError(f"expected at most {MOST_ROWS} rows and {MOST_COLUMNS} columns")
            if text:
                self.rows[-1].append(ReadCell(text, self._row, self._column))

    def _begin_row(self, number: int) -> None:
        if number <= self._row:
            raise ValueError(f"row {number} is not in order")
        self._row, self._column = number, 0
        if not self.rows or self.rows[-1]:
            self.rows.append([])

    def _value(self) -> str:
        """Return the text of the current cell; empty for an empty cell.

        Raises
        ------
        ValueError
            If the cell contains an error, a date, or a formula without its value.
        """
        kind = self._attributes.get("t", "n")
        value = "".join(self._contents.get("t" if kind == "inlineStr" else "v", ()))
        if not value:
            is_text = kind == "str" and "v" in self._contents
            if "f" in self._contents and not is_text:
                raise ValueError(
                    "a formula without its value: save the file in a spreadsheet program"
                )
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
        style = self._attributes.get("s", "0")
        if kind == _DATE or (style != "0" and _index(style) in self._parts.dates):
            read = f"read a date or time, {self._parts.date(value)}"
            hint = "a fraction is a text, '78/30, or a formula, =78/30"
            raise ValueError(f"{read}, expected a number or a text; {hint}")
        return number

    def _merged(self, ref: str) -> None:
        """Report merged cells, because all except the first would seem empty."""
        first, _, last = ref.partition(":")
        place = _PLACE.fullmatch(first)
        if place and last:
            self._report(
                f"{ref} are merged into one cell, expected a value in each cell: "
                "unmerge and fill them",
                int(place[2]),
                _column_of(place[1]),
            )

    def _report(self, message: str, row: int, column: int) -> None:
        at = CellPlace.of(self._place._replace(line=row, column=column), self._place.sheet)
        self._problems.append(Problem("E118", message, (), at))
        if len(self._problems) >= MOST_PROBLEMS:
            raise ReadError(self._problems)


def _column_of(letters: str) -> int:
    """Return the number of a column, from 1.

    >>> _column_of("A"), _column_of("XFD")
    (1, 16384)
    """
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _number(text: str) -> str:
    """Return a number as text in the notation of Python.

    >>> _number("-3.5"), _number("1E3"), _number("97")
    ('-3.5', '1000.0', '97')
    """
    is_whole = text.strip("-+ ").isdecimal()
    try:
        return repr(int(text) if is_whole and len(text) < 400 else float(text))
    except ValueError:
        raise ValueError(f"read {quoted(text[:40])}, expected a number") from None


def _index(text: str) -> int:
    """Return the index of a shared text or a format, from 0.

    Raises
    ------
    LookupError
        If the text is not an index, because the workbook is damaged.
    """
    if not (text.isascii() and text.isdecimal() and len(text) < 10):
        raise LookupError(f"there is no text or format {quoted(text[:40])}")
    return int(text)
