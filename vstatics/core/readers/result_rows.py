"""Readers of results with a single number per row, in CSV or Parquet."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Sequence

from vstatics.core.errors import ReadError
from vstatics.core.readers.reading import Source
from vstatics.core.readers.sweep_tables import open_parquet
from vstatics.core.tables.csv import unguarded
from vstatics.core.tables.quantities import BY_NAME
from vstatics.core.tables.written_results import Figure, WrittenResult


def no_result(message: str, file: str, line: int = 0, column: int = 1) -> ReadError:
    """Return the error that a file contains no result."""
    return ReadError("E110", message, place=Source(file, "").place(line, column))


COLUMNS = ["table", "row", "gear", "value"]
ABOUT = ("conventions", "program")
"""Values of the column `table` that mark rows with a text instead of a number."""
PARQUET = b"PAR1"
_Cells = dict[str, dict[str, dict[str, Figure]]]
"""Figures of a result: by table, by row, and by gear or device."""


def finite_figure(value: str | float | None) -> Figure:
    """Return a number or its text as a figure; None becomes NaN.

    Raises
    ------
    ValueError
        If the number is infinite, or the text is not a number.
    """
    number = math.nan if value is None else float(value)
    if math.isinf(number):
        raise ValueError("expected a finite number")
    return Figure(number)


def is_csv(text: str) -> bool:
    """Return whether a text begins with the headings of a result in CSV."""
    return text.partition("\n")[0].strip().split(",") in (COLUMNS, ["case", *COLUMNS])


def read_csv(text: str, file: str) -> list[WrittenResult]:
    """Read the results of a CSV file, in the order of the file.

    Raises
    ------
    ReadError
        If a line is not a row of a result, a value is neither empty nor a finite number, a table
        has too many rows, or the file contains no result.
    """
    lines = _csv_lines(text, file)
    has_case = next(lines)[1][0] == "case"
    results: dict[str, _Cells] = {}
    for number, row in lines:
        cells = [unguarded(cell) for cell in row]
        case = cells.pop(0) if has_case and cells else ""
        if not cells or cells[0] in ABOUT:
            continue
        if len(cells) != len(COLUMNS) or cells[0] not in BY_NAME:
            raise no_result(
                "no row of a result in CSV: expected table,row,gear,value", file, number
            )
        table, name, gear, value = cells
        try:
            figure = finite_figure(value or None)
        except ValueError:
            raise no_result(f"read {value!r}, expected a finite number", file, number) from None
        _put(results, case, (table, name, gear), figure)
    return _made(results, file)


def is_parquet(data: bytes) -> bool:
    """Return whether a file is Parquet with the columns of results, not of a sweep."""
    footer = data[-8 - int.from_bytes(data[-8:-4], "little") :]
    return data.startswith(PARQUET) and all(name.encode() in footer for name in ("case", *COLUMNS))


def read_parquet(data: bytes, file: str) -> list[WrittenResult]:
    """Read the results of a Parquet file, in the order of the file.

    Raises
    ------
    ReadError
        If the file cannot be read or contains no valid result, or the package for Parquet is
        missing.
    """
    results: dict[str, _Cells] = {}
    try:
        opened = open_parquet(data, file)
        for batch in opened.iter_batches(columns=["case", *COLUMNS], use_threads=False):
            for case, table, name, gear, value in zip(
                *(column.to_pylist() for column in batch.columns), strict=True
            ):
                figure = finite_figure(value)
                _put(
                    results, str(case or ""), (str(table), str(name or ""), str(gear or "")), figure
                )
    except ReadError:
        raise
    except Exception as error:  # noqa: BLE001 (pyarrow has many classes of errors)
        text = " ".join(str(error).split())
        raise no_result(f"no results in Parquet: {text[:200]}", file) from None
    return _made(results, file)


def _put(
    results: dict[str, _Cells], case: str, place: tuple[str, str, str], figure: Figure
) -> None:
    table, name, gear = place
    quantity = BY_NAME[table]  # in version 1, results had names of the deck
    if quantity.columns == "devices":
        name, _, gear = name.rpartition(":")
    results.setdefault(case, {}).setdefault(quantity.name, {}).setdefault(name, {})[gear] = figure


def _made(results: dict[str, _Cells], file: str) -> list[WrittenResult]:
    if not results:
        raise no_result("the file contains no result", file)
    return [checked(_result(case, cells), file) for case, cells in results.items()]


def checked(result: WrittenResult, file: str, line: int = 0) -> WrittenResult:
    """Return a result after checking that tables with a value per gear have a single row.

    Raises
    ------
    ReadError
        If a table with one value per gear has several rows.
    """
    for key, rows in result.tables.items():
        if BY_NAME[key].rows == "one" and len(rows) != 1:
            raise no_result(f"{key} has {len(rows)} rows, expected one", file, line)
    return result


def _csv_lines(text: str, file: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of a CSV file with line numbers. A carriage return also ends a line."""
    lines = csv.reader(io.StringIO(text, newline=None))
    try:
        for row in lines:
            yield lines.line_num, row
    except csv.Error as error:
        raise no_result(f"the file is not CSV: {error}", file, lines.line_num) from None


def _result(file: str, tables: _Cells) -> WrittenResult:
    figures, rows = {}, {}
    gears: Sequence[str] = ()
    devices: Sequence[str] = ()
    for key, table in tables.items():
        figures[key] = [list(row.values()) for row in table.values()]
        if BY_NAME[key].rows != "one":
            rows[key] = list(table)
        columns = list(next(iter(table.values())))
        if BY_NAME[key].columns == "devices":
            devices = columns
        else:
            gears = max(gears, columns, key=len)
    return WrittenResult(
        figures, None, printed=False, rows=rows, file=file, gears=gears, devices=devices
    )
