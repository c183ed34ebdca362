"""Written results, a listing, JSON or CSV, back to tables of numbers, for comparison."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.errors import ReadError
from vstatics.model.transmission import Transmission
from vstatics.readers import Format, read
from vstatics.readers.deck.text import decode, head
from vstatics.readers.reading import Source
from vstatics.tables.csv import unguarded
from vstatics.tables.names import BEFORE_NAME
from vstatics.tables.quantities import BY_NAME, PRINTED, QUANTITIES
from vstatics.tables.written_results import Figure, Figures, WrittenResult


def read_results(data: bytes, file: str) -> list[WrittenResult]:
    """Read a listing, JSON, JSON lines or CSV; several in one file come in their order.

    Raises
    ------
    ReadError
        If the text is no result.
    """
    text = decode(data, file)
    if text.lstrip()[:1] in ("{", "["):
        return _read_json(text, file)
    if is_result(text):
        return read_csv(text, file)
    return _read_listing(text, file)


def _fail(message: str, file: str, line: int = 0, column: int = 1) -> ReadError:
    return ReadError("E110", message, place=Source(file, "").place(line, column))


def _read_json(text: str, file: str) -> list[WrittenResult]:
    try:
        content = json.loads(text)
    except (RecursionError, ValueError) as error:
        if isinstance(error, json.JSONDecodeError) and _is_lines(text, error):
            return _read_lines(text, file)
        raise _no_json(error, file) from None
    documents = content if isinstance(content, list) else [content]
    if not documents:
        raise _fail("an empty array; expected at least one result", file)
    return [_report(document, file, number) for number, document in enumerate(documents, 1)]


def _is_lines(text: str, error: json.JSONDecodeError) -> bool:
    """Whether what is no JSON is JSON lines, of which one may be broken.

    The first object ends in its line, or objects begin in more lines than one.
    """
    if text.lstrip()[:1] != "{":
        return False
    ended = error.msg == "Extra data" and "\n" not in text[: error.pos].strip()
    begun = [line for line in text.split("\n") if line[:1] == "{" != line.strip()]
    return ended or len(begun) > 1


def _read_lines(text: str, file: str) -> list[WrittenResult]:
    """JSON lines: a result each; empty lines do not count as results."""
    results: list[WrittenResult] = []
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        try:
            results.append(_report(json.loads(line), file, len(results) + 1, number))
        except (RecursionError, ValueError) as error:
            raise _no_json(error, file, number) from None
    return results


def _no_json(error: Exception, file: str, line: int = 0) -> ReadError:
    if isinstance(error, json.JSONDecodeError):
        return _fail(f"no JSON: {error.msg}", file, line or error.lineno, error.colno)
    return _fail(f"no JSON that can be read: {error}", file, line)


def _report(document: Any, file: str, number: int, line: int = 0) -> WrittenResult:
    if not isinstance(document, dict):
        message = f"result {number} is no JSON object; expected one of `vstatics run`"
        raise _fail(message, file, line)
    if "errors" in document:
        return WrittenResult({}, None, printed=False, errors=True, file=_file(document))
    tables = {}
    for quantity in QUANTITIES:
        key = quantity.key
        if key in document:
            rows = document[key]
            try:
                rows_of_table = [rows] if quantity.rows == "one" else rows
                tables[key] = [[_from_json(value) for value in row] for row in rows_of_table]
            except (TypeError, ValueError, OverflowError):
                message = f"{key} of result {number} is no table of numbers"
                raise _fail(message, file, line) from None
    if not tables:
        known = ", ".join(quantity.key for quantity in QUANTITIES[:3])
        raise _fail(f"result {number} has none of the tables {known}, ...", file, line)
    case = _case(json.dumps(document.get("case")), "json")
    rows = _row_names(document.get("rows"), tables)
    return WrittenResult(tables, case, printed=False, rows=rows, file=_file(document))


def _file(document: Mapping[str, Any]) -> str:
    """The file of a result, if it tells."""
    file = document.get("file")
    return file if isinstance(file, str) else ""


def _row_names(given: Any, tables: Mapping[str, Figures]) -> dict[str, list[str]]:
    """The names of the rows of each table that has as many."""
    return {
        table: [str(name) for name in names]
        for table, names in (given.items() if isinstance(given, dict) else ())
        if table in tables and isinstance(names, list) and len(names) == len(tables[table])
    }


def _from_json(value: Any) -> Figure:
    if isinstance(value, str):
        raise TypeError(value)
    return Figure(math.nan if value is None else float(value))


def _case(text: str, kind: Format) -> Transmission | None:
    """The case that a result tells of, if it does."""
    try:
        return read(text.encode(), "", format=kind).case
    except ReadError:
        return None


def _read_listing(text: str, file: str) -> list[WrittenResult]:
    """A report begins at each KJG= that follows a table."""
    reports: list[WrittenResult] = []
    tables: dict[str, Figures] = {}
    names: dict[str, list[str]] = {}
    first, table = 0, ""
    lines = Source(file, text).lines
    for number, line in enumerate([*lines, "KJG="]):
        field = head(line)
        if field == "KJG" and tables:
            case, named = _case("\n".join(lines[first:number]), "deck"), _row_names(names, tables)
            reports.append(WrittenResult(tables, case, printed=True, rows=named))
            tables, names, first, table = {}, {}, number, ""
        elif field in PRINTED:
            table = PRINTED[field].key
            tables.setdefault(table, [])
        elif table and line.strip():
            numbers, is_named, name = line.partition(BEFORE_NAME)
            figures = _figures(numbers.split())
            if figures is None:
                table = ""
            else:
                tables[table].append(figures)
                names.setdefault(table, []).extend([name.strip()] * bool(is_named))
    if not reports:
        raise _fail("no table of results found; expected a listing or JSON of `vstatics run`", file)
    return reports


def _figures(words: Sequence[str]) -> list[Figure] | None:
    """The numbers of a printed row, or None if it is something else."""
    figures = []
    for word in words:
        if set(word) == {"*"}:
            figures.append(Figure(math.nan))
            continue
        mantissa, _, exponent = word.upper().replace("D", "E").partition("E")
        _, point, decimals = mantissa.partition(".")
        try:
            value = float(word.upper().replace("D", "E"))
            scale = int(exponent or 0) - len(decimals)
            slack = 0.5 * 10.0**scale if point else 0.0
        except (ValueError, OverflowError):
            return None
        figures.append(Figure(value, slack))
    return figures


COLUMNS = ["table", "row", "gear", "value"]
_Cells = dict[str, dict[str, dict[str, Figure]]]
"""Of a result: table, row, and gear or device."""


def is_result(text: str) -> bool:
    """Whether a text begins as such a file does."""
    return text.partition("\n")[0].strip().split(",") in (COLUMNS, ["case", *COLUMNS])


def read_csv(text: str, file: str) -> list[WrittenResult]:
    """The results of a file in their order.

    Raises
    ------
    ReadError
        If a line has no number, or belongs to no table.
    """
    lines = _csv_lines(text, file)
    has_case = next(lines)[1][0] == "case"
    results: dict[str, _Cells] = {}
    for number, row in lines:
        cells = [unguarded(cell) for cell in row]
        case = cells.pop(0) if has_case and cells else ""
        if not cells or cells[0] == "conventions":
            continue
        if len(cells) != len(COLUMNS) or cells[0] not in BY_NAME:
            message = "no row of a result in CSV: expected table,row,gear,value"
            raise _fail(message, file, number)
        table, name, gear, value = cells
        if BY_NAME[table].columns == "devices":
            name, _, gear = name.rpartition(":")
        try:
            figure = Figure(float(value) if value else math.nan)
        except ValueError:
            raise _fail(f"read {value!r}, expected a number", file, number) from None
        results.setdefault(case, {}).setdefault(table, {}).setdefault(name, {})[gear] = figure
    if not results:
        raise _fail("no result in it", file)
    return [_result(case, cells) for case, cells in results.items()]


def _csv_lines(text: str, file: str) -> Iterator[tuple[int, list[str]]]:
    """Lines of CSV, which a carriage return alone ends, too, each with its number."""
    lines = csv.reader(io.StringIO(text, newline=None))
    try:
        for row in lines:
            yield lines.line_num, row
    except csv.Error as error:
        raise _fail(f"no CSV: {error}", file, lines.line_num) from None


def _result(file: str, tables: _Cells) -> WrittenResult:
    figures, rows = {}, {}
    gears: Sequence[str] = ()
    for key, table in tables.items():
        figures[key] = [list(row.values()) for row in table.values()]
        if BY_NAME[key].rows != "one":
            rows[key] = list(table)
        if BY_NAME[key].columns != "devices":
            gears = max(gears, list(next(iter(table.values()))), key=len)
    name = os.path.basename(file)  # noqa: PTH119
    return WrittenResult(figures, None, printed=False, rows=rows, file=name, gears=gears)
