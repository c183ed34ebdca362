"""Tables as a workbook (XLSX): a sheet for each table, with all digits."""

from __future__ import annotations

import io
import math
import re
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from vstatics.core.errors import CaseError
from vstatics.core.tables.grid import Datum, Grid

if TYPE_CHECKING:
    from openpyxl import Workbook

MOST_ROWS, MOST_COLUMNS = 1_048_576, 16_384
"""Largest number of rows and of columns of a sheet."""
LONGEST_SHEET_NAME = 31
"""Largest number of characters of the name of a sheet."""
CONTENTS = "tables"
_FORBIDDEN = re.compile(r"[\[\]:*?/\\\x00-\x1f]")
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
"""Characters that XML cannot contain."""
_EPOCH = (1980, 1, 1, 0, 0, 0)


def write(
    cases: Iterable[tuple[str, Sequence[Grid]]], *, several: bool, digits: int | None = None
) -> bytes:
    """Return the tables of cases as a workbook, with a sheet for tables of the same name.

    For several cases, the first column of a sheet contains the file of the case. A row of headings
    is written whenever the headings change. Tables of the same group share a sheet, with a column
    of titles. If tables have keys, the first sheet lists their titles. Equal tables result in equal
    bytes.

    Parameters
    ----------
    cases : iterable of (str, sequence of Grid)
        Files of the cases, with their tables.
    several : bool
        Whether the first column is the file of the case.
    digits : int, optional
        Number of visible decimals. The stored numbers have all digits.

    Raises
    ------
    CaseError
        If openpyxl is missing, or a table is larger than a sheet.
    """
    from vstatics.core.extras import require

    require("xlsx", "XLSX")
    from openpyxl import Workbook

    book = _Book(Workbook(write_only=True), several=several, digits=digits)
    for file, grids in cases:
        for grid in grids:
            book.add(file, grid)
    return book.data()


def sheet_data(sheets: Mapping[str, Sequence[Sequence[Any]]]) -> bytes:
    """Return a workbook of sheets by name, whose first row contains the headings.

    Equal sheets result in equal bytes.
    """
    from openpyxl import Workbook

    book = _Book(Workbook(write_only=True), several=False, digits=None)
    for name, (headings, *rows) in sheets.items():
        _Worksheet(book.book.create_sheet(name), book).add([], list(headings), rows)
    return book.saved()


class _Book:
    """Workbook under construction."""

    def __init__(self, book: Workbook, *, several: bool, digits: int | None) -> None:
        self.book = book
        self.several = several
        self.number_format = "General" if digits is None else f"0.{'0' * digits}"
        self.sheets: dict[str, _Worksheet] = {}
        self.names: set[str] = {CONTENTS, "history"}  # Excel reserves the name "history"
        self.titles: dict[str, str] = {}

    def add(self, file: str, grid: Grid) -> None:
        """Add a table, below the earlier tables of the sheet."""
        name = grid.group or grid.key or grid.title
        if name not in self.sheets:
            sheet = sheet_name(name, self.names)
            self.sheets[name] = _Worksheet(self.book.create_sheet(sheet), self)
            if grid.key:
                self.titles[sheet] = grid.title
        front = [file] * self.several + [grid.title] * bool(grid.group)
        heads = ["case"] * self.several + ["table"] * bool(grid.group)
        self.sheets[name].add(
            front, [*heads, *(column.heading for column in grid.columns)], grid.data
        )

    def data(self) -> bytes:
        """Return the bytes of the workbook, with a sheet of contents if necessary."""
        if self.titles or not self.sheets:
            contents = _Worksheet(self.book.create_sheet(CONTENTS, 0), self)
            contents.add([], ["sheet", "table"], list(map(list, self.titles.items())))
        return self.saved()

    def saved(self) -> bytes:
        """Return the content of the workbook file."""
        written = io.BytesIO()
        self.book.save(written)
        return _without_dates(written)


class _Worksheet:
    """Sheet under construction."""

    def __init__(self, sheet: Any, book: _Book) -> None:
        sheet.freeze_panes = "B2"
        sheet.column_dimensions["A"].width = 24
        self.sheet, self.book = sheet, book
        self.headings: list[str] = []
        self.rows = 0

    def add(self, front: Sequence[str], headings: list[str], rows: Sequence[Sequence[Any]]) -> None:
        """Add rows, after headings if these differ from the previous headings."""
        from openpyxl.styles import Font

        bold = Font(bold=True)
        new = headings != self.headings
        self.rows += len(rows) + new
        if self.rows > MOST_ROWS or len(headings) > MOST_COLUMNS:
            message = f"a sheet has {MOST_ROWS} rows and {MOST_COLUMNS} columns at most"
            raise CaseError("E115", f"{message}: expected another format, such as CSV")
        if new:
            self.sheet.append([self._cell(heading, bold) for heading in headings])
            self.headings = headings
        for row in rows:
            self.sheet.append([self._cell(datum) for datum in (*front, *row)])

    def _cell(self, datum: Datum, font: Any = None) -> Any:
        """Return a cell with a value. Texts never become formulas."""
        from openpyxl.cell import WriteOnlyCell

        if datum is None:
            return None
        if isinstance(datum, str):
            cell = WriteOnlyCell(self.sheet, _CONTROL.sub("�", datum))
            cell.data_type = "s"
        elif isinstance(datum, float) and math.isfinite(datum):
            cell = WriteOnlyCell(self.sheet, repr(float(datum)))  # openpyxl writes 16 digits
            cell.data_type = "n"
            cell.number_format = self.book.number_format
        else:
            cell = WriteOnlyCell(self.sheet, datum)
        if font is not None:
            cell.font = font
        return cell


def sheet_name(name: str, taken: set[str]) -> str:
    """Return a valid name for a sheet that is not in `taken`, and add the name to `taken`.

    >>> taken = set()
    >>> sheet_name("Gear 1/2: [low]", taken), sheet_name("gear 1 2  (low)", taken)
    ('Gear 1 2  (low)', 'gear 1 2  (low) 2')
    """
    plain = name.replace("[", "(").replace("]", ")")
    plain = _CONTROL.sub(" ", _FORBIDDEN.sub(" ", plain)).strip("' ") or "table"
    chosen, number = plain[:LONGEST_SHEET_NAME].strip("' "), 1
    while chosen.casefold() in taken:
        number += 1
        end = f" {number}"
        chosen = f"{plain[: LONGEST_SHEET_NAME - len(end)]}{end}"
    taken.add(chosen.casefold())
    return chosen


def _without_dates(written: io.BytesIO) -> bytes:
    """Return a workbook without creation times, so that equal tables result in equal bytes."""
    dateless = io.BytesIO()
    with (
        zipfile.ZipFile(written) as old,
        zipfile.ZipFile(dateless, "w", zipfile.ZIP_DEFLATED) as new,
    ):
        for name in old.namelist():
            data = old.read(name)
            if name == "docProps/core.xml":
                data = re.sub(rb"<dcterms:(created|modified).*?</dcterms:\1>", b"", data)
            new.writestr(zipfile.ZipInfo(name, _EPOCH), data, zipfile.ZIP_DEFLATED)
    return dateless.getvalue()
