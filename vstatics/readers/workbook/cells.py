"""Opens a workbook and gives the cells of its sheets, bounded in size whatever the file holds."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from vstatics.errors import CellPlace, Place, Problem, ReadError, of_file, quoted
from vstatics.extras import missing

if TYPE_CHECKING:
    from openpyxl import Workbook

MOST_BYTES = 50_000_000
"""Of all that is packed in a workbook."""
MOST_ROWS, MOST_COLUMNS = 10_000, 500
"""Of a sheet."""
MOST_CHARACTERS = 32_767
"""Of a cell."""


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
    needs = missing("xlsx", "a case in XLSX")
    if needs:
        raise ReadError([of_file("E014", file, needs)])
    values, formulas = (_opened(data, file, data_only=only) for only in (True, False))
    wanted, read, problems = {*wanted}, [], list[Problem]()
    for name in values.sheetnames:
        rows = []
        if name in wanted:
            try:
                pairs = zip(_rows(values[name]), _rows(formulas[name]), strict=True)
                rows = [
                    _cells(CellPlace.of(Place(file, number, 0), name), *pair, problems)
                    for number, pair in enumerate(pairs, 1)
                ]
                problems += _merged(data, values[name], file)
            except Exception as error:  # noqa: BLE001 - whatever openpyxl meets in a file that is none
                raise _no_workbook(file, error, name) from None
        read.append(ReadSheet(name, [row for row in rows if row]))
    if problems:
        raise ReadError(problems)
    return read


def _opened(data: bytes, file: str, *, data_only: bool) -> Workbook:
    """A workbook, or an error that it is none."""
    from openpyxl import load_workbook

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            size = sum(one.file_size for one in packed.infolist())
        if size > MOST_BYTES:
            message = f"{size / 1e6:.0f} MB when unpacked, expected at most {MOST_BYTES / 1e6:.0f}"
            raise ValueError(message)  # noqa: TRY301 - told as all others
        return load_workbook(io.BytesIO(data), read_only=True, data_only=data_only)
    except Exception as error:  # noqa: BLE001 - whatever openpyxl meets in a file that is none
        raise _no_workbook(file, error) from None


def _no_workbook(file: str, error: Exception, sheet: str = "") -> ReadError:
    told = " ".join(str(error).split()) or type(error).__name__
    of = f"sheet {quoted(sheet)}: " if sheet else ""
    return ReadError([of_file("E117", file, f"can't be read as a workbook: {of}{told}")])


def _rows(sheet: Any) -> Iterator[tuple[Any, ...]]:
    """Rows of cells.

    Raises
    ------
    ValueError
        If there are more than a case has.
    """
    if not hasattr(sheet, "reset_dimensions"):
        return  # a chart
    sheet.reset_dimensions()  # what a file says of its size need not be so
    for number, row in enumerate(sheet.iter_rows(), 1):
        if number > MOST_ROWS or len(row) > MOST_COLUMNS:
            raise ValueError(f"expected at most {MOST_ROWS} rows and {MOST_COLUMNS} columns")
        yield row


_MERGED = re.compile(rb'<mergeCell [^>]*ref="([A-Z]{1,3})(\d{1,7}):([A-Z]{1,3}\d{1,7})"')


def _merged(data: bytes, sheet: Any, file: str) -> Iterator[Problem]:
    """Cells that are one: only the first of them has a value, the others would be empty."""
    from openpyxl.utils import column_index_from_string

    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        written = packed.read(sheet._worksheet_path)  # noqa: SLF001 - cells that are streamed lack it
    for column, row, last in _MERGED.findall(written):
        first = column.decode()
        place = Place(file, int(row), column_index_from_string(first))
        message = (
            f"{first}{int(row)}:{last.decode()} are merged into one cell, expected a value in "
        )
        yield Problem(
            "E118", f"{message}each: unmerge and fill them", (), CellPlace.of(place, sheet.title)
        )


def _cells(
    place: CellPlace, values: Sequence[Any], formulas: Sequence[Any], problems: list[Problem]
) -> list[ReadCell]:
    """The cells of a row, what is wrong with them put to the problems."""
    read = []
    pairs = zip(values, formulas, strict=True)
    for column, (value, formula) in enumerate(pairs, 1):
        try:
            text = _text(value.value, value.data_type, formula.value)
        except ValueError as error:
            at = CellPlace.of(place._replace(column=column), place.sheet)
            problems.append(Problem("E118", str(error), (), at))
            continue
        if text:
            read.append(ReadCell(text, place.line, column))
    return read


def _text(value: Any, kind: str, formula: Any) -> str:
    """What a cell says, nothing where it is empty.

    Raises
    ------
    ValueError
        If it says nothing to a case.
    """
    if kind == "e":
        raise ValueError(f"read {value}, expected a number or a text")
    if value is None:
        if formula is not None:
            message = "a formula without its value: save the file in a spreadsheet program"
            raise ValueError(message)
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, int | float):
        return repr(value)
    read = f"read a date or time, {value}"
    hint = "a fraction is a text, '78/30, or a formula, =78/30"
    raise ValueError(f"{read}, expected a number or a text; {hint}")
